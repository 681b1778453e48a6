"""What holds for every bond model: an energy, loads that are its gradient, and nothing for free."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.parts.bond_model import BondLoad, Strain
from tests.support.bonds import (
    GEOMETRY,
    KEY,
    L0,
    SHAPE_FACTORS,
    WRITTEN,
    YIELD,
    R,
    bending_stress,
    follow,
    law,
    respond,
    scaled,
    strains,
    swapped,
    torsion_stress,
)
from tests.support.bonds import normal_stress as sigma
from tests.support.bonds import shear_stress as tau
from tests.support.strategies import assert_close, assert_turned, negated, rotate, rotation

every_law = pytest.mark.parametrize("name", WRITTEN)
ALLOWED_MODES = {
    True: ("strain in tension", "strain in bending", "strain in shear", "strain in torsion"),
    False: ("strain in compression", "strain in bending", "strain in shear", "strain in torsion"),
}
paths = st.lists(strains(), min_size=1, max_size=12)


def flat(record: Strain | BondLoad) -> list[float]:
    return [record[0], *record[1], record[2], *record[3]]


def shifted(strain: Strain, component: int, by: float) -> Strain:
    values = flat(strain)
    values[component] += by
    return Strain(values[0], tuple(values[1:4]), values[4], tuple(values[5:8]))


def work(load: BondLoad, before: Strain, after: Strain) -> float:
    return sum(f * (b - a) for f, a, b in zip(flat(load), flat(before), flat(after), strict=True))


@every_law
def test_an_undeformed_bond_carries_nothing_stores_nothing_and_is_far_from_breaking(name):
    model, c, start = law(name)
    rest = Strain(0.0, (0.0, 0.0, 0.0), 0.0, (0.0, 0.0, 0.0))
    load = model.load(rest, c, start)
    assert flat(load) == [0.0] * 8
    assert model.energy(rest, c, start) == 0.0
    assert model.failure(rest, load, c, start) == 0.0


@every_law
@settings(max_examples=60, deadline=None)
@given(path=paths)
def test_the_stored_energy_is_never_negative(name, path):
    bond = law(name)
    for strain, response in zip(path, follow(bond, path), strict=True):
        assert bond.model.energy(strain, bond.constants, response.state) >= 0.0


@every_law
@settings(max_examples=30, deadline=None)
@given(path=paths)
def test_the_load_is_the_gradient_of_the_energy_at_fixed_state(name, path):
    """A bond may answer otherwise when pressed than when pulled, so a way through 0 is walked in two parts."""
    model, c, _ = bond = law(name)
    strain, state = path[-1], follow(bond, path)[-1].state
    sizes = [L0] * 4 + [1.0] * 4
    for component, size in enumerate(sizes):
        here, h = flat(strain)[component], 1e-3 * size
        places = sorted({-h, min(max(-here, -h), h), h})
        way = [shifted(strain, component, place) for place in places]
        loads = [flat(model.load(each, c, state))[component] for each in way]
        mean = sum(0.5 * (a + b) * (q - p) for a, b, p, q in zip(loads, loads[1:], places, places[1:], strict=False))
        down, up = (model.energy(each, c, state) for each in (way[0], way[-1]))
        assert (up - down) / (2.0 * h) == pytest.approx(mean / (2.0 * h), rel=1e-9, abs=1e-9 * (up + down) / size)


@every_law
@settings(max_examples=30, deadline=None)
@given(corners=st.lists(strains(0.0008), min_size=2, max_size=6))
def test_a_closed_elastic_path_gives_and_takes_no_energy(name, corners):
    bond = law(name)
    rest = scaled(corners[0], 0.0)
    path = [rest, *corners, rest]
    told = follow(bond, path)
    assert all(response.state == bond.start for response in told)
    parts = [
        0.5 * (work(a.load, p, q) + work(b.load, p, q))
        for a, b, p, q in zip(told, told[1:], path, path[1:], strict=False)
    ]
    assert_close(sum(parts), 0.0, 1e-13, sum(abs(part) for part in parts))


@every_law
@settings(max_examples=40, deadline=None)
@given(path=paths)
def test_swapping_the_ends_mirrors_every_answer_to_the_bit(name, path):
    bond = law(name)
    here, there = follow(bond, path), follow(bond, [swapped(strain) for strain in path])
    for a, b, strain in zip(here, there, path, strict=True):
        assert b.load == BondLoad(a.load.normal, negated(a.load.shear), a.load.torsion, negated(a.load.bending))
        assert b.index == a.index
        energies = [bond.model.energy(s, bond.constants, r.state) for s, r in ((strain, a), (swapped(strain), b))]
        assert energies[0] == energies[1]


@every_law
@settings(max_examples=40, deadline=None)
@given(path=paths, angle=st.floats(0.0, 6.0))
def test_a_bond_turned_about_its_axis_answers_with_turned_loads(name, path, angle):
    bond, q = law(name), rotation((1.0, 0.0, 0.0), angle)
    turned = [s._replace(shear=rotate(q, s.shear), bending=rotate(q, s.bending)) for s in path]
    for a, b in zip(follow(bond, path), follow(bond, turned), strict=True):
        if a.index >= 1.0 - 1e-9:
            break
        assert b.index == pytest.approx(a.index, rel=1e-9, abs=1e-12)
        assert_turned(b.load.shear, a.load.shear, q, YIELD * float(GEOMETRY.A), 1e-9)
        assert_turned(b.load.bending, a.load.bending, q, YIELD * float(GEOMETRY.I) / R, 1e-9)


@every_law
def test_the_stiffness_is_the_slope_of_the_load(name):
    model, c, start = law(name)
    told = model.stiffness(model.Params(**WRITTEN[name][1]), GEOMETRY)
    small = Strain(1e-6 * L0, (0.0, 1e-6 * L0, 0.0), 1e-6, (0.0, 0.0, 1e-6))
    load = model.load(small, c, start)
    found = (
        load.normal / small.axial,
        load.shear[1] / (1e-6 * L0),
        load.torsion / 1e-6,
        load.bending[2] / 1e-6,
    )
    assert found == pytest.approx([float(k) for k in told], rel=1e-13)


@every_law
@settings(max_examples=60, deadline=None)
@given(strain=strains(), factor=st.floats(0.0, 0.999))
def test_the_failure_index_grows_in_proportion_to_the_strain_so_it_meets_1_nowhere_else(name, strain, factor):
    model, c, start = law(name)

    def index(s: Strain) -> float:
        return model.failure(s, model.load(s, c, start), c, start)

    assert index(scaled(strain, factor)) == pytest.approx(factor * index(strain), rel=1e-12, abs=1e-14)


@every_law
@settings(max_examples=60, deadline=None)
@given(strain=strains(0.03))
def test_a_break_has_a_named_mode_that_agrees_with_the_strain(name, strain):
    bond = law(name)
    state, load, _ = respond(bond, strain, bond.start)
    mode = bond.model.modes[bond.model.mode(strain, load, bond.constants, state)]
    if "breakage_strain" not in WRITTEN[name][1]:
        only_tension = "normal_strength" in WRITTEN[name][1] and "shear_strength" not in WRITTEN[name][1]
        assert mode in (("tension",) if only_tension else ("tension", "shear", "opening", "sliding"))
    elif len(bond.model.modes) > 2:
        assert mode in ALLOWED_MODES[strain.axial > 0.0]
    else:
        assert mode == ("strain in tension" if strain.axial > 0.0 else "strain in compression")


@pytest.mark.parametrize("name", [name for name in WRITTEN if "yield_stress" in WRITTEN[name][1]])
@settings(max_examples=80, deadline=None)
@given(path=paths)
def test_no_stress_is_above_the_yield_stress_once_the_law_has_answered(name, path):
    for response in follow(law(name), path):
        if response.index < 1.0:
            assert abs(sigma(response.load)) <= YIELD * (1.0 + 1e-12)
            assert tau(response.load) <= YIELD * (1.0 + 1e-12)


@pytest.mark.parametrize("name", [name for name in WRITTEN if name.split(", ")[-1] in SHAPE_FACTORS])
@settings(max_examples=80, deadline=None)
@given(path=paths)
def test_no_moment_is_above_its_limit_once_the_law_has_answered(name, path):
    in_bending, in_torsion = SHAPE_FACTORS[name.split(", ")[-1]]
    for response in follow(law(name), path):
        if response.index < 1.0:
            assert bending_stress(response.load) <= in_bending * YIELD * (1.0 + 1e-12)
            assert abs(torsion_stress(response.load)) <= in_torsion * YIELD * (1.0 + 1e-12)


def plastic_measures(state: Any) -> list[float]:
    """Return the plastic part of every strain measure: axial, shear, twist, bending."""
    axis, fibre = (state.axis, state.fibre) if hasattr(state, "axis") else (state, None)
    angles = (fibre.torsion, *fibre.bending) if fibre else (0.0,) * 4
    return [L0 * axis.axial_plastic, *(L0 * g for g in axis.shear_plastic), *(L0 / R * a for a in angles)]


@pytest.mark.parametrize("name", [name for name in WRITTEN if name.startswith("elastic_plastic")])
@settings(max_examples=80, deadline=None)
@given(path=paths)
def test_plastic_flow_only_dissipates(name, path):
    bond = law(name)
    before = plastic_measures(bond.start)
    for response in follow(bond, path):
        after, load = plastic_measures(response.state), flat(response.load)
        spent = [f * (b - a) for f, a, b in zip(load, before, after, strict=True)]
        for part in (spent[:1], spent[1:4], spent[4:5], spent[5:]):
            size = sum(abs(f * b) for f, b in zip(load, after, strict=True))
            assert math.fsum(part) >= -1e-12 * size
        before = after


@pytest.mark.parametrize("name", [name for name in WRITTEN if name.startswith("micro")])
@settings(max_examples=80, deadline=None)
@given(path=paths)
def test_every_micro_crack_releases_energy(name, path):
    model, c, state = law(name)
    for strain in path:
        while model.overload(strain, c, state) > 1.0:
            after = model.on_event(strain, c, state, KEY)
            assert model.energy(strain, c, after) < model.energy(strain, c, state)
            state = after

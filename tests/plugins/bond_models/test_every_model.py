"""What holds for every bond model: an energy, loads that are its gradient, and nothing for free."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.parts.bond_model import BondLoad, Strain
from tests.support.bonds import GEOMETRY, KEY, L0, WRITTEN, YIELD, follow, law, respond, scaled, strains
from tests.support.bonds import normal_stress as sigma
from tests.support.bonds import shear_stress as tau
from tests.support.strategies import assert_close

every_law = pytest.mark.parametrize("name", WRITTEN)
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
    model, c, _ = bond = law(name)
    strain, state = path[-1], follow(bond, path)[-1].state
    sizes = [L0] * 4 + [1.0] * 4
    for component, (load, size) in enumerate(zip(flat(model.load(strain, c, state)), sizes, strict=True)):
        h = 1e-3 * size
        up, down = (model.energy(shifted(strain, component, s * h), c, state) for s in (1.0, -1.0))
        assert (up - down) / (2.0 * h) == pytest.approx(load, rel=1e-9, abs=1e-9 * (up + down) / size)


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
    if name.startswith("elastic,"):
        assert mode == "tension"
    elif name == "elastic":
        assert mode in ("tension", "shear")
    else:
        assert mode == ("strain in tension" if strain.axial > 0.0 else "strain in compression")


@pytest.mark.parametrize("name", [name for name in WRITTEN if not name.startswith("elastic,") and name != "elastic"])
@settings(max_examples=80, deadline=None)
@given(path=paths)
def test_no_stress_is_above_the_yield_stress_once_the_law_has_answered(name, path):
    for response in follow(law(name), path):
        if response.index < 1.0:
            assert abs(sigma(response.load)) <= YIELD * (1.0 + 1e-12)
            assert tau(response.load) <= YIELD * (1.0 + 1e-12)


@pytest.mark.parametrize("name", ["elastic_plastic", "elastic_plastic, K"])
@settings(max_examples=80, deadline=None)
@given(path=paths)
def test_plastic_flow_only_dissipates(name, path):
    bond = law(name)
    before = bond.start
    for response in follow(bond, path):
        after, load = response.state, response.load
        normal = load.normal * (after.axial_plastic - before.axial_plastic)
        shear = math.fsum(
            t * (b - a) for t, a, b in zip(load.shear, before.shear_plastic, after.shear_plastic, strict=True)
        )
        assert normal >= 0.0
        assert shear >= -1e-12 * tau(load) * float(GEOMETRY.A)
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

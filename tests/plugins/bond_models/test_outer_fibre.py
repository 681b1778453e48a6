"""Bending and torsion that yield, drop and break bonds: closed forms, and what the options leave alone."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from clast.engine.records import numbers as row_of
from clast.engine.records import width
from clast.maths.vec3 import ZERO, add, scale
from clast.parts.bond_model import BondLoad, RandomKey, Strain
from tests.support.bonds import (
    BREAKAGE,
    GEOMETRY,
    L0,
    SHAPE_FACTORS,
    SHEAR_BREAKAGE,
    YIELD,
    E,
    G,
    R,
    bending_stress,
    bent,
    follow,
    law,
    ramp,
    respond,
    scaled,
    shares,
    strains,
    stretch,
    torsion_stress,
    twisted,
)
from tests.support.strategies import directions, numbers

HAIR = 1e-12
LIMITS = {"fibre": "outer_fibre", "section": "full_section"}
each_limit = pytest.mark.parametrize("limit", LIMITS)
steps = st.integers(1, 200)


def along_y(load: BondLoad) -> float:
    return load.bending[1] * R / float(GEOMETRY.I)


MOMENTS: dict[str, tuple[int, float, Callable[[float], Strain], Callable[[BondLoad], float]]] = {
    "bending": (0, E, bent, along_y),
    "torsion": (1, G, twisted, torsion_stress),
}
each_moment = pytest.mark.parametrize("moment", MOMENTS)


def combined(epsilon: float, gamma: float, bending: float, torsion: float) -> Strain:
    strain = stretch(epsilon, gamma)
    return strain._replace(twist=twisted(torsion).twist, bending=bent(bending).bending)


def without_breaking(name: str, limit: str):
    return law(name, moment_limit=LIMITS[limit], breakage_strain=1.0)


@pytest.mark.parametrize("name", ["elastic_plastic", "micro_cracking"])
def test_who_does_not_ask_for_moments_gets_the_law_without_them(name):
    plain, limited = law(name), law(name, moment_limit="outer_fibre")
    assert (width(type(limited.start)) - width(type(plain.start))) == (4 if name == "elastic_plastic" else 6)
    assert plain.model.modes == ("strain in tension", "strain in compression")
    assert limited.model.modes[2:] == ("strain in bending", "strain in shear", "strain in torsion")
    assert law(name, breakage_strain_at="outer_fibre").model == limited.model
    assert law(name, breakage_shear_strain=0.1).model == limited.model


@each_moment
def test_the_limits_are_the_moments_of_a_yielding_disc(moment):
    """Integrate σ_y over the section: everywhere for the full section, growing with the distance up to the rim else."""
    component, _, deform, _ = MOMENTS[moment]
    r, dr = np.linspace(0.0, R, 20001, retstep=True)
    r = r[:-1] + 0.5 * dr
    around = 2.0 * math.pi if moment == "torsion" else 4.0  # of 1, and of |sin|
    squared = 2.0 * math.pi if moment == "torsion" else math.pi  # of 1, and of sin²
    full = float((YIELD * around * r**2).sum() * dr)
    first = float((YIELD * r / R * squared * r**2).sum() * dr)
    for limit, expected in (("fibre", first), ("section", full)):
        told = respond(bond := without_breaking("elastic_plastic", limit), deform(0.5), bond.start).load
        found = told.torsion if moment == "torsion" else math.hypot(*told.bending)
        assert found == pytest.approx(expected, rel=1e-8)
        assert SHAPE_FACTORS[limit][component] == pytest.approx(expected / first, rel=1e-8)


@each_limit
@each_moment
@settings(max_examples=40, deadline=None)
@given(reach=numbers(1.0, 6.0), back=numbers(0.0, 4.0), sign=st.sampled_from([1.0, -1.0]), count=steps)
def test_a_moment_of_model_2_grows_stays_unloads_elastically_and_yields_the_other_way(
    limit, moment, reach, back, sign, count
):
    component, modulus, deform, stress = MOMENTS[moment]
    at_limit = SHAPE_FACTORS[limit][component] * YIELD
    strain = sign * at_limit / modulus  # at which the moment reaches its limit
    out = [deform(reach * strain * k / count) for k in range(1, count + 1)]
    home = [deform((reach - back * k / count) * strain) for k in range(1, count + 1)]
    told = follow(without_breaking("elastic_plastic", limit), out + home)
    expected = [min(reach * k / count, 1.0) for k in range(1, count + 1)]
    expected += [max(1.0 - back * k / count, -1.0) for k in range(1, count + 1)]
    found = [sign * stress(response.load) / at_limit for response in told]
    assert found == pytest.approx(expected, rel=1e-11, abs=1e-11)


@each_limit
@each_moment
@settings(max_examples=40, deadline=None)
@given(reach=numbers(1.0, 6.0))
def test_a_cycle_of_model_2_costs_four_times_the_limit_and_the_reach_beyond_it(limit, moment, reach):
    component, modulus, deform, _ = MOMENTS[moment]
    at_limit = SHAPE_FACTORS[limit][component] * YIELD
    bond, angle = without_breaking("elastic_plastic", limit), at_limit / modulus * L0 / R
    corners = [reach, reach - 2.0, -reach, 2.0 - reach, reach]
    path = [deform(c * at_limit / modulus) for c in corners]
    told = follow(bond, path)
    loads = [r.load.torsion if moment == "torsion" else r.load.bending[1] for r in told]
    work = sum(
        0.5 * (a + b) * (q - p) * angle for a, b, p, q in zip(loads, loads[1:], corners, corners[1:], strict=False)
    )
    modulus_of_section = float(GEOMETRY.I) / R * (2.0 if moment == "torsion" else 1.0)
    unit_work = at_limit * modulus_of_section * angle
    assert work == pytest.approx(4.0 * unit_work * (reach - 1.0), rel=1e-10, abs=1e-10 * unit_work)


@each_limit
@each_moment
@pytest.mark.parametrize("fixed", [None, 0.4])
@settings(max_examples=40, deadline=None)
@given(strain=numbers(0.0, 0.02), count=steps)
def test_a_moment_of_model_3_is_a_sawtooth_of_its_own_draws_that_does_not_depend_on_the_step(
    limit, moment, fixed, strain, count
):
    component, modulus, deform, stress = MOMENTS[moment]
    number = {"torsion": 2, "bending": 3}[moment]
    at_limit = SHAPE_FACTORS[limit][component] * YIELD
    left = shares(500, component=number) if fixed is None else [fixed] * 500
    bond = law("micro_cracking", moment_limit=LIMITS[limit], breakage_strain=1.0, fixed_drop=fixed)
    last = follow(bond, ramp(deform(strain), count))[-1]
    expected, drops = modulus * strain, 0
    while expected > at_limit:
        expected, drops = expected - (1.0 - left[drops]) * at_limit, drops + 1
    assume(abs(expected / at_limit - 1.0) > 1e-9)
    assert stress(last.load) == pytest.approx(expected, rel=1e-9, abs=1e-9 * YIELD)
    had = last.state.torsion_drops if moment == "torsion" else last.state.bending_drops
    assert had == drops
    assert last.state.axis == bond.start.axis


@settings(max_examples=40, deadline=None)
@given(end=strains(0.03), count=steps)
def test_model_2_forgets_how_finely_a_straight_path_of_all_strains_was_walked(end, count):
    bond = law("elastic_plastic, fibre")
    once, often = follow(bond, [end])[-1].load, follow(bond, ramp(end, count))[-1].load
    sizes = [YIELD * float(GEOMETRY.A)] * 4 + [YIELD * float(GEOMETRY.I) / R] * 4
    for a, b, size in zip(
        [once.normal, *once.shear, once.torsion, *once.bending],
        [often.normal, *often.shear, often.torsion, *often.bending],
        sizes,
        strict=True,
    ):
        assert a == pytest.approx(b, rel=1e-10, abs=1e-10 * size)


@settings(max_examples=30, deadline=None)
@given(
    strain=st.tuples(numbers(0.0, 0.007), numbers(0.0, 0.01), numbers(0.0, 0.01), numbers(0.0, 0.01)),
    order=st.permutations(range(4)),
)
def test_the_order_in_which_the_four_drop_does_not_matter(strain, order):
    bond = law("micro_cracking", moment_limit="outer_fibre")
    parts, path = [0.0] * 4, []
    for k in order:
        parts[k] = strain[k]
        path.append(combined(*parts))
    together, apart = follow(bond, [path[-1]])[-1].state, follow(bond, path)[-1].state
    assert row_of(together) == pytest.approx(row_of(apart), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("over", [1.001, 1.5, 2.0])
@each_moment
def test_drops_of_moments_from_the_trial_stress_keep_the_share_of_that_stress(moment, over):
    _, modulus, deform, stress = MOMENTS[moment]
    bond = law("micro_cracking, trial", fixed_drop=0.25, moment_limit="outer_fibre", breakage_strain=1.0)
    told = respond(bond, deform(over * YIELD / modulus), bond.start)
    assert stress(told.load) == pytest.approx(0.25 * over * YIELD, rel=1e-12)


def test_every_component_of_every_bond_draws_for_itself():
    bond = law("micro_cracking", moment_limit="outer_fibre", breakage_strain=1.0)
    path = ramp(combined(0.007, 0.016, 0.007, 0.016), 30)

    def state(number: int) -> tuple[float, ...]:
        told = follow(bond, path, RandomKey(1, number))[-1].state
        return (
            told.axis.axial_plastic,
            math.hypot(*told.axis.shear_plastic),
            told.fibre.torsion,
            told.fibre.bending[1],
        )

    assert len({value for number in range(10) for value in state(number)}) == 40
    assert state(3) == state(3)


@settings(max_examples=40, deadline=None)
@given(path=st.lists(strains(), min_size=1, max_size=8))
def test_without_a_limit_the_moments_stay_those_of_the_elastic_bond(path):
    free = follow(law("elastic_plastic, break"), path)
    for response, plain in zip(free, follow(law("elastic_plastic"), path), strict=True):
        assert (response.load.normal, response.load.shear) == (plain.load.normal, plain.load.shear)
        assert response.load.torsion == pytest.approx(plain.load.torsion, rel=1e-14)
        assert response.load.bending == pytest.approx(plain.load.bending, rel=1e-14)
        assert response.state.fibre == (0.0, ZERO)


@settings(max_examples=40, deadline=None)
@given(path=st.lists(strains(), min_size=1, max_size=8), limit=st.sampled_from(list(LIMITS)))
def test_a_limit_of_moments_changes_neither_normal_nor_shear_nor_breakage(path, limit):
    for name in ("elastic_plastic, K", "micro_cracking, fixed"):
        limited = follow(law(name, moment_limit=LIMITS[limit]), path)
        for response, plain in zip(limited, follow(law(name), path), strict=True):
            assert (response.load.normal, response.load.shear) == (plain.load.normal, plain.load.shear)
            assert response.index == plain.index


FIBRE = ("elastic_plastic, fibre", "micro_cracking, fibre")
CRITICAL = {
    "stretching": (stretch(BREAKAGE), "strain in tension"),
    "stretching and some bending": (combined(0.6 * BREAKAGE, 0.0, 0.4 * BREAKAGE, 0.0), "strain in tension"),
    "bending": (bent(BREAKAGE), "strain in bending"),
    "bending and some stretching": (combined(0.4 * BREAKAGE, 0.0, 0.6 * BREAKAGE, 0.0), "strain in bending"),
    "bending of a shortened bond": (combined(-0.3 * BREAKAGE, 0.0, 1.3 * BREAKAGE, 0.0), "strain in bending"),
    "shortening": (stretch(-2.0 * BREAKAGE), "strain in compression"),
    "shortening and some bending": (combined(-1.8 * BREAKAGE, 0.0, 0.2 * BREAKAGE, 0.0), "strain in compression"),
    "shearing": (stretch(0.0, SHEAR_BREAKAGE), "strain in shear"),
    "shearing and some twisting": (combined(0.0, 0.7 * SHEAR_BREAKAGE, 0.0, 0.3 * SHEAR_BREAKAGE), "strain in shear"),
    "twisting": (twisted(SHEAR_BREAKAGE), "strain in torsion"),
    "twisting back and some shearing": (
        combined(0.0, 0.3 * SHEAR_BREAKAGE, 0.0, -0.7 * SHEAR_BREAKAGE),
        "strain in torsion",
    ),
}


@pytest.mark.parametrize("name", FIBRE)
@pytest.mark.parametrize("case", CRITICAL)
def test_the_outermost_fibre_breaks_exactly_at_its_strain_and_tells_how(name, case):
    critical, mode = CRITICAL[case]
    bond = law(name)
    below, above = (respond(bond, scaled(critical, 1.0 + s * HAIR), bond.start) for s in (-1.0, 1.0))
    assert below.index < 1.0 <= above.index
    assert above.index == pytest.approx(1.0, rel=1e-11)
    assert bond.model.modes[bond.model.mode(critical, above.load, bond.constants, above.state)] == mode


@pytest.mark.parametrize("name", ["elastic_plastic", "micro_cracking"])
def test_at_the_axis_a_shear_limit_knows_no_twist_and_a_strain_limit_no_bending(name):
    bond = law(name, breakage_shear_strain=SHEAR_BREAKAGE)
    turned = combined(0.5 * BREAKAGE, 0.5 * SHEAR_BREAKAGE, 10.0, 10.0)
    assert respond(bond, turned, bond.start).index == pytest.approx(0.5, rel=1e-12)


@settings(max_examples=40, deadline=None)
@given(about=directions(), other=directions(), reach=numbers(1.0, 4.0))
def test_bending_about_another_axis_turns_the_moment_towards_it_at_its_limit(about, other, reach):
    bond = without_breaking("elastic_plastic", "fibre")
    first, second = bent(reach * YIELD / E, about), bent(10.0 * reach * YIELD / E, other)
    there = Strain(0.0, ZERO, 0.0, add(first.bending, second.bending))
    told = follow(bond, [first, there])
    start, end = (np.array(r.load.bending) for r in told)
    step = np.array(scale(1.0, second.bending))
    assert bending_stress(told[1].load) == pytest.approx(YIELD, rel=1e-12)
    assert end @ step >= start @ step - 1e-12 * np.linalg.norm(start) * np.linalg.norm(step)

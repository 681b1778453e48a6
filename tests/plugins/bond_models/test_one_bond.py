"""One bond pulled, pushed, sheared, twisted and bent: closed forms, among them Fig. 5 of the paper."""

from __future__ import annotations

import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from clast.maths.vec3 import scale
from clast.parts.bond_model import RandomKey, Strain
from tests.support.bonds import (
    BREAKAGE,
    GEOMETRY,
    KEY,
    L0,
    SHEAR_STRENGTH,
    STRENGTH,
    YIELD,
    E,
    G,
    R,
    follow,
    law,
    normal_stress,
    ramp,
    respond,
    scaled,
    shares,
    shear_stress,
    stretch,
)
from tests.support.strategies import directions, numbers

HAIR = 1e-12
MICRO = ("micro_cracking", "micro_cracking, fixed")
steps = st.integers(1, 200)


def index(bond, strain: Strain) -> float:
    return respond(bond, strain, bond.start).index


def sawtooth(epsilon: float, left: list[float], modulus: float = E) -> tuple[float, int]:
    """Return stress and number of drops of Model 3 at a strain, each drop leaving its share of the yield stress."""
    stress, drops = modulus * epsilon, 0
    while stress > YIELD:
        stress -= (1.0 - left[drops]) * YIELD
        drops += 1
    return stress, drops


@settings(max_examples=40, deadline=None)
@given(share=numbers(0.0, 0.999))
def test_fig_5_model_1_is_a_straight_line_up_to_its_strength(share):
    bond = law("elastic")
    told = respond(bond, stretch(share * STRENGTH / E), None)
    assert normal_stress(told.load) == pytest.approx(share * STRENGTH, rel=1e-13)
    assert told.index == pytest.approx(share, rel=1e-13)


@settings(max_examples=40, deadline=None)
@given(epsilon=numbers(0.0, 0.999 * BREAKAGE), count=steps)
def test_fig_5_model_2_is_a_straight_line_and_a_plateau_up_to_its_strain(epsilon, count):
    told = follow(law("elastic_plastic"), ramp(stretch(epsilon), count))
    expected = [min(E * epsilon * k / count, YIELD) for k in range(1, count + 1)]
    assert [normal_stress(r.load) for r in told] == pytest.approx(expected, rel=1e-12)
    assert all(r.index < 1.0 for r in told)


@pytest.mark.parametrize(("name", "left"), [(MICRO[0], shares(500)), (MICRO[1], [0.4] * 500)])
@settings(max_examples=40, deadline=None)
@given(epsilon=numbers(0.0, 0.999 * BREAKAGE), count=steps)
def test_fig_5_model_3_is_a_sawtooth_that_does_not_depend_on_the_step(name, left, epsilon, count):
    last = follow(law(name), ramp(stretch(epsilon), count))[-1]
    stress, drops = sawtooth(epsilon, left)
    assume(abs(stress / YIELD - 1.0) > 1e-9)
    assert last.state.normal_drops == drops
    assert normal_stress(last.load) == pytest.approx(stress, rel=1e-10, abs=1e-9 * YIELD)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_model_3_drops_alike_in_tension_and_in_compression(sign):
    last = follow(law("micro_cracking"), ramp(stretch(sign * 0.007), 50))[-1]
    assert normal_stress(last.load) == pytest.approx(sign * sawtooth(0.007, shares(50))[0], rel=1e-10)


@settings(max_examples=40, deadline=None)
@given(gamma=numbers(0.0, 0.02), across=directions(), count=steps)
def test_model_3_in_shear_is_the_same_sawtooth_with_its_own_random_numbers(gamma, across, count):
    last = follow(law("micro_cracking"), ramp(stretch(0.0, gamma, across), count))[-1]
    stress, drops = sawtooth(gamma, shares(500, component=1), G)
    assume(abs(stress / YIELD - 1.0) > 1e-9)
    assert last.state.shear_drops == drops
    assert shear_stress(last.load) == pytest.approx(stress, rel=1e-10, abs=1e-9 * YIELD)


@settings(max_examples=40, deadline=None)
@given(epsilon=numbers(-BREAKAGE, BREAKAGE), gamma=numbers(0.0, 0.02), across=directions(), count=steps)
def test_model_2_forgets_how_finely_a_straight_path_was_walked(epsilon, gamma, across, count):
    end = stretch(0.999 * epsilon, gamma, across)
    bond = law("elastic_plastic")
    once, often = follow(bond, [end])[-1], follow(bond, ramp(end, count))[-1]
    assert often.load.normal == pytest.approx(once.load.normal, rel=1e-11)
    assert often.load.shear == pytest.approx(once.load.shear, rel=1e-10, abs=1e-12 * YIELD * float(GEOMETRY.A))


@settings(max_examples=40, deadline=None)
@given(past=numbers(1.0, 5.0), back=numbers(0.0, 1.9))
def test_model_2_unloads_along_the_elastic_line(past, back):
    bond = law("elastic_plastic")
    top = YIELD / E * past
    told = follow(bond, [stretch(top), stretch(top - back * YIELD / E)])
    assert normal_stress(told[1].load) == pytest.approx((1.0 - back) * YIELD, rel=1e-11, abs=1e-11 * YIELD)
    assert told[1].state == told[0].state


@settings(max_examples=30, deadline=None)
@given(epsilon=numbers(0.0, 0.99 * BREAKAGE), gamma=numbers(0.0, 0.01))
def test_the_order_of_normal_and_shear_drops_does_not_matter(epsilon, gamma):
    bond = law("micro_cracking")
    first = follow(bond, [*ramp(stretch(epsilon), 9), stretch(epsilon, gamma)])[-1]
    second = follow(bond, [*ramp(stretch(0.0, gamma), 7), stretch(epsilon, gamma)])[-1]
    for a, b in zip(first.state, second.state, strict=True):
        assert a == pytest.approx(b, rel=1e-9, abs=1e-12)


def test_each_bond_and_each_seed_has_drops_of_its_own_and_the_same_ones_every_time():
    bond, path = law("micro_cracking"), ramp(stretch(0.007), 20)

    def plastic(key: RandomKey) -> float:
        return follow(bond, path, key)[-1].state.axial_plastic

    assert plastic(KEY) == plastic(RandomKey(*KEY))
    assert len({plastic(RandomKey(seed, number)) for seed in (1, 2) for number in range(20)}) == 40


@settings(max_examples=60, deadline=None)
@given(number=st.integers(0, 2**40), weakening=numbers(0.05, 1.0))
def test_a_drop_leaves_a_share_between_nothing_and_the_weakening_factor(number, weakening):
    bond = law("micro_cracking", weakening_factor=weakening)
    at_yield = stretch(YIELD / E * (1.0 + 1e-9))
    state = bond.model.on_event(at_yield, bond.constants, bond.start, RandomKey(3, number))
    left = normal_stress(bond.model.load(at_yield, bond.constants, state)) / YIELD
    assert 0.0 < left < weakening + 1e-8
    assert state.normal_drops == 1.0


@pytest.mark.parametrize("over", [1.001, 1.5, 2.0])
def test_drops_from_the_trial_stress_keep_the_share_of_that_stress(over):
    bond = law("micro_cracking, trial", fixed_drop=0.25)
    told = respond(bond, stretch(over * YIELD / E), bond.start)
    assert normal_stress(told.load) == pytest.approx(0.25 * over * YIELD, rel=1e-12)


def test_without_shear_drops_the_shear_stress_is_not_limited():
    told = respond(law("micro_cracking", shear_drops=False), stretch(0.0, 0.02), law("micro_cracking").start)
    assert shear_stress(told.load) == pytest.approx(0.02 * G, rel=1e-12)


CRITICAL = {
    "elastic in tension": (law, "elastic", stretch(STRENGTH / E), "tension"),
    "elastic in shear": (law, "elastic", stretch(0.0, SHEAR_STRENGTH / G), "shear"),
    "elastic in bending": (
        law,
        "elastic",
        Strain(0.0, (0, 0, 0), 0.0, (0.0, STRENGTH * L0 / (E * R), 0.0)),
        "tension",
    ),
    "elastic in torsion": (
        law,
        "elastic",
        Strain(0.0, (0, 0, 0), -SHEAR_STRENGTH * L0 / (G * R), (0, 0, 0)),
        "shear",
    ),
    "absolute in compression": (law, "elastic, absolute", stretch(-STRENGTH / E), "tension"),
    "plastic strain": (law, "elastic_plastic", stretch(BREAKAGE), "strain in tension"),
    "plastic K": (law, "elastic_plastic, K", stretch(-2.0 * BREAKAGE), "strain in compression"),
    "micro strain": (law, "micro_cracking", stretch(BREAKAGE), "strain in tension"),
    "micro K": (law, "micro_cracking, fixed", stretch(-2.0 * BREAKAGE), "strain in compression"),
}


@pytest.mark.parametrize("case", CRITICAL)
def test_a_bond_breaks_exactly_at_its_criterion_and_tells_how(case):
    make, name, critical, mode = CRITICAL[case]
    bond = make(name)
    assert index(bond, critical) == pytest.approx(1.0, rel=1e-14)
    assert index(bond, scaled(critical, 1.0 - HAIR)) < 1.0 <= index(bond, scaled(critical, 1.0 + HAIR))
    state, load, _ = respond(bond, scaled(critical, 1.0 + HAIR), bond.start)
    assert bond.model.modes[bond.model.mode(critical, load, bond.constants, state)] == mode


@settings(max_examples=60, deadline=None)
@given(sigma=numbers(-1.0, 1.0), bent=numbers(0.0, 1.0), about=directions(), absolute=st.booleans())
def test_model_1_breaks_where_tension_and_bending_together_reach_the_strength(sigma, bent, about, absolute):
    bond = law("elastic, absolute" if absolute else "elastic", shear_strength=None)
    bending = scale(bent * STRENGTH * L0 / (E * R), about)
    strain = Strain(sigma * STRENGTH / E * L0, (0.0, 0.0, 0.0), 0.0, bending)
    expected = (abs(sigma) if absolute else sigma) + bent
    assert index(bond, strain) == pytest.approx(max(expected, 0.0), rel=1e-12, abs=1e-13)


@settings(max_examples=60, deadline=None)
@given(sheared=numbers(0.0, 1.0), twisted=numbers(-1.0, 1.0), across=directions())
def test_model_1_breaks_where_shear_and_torsion_together_reach_the_shear_strength(sheared, twisted, across):
    slip = scale(sheared * SHEAR_STRENGTH / G * L0, across)
    strain = Strain(0.0, slip, twisted * SHEAR_STRENGTH * L0 / (G * R), (0.0, 0.0, 0.0))
    assert index(law("elastic"), strain) == pytest.approx(sheared + abs(twisted), rel=1e-12, abs=1e-15)
    assert index(law("elastic", shear_strength=None), strain) == 0.0


@pytest.mark.parametrize("name", ["elastic_plastic", "micro_cracking"])
def test_without_a_compressive_factor_no_compression_breaks_a_bond(name):
    assert index(law(name), stretch(-10.0 * BREAKAGE)) <= 0.0


def test_a_bond_twice_as_thick_is_four_times_as_stiff_against_stretching_and_sixteen_against_bending():
    bond = law("elastic")
    thick = GEOMETRY._replace(R=2.0 * R, A=4.0 * GEOMETRY.A, I=16.0 * GEOMETRY.I)
    params = bond.model.Params(young_modulus=E, poisson_ratio=0.2, normal_strength=STRENGTH)
    strain = Strain(1e-6, (0.0, 0.0, 0.0), 0.0, (1e-3, 0.0, 0.0))
    loads = [bond.model.load(strain, bond.model.constants(params, shape), None) for shape in (GEOMETRY, thick)]
    assert loads[1].normal == pytest.approx(4.0 * loads[0].normal)
    assert math.hypot(*loads[1].bending) == pytest.approx(16.0 * math.hypot(*loads[0].bending))

"""Hertz–Mindlin: closed forms, symmetries, and the limits of sliding and rolling friction."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.maths.vec3 import add, dot, norm, scale
from clast.parts.contact_law import ContactLoad, Features
from clast_plugins.contact_laws.hertz_mindlin import History, energy, stiffness
from tests.support.contacts import (
    DT,
    GLASS,
    LIMITS,
    REST,
    across,
    contact,
    mirrored,
    sliding_contacts,
    tangential,
    touches,
    turned,
)
from tests.support.strategies import (
    assert_close,
    assert_turned,
    directions,
    negated,
    numbers,
    rotations,
    vectors,
)

ELASTIC_ONLY = Features(damping=False, sliding=False, rolling=False)
each_limit = pytest.mark.parametrize("limit", LIMITS)


def hertz(touch) -> float:
    E = 1.0 / ((1 - 0.2**2) / 420e6 + (1 - 0.3**2) / 210e9)
    return 4.0 / 3.0 * E * math.sqrt(touch.radius) * touch.overlap**1.5


def test_effective_moduli_of_a_pair_have_their_closed_forms():
    c = contact().constants
    G_i, G_j = 420e6 / 2.4, 210e9 / 2.6
    assert pytest.approx(1.0 / ((1 - 0.04) / 420e6 + (1 - 0.09) / 210e9), rel=1e-14) == c.E
    assert pytest.approx(1.0 / ((2 - 0.2) / G_i + (2 - 0.3) / G_j), rel=1e-14) == c.G


def test_a_pair_and_its_reverse_have_the_same_numbers():
    swapped = GLASS._replace(young_modulus_i=210e9, poisson_ratio_i=0.3, young_modulus_j=420e6, poisson_ratio_j=0.2)
    assert contact(swapped).constants == contact().constants


@settings(max_examples=50, deadline=None)
@given(touch=touches())
def test_without_damping_and_friction_only_the_force_of_hertz_acts(touch):
    told, _ = contact(features=ELASTIC_ONLY).load(touch)
    assert_close(told.force, scale(hertz(touch), touch.normal), 1e-13)
    assert (told.torque_i, told.torque_j) == (REST, REST)


@settings(max_examples=50, deadline=None)
@given(touch=touches())
def test_force_and_stiffness_are_the_derivatives_of_the_energy(touch):
    c, chosen = contact(features=ELASTIC_ONLY)
    h = 1e-3 * touch.overlap

    def shifted(steps: int):
        return touch._replace(overlap=touch.overlap + steps * h)

    def slope(values) -> float:
        return (8.0 * (values(1) - values(-1)) - (values(2) - values(-2))) / (12.0 * h)

    force = slope(lambda k: energy(shifted(k), c, History(REST), chosen))
    assert force == pytest.approx(hertz(touch), rel=1e-9)
    assert slope(lambda k: hertz(shifted(k))) == pytest.approx(stiffness(c, touch.radius, touch.overlap), rel=1e-9)


@each_limit
@settings(max_examples=40, deadline=None)
@given(drawn=sliding_contacts())
def test_swapping_the_bodies_mirrors_the_loads_to_the_bit(limit, drawn):
    touch, xi = drawn
    law = contact(coulomb_limit=limit)
    told, kept = law.load(touch, xi)
    there, mirror = law.load(mirrored(touch), negated(xi))
    assert there == ContactLoad(negated(told.force), told.torque_j, told.torque_i, told.limit)
    assert mirror == negated(kept)


@each_limit
@settings(max_examples=40, deadline=None)
@given(drawn=sliding_contacts(), q=rotations())
def test_a_rotated_world_gives_rotated_loads(limit, drawn, q):
    touch, xi = drawn
    law = contact(coulomb_limit=limit)
    told, kept = law.load(touch, xi)
    there, turned_xi = law.load(turned(touch, q), turned(touch._replace(normal=xi), q).normal)
    # forces may be small differences of large ones
    assert_turned(there.force, told.force, q, norm(told.force) + hertz(touch), 1e-8)
    assert_turned(turned_xi, kept, q, norm(kept) + DT, 1e-8)


@settings(max_examples=80, deadline=None)
@given(drawn=sliding_contacts(), mu=numbers(0.0, 1.0), cutoff=st.booleans())
def test_the_whole_tangential_force_stays_below_friction_times_the_elastic_normal_force(drawn, mu, cutoff):
    touch, xi = drawn
    law = contact(GLASS._replace(sliding_friction=mu), tension_cutoff=cutoff)
    told, _ = law.load(touch, xi)
    assert norm(tangential(told, touch)) <= mu * hertz(touch) + 1e-13 * norm(told.force)


@settings(max_examples=80, deadline=None)
@given(drawn=sliding_contacts(), mu=numbers(0.0, 1.0), cutoff=st.booleans())
def test_with_the_limit_total_it_stays_below_friction_times_the_pushing_normal_force(drawn, mu, cutoff):
    touch, xi = drawn
    law = contact(GLASS._replace(sliding_friction=mu), coulomb_limit="total", tension_cutoff=cutoff)
    told, _ = law.load(touch, xi)
    push = max(dot(told.force, touch.normal), 0.0)
    assert norm(tangential(told, touch)) <= mu * push + 1e-13 * norm(told.force)


@settings(max_examples=80, deadline=None)
@given(drawn=sliding_contacts(), mu=numbers(0.01, 1.0))
def test_with_the_limit_musen_the_spring_alone_is_limited_and_the_dashpot_rests_while_sliding(drawn, mu):
    touch, xi = drawn
    law = contact(GLASS._replace(sliding_friction=mu), coulomb_limit="musen")
    told, kept = law.load(touch, xi)
    k_t = 8.0 * law.constants.G * math.sqrt(touch.radius * touch.overlap)
    limit = mu * abs(dot(told.force, touch.normal))
    trial = add(xi, across(touch.moved, touch.normal))
    assert k_t * norm(kept) <= limit * (1.0 + 1e-12)
    if k_t * norm(trial) > limit * (1.0 + 1e-12):
        assert norm(tangential(told, touch)) == pytest.approx(limit, rel=1e-10, abs=1e-13 * norm(told.force))


@each_limit
@settings(max_examples=50, deadline=None)
@given(touch=touches())
def test_without_friction_coefficient_there_is_no_tangential_force_at_all(limit, touch):
    slippery = GLASS._replace(sliding_friction=0.0, rolling_friction=0.0)
    smooth = contact(slippery, Features(True, False, False), coulomb_limit=limit)
    rough = contact(slippery, Features(True, True, True), coulomb_limit=limit)
    told, alone = rough.load(touch)[0], smooth.load(touch)[0]
    if limit == "musen":  # its dashpot may see what rounding leaves across the normal where the spring sees nothing
        assert_close(told.force, alone.force, 1e-12, norm(alone.force) + hertz(touch))
    else:
        assert told.force == alone.force
    assert (told.torque_i, told.torque_j) == (REST, REST)


@each_limit
@settings(max_examples=40, deadline=None)
@given(touch=touches(), rates=st.lists(vectors(2.0), min_size=2, max_size=6), damped=st.booleans())
def test_a_closed_tangential_path_without_slip_creates_no_energy(limit, touch, rates, damped):
    law = contact(GLASS._replace(sliding_friction=1e9), Features(damped, True, False), coulomb_limit=limit)
    back = scale(-1.0, tuple(math.fsum(rate[k] for rate in rates) for k in range(3)))
    xi, before, given_out, size = REST, REST, 0.0, 1e-300
    for rate in (*rates, back):
        v_t = across(rate, touch.normal)
        told, xi = law.load(touch._replace(velocity=v_t, moved=scale(DT, v_t)), xi)
        force = tangential(told, touch)
        mean = force if damped else scale(0.5, add(before, force))
        given_out += DT * dot(mean, v_t)
        size += DT * norm(told.force) * norm(rate)  # the projection rounds on the scale of the whole force
        before = force
    assert norm(xi) <= 1e-12 * DT * 10.0
    if damped:
        assert given_out <= 1e-12 * size
    else:
        assert_close(given_out, 0.0, 1e-12, size)


@settings(max_examples=50, deadline=None)
@given(touch=touches(), xi=vectors(1e-5))
def test_the_stored_tangential_energy_is_the_work_of_the_spring(touch, xi):
    slip = across(xi, touch.normal)
    c, chosen = contact(GLASS._replace(sliding_friction=1e9), Features(False, True, False))
    stored = energy(touch, c, History(slip), chosen) - energy(touch, c, History(REST), chosen)
    k_t = 8.0 * c.G * math.sqrt(touch.radius * touch.overlap)
    size = energy(touch, c, History(slip), chosen)
    assert_close(stored, 0.5 * k_t * dot(slip, slip), 1e-13, size)


@settings(max_examples=40, deadline=None)
@given(touch=touches(), n=directions(), rate=numbers(-5.0, 5.0))
def test_with_tension_cutoff_a_contact_never_pulls(touch, n, rate):
    leaving = touch._replace(normal=n, velocity=scale(rate, n))
    smooth = Features(True, False, False)
    free = dot(contact(features=smooth).load(leaving)[0].force, n)
    cut = dot(contact(features=smooth, tension_cutoff=True).load(leaving)[0].force, n)
    assert cut == pytest.approx(max(free, 0.0), rel=1e-12, abs=1e-300)


@pytest.mark.parametrize("memory", ["displacement", "force"])
@settings(max_examples=40, deadline=None)
@given(touch=touches(), deeper=numbers(1.0, 4.0), xi=vectors(1e-6))
def test_only_a_spring_that_keeps_its_displacement_gains_energy_while_it_is_pressed(memory, touch, deeper, xi):
    law = contact(GLASS._replace(sliding_friction=1e9), Features(False, True, False), tangential_memory=memory)
    slip, pressed = across(xi, touch.normal), scale((1.0 - deeper) * touch.overlap, touch.normal)
    there = touch._replace(overlap=deeper * touch.overlap, moved=pressed, velocity=REST)
    k_t, k_deeper = (8.0 * law.constants.G * math.sqrt(touch.radius * each.overlap) for each in (touch, there))
    told, kept = law.load(there, slip)
    held = norm(slip) * (k_t if memory == "force" else k_deeper)
    assert norm(tangential(told, touch)) == pytest.approx(held, rel=1e-6, abs=1e-9 * norm(told.force))
    gained = k_deeper * dot(kept, kept) - k_t * dot(slip, slip)
    size = k_deeper * (norm(slip) + 1e-9 * norm(pressed)) ** 2
    assert gained * (-1.0 if memory == "force" else 1.0) >= -1e-9 * size

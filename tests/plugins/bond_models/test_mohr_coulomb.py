"""Parallel bonds break on the envelope of Mohr and Coulomb, cut off in tension."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.parts.bond_model import Strain
from tests.support.bonds import GEOMETRY, L0, Law, R, law, scaled, strains, stretch
from tests.support.strategies import numbers

TENSILE, COHESION, ANGLE = 4e6, 6e6, math.radians(30.0)


def index(bond: Law, strain: Strain) -> float:
    return bond.model.failure(strain, bond.model.load(strain, bond.constants, None), bond.constants, None)


def mode(bond: Law, strain: Strain) -> str:
    load = bond.model.load(strain, bond.constants, None)
    return bond.model.modes[bond.model.mode(strain, load, bond.constants, None)]


def strained(bond: Law, sigma: float, tau: float) -> Strain:
    """Return the strain at which the stresses on the axis are these."""
    A, k = float(GEOMETRY.A), bond.constants.k
    return Strain(sigma * A / k.axial, (0.0, tau * A / k.shear, 0.0), 0.0, (0.0, 0.0, 0.0))


@settings(max_examples=50, deadline=None)
@given(sigma=numbers(-40e6, 0.99 * TENSILE))
def test_a_sheared_bond_breaks_at_the_cohesion_and_what_pressure_adds(sigma: float) -> None:
    bond = law("mohr_coulomb")
    tau = COHESION - sigma * math.tan(ANGLE)
    assert index(bond, strained(bond, sigma, tau)) == pytest.approx(1.0, rel=1e-12)
    assert mode(bond, strained(bond, sigma, 1.0001 * tau)) == "shear"


def test_a_bond_that_is_pulled_breaks_at_its_tensile_strength_and_one_that_is_pressed_holds() -> None:
    bond = law("mohr_coulomb")
    assert index(bond, strained(bond, TENSILE, 0.0)) == pytest.approx(1.0, rel=1e-12)
    assert mode(bond, strained(bond, TENSILE, 0.0)) == "tension"
    assert index(bond, strained(bond, -1e9, 0.0)) == 0.0


@settings(max_examples=30, deadline=None)
@given(share=numbers(0.0, 1.0), angle=numbers(0.01, 0.1), twisting=st.booleans())
def test_moments_count_by_the_share_that_is_set(share: float, angle: float, twisting: bool) -> None:
    bond = law("mohr_coulomb", moment_contribution=share)
    load = bond.constants.k
    if twisting:
        stress = load.torsion * angle * R / (2.0 * float(GEOMETRY.I)) / COHESION
        strain = Strain(0.0, (0.0, 0.0, 0.0), angle, (0.0, 0.0, 0.0))
    else:
        stress = load.bending * angle * R / float(GEOMETRY.I) / TENSILE
        strain = Strain(0.0, (0.0, 0.0, 0.0), 0.0, (0.0, angle, 0.0))
    assert index(bond, strain) == pytest.approx(share * stress, rel=1e-12)


def test_the_modulus_is_the_stiffness_of_an_area_times_the_length_and_the_ratio_that_of_normal_to_shear() -> None:
    bond = law("mohr_coulomb", stiffness_ratio=2.5)
    load = bond.model.load(stretch(0.001, 0.001), bond.constants, None)
    assert load.normal == pytest.approx(500e6 / L0 * float(GEOMETRY.A) * 0.001 * L0, rel=1e-12)
    assert load.normal / load.shear[1] == pytest.approx(2.5, rel=1e-12)


@settings(max_examples=30, deadline=None)
@given(strain=strains(), angle=numbers(0.0, 60.0))
def test_without_friction_pressure_does_not_help_and_with_it_never_harms(strain: Strain, angle: float) -> None:
    pressed = strain._replace(axial=-abs(strain.axial))
    rubbing, smooth = law("mohr_coulomb", friction_angle=f"{angle} deg"), law("mohr_coulomb", friction_angle=0.0)
    assert index(rubbing, pressed) <= index(smooth, pressed)
    harder = scaled(pressed, 1.0)._replace(axial=2.0 * pressed.axial)
    assert index(rubbing, harder) <= index(rubbing, pressed)

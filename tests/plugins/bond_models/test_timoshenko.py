"""Rows of Timoshenko beams: exact at every node, however many there are; Euler and Bernoulli's where slender."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.parts.bond_model import BondGeometry, Strain
from clast.plugins.discovery import discover
from clast.verification.closed_forms.beam import Beam, Cantilever
from tests.support.bonds import GEOMETRY, L0, NU, STRENGTH, E, R, law
from tests.support.strategies import numbers

PART = discover().get("bond_model", "timoshenko").part
LOAD = 1e-6


def row(bonds: int, slenderness: float, nu: float) -> tuple[Cantilever, float, float]:
    """Return a cantilever of the length 1, and what its tip deflects and turns by, from the stiffness of its bonds."""
    radius, length = 0.5 / slenderness, 1.0 / bonds
    section = BondGeometry(length, radius, math.pi * radius**2, 0.25 * math.pi * radius**4)
    k = PART.stiffness(PART.Params(young_modulus=E, poisson_ratio=nu, normal_strength=1.0), section)
    at = (np.arange(bonds) + 0.5) * length
    turned = np.cumsum(LOAD * (1.0 - at) / k.bending)
    slant = np.concatenate([[0.0], turned])
    deflected = sum(0.5 * (slant[1:] + slant[:-1]) * length + LOAD / k.shear)
    return Cantilever(Beam(E, nu, radius, length), bonds), float(deflected), float(turned[-1])


@settings(max_examples=50, deadline=None)
@given(bonds=st.integers(1, 12), slenderness=numbers(0.5, 50.0), nu=numbers(-0.5, 0.49))
def test_a_row_of_any_number_of_bonds_is_timoshenkos_cantilever(bonds: int, slenderness: float, nu: float) -> None:
    beam, deflected, turned = row(bonds, slenderness, nu)
    kappa = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu)
    assert deflected == pytest.approx(beam.timoshenko(LOAD, kappa), rel=1e-11)
    assert turned == pytest.approx(beam.slope(LOAD), rel=1e-12)


@settings(max_examples=30, deadline=None)
@given(bonds=st.integers(1, 6), slenderness=numbers(5.0, 500.0))
def test_what_shear_adds_to_euler_and_bernoullis_beam_falls_with_the_square_of_slenderness(
    bonds: int, slenderness: float
) -> None:
    beam, deflected, _ = row(bonds, slenderness, 0.0)
    added = deflected / (LOAD / (3.0 * beam.bending)) - 1.0
    assert added * slenderness**2 == pytest.approx(3.0 * (2.0 * 7.0 / 6.0) / 16.0, rel=1e-6)  # 3 E I/(κ G A L²)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_bond_breaks_at_its_more_loaded_end(sign: float) -> None:
    """Held at one end and loaded across at the other, a bond is bent by P L0 there, by half of it in its middle."""
    model, c, _ = law("timoshenko")
    at_the_end = 0.5 * STRENGTH * float(GEOMETRY.I) / R
    force, middle = at_the_end / L0, 0.5 * at_the_end
    strain = Strain(0.0, (0.0, force / c.k.shear, 0.0), 0.0, (0.0, 0.0, sign * middle / c.k.bending))
    load = model.load(strain, c, None)
    assert model.failure(strain, load, c, None) == pytest.approx(0.5, rel=1e-12)
    assert model.modes[model.mode(strain, load, c, None)] == "tension"


def test_a_shear_coefficient_that_is_given_takes_the_place_of_cowpers() -> None:
    written = {"young_modulus": E, "poisson_ratio": NU, "normal_strength": 1.0}
    given, own = (
        PART.stiffness(PART.Params(**written | more), GEOMETRY).shear for more in ({"shear_coefficient": 0.5}, {})
    )
    G = E / (2.0 * (1.0 + NU))
    A, bent = float(GEOMETRY.A), L0**3 / (12.0 * E * float(GEOMETRY.I))
    assert 1.0 / given == pytest.approx(bent + L0 / (0.5 * G * A), rel=1e-12)
    assert 1.0 / own == pytest.approx(bent + L0 * (7.0 + 6.0 * NU) / (6.0 * (1.0 + NU) * G * A), rel=1e-12)

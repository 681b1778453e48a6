"""Porosity, coordination and overlap of packings whose values can be worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.scene.bonding import bond_neighbours
from clast.scene.packing_report import (
    bond_coordination,
    contact_coordination,
    cut_sphere_volume,
    overlaps,
    porosity,
    sphere_volume,
)


def simple_cubic(edge: int, spacing: float) -> np.ndarray:
    axis = spacing * np.arange(edge)
    return np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3).astype(float)


def test_a_simple_cubic_lattice_has_the_porosity_of_the_textbook() -> None:
    assert porosity(np.ones(64), 8.0**3) == pytest.approx(1 - math.pi / 6, rel=1e-12)


def test_a_simple_cubic_lattice_touches_along_its_edges_only() -> None:
    x = simple_cubic(3, 2.0)
    assert contact_coordination(x, np.ones(27)) == pytest.approx(2 * 54 / 27)
    assert contact_coordination(1.01 * x, np.ones(27)) == 0.0


def test_bonds_reach_over_gaps_that_do_not_touch() -> None:
    bonds = bond_neighbours(simple_cubic(2, 2.2), np.ones(8), max_gap=0.5)
    assert bond_coordination(8, bonds) == 3.0


def test_overlaps_are_counted_once_per_pair() -> None:
    x = np.array([[0.0, 0.0, 0.0], [1.9, 0.0, 0.0], [3.6, 0.0, 0.0]])
    found = overlaps(x, np.ones(3))
    assert found.pairs == 2
    assert found.largest == pytest.approx(0.3)
    assert found.mean == pytest.approx(0.2)


def test_nothing_overlaps_or_touches_among_no_particles() -> None:
    nothing, none = np.zeros((0, 3)), np.zeros(0)
    assert overlaps(nothing, none) == (0, 0.0, 0.0)
    assert contact_coordination(nothing, none) == 0.0
    assert bond_coordination(0, bond_neighbours(nothing, none, 1.0)) == 0.0


@given(diameter=st.floats(0.1, 10), share=st.floats(0.01, 1.0))
def test_the_cut_sphere_is_the_integral_of_its_slices(diameter: float, share: float) -> None:
    height = share * diameter
    z, weight = np.polynomial.legendre.leggauss(4)
    slices = math.pi * (diameter**2 / 4 - (height / 2 * z) ** 2)
    assert cut_sphere_volume(diameter, height) == pytest.approx(height / 2 * float(weight @ slices), rel=1e-12)
    assert cut_sphere_volume(diameter, height) <= sphere_volume(diameter) * (1 + 1e-12)

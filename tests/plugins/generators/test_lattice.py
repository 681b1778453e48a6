"""Lattices: how many neighbours, how dense, and wholly inside."""

from __future__ import annotations

from collections import Counter
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from clast.errors import ConfigError
from clast.parts.generator import Packing, Site
from clast.plugins.discovery import discover
from clast.testing.kit import try_part
from clast_plugins.generators.lattice import CELLS, Lattice, generate

each = pytest.mark.parametrize("lattice", sorted(CELLS))
NEIGHBOURS = {"sc": 6, "bcc": 8, "fcc": 12, "hcp": 12}
DENSITY = {"sc": pi / 6.0, "bcc": sqrt(3.0) * pi / 8.0, "fcc": pi / sqrt(18.0), "hcp": pi / sqrt(18.0)}


def made(**given: object) -> Packing:
    return generate(Lattice(material="glass", primary_diameter=1.0, **given), Site(Path()))


def neighbours(position: np.ndarray, distance: float) -> Counter[int]:
    pairs = cKDTree(position).query_pairs(distance * (1.0 + 1e-9), output_type="ndarray")
    return Counter(pairs.ravel().tolist())


def test_it_keeps_to_what_holds_for_every_generator():
    assert [each for each in try_part(discover().get("generator", "lattice")) if not each.passed] == []


@each
@pytest.mark.parametrize("gap", [0.0, 0.3])
def test_spheres_inside_have_all_their_neighbours_at_the_nearest_distance(lattice, gap):
    position = made(lattice=lattice, diameter=9.0, gap=gap).position
    inside = np.nonzero(np.linalg.norm(position, axis=1) < 2.0)[0]
    counts = neighbours(position, 1.0 + gap)
    assert len(inside) > 5
    assert {counts[int(k)] for k in inside} == {NEIGHBOURS[lattice]}
    assert cKDTree(position).query(position, 2)[0][:, 1].min() == pytest.approx(1.0 + gap)


@each
def test_a_large_ball_is_as_dense_as_the_lattice(lattice):
    """Spheres whose centres lie in a ball make up the lattice's share of it, but for its surface."""
    packing = made(lattice=lattice, diameter=41.0)
    assert len(packing.position) / 40.0**3 == pytest.approx(DENSITY[lattice], rel=0.01)


@pytest.mark.parametrize(("lattice", "count"), [("sc", 7), ("bcc", 9), ("fcc", 13), ("hcp", 13)])
def test_a_ball_of_three_diameters_holds_a_sphere_and_its_neighbours(lattice, count):
    assert len(made(lattice=lattice, diameter=3.0).position) == count


@each
@settings(max_examples=30, deadline=None)
@given(box=st.tuples(*[st.floats(1.0, 6.0)] * 3))
def test_a_box_holds_its_spheres_in_the_middle_with_room_for_no_further_layer(lattice, box):
    position = made(lattice=lattice, box=box, centre=[1, 2, 3]).position - np.array([1.0, 2.0, 3.0])
    low, high = position.min(axis=0), position.max(axis=0)
    assert low + high == pytest.approx(np.zeros(3), abs=1e-9)
    assert (high - low + 1.0 <= np.array(box) * (1.0 + 1e-9)).all()
    assert (high - low + 1.0 > np.array(box) - np.array(CELLS[lattice].edges)).all()


def test_simple_cubic_fills_a_box_that_fits():
    assert len(made(lattice="sc", box=[3.0, 4.0, 5.0]).position) == 60


@pytest.mark.parametrize(
    ("given_", "problem"),
    [
        ({}, "exactly one of 'box' and 'diameter'"),
        ({"box": [2, 2, 2], "diameter": 3}, "exactly one of 'box' and 'diameter'"),
        ({"box": [2, 0.5, 2]}, "a sphere of 1 m does not fit into 0.5 m"),
    ],
)
def test_a_room_that_makes_no_sense_is_refused(given_, problem):
    with pytest.raises(ValueError, match=problem):
        made(**given_)


def test_too_many_spheres_are_refused_before_memory_is_asked_for():
    with pytest.raises(ConfigError, match="the lattice would have about"):
        made(diameter=1e4)

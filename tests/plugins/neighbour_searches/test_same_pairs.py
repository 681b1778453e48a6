"""Neighbour searches: each finds exactly the pairs that looking at every pair finds, in the same order."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from clast.plugins.discovery import discover
from clast_plugins.neighbour_searches import brute_force

ARRANGEMENTS = ("spread", "clustered", "far-flung", "coincident", "in a plane", "on a grid")
each = pytest.mark.parametrize("name", discover().names("neighbour_search"))


def particles(seed: int, count: int, ratio: float, arrangement: str) -> tuple[np.ndarray, np.ndarray]:
    """Return positions and reaches, the largest reach ``ratio`` times the smallest."""
    draw = np.random.default_rng(seed)
    reach = ratio ** draw.uniform(0.0, 1.0, count)
    reach[draw.integers(count)] = ratio
    x = draw.uniform(-1.0, 1.0, (count, 3)) * ratio * count ** (1 / 3)
    if arrangement == "clustered":
        x = x[draw.integers(0, 1 + count // 20, count)] * 3.0 + draw.normal(size=(count, 3))
    elif arrangement == "far-flung":
        x *= 10.0 ** draw.uniform(0.0, 6.0, (count, 1))
    elif arrangement == "coincident":
        x = x[draw.integers(0, 1 + count // 4, count)]
    elif arrangement == "in a plane":
        x[:, draw.integers(3)] = 1.0
    elif arrangement == "on a grid":
        reach[:] = ratio
        x = np.round(x / ratio) * 2.0 * ratio * (1.0 - 1e-15 * draw.integers(0, 3, (count, 3)))
    return x, reach


@pytest.mark.parametrize("name", [name for name in discover().names("neighbour_search") if name != "brute_force"])
@settings(max_examples=150, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    count=st.integers(2, 200),
    ratio=st.floats(1.0, 100.0),
    arrangement=st.sampled_from(ARRANGEMENTS),
)
def test_a_search_finds_what_brute_force_finds(name, seed, count, ratio, arrangement):
    x, reach = particles(seed, count, ratio, arrangement)
    found = discover().get("neighbour_search", name).part.find_pairs(x, reach)
    np.testing.assert_array_equal(found, brute_force.find_pairs(x, reach))


@each
@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    count=st.integers(2, 200),
    ratio=st.floats(1.0, 20.0),
    arrangement=st.sampled_from(ARRANGEMENTS[:-1]),
)
@example(seed=1, count=2, ratio=1.0, arrangement="coincident")
def test_a_tree_of_the_same_particles_agrees(name, seed, count, ratio, arrangement):
    x, reach = particles(seed, count, ratio, arrangement)
    near = cKDTree(x).query_pairs(2.0 * reach.max() * (1.0 + 1e-9), output_type="ndarray")
    i, j = near.min(axis=1), near.max(axis=1)
    touching = np.linalg.norm(x[i] - x[j], axis=1) < reach[i] + reach[j]
    expected = sorted(zip(i[touching].tolist(), j[touching].tolist(), strict=True))
    found = discover().get("neighbour_search", name).part.find_pairs(x, reach)
    assert found.dtype == np.uint32
    assert [tuple(pair) for pair in found.tolist()] == expected


@each
@pytest.mark.parametrize("count", [0, 1])
def test_none_or_one_particle_has_no_neighbours(name, count):
    find_pairs = discover().get("neighbour_search", name).part.find_pairs
    assert find_pairs(np.zeros((count, 3)), np.ones(count)).shape == (0, 2)


@each
def test_particles_that_only_just_touch_the_reach_are_no_pair(name):
    find_pairs = discover().get("neighbour_search", name).part.find_pairs
    x = np.array([[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1.5, 0.0]])
    assert find_pairs(x, np.array([0.5, 1.0, np.nextafter(1.0, 2.0)])).tolist() == [[0, 2]]


@each
def test_a_lone_fragment_a_million_diameters_away_needs_no_memory_and_hides_no_pair(name):
    find_pairs = discover().get("neighbour_search", name).part.find_pairs
    x = np.vstack([np.random.default_rng(1).uniform(0.0, 10.0, (200, 3)), [[1e6, -1e6, 1e6]]])
    reach = np.full(201, 0.7)
    np.testing.assert_array_equal(find_pairs(x, reach), brute_force.find_pairs(x, reach))


@each
def test_a_pair_within_rounding_of_the_width_of_a_cell_is_not_lost(name):
    """Seen from −32, the first lies just below 32 and the second rounds up to 33: two cells apart, were they 1 wide."""
    x = np.zeros((3, 3))
    x[:, 0] = -32.0, -2e-15, 1.0 - 2.2e-15
    reach = np.full(3, 0.5)
    assert discover().get("neighbour_search", name).part.find_pairs(x, reach).tolist() == [[1, 2]]

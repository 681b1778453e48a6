"""Near pairs: across the faces of a periodic box every search finds what looking at every nearest image finds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.engine.near_pairs import near_pairs
from clast.maths.box import Box
from clast.plugins.discovery import discover
from clast.scene.bonding import close_pairs

ARRANGEMENTS = ("spread", "at the faces", "outside", "in a corner")


def crowd(seed: int, count: int, periodic: tuple[bool, ...], arrangement: str) -> tuple[np.ndarray, np.ndarray, Box]:
    """Return positions, reaches and a box whose sides are more than four of the largest reach."""
    draw = np.random.default_rng(seed)
    reach = draw.uniform(0.5, 1.5, count)
    lower, size = draw.uniform(-20.0, 20.0, 3), draw.uniform(6.1, 12.0, 3)
    x = draw.uniform(0.0, 1.0, (count, 3))
    if arrangement == "at the faces":
        x = np.round(x) * (1.0 - 1e-16 * draw.integers(0, 3, (count, 3)))
    elif arrangement == "outside":
        x += draw.integers(-3, 4, (count, 3))
    elif arrangement == "in a corner":
        x *= 0.1 * draw.integers(-1, 2, 3)
    return lower + x * size, reach, Box(lower, lower + size, np.array(periodic))


def nearest_pairs(x: np.ndarray, reach: np.ndarray, box: Box) -> list[list[int]]:
    """Look at every pair of particles and every image next to the second."""
    i, j = np.triu_indices(len(x), 1)
    steps = [[-1, 0, 1] if repeats else [0] for repeats in box.periodic]
    shifts = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3) * box.span
    d = box.wrapped(x)[i] - box.wrapped(x)[j]
    distance = np.sqrt(((d[:, None] - shifts) ** 2).sum(axis=2)).min(axis=1)
    near = distance < reach[i] + reach[j]
    return np.column_stack([i[near], j[near]]).tolist()


cases = given(
    seed=st.integers(0, 2**32),
    count=st.integers(0, 80),
    periodic=st.tuples(st.booleans(), st.booleans(), st.booleans()),
    arrangement=st.sampled_from(ARRANGEMENTS),
)


@pytest.mark.parametrize("name", discover().names("neighbour_search"))
@settings(max_examples=60)
@cases
def test_every_search_finds_the_pairs_of_nearest_images(name, seed, count, periodic, arrangement):
    x, reach, box = crowd(seed, count, periodic, arrangement)
    found = near_pairs(discover().get("neighbour_search", name).part, x, reach, box)
    assert found.tolist() == nearest_pairs(x, reach, box)


@settings(max_examples=60)
@cases
def test_gaps_are_those_to_nearest_images(seed, count, periodic, arrangement):
    x, radius, box = crowd(seed, count, periodic, arrangement)
    ends, gap = close_pairs(x, radius, 0.0, box)
    assert [pair for pair, width in zip(ends.tolist(), gap, strict=True) if width < 0.0] == nearest_pairs(
        x, radius, box
    )


@settings(max_examples=100)
@cases
def test_images_tell_where_a_wrapped_particle_was(seed, count, periodic, arrangement):
    x, _, box = crowd(seed, count, periodic, arrangement)
    inside = box.wrapped(x)
    np.testing.assert_allclose(inside + box.span * box.images(x), x, rtol=0.0, atol=1e-13 * 100.0)
    for axis in np.flatnonzero(box.periodic):
        assert (inside[:, axis] >= box.lower[axis] - 1e-12).all()
        assert (inside[:, axis] <= box.upper[axis] + 1e-12).all()
    way = box.nearest(x - x[::-1])
    assert (np.abs(way) <= np.where(box.periodic, 0.5 * box.span * (1 + 1e-12), np.inf)).all()
    np.testing.assert_allclose(way, box.beside(x[::-1], x) - x[::-1], rtol=0.0, atol=1e-11)

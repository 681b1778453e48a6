"""What holds for every neighbour search: exactly the pairs that looking at every pair finds, in rising order."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from clast.parts.neighbour_search import NeighbourSearch
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import numbers

Floats = NDArray[np.float64]
ARRANGEMENTS = ("spread", "clustered", "far-flung", "coincident", "in a plane", "on a grid")


def claims(search: NeighbourSearch, params: Any) -> list[Claim]:
    """Return what a neighbour search must keep to."""
    drawn = (st.integers(0, 2**32), st.integers(0, 150), numbers(1.0, 30.0), st.sampled_from(ARRANGEMENTS))
    return [
        claim(
            "it finds every pair and no other, in rising order",
            lambda seed, count, ratio, how: _complete(search, seed, count, ratio, how),
            *drawn,
        ),
        claim("it leaves what it is given as it is", lambda: _harmless(search)),
    ]


def particles(seed: int, count: int, ratio: float, arrangement: str) -> tuple[Floats, Floats]:
    """Return positions (n, 3) and reaches (n,), the largest reach ``ratio`` times the smallest."""
    draw = np.random.default_rng(seed)
    reach = draw.uniform(1.0, ratio, count)
    x = draw.uniform(-1.0, 1.0, (count, 3)) * ratio * max(count, 1) ** (1 / 3)
    if count == 0:
        return x, reach
    reach[draw.integers(count)] = ratio
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


def every_pair(x: Floats, reach: Floats) -> NDArray[np.uint32]:
    """Return all pairs nearer than the sum of their reaches, (p, 2), by looking at every pair."""
    i, j = np.triu_indices(len(x), 1)
    d = x[i] - x[j]
    far = reach[i] + reach[j]
    near = d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2] < far * far
    return np.column_stack([i[near], j[near]]).astype(np.uint32)


def _complete(search: NeighbourSearch, seed: int, count: int, ratio: float, arrangement: str) -> None:
    x, reach = particles(seed, count, ratio, arrangement)
    found, wanted = search.find_pairs(x, reach), every_pair(x, reach)
    case = f"{count} particles ({arrangement}, seed {seed}, sizes 1 to {ratio:g})"
    must(isinstance(found, np.ndarray) and found.dtype == np.uint32, lambda: f"{case}: uint32 is needed, not {found!r}")
    must(found.shape[1:] == (2,), f"{case}: pairs have the shape {found.shape}")
    a, b = {tuple(pair) for pair in found.tolist()}, {tuple(pair) for pair in wanted.tolist()}
    must(a >= b, lambda: f"{case}: {len(b - a)} pairs are missing, such as {min(b - a)}")
    must(a <= b, lambda: f"{case}: {len(a - b)} pairs are too many, such as {min(a - b)}")
    must(np.array_equal(found, wanted), f"{case}: the pairs are not in rising order, or some are there twice")


def _harmless(search: NeighbourSearch) -> None:
    x, reach = particles(1, 100, 3.0, "spread")
    before = x.copy(), reach.copy()
    search.find_pairs(x, reach)
    must(np.array_equal(before[0], x) and np.array_equal(before[1], reach), "it changes the positions or the reaches")

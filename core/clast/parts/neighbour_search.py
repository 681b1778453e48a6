"""Neighbour search: which particles may touch before the list is made anew."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.parts.params import Params


@dataclass(frozen=True)
class NeighbourSearch:
    """The part a plugin registers with ``registry.neighbour_search(name, NeighbourSearch(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``neighbours``, beside ``skin``.
    find_pairs : (position, reach) -> pairs
        All pairs with |x_i − x_j| < reach_i + reach_j, from (n, 3) and (n,) float64 to (p, 2) uint32 with i < j in
        rising order. Must not depend on anything else.
    told : (reach) -> str, optional
        What the search does with particles of some reaches, and why: for ``clast check --build``.
    """

    summary: str
    Params: type[Params]
    find_pairs: Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.uint32]]
    told: Callable[[NDArray[np.float64]], str] | None = None

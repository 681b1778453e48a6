"""The neighbour search that suits the sizes of the particles."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast import hookimpl
from clast.parts.neighbour_search import NeighbourSearch
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.neighbour_searches import hierarchical_grid, linked_cells
from clast_plugins.neighbour_searches.hierarchical_grid_cells import levels

Floats = NDArray[np.float64]

LOOK = 60.0
"""What looking into the cells of one more grid costs, in particles tested; see ``clast bench --only search``."""

FILLED = 0.5
"""Share of the space that particles are taken to fill."""


class Auto(Params):
    """Take ``linked_cells`` or ``hierarchical_grid``, whichever has less to do; both find the same pairs.

    Equation
    --------
    A grid whose cells are w wide tests 27 n w³/V of its n particles for each that looks into it. One grid for all costs
    N tests of that kind, with w twice the largest reach; several cost each particle those of its own level and of all
    coarser ones, and 60 more for each. The smaller sum decides.

    Symbols
    -------
    N : number of particles; w : width of cells in m; V : volume in m³ that the particles fill half

    Limits
    ------
    Sizes and number alone decide, not where the particles are: the choice is the same on every machine.
    """


class Tests(NamedTuple):
    """Particles tested for each: with one grid, and with one for every class of sizes, lookups included."""

    one_grid: float
    several: float


def tests(reach: Floats) -> Tests:
    """Return how much both searches have to do.

    >>> found = tests(np.repeat([1.0, 10.0], [10000, 10]))
    >>> bool(found.several < 0.02 * found.one_grid)
    True
    """
    volume = 4.0 / 3.0 * np.pi * float(np.sum(reach**3)) / FILLED
    level = levels(reach)
    several = 0.0
    for k in np.unique(level):
        mine = level == k
        width = 2.0 * float(reach[mine].max())
        several += int(np.count_nonzero(level <= k)) * (27.0 * np.count_nonzero(mine) * width**3 / volume + LOOK)
    one = 27.0 * len(reach) * (2.0 * float(reach.max())) ** 3 / volume + LOOK
    return Tests(one, several / len(reach))


def find_pairs(position: Floats, reach: Floats) -> NDArray[np.uint32]:
    """Return all pairs with |x_i − x_j| < reach_i + reach_j, as brute force does."""
    if len(reach) < 2:
        return np.zeros((0, 2), np.uint32)
    found = tests(reach)
    if found.one_grid <= found.several:
        return linked_cells.find_pairs(position, reach)
    return hierarchical_grid.find_pairs(position, reach)


def told(reach: Floats) -> str:
    """Say what is taken for particles of some reaches, and why."""
    found = tests(reach)
    name = "linked_cells" if found.one_grid <= found.several else "hierarchical_grid"
    return (
        f"{name}: sizes differ by a factor of {reach.max() / reach.min():.3g}, so it costs each particle about "
        f"{min(found):.0f} tests, the other {max(found):.0f}"
    )


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the choice."""
    registry.neighbour_search(
        "auto",
        NeighbourSearch(
            summary="linked cells, or a hierarchical grid where sizes differ so much that it has less to do",
            Params=Auto,
            find_pairs=find_pairs,
            told=told,
        ),
    )

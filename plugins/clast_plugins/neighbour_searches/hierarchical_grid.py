"""Hierarchical grid: cells for every class of sizes, so that large particles do not widen those of small ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast import hookimpl
from clast.parts.neighbour_search import NeighbourSearch
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.neighbour_searches.hierarchical_grid_cells import grid_of, levels

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class HierarchicalGrid(Params):
    """Several grids of cells, one for each doubling of the reach; a particle looks into its own and all coarser ones.

    Equation
    --------
    Particle i is on the level l with 2^l r_min ≤ r_i < 2^(l+1) r_min; the cells of a level are 2 max r_i wide, of the
    particles on it. Particles i and j ≥ i of levels l ≤ m touch only if they are in neighbouring cells of level m.

    Symbols
    -------
    r_i : reach of particle i in m: its radius and its share of the skin; r_min the smallest

    Limits
    ------
    For particles of about one size it is ``linked_cells`` with a sort of all pairs at the end. Work grows with the
    number of levels, so it pays from size ratios of about 3 on, more the more small particles there are. Cells of a
    level are widened until there are at most about two per particle, so far-flung fragments cost no memory.

    Source
    ------
    T. Iwai, C.-W. Hong, P. Greil (1999), International Journal of Modern Physics C 10, 823–837; V. Ogarko, S. Luding
    (2012), Computer Physics Communications 183, 931–936, doi:10.1016/j.cpc.2011.12.019; D. Krijgsman, V. Ogarko,
    S. Luding (2014), Computational Particle Mechanics 1, 357–372, doi:10.1007/s40571-014-0020-9.
    """


def find_pairs(position: Floats, reach: Floats) -> NDArray[np.uint32]:
    """Return all pairs with |x_i − x_j| < reach_i + reach_j, as brute force does."""
    from clast_plugins.neighbour_searches.grids_kernel import search_grids

    n = len(position)
    if n < 2:
        return np.zeros((0, 2), np.uint32)
    level = levels(reach)
    grids = [grid_of(position, reach, np.nonzero(level == k)[0], 2 * n + 64) for k in np.unique(level)]
    found = []
    for k, fine in enumerate(grids):
        for coarse in grids[k:]:
            room = np.empty(16 * len(fine.members), np.int64)
            while True:
                count = search_grids(position, reach, fine.members, fine is coarse, coarse, room)
                if count <= len(room):
                    break
                room = np.empty(count, np.int64)
            found.append(room[:count])
    keys = np.sort(np.concatenate(found))
    return np.column_stack([keys >> 32, keys & 0xFFFFFFFF]).astype(np.uint32)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the hierarchical grid."""
    registry.neighbour_search(
        "hierarchical_grid",
        NeighbourSearch(
            summary="a grid of cells for every class of sizes, for wide size distributions",
            Params=HierarchicalGrid,
            find_pairs=find_pairs,
        ),
    )

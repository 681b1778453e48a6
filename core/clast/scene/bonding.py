"""Bonding neighbours: a bond between every pair of particles whose surfaces are close."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from clast.maths.box import Box, open_space
from clast.parts.generator import BondList

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
FEW = 32
"""So few particles are compared each with each, which spares importing scipy."""


def bond_neighbours(
    position: Floats,
    radius: Floats,
    max_gap: float,
    min_gap: float = -math.inf,
    diameter: float | None = None,
    relative: bool = False,
    box: Box | None = None,
) -> BondList:
    """Bond every pair whose surface gap lies in ``[min_gap, max_gap]``.

    The gap of a pair is the distance of its centres minus both radii; it is negative where particles overlap.

    Parameters
    ----------
    position : (n, 3) float64
        Centres in m.
    radius : (n,) float64
        Radii in m.
    max_gap, min_gap : float
        Bounds of the gap in m, both included.
    diameter : float, optional
        Bond diameter in m; never more than the smaller particle's, which is also the default.
    relative : bool
        Whether ``max_gap`` is a share of the smaller particle's diameter, instead of a length.
    box : Box, optional
        Where it repeats itself, pairs are bonded across its faces.

    Returns
    -------
    BondList
        Ordered by ``(i, j)`` with ``i < j``; every length is ``nan``, the distance of the two centres.

    Raises
    ------
    ValueError
        ``min_gap`` above ``max_gap``, or a diameter that is not positive.

    Source: the rule of MUSEN, the program of Rotter, Dosta and Düster (2023), doi:10.1007/s40571-023-00610-0.

    Examples
    --------
    >>> x = np.array([[0.0, 0.0, 0.0], [2.1, 0.0, 0.0], [9.0, 0.0, 0.0]])
    >>> bonds = bond_neighbours(x, np.array([1.0, 1.0, 1.0]), max_gap=0.2)
    >>> bonds.ends.tolist(), bonds.diameter.tolist()
    ([[0, 1]], [2.0])
    """
    if not relative and not min_gap <= max_gap:
        raise ValueError(f"the smallest gap, {min_gap:g} m, is above the largest, {max_gap:g} m")
    if diameter is not None and not diameter > 0.0:
        raise ValueError(f"a bond diameter must be above zero; {diameter:g} m given")
    widest = max_gap * 2.0 * float(radius.max(initial=0.0)) if relative else max_gap
    ends, gap = close_pairs(position, radius, widest, box)
    smaller = 2.0 * np.minimum(radius[ends[:, 0]], radius[ends[:, 1]])
    near = (gap >= min_gap) & (gap <= (max_gap * smaller if relative else max_gap))
    ends, smaller = ends[near], smaller[near]
    return BondList(
        ends=ends,
        diameter=smaller if diameter is None else np.minimum(diameter, smaller),
        length=np.full(len(ends), math.nan),
    )


def close_pairs(position: Floats, radius: Floats, max_gap: float, box: Box | None = None) -> tuple[Ints, Floats]:
    """Return the pairs with a surface gap up to ``max_gap``, and their gaps.

    Parameters
    ----------
    position : (n, 3) float64
        Centres in m.
    radius : (n,) float64
        Radii in m.
    max_gap : float
        Largest gap in m; may be negative, then only overlapping pairs are found.
    box : Box, optional
        Where it repeats itself, gaps are those to the nearest image.

    Returns
    -------
    ends : (m, 2) int64
        Ordered by ``(i, j)`` with ``i < j``.
    gap : (m,) float64
        In m.
    """
    box = box or open_space()
    ends = _candidates(position, 2.0 * float(radius.max(initial=0.0)) + max_gap, box)
    way = box.nearest(position[ends[:, 0]] - position[ends[:, 1]])
    distance = np.sqrt(way[:, 0] ** 2 + way[:, 1] ** 2 + way[:, 2] ** 2)
    gap = distance - (radius[ends[:, 0]] + radius[ends[:, 1]])
    close = gap <= max_gap
    return ends[close], gap[close]


def doubled(ends: Ints) -> tuple[int, int] | None:
    """Return the first bond between two particles that are bonded already, and their first bond; None if there is none.

    Parameters
    ----------
    ends : (m, 2) int64
        In either order.

    Examples
    --------
    >>> doubled(np.array([[0, 1], [1, 2], [1, 0]]))
    (2, 0)
    """
    pairs = np.sort(ends, axis=1)
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))  # stable: equal pairs keep their order
    again = np.nonzero((np.diff(pairs[order], axis=0) == 0).all(axis=1))[0]
    if len(again) == 0:
        return None
    k = again[np.argmin(order[again + 1])]
    return int(order[k + 1]), int(order[k])


def _candidates(position: Floats, reach: float, box: Box) -> Ints:
    """Return every pair nearer than ``reach``, and perhaps some that are farther, (m, 2) with ``i < j`` rising."""
    if len(position) <= FEW:
        return np.column_stack(np.triu_indices(len(position), 1)).astype(np.int64)
    if reach < 0.0:
        return np.zeros((0, 2), np.int64)
    from scipy.spatial import cKDTree

    # the tree rounds distances its own way: ask it for a little more
    tree = cKDTree(_in_the_box(position, box), boxsize=box.span)
    found = tree.query_pairs(reach * (1.0 + 1e-9), output_type="ndarray")
    ends = np.sort(found.astype(np.int64), axis=1)
    return np.asarray(ends[np.lexsort((ends[:, 1], ends[:, 0]))])


def _in_the_box(position: Floats, box: Box) -> Floats:
    """Return positions from the lower corner on, below the span in directions that repeat, as the tree wants them."""
    inside = box.wrapped(position) - np.where(box.periodic, box.lower, 0.0)
    return np.where(box.periodic, np.clip(inside, 0.0, np.nextafter(box.span, 0.0)), inside)

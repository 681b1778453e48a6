"""Volumes of spheres that planes and tubes cut, exact for planes and by quadrature for tubes."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Inside = Callable[[Floats, Floats, float], Floats]
"""(places, radii, edge) -> volume of each sphere inside the edge."""
NODES = 10
"""Of Gauss and Legendre in each part of a sphere; the volume inside a tube is then right to 1e-5 of the sphere."""


def sphere_volumes(radius: Floats) -> Floats:
    """Return 4/3 π r³."""
    return np.asarray(4.0 / 3.0 * np.pi * radius**3)


def below_plane(height: Floats, radius: Floats, plane: float) -> Floats:
    """Return the volume of each sphere below a plane in m³.

    Equation: V = π c² (3 r − c)/3 with the height c = plane − z + r of the cap, between 0 and 2 r.

    Parameters
    ----------
    height, radius : (n,) float64
        Heights z of the centres and radii r in m.
    plane : float
        Height of the plane in m.

    Examples
    --------
    Half a unit sphere:

    >>> below_plane(np.zeros(1), np.ones(1), 0.0) * 3.0 / np.pi
    array([2.])
    """
    cap = np.clip(plane - height + radius, 0.0, 2.0 * radius)
    return np.asarray(np.pi * cap**2 * (3.0 * radius - cap) / 3.0)


def slab_volumes(height: Floats, radius: Floats, edges: Floats, weight: Floats | None = None) -> Floats:
    """Return the volume of spheres in each slab between neighbouring edges in m³; the outermost slabs reach on.

    Parameters
    ----------
    height, radius : (n,) float64
        Of the spheres in m.
    edges : (b + 1,) float64
        Heights of the planes, rising, in m.
    weight : (n,) or (n, k) float64, optional
        Factors on the volume of each sphere; with ``k`` columns the result has as many.

    Returns
    -------
    (b,) or (b, k) float64
        They add up to the volume of all spheres: what lies beyond the first and the last edge counts in their slabs.

    Examples
    --------
    >>> slab_volumes(np.zeros(1), np.ones(1), np.array([-9.0, 0.0, 9.0])) * 3.0 / np.pi
    array([2., 2.])
    """
    return _between(below_plane, height, radius, edges, weight)


def shell_volumes(distance: Floats, radius: Floats, edges: Floats, weight: Floats | None = None) -> Floats:
    """Return the volume of spheres in each shell between tubes about one axis in m³; the outermost shell reaches on.

    Parameters
    ----------
    distance, radius : (n,) float64
        Distances of the centres from the axis and radii in m.
    edges : (b + 1,) float64
        Radii of the tubes, rising from 0, in m.
    weight : (n,) or (n, k) float64, optional
        Factors on the volume of each sphere; with ``k`` columns the result has as many.

    Returns
    -------
    (b,) or (b, k) float64
        They add up to the volume of all spheres.
    """
    return _between(inside_tube, distance, radius, edges, weight)


def inside_tube(distance: Floats, radius: Floats, tube: float) -> Floats:
    """Return the volume of each sphere inside an infinite tube in m³.

    Equation: V = ∫ A(√(r² − h²), d, R) dh over the sphere, with the area A that the sphere's section at h and that of
    the tube share, two circles with the distance d of the centres; with h = r sin φ and Gauss and Legendre in φ between
    the bends of A, where one circle begins to lie in the other.

    Parameters
    ----------
    distance, radius : (n,) float64
        Distances d of the centres from the axis and radii r in m.
    tube : float
        Radius R of the tube in m.

    Examples
    --------
    A sphere about the axis without what is left of it when a hole is drilled through:

    >>> ring = 4.0 / 3.0 * np.pi * 0.75**1.5
    >>> error = inside_tube(np.zeros(1), np.ones(1), 0.5) - (4.0 / 3.0 * np.pi - ring)
    >>> bool(abs(error[0]) < 1e-5)
    True
    """
    bends = [np.arccos(np.minimum(bend / radius, 1.0)) for bend in (tube + distance, np.abs(tube - distance))]
    ends = [np.zeros(len(radius)), *bends, np.full(len(radius), 0.5 * np.pi)]
    volume = np.zeros(len(radius))
    x, weight = np.polynomial.legendre.leggauss(NODES)
    for first, last in pairwise(ends):  # of the half above the equator; the other is the same
        half = 0.5 * (last - first)
        section = radius[:, None] * np.cos(first[:, None] + half[:, None] * (x + 1.0))
        volume += 2.0 * half * ((_shared_area(section, distance[:, None], tube) * section) @ weight)
    return volume


def _shared_area(radius: Floats, distance: Floats, tube: float) -> Floats:
    """Return the area that circles share with one of the radius ``tube``."""
    small = np.minimum(radius, tube)
    apart, within = distance >= radius + tube, distance <= np.abs(tube - radius)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        a = (distance**2 + radius**2 - tube**2) / (2.0 * distance * radius)
        b = (distance**2 + tube**2 - radius**2) / (2.0 * distance * tube)
    product = (radius + tube - distance) * (distance + radius - tube) * (distance - radius + tube)
    root = np.sqrt(np.maximum(product * (distance + radius + tube), 0.0))
    lens = radius**2 * np.arccos(np.clip(a, -1.0, 1.0)) + tube**2 * np.arccos(np.clip(b, -1.0, 1.0)) - 0.5 * root
    return np.asarray(np.where(apart, 0.0, np.where(within, np.pi * small**2, lens)))


def _between(inside: Inside, place: Floats, radius: Floats, edges: Floats, weight: Floats | None) -> Floats:
    """Return what lies between edges, asking for the parts of those spheres only that an edge may cut."""
    order = np.argsort(place, kind="stable")
    place, radius = place[order], radius[order]
    weights = np.ones(len(place)) if weight is None else weight[order]
    of_all = np.cumsum((weights.T * sphere_volumes(radius)).T, axis=0)
    whole = np.concatenate([np.zeros_like(weights[:1]), of_all])
    reach = float(radius.max(initial=0.0))
    total = [whole[0]]
    for edge in edges[1:-1].tolist():
        first, last = np.searchsorted(place, [edge - reach, edge + reach])
        cut = slice(int(first), int(last))
        total.append(whole[first] + inside(place[cut], radius[cut], edge) @ weights[cut])
    return np.diff([*total, whole[-1]], axis=0)

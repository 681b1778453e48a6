"""Filling a body with spheres at random, and what is said where that cannot be."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from clast.engine.chunks import LARGE
from clast.errors import ConfigError, KeyPath, PackingError
from clast.maths.box import Box, open_space
from clast.scene.packing_report import contact_coordination, overlaps, sphere_volume
from clast_plugins.generators.packing.relax import Relaxed, relax
from clast_plugins.generators.packing.room import Floats, Room
from clast_plugins.generators.packing.spheres import Spheres, SpheresParams, millimetres, spheres_of

DENSEST = 0.66
"""Share of a body that equal spheres packed at random can fill: 0.64 in the bulk, less at a surface, and some luck."""
DENSER = 0.1
"""What a deviation of the diameters adds to that share: 0.03 at a deviation of 0.3 (R. S. Farr, Powder Technology 245
(2013) 28, doi:10.1016/j.powtec.2013.04.009)."""
# packings with less overlap left than this share of a diameter succeed with some seeds
NEARLY = 0.01

Told = dict[str, float | int | str]


class Body(NamedTuple):
    """What is filled.

    Attributes
    ----------
    room : Room
        In m.
    whole : float
        Diameter in m of the sphere with the volume that porosity refers to.
    words : str
        What it is, for messages.
    box : Box
        About the origin in m, with the directions in which the room repeats itself.
    """

    room: Room
    whole: float
    words: str
    box: Box = open_space()


def body_of(room: Room, words: str, box: Box | None = None) -> Body:
    """Return a room in m as a body whose porosity refers to all of its volume."""
    return Body(room, math.cbrt(6.0 * room.volume / math.pi), words, box or open_space())


class Filled(NamedTuple):
    """Spheres in their places about the origin: (n, 3) centres and (n,) radii in m, and how they came there."""

    spheres: Spheres
    position: Floats
    radius: Floats
    relaxed: Relaxed

    @property
    def relieved(self) -> bool:
        """Whether larger overlaps stay than were allowed."""
        return self.relaxed.overlap > self.spheres.allowed / self.spheres.primary


def plan(params: SpheresParams, body: Body) -> Spheres:
    """Return the spheres that a body is to be filled with.

    Raises
    ------
    ConfigError
        No random packing is so dense, or the largest sphere has no room.
    """
    spheres = spheres_of(params, body.whole)
    if spheres.largest > 2.0 * body.room.inradius * (1.0 + 1e-12):
        raise ConfigError(
            f"the largest primary, {millimetres(spheres.largest)}, does not fit into {body.words}, which has room for "
            f"spheres of up to {millimetres(2.0 * body.room.inradius)}; take smaller ones",
            ("primary_diameter",) if params.primary_deviation == 0.0 else ("primary_deviation",),
        )
    _refuse_impossible(params, body, spheres)
    return spheres


def fill(params: SpheresParams, body: Body) -> Filled:
    """Pack the spheres into a body.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set; or the largest sphere has no room.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set.
    """
    spheres = plan(params, body)
    d = spheres.primary
    relaxed = relax(spheres.shares, body.room.per(d), params.seed, spheres.allowed / d, body.box.per(d))
    filled = Filled(spheres, d * relaxed.position, 0.5 * (d * spheres.shares), relaxed)
    if filled.relieved and not params.accept_overlap:
        raise PackingError(_too_dense(params, body, filled), _density_key(params))
    return filled


def near_in_number(position: Floats) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    """Return the order (n,) in which neighbours in space are neighbours in number, in a large packing.

    Threads share runs of consecutive particles, and what is near is then found in the same cache.
    """
    if len(position) <= LARGE:
        return np.arange(len(position))
    from scipy.spatial import cKDTree

    return np.asarray(cKDTree(position).indices, np.int64)


def reached(params: SpheresParams, filled: Filled, position: Floats, radius: Floats, box: Box) -> Told:
    """Return what is told of the spheres that are left of a packing, in a box that may repeat itself."""
    left = overlaps(position, radius, box)
    spheres, relaxed = filled.spheres, filled.relaxed
    return {
        "seed": params.seed,
        **_spread(params, radius),
        "sweeps": relaxed.sweeps,
        "shakes": relaxed.shakes,
        "largest_overlap_m": left.largest,
        "largest_overlap_per_diameter": left.largest / spheres.primary,
        "mean_overlap_m": left.mean,
        "allowed_overlap_m": spheres.allowed,
        "overlaps_within_tolerance": "no, accepted; contacts start stress-free" if filled.relieved else "yes",
        "coordination_touching": contact_coordination(position, radius, box=box),
    }


def _spread(params: SpheresParams, radius: Floats) -> Told:
    if params.primary_deviation == 0.0:
        return {}
    return {
        "primary_diameter_mean_m": 2.0 * float(radius.mean()),
        "primary_diameter_deviation_m": 2.0 * float(radius.std()),
        "primary_diameter_smallest_m": 2.0 * float(radius.min()),
        "primary_diameter_largest_m": 2.0 * float(radius.max()),
    }


def _density_key(params: SpheresParams) -> KeyPath:
    return ("primaries",) if params.porosity is None else ("porosity",)


def _refuse_impossible(params: SpheresParams, body: Body, spheres: Spheres) -> None:
    """Refuse more primaries than fill their share of a body even where each pair overlaps as far as allowed."""
    count = len(spheres.shares)
    filled = count * sphere_volume(max(spheres.primary - spheres.allowed, 0.0)) / body.room.volume
    densest = DENSEST + DENSER * params.primary_deviation
    if count == 1 or params.accept_overlap or filled <= densest:
        return
    raise ConfigError(
        f"denser than any random packing: {_asked(params, spheres)} fill {filled:.0%} of {body.words}, and at most "
        f"{densest:.0%} can be filled. {_remedies(params)}",
        _density_key(params),
    )


def _asked(params: SpheresParams, spheres: Spheres) -> str:
    asked = "" if params.porosity is None else f" (porosity {params.porosity:g})"
    return f"{len(spheres.shares)} primaries of {millimetres(spheres.primary)}{asked}"


def _remedies(params: SpheresParams) -> str:
    knob = "fewer 'primaries'" if params.porosity is None else "a larger 'porosity'"
    return f"Take {knob}, or 'accept_overlap: true' to go on with the best packing found"


def _too_dense(params: SpheresParams, body: Body, filled: Filled) -> str:
    spheres, relaxed = filled.spheres, filled.relaxed
    left = 1e6 * relaxed.overlap * spheres.primary
    luck = "" if relaxed.overlap > NEARLY else "; little is missing, so another 'seed' may do"
    return (
        f"too dense for a random packing: {_asked(params, spheres)} in {body.words}; after {relaxed.sweeps} sweeps and "
        f"{relaxed.shakes} shakes the best packing still has an overlap of {left:.4g} um, "
        f"allowed are {1e6 * spheres.allowed:.4g} um. {_remedies(params)}{luck}"
    )

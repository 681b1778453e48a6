"""What the two agglomerates share: their common parameters, and a packing from a body and a count."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np
from pydantic import Field

from clast.config.quantities import Length, Number, Point
from clast.engine.chunks import LARGE
from clast.errors import PackingError
from clast.parts.generator import Estimate, Gaps, Packing, Prediction
from clast.parts.params import Params
from clast.scene.packing_report import contact_coordination, cut_sphere_surface, cut_sphere_volume, overlaps
from clast_plugins.generators.packing.container import Floats, around
from clast_plugins.generators.packing.near_pairs import near_pairs
from clast_plugins.generators.packing.relax import Relaxed, relax

MOST_PRIMARIES = 10_000_000
TOLERANCE = 1e-4
# packings with less overlap left than this share of a diameter succeed with some seeds
NEARLY = 0.01


class AgglomerateParams(Params):
    """Parameters of every agglomerate of equal spheres.

    The default tolerance, 1e-4 of a primary, makes the largest start force of a pair about 0.01 % of what
    yields its bond (glass of the paper: 1e-5 N of 0.1 N); an overlap of 1 µm, as in the paper's program,
    makes it 3 %.
    """

    material: Annotated[str, Field(description="Material of the primaries")]
    primary_diameter: Annotated[Length, Field(gt=0, description="Diameter of a primary")]
    porosity: Annotated[
        Number | None,
        Field(gt=0, lt=1, description="Share of the sphere that is left free; or give `primaries`"),
    ] = None
    primaries: Annotated[
        int | None, Field(ge=1, le=MOST_PRIMARIES, description="Number of primaries; or give `porosity`")
    ] = None
    seed: Annotated[int, Field(ge=0, description="Start of the random numbers; the same seed, the same packing")] = 1
    max_overlap: Annotated[
        Length | None,
        Field(gt=0, description="Largest overlap that may stay; by default 1e-4 primary diameters"),
    ] = None
    accept_overlap: Annotated[
        bool,
        Field(description="Take the best packing found even where larger overlaps stay, and report them"),
    ] = False
    centre: Annotated[Point, Field(description="Centre of the agglomerate")] = (0.0, 0.0, 0.0)


class Body(NamedTuple):
    """What is packed: a sphere about the origin, cut at ± half the height (infinite when uncut)."""

    diameter: float
    height: float
    words: str


def number_of_primaries(params: AgglomerateParams, diameter: float) -> int:
    """Return the count the user gave, or ⌊(1 − porosity)·(D/d)³⌋ for a sphere of diameter D.

    Raises
    ------
    ValueError
        Neither or both of ``porosity`` and ``primaries`` are given, or the count makes no sense.
    """
    if (params.porosity is None) == (params.primaries is None):
        raise ValueError("give exactly one of 'porosity' and 'primaries'")
    if params.primaries is not None:
        return params.primaries
    assert params.porosity is not None
    exact = (1.0 - params.porosity) * (diameter / params.primary_diameter) ** 3
    if not 1.0 <= exact <= MOST_PRIMARIES:
        raise ValueError(
            f"porosity {params.porosity:g} makes {math.floor(min(exact, 1e18))} primaries of "
            f"{millimetres(params.primary_diameter)} in {millimetres(diameter)}; "
            f"1 to {MOST_PRIMARIES} are allowed: check the diameters and their units"
        )
    # 0.5 · 2³ must give 4 however the diameters round
    return math.floor(exact * (1.0 + 1e-12))


def predict_agglomerate(params: AgglomerateParams, body: Body, count: int, gaps: Gaps | None) -> Prediction:
    """Return what packing ``count`` primaries into a body will make, with the bonds between near ones."""
    d = params.primary_diameter
    if gaps is None:
        bonds: Estimate | None = Estimate(0.0)
    else:
        size = (body.diameter / d, body.height / d)
        wanted = Gaps(gaps.least / d, gaps.most / d)
        bonds = near_pairs(count, cut_sphere_volume(*size), cut_sphere_surface(*size), wanted)
    return Prediction(count, 0.5 * d, params.material, bonds)


def near_in_number(position: Floats) -> Floats:
    """Return the positions of a large packing so numbered that neighbours in space are neighbours in number.

    Threads share runs of consecutive particles, and what is near is then found in the same cache.
    """
    if len(position) <= LARGE:
        return position
    from scipy.spatial import cKDTree

    return np.asarray(position[cKDTree(position).indices])


def make_agglomerate(params: AgglomerateParams, body: Body, count: int) -> tuple[Packing, dict[str, float | int | str]]:
    """Pack ``count`` primaries into a body; return the packing and what was reached.

    Raises
    ------
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set.
    """
    d = params.primary_diameter
    allowed = params.max_overlap if params.max_overlap is not None else TOLERANCE * d
    relaxed = relax(count, around(0.5 * body.diameter / d, 0.5 * body.height / d), params.seed, allowed / d)
    if relaxed.overlap > allowed / d and not params.accept_overlap:
        at = ("primaries",) if params.porosity is None else ("porosity",)
        raise PackingError(_too_dense(params, body, count, relaxed, allowed), at)
    position = np.asarray(params.centre) + d * near_in_number(relaxed.position)
    radius = np.full(count, 0.5 * d)
    packing = Packing(
        position=position,
        radius=radius,
        material=[params.material] * count,
        velocity=np.zeros((count, 3)),
        spin=np.zeros((count, 3)),
        prescribed=np.zeros(count, np.bool_),
        grain=np.zeros(count, np.int64),
        relieved=relaxed.overlap > allowed / d,
    )
    return packing, _reached(params, relaxed, position, radius, allowed)


def _reached(
    params: AgglomerateParams, relaxed: Relaxed, position: Floats, radius: Floats, allowed: float
) -> dict[str, float | int | str]:
    left = overlaps(position, radius)
    return {
        "seed": params.seed,
        "sweeps": relaxed.sweeps,
        "shakes": relaxed.shakes,
        "largest_overlap_m": left.largest,
        "largest_overlap_per_diameter": left.largest / params.primary_diameter,
        "mean_overlap_m": left.mean,
        "allowed_overlap_m": allowed,
        "overlaps_within_tolerance": "yes"
        if relaxed.overlap * params.primary_diameter <= allowed
        else "no, accepted; contacts start stress-free",
        "coordination_touching": contact_coordination(position, radius),
    }


def _too_dense(params: AgglomerateParams, body: Body, count: int, relaxed: Relaxed, allowed: float) -> str:
    asked = "" if params.porosity is None else f" (porosity {params.porosity:g})"
    knob = "fewer 'primaries'" if params.porosity is None else "a larger 'porosity'"
    left = relaxed.overlap * params.primary_diameter
    luck = "" if relaxed.overlap > NEARLY else "; little is missing, so another 'seed' may do"
    return (
        f"too dense for a random packing: {count} primaries of {millimetres(params.primary_diameter)}{asked} "
        f"in {body.words}; after {relaxed.sweeps} sweeps and {relaxed.shakes} shakes the best packing still "
        f"has an overlap of {1e6 * left:.4g} um, allowed are {1e6 * allowed:.4g} um. Take {knob}, or "
        f"'accept_overlap: true' to go on with the best packing found{luck}"
    )


def millimetres(length: float) -> str:
    """Return a length as a user writes it.

    >>> millimetres(0.00025)
    '0.25 mm'
    """
    return f"{1e3 * length:.6g} mm"

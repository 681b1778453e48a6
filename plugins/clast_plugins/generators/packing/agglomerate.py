"""What the two agglomerates share: their common parameters, and a packing from a body and a count."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np
from pydantic import Field, model_validator

from clast.config.quantities import Length, Number, Point
from clast.engine.chunks import LARGE
from clast.errors import ConfigError, KeyPath, PackingError
from clast.parts.generator import Estimate, Gaps, Packing, Prediction
from clast.parts.params import Params
from clast.scene.packing_report import (
    contact_coordination,
    cut_sphere_surface,
    cut_sphere_volume,
    overlaps,
    sphere_volume,
)
from clast_plugins.generators.packing.container import Container, Floats, around
from clast_plugins.generators.packing.macro_pores import MacroPores, carve, make_voids, report_of
from clast_plugins.generators.packing.near_pairs import near_pairs
from clast_plugins.generators.packing.pore_estimates import Bulk, pairs_left, primaries_inside
from clast_plugins.generators.packing.relax import Relaxed, relax

MOST_PRIMARIES = 10_000_000
TOLERANCE = 1e-4
DENSEST = 0.66
"""Share of a body that spheres packed at random can fill: 0.64 in the bulk, less at a surface, and some luck."""
# packings with less overlap left than this share of a diameter succeed with some seeds
NEARLY = 0.01


class AgglomerateParams(Params):
    """Parameters of every agglomerate of equal spheres.

    The default tolerance, 1e-4 of a primary, makes the largest start force of a pair about 0.01 % of what
    yields its bond (glass of the paper: 1e-5 N of 0.1 N); an overlap of 1 µm, as in the paper's program,
    makes it 3 %.
    """

    material: Annotated[str, Field(examples=["glass"], description="Material of the primaries")]
    primary_diameter: Annotated[
        Length | None,
        Field(gt=0, examples=["0.25 mm"], description="Diameter of a primary; or give `porosity` and `primaries`"),
    ] = None
    porosity: Annotated[
        Number | None,
        Field(
            gt=0,
            lt=1,
            examples=[0.55],
            description="Share of the sphere that is left free; two of these three are needed",
        ),
    ] = None
    primaries: Annotated[
        int | None, Field(ge=1, le=MOST_PRIMARIES, description="Number of primaries; two of these three are needed")
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
    macro_pores: Annotated[
        MacroPores | None,
        Field(description="Voids carved out of the packing; porosity and primaries are those before"),
    ] = None

    @model_validator(mode="after")
    def _two_of_three(self) -> AgglomerateParams:
        three = ("primary_diameter", "porosity", "primaries")
        given = [name for name in three if getattr(self, name) is not None]
        if len(given) != 2:
            told = " and ".join(given) or "none of them"
            raise ValueError(f"exactly two of primary_diameter, porosity and primaries are needed; given {told}")
        return self

    @property
    def whole(self) -> float:
        """Diameter in m of the sphere that porosity refers to."""
        raise NotImplementedError

    @property
    def primary(self) -> float:
        """Diameter of a primary in m, as given or so that ``primaries`` leave the share ``porosity`` free."""
        if self.primary_diameter is not None:
            return self.primary_diameter
        assert self.primaries is not None
        assert self.porosity is not None
        return float(self.whole * math.cbrt((1.0 - self.porosity) / self.primaries))


class Body(NamedTuple):
    """What is packed: a sphere about the origin, cut at ± half the height (infinite when uncut)."""

    diameter: float
    height: float
    words: str

    @property
    def volume(self) -> float:
        """Volume in m³."""
        return cut_sphere_volume(self.diameter, self.height)


def number_of_primaries(params: AgglomerateParams) -> int:
    """Return the count the user gave, or ⌊(1 − porosity)·(D/d)³⌋ for a sphere of diameter D.

    Raises
    ------
    ValueError
        The count makes no sense.
    """
    if params.primaries is not None:
        return params.primaries
    assert params.porosity is not None
    exact = (1.0 - params.porosity) * (params.whole / params.primary) ** 3
    if not 1.0 <= exact <= MOST_PRIMARIES:
        raise ValueError(
            f"porosity {params.porosity:g} makes {math.floor(min(exact, 1e18))} primaries of "
            f"{millimetres(params.primary)} in {millimetres(params.whole)}; "
            f"1 to {MOST_PRIMARIES} are allowed: check the diameters and their units"
        )
    # 0.5 · 2³ must give 4 however the diameters round
    return math.floor(exact * (1.0 + 1e-12))


def predict_agglomerate(params: AgglomerateParams, body: Body, gaps: Gaps | None) -> Prediction:
    """Return what packing the primaries into a body will make, with the bonds between near ones.

    Raises
    ------
    ConfigError
        No random packing is so dense, or its pores make no sense.
    PackingError
        There is no room for its pores.
    """
    count = number_of_primaries(params)
    _refuse_impossible(params, body, count)
    d = params.primary
    size = (body.diameter / d, body.height / d)
    packed = Bulk(count, cut_sphere_volume(*size), cut_sphere_surface(*size))
    wanted = None if gaps is None else gaps.per(d)
    bonds = Estimate(0.0) if wanted is None else near_pairs(*packed, wanted)
    if params.macro_pores is None:
        return Prediction(count, 0.5 * d, params.material, bonds)
    pores = make_voids(params.macro_pores, _room(body), body.volume).diameter / d
    inside = primaries_inside(packed, pores)
    left = count - round(inside.value)
    if wanted is not None and bonds is not None:
        bonds = pairs_left(packed, bonds, pores, wanted)
    return Prediction(left, 0.5 * d, params.material, bonds, inside.band * inside.value / left)


def near_in_number(position: Floats) -> Floats:
    """Return the positions of a large packing so numbered that neighbours in space are neighbours in number.

    Threads share runs of consecutive particles, and what is near is then found in the same cache.
    """
    if len(position) <= LARGE:
        return position
    from scipy.spatial import cKDTree

    return np.asarray(position[cKDTree(position).indices])


def make_agglomerate(params: AgglomerateParams, body: Body) -> tuple[Packing, dict[str, float | int | str]]:
    """Pack the primaries into a body; return the packing and what was reached.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set; or there is no room for the pores, or they
        cut the grain into pieces.
    """
    count = number_of_primaries(params)
    _refuse_impossible(params, body, count)
    d, allowed = params.primary, _allowed_overlap(params)
    relaxed = relax(count, around(0.5 * body.diameter / d, 0.5 * body.height / d), params.seed, allowed / d)
    if relaxed.overlap > allowed / d and not params.accept_overlap:
        raise PackingError(_too_dense(params, body, count, relaxed, allowed), _density_key(params))
    position, pores = _with_pores(params, body, relaxed.position)
    position = np.asarray(params.centre) + d * near_in_number(position)
    count = len(position)
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
    return packing, pores | _reached(params, relaxed, position, radius, allowed)


def _with_pores(params: AgglomerateParams, body: Body, position: Floats) -> tuple[Floats, dict[str, float | int | str]]:
    """Return the primaries (n, 3), in their diameters, that pores leave, and what is told of the pores."""
    if params.macro_pores is None:
        return position, {}
    voids = make_voids(params.macro_pores, _room(body), body.volume)
    carved = carve(voids, params.primary * position, params.primary)
    return position[carved.kept], {**report_of(voids, carved, body.volume)}


def _room(body: Body) -> Container:
    return Container(0.5 * body.diameter, 0.5 * body.height)


def _allowed_overlap(params: AgglomerateParams) -> float:
    return params.max_overlap if params.max_overlap is not None else TOLERANCE * params.primary


def _density_key(params: AgglomerateParams) -> KeyPath:
    return ("primaries",) if params.porosity is None else ("porosity",)


def _refuse_impossible(params: AgglomerateParams, body: Body, count: int) -> None:
    """Refuse more primaries than fill their share of a body even where each pair overlaps as far as allowed."""
    d = max(params.primary - _allowed_overlap(params), 0.0)
    filled = count * sphere_volume(d) / body.volume
    if count == 1 or params.accept_overlap or filled <= DENSEST:
        return
    raise ConfigError(
        f"denser than any random packing: {_asked(params, count)} fill {filled:.0%} of {body.words}, and at most "
        f"{DENSEST:.0%} can be filled. {_remedies(params)}",
        _density_key(params),
    )


def _asked(params: AgglomerateParams, count: int) -> str:
    asked = "" if params.porosity is None else f" (porosity {params.porosity:g})"
    return f"{count} primaries of {millimetres(params.primary)}{asked}"


def _remedies(params: AgglomerateParams) -> str:
    knob = "fewer 'primaries'" if params.porosity is None else "a larger 'porosity'"
    return f"Take {knob}, or 'accept_overlap: true' to go on with the best packing found"


def _reached(
    params: AgglomerateParams, relaxed: Relaxed, position: Floats, radius: Floats, allowed: float
) -> dict[str, float | int | str]:
    left = overlaps(position, radius)
    return {
        "seed": params.seed,
        "sweeps": relaxed.sweeps,
        "shakes": relaxed.shakes,
        "largest_overlap_m": left.largest,
        "largest_overlap_per_diameter": left.largest / params.primary,
        "mean_overlap_m": left.mean,
        "allowed_overlap_m": allowed,
        "overlaps_within_tolerance": "yes"
        if relaxed.overlap * params.primary <= allowed
        else "no, accepted; contacts start stress-free",
        "coordination_touching": contact_coordination(position, radius),
    }


def _too_dense(params: AgglomerateParams, body: Body, count: int, relaxed: Relaxed, allowed: float) -> str:
    left = relaxed.overlap * params.primary
    luck = "" if relaxed.overlap > NEARLY else "; little is missing, so another 'seed' may do"
    return (
        f"too dense for a random packing: {_asked(params, count)} in {body.words}; after {relaxed.sweeps} sweeps and "
        f"{relaxed.shakes} shakes the best packing still has an overlap of {1e6 * left:.4g} um, allowed are "
        f"{1e6 * allowed:.4g} um. {_remedies(params)}{luck}"
    )


def millimetres(length: float) -> str:
    """Return a length as a user writes it.

    >>> millimetres(0.00025)
    '0.25 mm'
    """
    return f"{1e3 * length:.6g} mm"

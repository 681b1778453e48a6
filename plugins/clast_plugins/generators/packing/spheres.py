"""The spheres of a random packing: how many there are and how large, from two of three numbers and a spread."""

from __future__ import annotations

import math
from typing import Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field, model_validator

from clast.config.quantities import Length, Number, Point
from clast.parts.params import Params
from clast_plugins.generators.packing.room import Floats
from clast_plugins.generators.sizes import lognormal_sizes, sizes

MOST_PRIMARIES = 10_000_000
TOLERANCE = 1e-4
WIDEST = 0.3
"""Largest deviation as a share of the mean: where the distribution is cut, a sphere is still a tenth of the mean."""


class SpheresParams(Params):
    """Parameters of every random packing of spheres.

    The default tolerance, 1e-4 of a primary, makes the largest start force of a pair about 0.01 % of what
    yields its bond (glass of the paper: 1e-5 N of 0.1 N); an overlap of 1 µm, as in the paper's program,
    makes it 3 %.
    """

    material: Annotated[str, Field(examples=["glass"], description="Material of the primaries")]
    primary_diameter: Annotated[
        Length | None,
        Field(
            gt=0,
            examples=["0.25 mm"],
            description="Diameter of a primary, of the one of mean volume where they differ; "
            "or give `porosity` and `primaries`",
        ),
    ] = None
    primary_deviation: Annotated[
        Number,
        Field(
            ge=0,
            le=WIDEST,
            description="Standard deviation of the diameters of the primaries, as a share of their mean; 0: all equal",
        ),
    ] = 0.0
    primary_distribution: Annotated[
        Literal["normal", "lognormal"],
        Field(description="Distribution of the diameters where they differ, cut at three deviations"),
    ] = "normal"
    porosity: Annotated[
        Number | None,
        Field(
            gt=0,
            lt=1,
            examples=[0.55],
            description="Share of the body that is left free; two of these three are needed",
        ),
    ] = None
    primaries: Annotated[
        int | None, Field(ge=1, le=MOST_PRIMARIES, description="Number of primaries; two of these three are needed")
    ] = None
    seed: Annotated[int, Field(ge=0, description="Start of the random numbers; the same seed, the same packing")] = 1
    max_overlap: Annotated[
        Length | None,
        Field(gt=0, description="Largest overlap that may stay; by default 1e-4 diameters of the smallest primary"),
    ] = None
    accept_overlap: Annotated[
        bool,
        Field(description="Take the best packing found even where larger overlaps stay; contacts push beyond them"),
    ] = False
    centre: Annotated[Point, Field(description="Centre of the packing")] = (0.0, 0.0, 0.0)

    @model_validator(mode="after")
    def _two_of_three(self) -> SpheresParams:
        three = ("primary_diameter", "porosity", "primaries")
        given = [name for name in three if getattr(self, name) is not None]
        if len(given) != 2:
            told = " and ".join(given) or "none of them"
            raise ValueError(f"exactly two of primary_diameter, porosity and primaries are needed; given {told}")
        return self


class Spheres(NamedTuple):
    """What is packed.

    Attributes
    ----------
    primary : float
        Diameter in m of the sphere of mean volume.
    shares : (n,) float64
        Diameters in ``primary``, rising.
    allowed : float
        Overlap that may stay, in m.
    """

    primary: float
    shares: Floats
    allowed: float

    @property
    def smallest(self) -> float:
        """Diameter of the smallest sphere in m."""
        return float(self.primary * self.shares[0])

    @property
    def largest(self) -> float:
        """Diameter of the largest sphere in m."""
        return float(self.primary * self.shares[-1])


def spheres_of(params: SpheresParams, whole: float) -> Spheres:
    """Return the spheres that fill a body of the volume of a sphere of diameter ``whole`` in m.

    Their volumes add up to that of as many spheres of the diameter ``primary``, whatever their distribution.

    Raises
    ------
    ValueError
        The count makes no sense.
    """
    primary = primary_of(params, whole)
    shares = _shares(params, number_of_primaries(params, whole))
    allowed = params.max_overlap if params.max_overlap is not None else TOLERANCE * primary * float(shares[0])
    return Spheres(primary, shares, allowed)


def primary_of(params: SpheresParams, whole: float) -> float:
    """Return the diameter of a primary in m, as given or so that ``primaries`` leave the share ``porosity`` free."""
    if params.primary_diameter is not None:
        return params.primary_diameter
    assert params.primaries is not None
    assert params.porosity is not None
    return float(whole * math.cbrt((1.0 - params.porosity) / params.primaries))


def number_of_primaries(params: SpheresParams, whole: float) -> int:
    """Return the count the user gave, or ⌊(1 − porosity)·(D/d)³⌋ for the volume of a sphere of diameter D.

    Raises
    ------
    ValueError
        The count makes no sense.
    """
    if params.primaries is not None:
        return params.primaries
    assert params.porosity is not None
    primary = primary_of(params, whole)
    exact = (1.0 - params.porosity) * (whole / primary) ** 3
    if not 1.0 <= exact <= MOST_PRIMARIES:
        raise ValueError(
            f"porosity {params.porosity:g} makes {math.floor(min(exact, 1e18))} primaries of "
            f"{millimetres(primary)} in the volume of a sphere of {millimetres(whole)}; "
            f"1 to {MOST_PRIMARIES} are allowed: check the diameters and their units"
        )
    # 0.5 · 2³ must give 4 however the diameters round
    return math.floor(exact * (1.0 + 1e-12))


def _shares(params: SpheresParams, count: int) -> Floats:
    """Return ``count`` diameters in that of the sphere of mean volume, rising."""
    if params.primary_deviation == 0.0:
        return np.ones(count)
    normal = params.primary_distribution == "normal"
    drawn = sizes(count, 1.0, params.primary_deviation) if normal else lognormal_sizes(count, params.primary_deviation)
    return np.asarray(drawn * math.cbrt(count / math.fsum(drawn**3)))


def millimetres(length: float) -> str:
    """Return a length as a user writes it.

    >>> millimetres(0.00025)
    '0.25 mm'
    """
    return f"{1e3 * length:.6g} mm"

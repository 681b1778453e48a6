"""Macro-pores: spherical voids carved out of a packing, as the large pores that a microscope shows in a granule.

A primary goes where its centre lies in a void. What then hangs on nothing would fall off in reality: primaries
from which no chain of neighbours, each within half a primary diameter, leads to the largest piece go too.

Source of the picture: Rotter, Dosta and Düster (2023), doi:10.1007/s40571-023-00610-0, Fig. 4. The distribution of
sizes and places is not in the paper.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Discriminator, Field, Tag, model_validator

from clast.config.problems import problem, refuse
from clast.config.quantities import Length, Number
from clast.errors import ConfigError, PackingError
from clast.maths.counter_random import uniform
from clast.maths.distributions import lognormal
from clast.parts.params import Params
from clast.results.fragments import fragments
from clast.scene.bonding import close_pairs
from clast.scene.packing_report import sphere_volume
from clast_plugins.generators.packing.room import Floats, Room

MOST_PORES = 100_000
TRIALS, BATCHES, STARTS = 64, 32, 20
"""Places tried at a time and how often for a pore, and how often all pores are placed anew."""
REACH = 0.5
"""Largest gap, in mean primary diameters, across which primaries hold together."""
MOST_LOOSE = 0.05
"""Share of the primaries that may fall off; with more the grain is in pieces."""


class PoreSize(Params):
    """How large pores are: their diameters have a lognormal distribution."""

    mean: Annotated[Length, Field(gt=0, description="Mean diameter")]
    deviation: Annotated[Length, Field(gt=0, description="Standard deviation of the diameters")]


def _size_branch(given: object) -> str:
    return "<sizes>" if isinstance(given, dict | PoreSize) else "<diameter>"


class MacroPores(Params):
    """Spherical voids at random places in a grain; they overlap neither each other nor its surface."""

    count: Annotated[int | None, Field(ge=1, le=MOST_PORES, description="Number of pores; or give `porosity`")] = None
    porosity: Annotated[
        Number | None, Field(gt=0, lt=1, description="Share of the grain's volume that the pores take; or give `count`")
    ] = None
    diameter: Annotated[
        Annotated[PoreSize, Tag("<sizes>")] | Annotated[Length, Field(gt=0), Tag("<diameter>")],
        Discriminator(_size_branch),
        Field(description="Diameter of all pores, or mean and deviation"),
    ]
    wall: Annotated[
        Length, Field(ge=0, description="Least distance of a pore from the others and from the grain's surface")
    ] = 0.0
    seed: Annotated[int, Field(ge=0, lt=2**32, description="Start of the random numbers; same seed, same pores")] = 1

    @model_validator(mode="after")
    def _count_or_porosity(self) -> MacroPores:
        if (self.count is None) == (self.porosity is None):
            raise ValueError("give exactly one of 'count' and 'porosity'")
        return self

    @property
    def mean_diameter(self) -> float:
        """Mean diameter in m."""
        return self.diameter.mean if isinstance(self.diameter, PoreSize) else self.diameter


class Voids(NamedTuple):
    """Pores of a grain about the origin: (p, 3) centres and (p,) diameters in m."""

    centre: Floats
    diameter: Floats

    @property
    def volume(self) -> float:
        """Volume of all pores in m³."""
        return math.fsum(sphere_volume(1.0) * self.diameter**3)


def refuse_senseless(pores: MacroPores | None, room: float, primary: float) -> None:
    """Refuse pores that are larger than the room they have, or smaller than a primary; lengths in m.

    Raises
    ------
    ValidationError
    """
    if pores is None:
        return
    mean, text = pores.mean_diameter, ""
    if mean + 2.0 * pores.wall > room:
        text = f"a pore of {_mm(mean)} with walls of {_mm(pores.wall)} does not fit into a grain of {_mm(room)}"
    elif mean < primary:
        text = (
            f"a pore of {_mm(mean)} is smaller than a primary of {_mm(primary)}; so small ones are part of the "
            "packing's own porosity"
        )
    if text:
        raise refuse([problem(("macro_pores", "diameter"), text)])


def make_voids(pores: MacroPores, grain: Room) -> Voids:
    """Draw pores and place them at random in a grain.

    Parameters
    ----------
    pores : MacroPores
    grain : Room
        The grain itself, in m.

    Raises
    ------
    ConfigError
        The share asked for is less than half a pore, or more pores than can be counted.
    PackingError
        There is no room for all of them.
    """
    diameter = np.sort(_diameters(pores, grain.volume))[::-1]
    stream = np.random.Philox(pores.seed)
    most = 0
    for _ in range(STARTS):
        centre = _place(stream, diameter, pores.wall, grain)
        if len(centre) == len(diameter):
            return Voids(centre, diameter)
        most = max(most, len(centre))
    share = math.fsum(sphere_volume(1.0) * diameter**3) / grain.volume
    raise PackingError(
        f"no room for {len(diameter)} pores of {_mm(diameter[-1])} to {_mm(diameter[0])}, {share:.0%} of the grain, "
        f"that keep {_mm(pores.wall)} from each other and from the surface: the best of {STARTS} attempts placed "
        f"{most}. Take fewer or smaller pores, a thinner 'wall', or another 'seed'",
        ("macro_pores",),
    )


def _diameters(pores: MacroPores, volume: float) -> Floats:
    """Return the diameters in the order in which they are drawn."""
    if pores.count is not None:
        return _drawn(pores, pores.count)
    assert pores.porosity is not None
    wanted = pores.porosity * volume
    count = math.ceil(2.0 * wanted / sphere_volume(pores.mean_diameter)) + 1
    if count > MOST_PORES:
        raise ConfigError(
            f"a share of {pores.porosity:g} makes more than {MOST_PORES // 2} pores of {_mm(pores.mean_diameter)}; "
            "check the diameter and its unit",
            ("macro_pores",),
        )
    filled = np.cumsum(sphere_volume(1.0) * _drawn(pores, count) ** 3)
    nearest = int(np.argmin(np.abs(np.append(0.0, filled) - wanted)))
    if nearest == 0:
        raise ConfigError(
            f"a share of {pores.porosity:g} is less than half a pore of {_mm(pores.mean_diameter)}; take a larger "
            "share, or smaller pores",
            ("macro_pores", "porosity"),
        )
    return _drawn(pores, nearest)


def _drawn(pores: MacroPores, count: int) -> Floats:
    if not isinstance(pores.diameter, PoreSize):
        return np.full(count, pores.diameter)
    u = np.array([uniform(pores.seed, pore, 0, 0) for pore in range(count)])
    return pores.diameter.mean * lognormal(u, pores.diameter.deviation / pores.diameter.mean)


def _place(stream: np.random.Philox, diameter: Floats, wall: float, grain: Room) -> Floats:
    """Return the centres of as many pores as found room, one after the other."""
    centre = np.empty((0, 3))
    for pore, each in enumerate(diameter):
        least = 0.5 * (diameter[:pore] + each) + wall
        found = _free_place(stream, grain, 0.5 * each + wall, centre, least)
        if found is None:
            return centre
        centre = np.vstack([centre, found])
    return centre


def _free_place(stream: np.random.Philox, grain: Room, margin: float, centre: Floats, least: Floats) -> Floats | None:
    """Return a random place with at least these distances from the centres there are, None where none was found."""
    if margin > grain.inradius:
        return None
    for _ in range(BATCHES):
        trial = grain.random(stream, TRIALS, margin)
        way = trial[:, None, :] - centre[None, :, :]
        free = ((way**2).sum(axis=2) >= least**2).all(axis=1)
        if free.any():
            return np.asarray(trial[int(np.argmax(free))])
    return None


class Carved(NamedTuple):
    """What pores leave of a packing: which primaries stay, and how many fell into pores and off."""

    kept: NDArray[np.bool_]
    inside: int
    loose: int


def carve(voids: Voids, position: Floats, radius: Floats) -> Carved:
    """Take the primaries out of the pores, and those off that then hang on nothing.

    Parameters
    ----------
    position : (n, 3) float64
        Centres in m.
    radius : (n,) float64
        Radii in m.

    Raises
    ------
    PackingError
        The pores leave nothing, or cut the grain into pieces.
    """
    kept = np.ones(len(position), bool)
    for centre, diameter in zip(*voids, strict=True):
        kept &= ((position - centre) ** 2).sum(axis=1) >= (0.5 * diameter) ** 2
    inside = int(np.count_nonzero(~kept))
    if not kept.any():
        raise PackingError("the pores leave no primary; take fewer or smaller pores", ("macro_pores",))
    left = np.flatnonzero(kept)
    ends, _ = close_pairs(position[left], radius[left], REACH * 2.0 * float(radius.mean()))
    piece = fragments(len(left), ends, np.ones(len(ends), bool))
    fallen = left[piece != np.argmax(np.bincount(piece))]
    if len(fallen) > MOST_LOOSE * len(left):
        raise PackingError(
            f"the pores cut the grain into {piece.max() + 1} pieces: {len(fallen)} of {len(left)} primaries do not "
            "hang on the largest. Take fewer or smaller pores, a thicker 'wall', or another 'seed'",
            ("macro_pores",),
        )
    kept[fallen] = False
    return Carved(kept, inside, len(fallen))


def report_of(voids: Voids, carved: Carved, volume: float) -> dict[str, float | int]:
    """Return what a user wants to know of the pores in a grain of some volume in m³."""
    return {
        "primaries_packed": len(carved.kept),
        "macro_pores": len(voids.diameter),
        "macro_pore_mean_diameter_m": float(voids.diameter.mean()),
        "macro_pore_share": voids.volume / volume,
        "primaries_in_macro_pores": carved.inside,
        "primaries_loose": carved.loose,
    }


def _mm(length: float) -> str:
    return f"{1e3 * length:.4g} mm"

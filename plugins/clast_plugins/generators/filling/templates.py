"""Templates: a few packings of each fraction, from which all its grains are made, turned and scaled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.errors import ConfigError, KeyPath, about
from clast.parts.generator import Packing, Site

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Template:
    """One grain, about its centre of mass.

    Attributes
    ----------
    arm : (n, 3) float64
        Centres of the primaries in m.
    radius, mass : (n,) float64
        Radii in m and masses in kg.
    material : list of n str
    reach : float
        Radius of the sphere about the centre that holds it, in m.
    """

    arm: Floats
    radius: Floats
    mass: Floats
    material: list[str]
    reach: float


def templates(chosen: Chosen, count: int, site: Site, at: KeyPath) -> list[Template]:
    """Return ``count`` different packings of one generator; only one where it knows no seed.

    Parameters
    ----------
    chosen : Chosen
        The generator; its seeds are its own, and the numbers after it.
    count : int
    site : Site
    at : key path
        Where the generator stands, for its errors.
    """
    seed = getattr(chosen.params, "seed", None)
    if not isinstance(seed, int):
        seeds = [chosen.params]
    else:
        seeds = [chosen.params.model_copy(update={"seed": seed + k}) for k in range(count)]
    with about(*at):
        return [centred(chosen.part.generate(params, site), site) for params in seeds]


def centred(packing: Packing, site: Site) -> Template:
    """Return a packing as a template."""
    missing = [name for name in packing.material if name not in site.density]
    if missing:
        known = ", ".join(site.density)
        raise ConfigError(f"there is no material {missing[0]!r}; known are {known}", ("material",))
    density = np.array([site.density[name] for name in packing.material])
    mass = density * 4.0 / 3.0 * np.pi * packing.radius**3
    arm = packing.position - (mass[:, None] * packing.position).sum(axis=0) / mass.sum()
    reach = float((np.sqrt((arm**2).sum(axis=1)) + packing.radius).max())
    return Template(arm, packing.radius, mass, packing.material, reach)

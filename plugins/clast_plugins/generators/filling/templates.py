"""Templates: a few packings of each fraction, from which all its grains are made, turned and scaled."""

from __future__ import annotations

from collections.abc import Sequence
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
    relieved : bool
        Whether its overlaps count as undeformed.
    """

    arm: Floats
    radius: Floats
    mass: Floats
    material: list[str]
    reach: float
    relieved: bool = False


def templates(chosen: Chosen, count: int, site: Site, at: KeyPath, dice: Sequence[int]) -> list[Template]:
    """Return ``count`` different packings of one generator; only one where it knows no seed.

    Parameters
    ----------
    chosen : Chosen
        The generator.
    count : int
    site : Site
    at : key path
        Where the generator stands, for its errors.
    dice : sequence of int
        What, beside the generator's own seed, the seeds of the packings are made of.
    """
    seed = getattr(chosen.params, "seed", None)
    with about(*at):
        if not isinstance(seed, int):
            return [centred(chosen.part.generate(chosen.params, site), site)]
        seeds = np.random.SeedSequence([*dice, seed]).generate_state(count).tolist()
        each = (chosen.params.model_copy(update={"seed": seed}) for seed in seeds)
        return [centred(chosen.part.generate(params, site), site) for params in each]


def centred(packing: Packing, site: Site) -> Template:
    """Return a packing as a template.

    Raises
    ------
    ConfigError
        It brings what cannot be turned and scaled, or a material that is not there.
    """
    loads = {"force": packing.force, "torque": packing.torque}
    carried = [name for name, given in loads.items() if given is not None and given.any()]
    carried += ["bonds"] if packing.bonds is not None and len(packing.bonds.ends) else []
    carried += ["prescribed particles"] if packing.prescribed.any() else []
    if carried:
        raise ConfigError(
            f"brings {' and '.join(carried)}, which a template of a fill cannot have; bond primaries with bonds.between"
        )
    missing = [name for name in packing.material if name not in site.density]
    if missing:
        known = ", ".join(site.density)
        raise ConfigError(f"there is no material {missing[0]!r}; known are {known}", ("material",))
    density = np.array([site.density[name] for name in packing.material])
    mass = density * 4.0 / 3.0 * np.pi * packing.radius**3
    arm = packing.position - (mass[:, None] * packing.position).sum(axis=0) / mass.sum()
    reach = float((np.sqrt((arm**2).sum(axis=1)) + packing.radius).max())
    return Template(arm, packing.radius, mass, packing.material, reach, packing.relieved)

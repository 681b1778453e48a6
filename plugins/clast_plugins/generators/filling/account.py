"""What is told of a finished fill, and of one that does not fit."""

from __future__ import annotations

from collections.abc import Iterable
from math import pi

import numpy as np
from numpy.typing import NDArray

from clast_plugins.generators.filling.recipe import Recipe
from clast_plugins.generators.filling.rigid import Grains, neighbours_touching
from clast_plugins.generators.filling.room import Room
from clast_plugins.generators.filling.settle import Settled

Floats = NDArray[np.float64]


def account(
    fractions: Iterable[str], room: Room, recipe: Recipe, grains: Grains, poured: Floats, settled: Settled
) -> dict[str, float | int | str]:
    """Return what a fill of fractions with these names reached; ``poured`` (g, 3) are the centres of the spheres.

    Porosity between grains counts each grain as a sphere of its diameter.
    """
    names, volume, mass = list(fractions), room.section * settled.height, float(recipe.mass.sum())
    told: dict[str, float | int | str] = {"grains": len(recipe.kind), "primaries": len(grains.radius)}
    told |= {f"grains_of_{name}": n for name, n in zip(names, recipe.counts.grains.tolist(), strict=True)}
    if recipe.counts.family is not None:
        ends = (f"{name} {a:.0f} to {b:.0f}" for name, (a, b) in zip(names, recipe.counts.family, strict=True))
        told["counts_that_number_and_mass_allow"] = ", ".join(ends)
    return told | {
        "mass_kg": mass,
        "size_factor": recipe.factor,
        "mean_diameter_m": float(recipe.diameter.mean()),
        "height_m": settled.height,
        "bulk_density_kg_per_m3": mass / volume,
        "porosity_between_primaries": 1.0 - float(grains.volume.sum()) / volume,
        "porosity_between_grains": 1.0 - float((pi / 6.0 * recipe.diameter**3).sum()) / volume,
        "coordination_of_grains": neighbours_touching(grains),
        "height_of_poured_spheres_m": float((poured[:, 2] + grains.reach).max()),
        "largest_overlap_m": settled.overlap,
    }


def too_full(height: float | None, overlap: float, allowed: float) -> str:
    """Return what to tell of grains that do not fit under a height in m without an overlap in m."""
    lid = f"under a height of {1e3 * height:.4g} mm " if height is not None else ""
    return (
        f"the grains do not fit {lid}without overlaps: {1e6 * overlap:.4g} um stay, allowed are {1e6 * allowed:.4g}; "
        "raise 'height', take fewer grains, or a larger room"
    )

"""What is told of a finished fill, and of one that does not fit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.granular.envelope import hull_volume
from clast_plugins.generators.filling.recipe import Recipe
from clast_plugins.generators.filling.rigid import Grains, list_pairs, neighbours_touching
from clast_plugins.generators.filling.room import Room
from clast_plugins.generators.filling.settle import Settled

Floats = NDArray[np.float64]


class Bed(NamedTuple):
    """Settled grains, the centres (g, 3) in m of the spheres poured for them, and how often it took to pour them."""

    grains: Grains
    poured: Floats
    settled: Settled
    tries: int


def account(
    fractions: Iterable[str], room: Room, asked: float | None, recipe: Recipe, bed: Bed
) -> dict[str, float | int | str]:
    """Return what a fill of fractions with these names reached.

    Densities and porosities are those below the height in m that was ``asked``, or below the mean surface where none
    was or the bed does not reach it. Porosities are those of :mod:`clast.granular`: in all, and between the grains,
    which then count with their pores, as convex hulls of their primaries.
    """
    grains, settled = bed.grains, bed.settled
    names, mass, surface = list(fractions), float(recipe.mass.sum()), mean_surface(grains, room)
    reached = asked is not None and settled.height > asked - 0.5 * float(recipe.diameter.mean())
    volume = room.section * (asked if asked is not None and reached else surface)
    told: dict[str, float | int | str] = {"grains": len(recipe.kind), "primaries": len(grains.radius)}
    told |= {f"grains_of_{name}": n for name, n in zip(names, recipe.counts.grains.tolist(), strict=True)}
    if recipe.counts.family is not None:
        ends = (f"{name} {a:.0f} to {b:.0f}" for name, (a, b) in zip(names, recipe.counts.family, strict=True))
        told["counts_that_number_and_mass_allow"] = ", ".join(ends)
    told |= {
        "mass_kg": mass,
        "size_factor": recipe.factor,
        "mean_diameter_m": float(recipe.diameter.mean()),
        "height_m": settled.height,
        "mean_surface_m": surface,
    }
    if asked is not None and not reached:
        told["height_not_reached"] = f"the bed ends {1e3 * (asked - settled.height):.3g} mm below the height asked for"
    return told | {
        "bulk_density_kg_per_m3": mass / volume,
        "porosity": 1.0 - float(grains.volume.sum()) / volume,
        "porosity_between": 1.0 - sum(hulls(grains)) / volume,
        "coordination_of_grains": neighbours_touching(grains),
        "height_of_poured_spheres_m": float((bed.poured[:, 2] + grains.reach).max()),
        "times_poured": bed.tries,
        "settling_steps": settled.steps,
        "largest_overlap_m": settled.overlap,
        "residual_stress_per_contact_modulus": residual_stress(grains, volume),
    }


def hulls(grains: Grains) -> list[float]:
    """Return the volume in m³ of the convex hull of each grain's primaries."""
    bounds = pairwise(grains.begin.tolist())
    return [hull_volume(grains.arm[first:last], grains.radius[first:last]) for first, last in bounds]


def concerns(told: Mapping[str, float | int | str]) -> tuple[str, ...]:
    """Return what of an account a user should know before the run."""
    low = told.get("height_not_reached")
    text = f"{low}, so that a piston at this height meets nothing at first; lower 'height' and the walls, or add grains"
    return () if low is None else (text,)


def mean_surface(grains: Grains, room: Room) -> float:
    """Return the mean height in m of the highest primary in each column one mean grain wide."""
    x = grains.positions()
    width = 2.0 * float(grains.reach.mean())
    inside = room.side_gap(x) > 0.0
    column = np.floor(x[inside, :2] / width).astype(np.int64)
    _, member = np.unique(column, axis=0, return_inverse=True)
    highest = np.zeros(int(member.max()) + 1)
    np.maximum.at(highest, member.ravel(), x[inside, 2] + grains.radius[inside])
    return float(highest.mean())


def residual_stress(grains: Grains, volume: float) -> float:
    """Return the mean pressure of the overlaps left between grains, for a contact modulus E* of 1 Pa.

    Equation: p = Σ f l / (3 V), f = 4/3 E* √R* δ^1.5, with l the distance of two grains along the contact's normal.
    Source: Love-Weber average of the stress; Hertz contact.
    """
    x = grains.positions()
    i, j = list_pairs(grains, x, 0.0).T
    way = x[j] - x[i]
    apart = np.sqrt((way**2).sum(axis=1))
    reduced = grains.radius[i] * grains.radius[j] / (grains.radius[i] + grains.radius[j])
    overlap = np.maximum(grains.radius[i] + grains.radius[j] - apart, 0.0)
    branch = grains.centre[grains.grain[j]] - grains.centre[grains.grain[i]]
    along = (branch * way).sum(axis=1) / np.maximum(apart, 1e-300)
    return float((4.0 / 3.0 * np.sqrt(reduced) * overlap**1.5 * along).sum() / (3.0 * volume))


def too_full(height: float | None, overlap: float, allowed: float, tries: int) -> str:
    """Return what to tell of grains that do not fit under a height in m without an overlap in m, however poured."""
    lid = f"under a height of {1e3 * height:.4g} mm " if height is not None else ""
    remedy = "raise 'height', take fewer grains," if height is not None else "take another 'seed', fewer grains,"
    return (
        f"the grains do not fit {lid}without overlaps, poured {tries} times: {1e6 * overlap:.4g} um stay, allowed are "
        f"{1e6 * allowed:.4g}; {remedy} or a larger room"
    )

"""Foreseeing: what a fill will hold, and what of it cannot be, without packing anything."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError, about
from clast.parts.generator import Estimate, Gaps, Prediction, Site
from clast_plugins.generators.filling.counts import counts
from clast_plugins.generators.filling.fraction import Fraction
from clast_plugins.generators.filling.outline import outline
from clast_plugins.generators.filling.recipe import MOST_OFF, mass_factor, shares_of
from clast_plugins.generators.filling.room import Room
from clast_plugins.generators.sizes import sizes

Floats = NDArray[np.float64]

DENSEST = 0.75
"""Share of the room that grains, as spheres of their sizes, cannot fill; equal spheres reach 0.64, mixtures more."""


def foresee(
    fractions: Mapping[str, Fraction],
    room: Room,
    base: tuple[float, float, float],
    height: float | None,
    grains: int | None,
    mass: float | None,
    site: Site,
    gaps: Gaps | None,
) -> Prediction:
    """Return how many primaries and bonds a fill will have, and its smallest primary.

    Parameters
    ----------
    fractions : mapping
    room : Room
    base : (x, y, z)
        Middle of its bottom in m.
    height : float or None
        To which the bed is levelled, in m.
    grains, mass : int or None, float or None
        Of all grains; mass in kg.
    site : Site
    gaps : Gaps or None
        Between which the scene bonds.

    Raises
    ------
    ConfigError
        Counts that do not add up, a mass that the grains do not have, or more than the room can hold.
    """
    told = {name: _template(name, each, site, gaps) for name, each in fractions.items()}
    weight = {
        name: each.particles * site.density.get(each.material, np.nan) * 4.0 / 3.0 * pi * each.radius**3
        for name, each in told.items()
    }
    count = counts(shares_of(fractions, weight), grains, mass).grains.tolist()
    drawn = [sizes(n, *each.distribution) for n, each in zip(count, fractions.values(), strict=True)]
    scale = [d / each.diameter for d, each in zip(drawn, fractions.values(), strict=True)]
    there = sum(float((s**3).sum()) * m for s, m in zip(scale, weight.values(), strict=True))
    factor = 1.0 if mass is None else mass_factor(sum(count), there, mass)
    diameter = factor * np.concatenate(drawn)
    _refuse_too_much(diameter, room, height)
    smallest = min(
        (factor * float(s.min()) * each.radius, each.material)
        for s, each in zip(scale, told.values(), strict=True)
        if len(s)
    )
    particles = sum(n * each.particles for n, each in zip(count, told.values(), strict=True))
    band = max(each.particles_band for each in told.values())
    filled = outline(room, base, height or _lowest(diameter, room))
    concerns = tuple(f"fractions.{name}.template: {text}" for name, each in told.items() for text in each.concerns)
    return Prediction(particles, *smallest, _bonds(count, list(told.values())), band, filled, concerns)


def _template(name: str, fraction: Fraction, site: Site, gaps: Gaps | None) -> Prediction:
    chosen = fraction.template
    with about("fractions", name, "template"):
        if chosen.part.predict is not None:
            told: Prediction = chosen.part.predict(chosen.params, site, gaps)
            return told
        packing = chosen.part.generate(chosen.params, site)
        k = int(np.argmin(packing.radius))
        return Prediction(len(packing.radius), float(packing.radius[k]), packing.material[k])


def _lowest(diameter: Floats, room: Room) -> float:
    """Return the height in m that a bed of these grains surely has."""
    return max(_spheres(diameter) / (room.section * DENSEST), (1.0 - MOST_OFF) * float(diameter.max()))


def _spheres(diameter: Floats) -> float:
    """Return the volume in m³ of all grains as spheres of their sizes."""
    return float((pi / 6.0 * diameter**3).sum())


def _refuse_too_much(diameter: Floats, room: Room, height: float | None) -> None:
    """Refuse grains that are wider than the room, or more than can lie below a height."""
    widest, across = float(diameter.max()), 2.0 * min(room.half_widths)
    if widest > across:
        raise ConfigError(
            f"a grain of {1e3 * widest:.4g} mm does not fit into a room {1e3 * across:.4g} mm wide", ("fractions",)
        )
    if height is not None:
        share = _spheres(diameter) / (room.section * height)
        if share > DENSEST:
            raise ConfigError(
                f"the grains would fill {share:.0%} of the room below this height, and {DENSEST:.0%} is more than they "
                "can; raise it, or take fewer grains or a larger room",
                ("height",),
            )


def _bonds(count: list[int], told: list[Prediction]) -> Estimate | None:
    known = [(n, each.bonds) for n, each in zip(count, told, strict=True) if each.bonds is not None]
    if len(known) < len(told):
        return None
    return Estimate(sum(n * each.value for n, each in known), max(each.band for _, each in known))

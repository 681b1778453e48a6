"""Oedometer fill: a tube or a box full of grains of several sizes, each an agglomerate of its own."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.plain import plain_data
from clast.config.quantities import Length, Mass, Number, Point
from clast.errors import PackingError, about
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.generators.filling import kept
from clast_plugins.generators.filling.account import Bed, account, concerns, too_full
from clast_plugins.generators.filling.dice import random_turns
from clast_plugins.generators.filling.foresee import foresee
from clast_plugins.generators.filling.fraction import Fraction
from clast_plugins.generators.filling.recipe import Recipe, make_recipe
from clast_plugins.generators.filling.rigid import Grains
from clast_plugins.generators.filling.room import Room

Floats = NDArray[np.float64]
TOLERANCE = 1e-4
TRIES = 4
"""How often a bed is poured, with other random numbers each time, before it is said not to fit."""


class OedometerFill(Params):
    """Grains poured into a tube or a box, levelled to a height.

    The counts of the fractions follow from what is given: a number for each; shares of all grains; or number and mass
    of all, and then of the answers that these leave the nearest to the ``prior`` shares. Diameters are the quantiles of
    each fraction's distribution; with ``mass`` all are multiplied by one factor, so that the mass is met exactly.

    Filling: grains fall as single spheres under gravity until they are at rest; then the agglomerates take their
    places, turned at random, and settle as rigid bodies without friction until they hardly sink any more; a lid presses
    down what stands out above ``height``; last, without weight, what overlaps is pushed apart. Where an overlap stays,
    the same grains are poured again with the next random numbers of the seed, four times in all.

    Limits: friction acts while spheres are poured and not while agglomerates settle, so a bed is as dense as a well
    shaken one; grains lie free of stress at the start, without their weight.
    """

    diameter: Annotated[Length | None, Field(gt=0, description="Inner diameter of a tube; or width, depth")] = None
    width: Annotated[Length | None, Field(gt=0, description="Inner width of a box, along x")] = None
    depth: Annotated[Length | None, Field(gt=0, description="Inner depth of a box, along y")] = None
    height: Annotated[
        Length | None, Field(gt=0, description="Height to which the grains are levelled; by default as they lie")
    ] = None
    base: Annotated[Point, Field(description="Middle of the bottom; the room rises along z")] = (0.0, 0.0, 0.0)
    fractions: Annotated[dict[str, Fraction], Field(min_length=1, description="Size classes by name")]
    grains: Annotated[int | None, Field(ge=1, le=1_000_000, description="Number of all grains")] = None
    mass: Annotated[Mass | None, Field(gt=0, description="Mass of all grains, before any mass scaling")] = None
    friction: Annotated[Number, Field(ge=0, description="Sliding friction while spheres are poured")] = 0.3
    max_overlap: Annotated[
        Length | None,
        Field(gt=0, description="Largest overlap that may stay; by default 1e-4 of the smallest primary's diameter"),
    ] = None
    seed: Annotated[int, Field(ge=0, description="Start of the random numbers; the same seed, the same fill")] = 1
    file: Annotated[
        Path | None, Field(description="File that keeps the finished fill: read where it exists, else written")
    ] = None

    @model_validator(mode="after")
    def _has_one_room(self) -> OedometerFill:
        box = (self.width, self.depth)
        if (self.diameter is None) == (None in box) or (self.diameter is not None and box != (None, None)):
            raise ValueError("either a 'diameter' is needed, for a tube, or 'width' and 'depth', for a box")
        return self

    @property
    def room(self) -> Room:
        """The empty room, with its bottom at z = 0."""
        if self.diameter is not None:
            return Room(radius=0.5 * self.diameter)
        return Room(width=self.width or 0.0, depth=self.depth or 0.0)


def generate(params: OedometerFill, site: Site) -> Packing:
    """Fill the room, or read the fill that the file keeps.

    Raises
    ------
    ConfigError
        Counts that do not add up, a mass that the grains do not have, a file that keeps another fill.
    PackingError
        A template that cannot be packed, grains that do not come to rest, or more than fit under the height.
    """
    packing = _filled(params, site) if params.file is None else _kept(params, site, site.folder / params.file)
    return replace(packing, concerns=concerns(packing.report))


def _kept(params: OedometerFill, site: Site, path: Path) -> Packing:
    """Return the fill that a file keeps; where there is none, make and keep it."""
    keys = _keys(params, site)
    with about("file"):
        packing = kept.read(path, keys)
    if packing is None:
        with about("file"):
            kept.make_room(path)
        packing = _filled(params, site)
        with about("file"):
            kept.write(path, packing, keys)
    return packing


def predict(params: OedometerFill, site: Site, gaps: Gaps | None) -> Prediction:
    """Return how many primaries and bonds there will be and what they fill, and refuse what cannot be.

    Raises
    ------
    ConfigError
        Counts that do not add up, a mass that the grains do not have, or more than the room can hold.
    """
    return foresee(params.fractions, params.room, params.base, params.height, params.grains, params.mass, site, gaps)


def _keys(params: OedometerFill, site: Site) -> dict[str, Any]:
    """Return all that a fill depends on, as plain data."""
    keys: dict[str, Any] = plain_data(params, site.folder)
    del keys["file"]
    return keys | {"density": dict(site.density)}


def _filled(params: OedometerFill, site: Site) -> Packing:
    stream = np.random.Philox(params.seed)
    recipe = make_recipe(params.fractions, params.grains, params.mass, site, stream)
    bed = _bed(params, recipe, stream)
    grains = bed.grains
    position = grains.positions()
    n = len(position)
    return Packing(
        position=position + np.asarray(params.base),
        radius=grains.radius,
        material=[name for each in recipe.template for name in each.material],
        velocity=np.zeros((n, 3)),
        spin=np.zeros((n, 3)),
        prescribed=np.zeros(n, np.bool_),
        grain=grains.grain,
        relieved=any(each.relieved for each in recipe.template),
        report=account(params.fractions, params.room, params.height, recipe, bed),
    )


def _bed(params: OedometerFill, recipe: Recipe, stream: np.random.Philox) -> Bed:
    """Pour and settle the grains of a recipe, again and again where an overlap stays.

    One grain caught between the lid and its neighbours keeps a bed from fitting that would fit otherwise.

    Raises
    ------
    PackingError
        If an overlap stays every time.
    """
    from clast_plugins.generators.filling.pour import pour
    from clast_plugins.generators.filling.settle import settle

    reach = recipe.scale * np.array([each.reach for each in recipe.template])
    for tried in range(1, TRIES + 1):
        poured = pour(reach, params.room, params.friction, stream)
        grains = _agglomerates(recipe, reach, poured, random_turns(stream, len(reach)))
        allowed = params.max_overlap or TOLERANCE * 2.0 * float(grains.radius.min())
        settled = settle(grains, params.room, params.height, allowed)
        if settled.overlap <= allowed:
            return Bed(grains, poured, settled, tried)
    text = too_full(params.height, settled.overlap, allowed, TRIES)
    raise PackingError(text, ("height",) if params.height else ())


def _agglomerates(recipe: Recipe, reach: Floats, poured: Floats, turned: Floats) -> Grains:
    """Return the grains in the places (g, 3) of the spheres, turned (g, 4)."""
    sizes = [len(each.radius) for each in recipe.template]
    scaled = list(zip(recipe.scale.tolist(), recipe.template, strict=True))
    radius = np.concatenate([s * each.radius for s, each in scaled])
    grain = np.repeat(np.arange(len(sizes)), sizes)
    return Grains(
        centre=poured,
        turned=turned,
        reach=reach,
        volume=np.asarray(np.bincount(grain, 4.0 / 3.0 * np.pi * radius**3), np.float64),
        begin=np.concatenate([[0], np.cumsum(sizes)]),
        arm=np.concatenate([s * each.arm for s, each in scaled]),
        radius=radius,
    )


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the oedometer fill."""
    registry.generator(
        "oedometer_fill",
        Generator(
            summary="a tube or box filled with agglomerates of several sizes, levelled to a height",
            Params=OedometerFill,
            generate=generate,
            predict=predict,
        ),
    )

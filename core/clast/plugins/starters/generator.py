"""Starter: spheres in a row."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Length
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """Equal spheres along x that just touch, as one grain.

    Limits
    ------
    Where more than a few spheres are packed at random, draw from ``numpy.random.default_rng(params.seed)`` alone.

    Source
    ------
    Name where the packing was published.
    """

    material: Annotated[str, Field(examples=["glass"], description="Material of the spheres")]
    diameter: Annotated[Length, Field(gt=0, examples=["0.25 mm"], description="Diameter of a sphere")]
    number: Annotated[int, Field(ge=1, examples=[10], description="Number of spheres")]


def generate(params: Starter, site: Site) -> Packing:
    """Place the spheres; ``site`` is the scene's folder, and the density of each material."""
    n = params.number
    position = np.zeros((n, 3))
    position[:, 0] = params.diameter * (1.0 + 1e-9) * np.arange(n)  # rounding must not make them overlap
    return Packing(
        position=position,
        radius=np.full(n, 0.5 * params.diameter),
        material=[params.material] * n,
        velocity=np.zeros((n, 3)),
        spin=np.zeros((n, 3)),
        prescribed=np.zeros(n, bool),
        grain=np.zeros(n, np.int64),
        report={"length / m": n * params.diameter},
    )


def predict(params: Starter, site: Site, gaps: Gaps | None) -> Prediction:
    """Tell what ``generate`` will make, for ``clast check``; leave it out where generating takes no time."""
    return Prediction(params.number, 0.5 * params.diameter, params.material)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the generator."""
    registry.generator("starter", Generator("equal spheres in a row", Starter, generate, predict))

"""Random packing: loose spheres in a box or a tube."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import Length, Point
from clast.maths.box import Box as Repeating
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.plugins.registry import Registry
from clast_plugins.generators.packing.agglomerate import packing_of, predict_spheres
from clast_plugins.generators.packing.fill import Body, body_of, fill, near_in_number
from clast_plugins.generators.packing.room import Floats
from clast_plugins.generators.packing.spheres import SpheresParams, millimetres, number_of_primaries
from clast_plugins.generators.packing.vessels import Box, Cell, Tube

NOWHERE = np.zeros(3)
ALIKE = 1e-9
"""Difference, as a share, up to which an edge of the box is that of the domain."""


class RandomPacking(SpheresParams):
    r"""Loose spheres at random places in a box or an upright tube, each wholly inside, none overlapping another.

    Equation
    --------
    N = ⌊(1 − p) V/(π/6 d³)⌋;  Σ d_i³ = N d³

    Symbols
    -------
    V : volume of the box, or of the tube, in m³; p : ``porosity``, the share of it that is free; d_i : diameters in m,
    evenly spaced quantiles of a normal or lognormal distribution; d : that of the sphere of mean volume in m

    Limits
    ------
    Spheres are pushed apart, they do not fall: none rests on others, and at porosities above about 0.45 hardly any
    touch. Below 0.36 no random packing of equal spheres exists; in rooms of a few diameters the limit is higher.
    Where an edge of the box is that of a periodic domain, there is no wall: spheres push each other across it.
    They belong to no grain. ``bonds.between`` joins near ones all the same, unless its ``materials`` name others.

    Source
    ------
    J. Mościński et al. (1989), Molecular Simulation 3, 201; W. S. Jodrey, E. M. Tory (1985),
    doi:10.1103/PhysRevA.32.2347; E. Bitzek et al. (2006), doi:10.1103/PhysRevLett.97.170201.
    """

    box: Annotated[Point | None, Field(description="Edges of a box along x, y and z")] = None
    diameter: Annotated[
        Annotated[Length, Field(gt=0)] | None,
        Field(examples=["1.2 mm"], description="Diameter of an upright tube, instead of a box; with `height`"),
    ] = None
    height: Annotated[
        Annotated[Length, Field(gt=0)] | None, Field(examples=["2 mm"], description="Height of the tube, along z")
    ] = None

    @model_validator(mode="after")
    def _one_room(self) -> RandomPacking:
        tube = (self.diameter is not None, self.height is not None)
        if tube != ((True, True) if self.box is None else (False, False)):
            raise ValueError("give either 'box', or 'diameter' and 'height' of a tube")
        if self.box is not None and min(self.box) <= 0.0:
            raise ValueError("every edge of 'box' must be above 0")
        number_of_primaries(self, body(self).whole)
        return self


def body(params: RandomPacking, span: Floats = NOWHERE) -> Body:
    """Return what is filled, in a scene that repeats itself at some distances, (3,) in m; 0 where it does not."""
    if params.box is not None:
        words = f"a box of {' x '.join(map(millimetres, params.box))}"
        x, y, z = (0.5 * edge for edge in params.box)
        goes_on = (span > 0.0) & (np.abs(np.array(params.box) - span) <= ALIKE * span)
        if not goes_on.any():
            return body_of(Box(x, y, z), words)
        a, b, c = (~goes_on).tolist()
        half = np.array([x, y, z])
        return body_of(Cell((x, y, z), (a, b, c)), words, Repeating(-half, half, goes_on))
    assert params.diameter is not None
    assert params.height is not None
    words = f"a tube of {millimetres(params.diameter)}, {millimetres(params.height)} high"
    return body_of(Tube(0.5 * params.diameter, 0.5 * params.height), words)


def predict(params: RandomPacking, site: Site, gaps: Gaps | None) -> Prediction:
    """Return how many spheres there will be, and about how many bonds."""
    return predict_spheres(params, body(params, site.box.span), gaps)


def generate(params: RandomPacking, site: Site) -> Packing:
    """Pack the spheres.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set; or the largest sphere has no room.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set.
    """
    room = body(params, site.box.span)
    filled = fill(params, room)
    order = near_in_number(filled.position)
    return packing_of(params, room, filled, filled.position[order], filled.radius[order], grain=-1, also={})


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the random packing."""
    registry.generator(
        "random_packing",
        Generator(
            summary="loose spheres at random places in a box or a tube",
            Params=RandomPacking,
            generate=generate,
            predict=predict,
        ),
    )

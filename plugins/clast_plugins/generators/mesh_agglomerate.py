"""Mesh agglomerate: a body of any shape, from an STL file, of randomly packed spheres."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.files import InputFile
from clast.config.problems import wrong
from clast.config.quantities import Length, Point
from clast.errors import ConfigError
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.plugins.registry import Registry
from clast_plugins.generators.packing.agglomerate import AgglomerateParams, make_agglomerate, predict_agglomerate
from clast_plugins.generators.packing.closed_surface import ClosedSurface, closed
from clast_plugins.generators.packing.fill import Body, body_of
from clast_plugins.generators.packing.macro_pores import refuse_senseless
from clast_plugins.generators.packing.spheres import millimetres, number_of_primaries, primary_of
from clast_plugins.walls.surface.read import Content, content_of, refuse_bad, version


class MeshAgglomerate(AgglomerateParams):
    r"""Spheres packed at random, equal or of scattered sizes, each wholly inside a closed surface of triangles.

    Equation
    --------
    N = ⌊(1 − p) V/(π/6 d³)⌋;  Σ d_i³ = N d³

    Symbols
    -------
    V : volume inside the surface in m³; p : ``porosity``, the share of it that is free
    d_i : diameters of the primaries in m; d : that of the one of mean volume in m

    Limits
    ------
    The middle of the volume comes to ``centre``. Edges and tips that a primary does not fit into stay empty, so what
    lies beside them is denser; a neck that is too narrow parts the body. The surface is that of one body: separate
    ones are refused; a closed surface inside it that turns the other way is a hollow. A surface that goes through
    itself is not noticed. It does not turn: turn it where it is made.

    Source
    ------
    Inside or not: rays through the surface, T. Möller, B. Trumbore (1997), doi:10.1080/10867651.1997.10487468. Nearest
    point: C. Ericson (2005), Real-Time Collision Detection, Sect. 5.1.5.
    """

    file: Annotated[InputFile | None, Field(description="STL file with a closed surface")] = None
    triangles: Annotated[
        tuple[tuple[Point, Point, Point], ...] | None,
        Field(
            examples=[
                [
                    [[0, 0, 0], [0, "1 mm", 0], ["1 mm", 0, 0]],
                    [[0, 0, 0], ["1 mm", 0, 0], [0, 0, "1 mm"]],
                    [[0, 0, 0], [0, 0, "1 mm"], [0, "1 mm", 0]],
                    [["1 mm", 0, 0], [0, "1 mm", 0], [0, 0, "1 mm"]],
                ]
            ],
            description="Corners of triangles, instead of a file",
        ),
    ] = None
    diameter: Annotated[
        Length | None,
        Field(gt=0, examples=["2 mm"], description="Diameter of the sphere of the same volume: the size; or give unit"),
    ] = None
    unit: Annotated[
        Length | None, Field(gt=0, description="Length of one unit of the file, instead of the diameter")
    ] = None

    @model_validator(mode="after")
    def _fits(self) -> MeshAgglomerate:
        if (self.file is None) == (self.triangles is None):
            text = "exactly one of file and triangles is needed; given "
            raise wrong("triangles", f"{text}both") if self.file is not None else ValueError(f"{text}neither")
        if self.file is not None and (self.unit is None) == (self.diameter is None):
            key, given = ("unit", "both") if self.unit is not None else ("file", "neither")
            text = "an STL file does not tell lengths: exactly one of diameter and unit is needed"
            raise wrong(key, f"{text}; given {given}")
        if self.file is None and self.unit is not None:
            raise wrong("unit", "a unit is that of a file; give a diameter, or leave the triangles as they are")
        try:
            whole = body(self).whole
        except ConfigError as error:
            raise wrong("file" if self.file is not None else "triangles", str(error)) from None
        number_of_primaries(self, whole)
        refuse_senseless(self.macro_pores, whole, primary_of(self, whole))
        return self


def body(params: MeshAgglomerate) -> Body:
    """Return what is filled.

    Raises
    ------
    ConfigError
        The surface is none, or not closed.
    """
    at = version(params.file) if params.file is not None else None
    return _body(params.file, at, params.triangles, params.unit, params.diameter)


@lru_cache(maxsize=8)
def _body(
    file: InputFile | None,
    version: tuple[int, int] | None,
    triangles: tuple[tuple[Point, Point, Point], ...] | None,
    unit: float | None,
    diameter: float | None,
) -> Body:
    if file is not None:
        content = content_of(file)
        where = f"{file}: {''.join(f'{text}; ' for text in content.left_out)}the surface "
    else:
        content, where = Content(np.array(triangles, float).reshape(-1, 3, 3), 0), "the surface "
        refuse_bad(content.triangles)
    about = closed(content.triangles * (unit or 1.0), where)
    if diameter is not None:
        about = about * (diameter / math.cbrt(6.0 * ClosedSurface(about).volume / math.pi))
    room = ClosedSurface(about)
    edges = " x ".join(millimetres(edge) for edge in np.ptp(about, axis=(0, 1)).tolist())
    return body_of(room, f"a body of {edges}")


def predict(params: MeshAgglomerate, site: Site, gaps: Gaps | None) -> Prediction:
    """Return how many primaries there will be, and about how many bonds."""
    left_out = content_of(params.file).left_out if params.file is not None else ()
    return replace(predict_agglomerate(params, body(params), gaps), concerns=left_out)


def generate(params: MeshAgglomerate, site: Site) -> Packing:
    """Pack the primaries.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set; or the largest primary has no room.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set; or there is no room for the pores, or they
        cut the grain into pieces.
    """
    return make_agglomerate(params, body(params))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the mesh agglomerate."""
    registry.generator(
        "mesh_agglomerate",
        Generator(
            summary="a body of any shape, from an STL file, of randomly packed spheres",
            Params=MeshAgglomerate,
            generate=generate,
            predict=predict,
        ),
    )

"""Lattice: equal spheres in a regular order, in a box or a ball."""

from __future__ import annotations

from math import pi, sqrt
from typing import Annotated, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import Length, Point
from clast.errors import ConfigError
from clast.maths.vec3 import ZERO
from clast.parts.generator import Generator, Packing, Site
from clast.parts.params import Params
from clast.plugins.registry import Registry

MOST = 100_000_000
"""More spheres than these are a mistake."""

FITS = 1e-9
"""Share of a diameter by which a sphere may stick out: rounding."""

MISFIT = 1e-5
"""Share of a diameter by which the edge of a periodic box may differ from a whole number of cells: digits left out."""


class Lattice(Params):
    r"""Equal spheres on a crystal lattice, each wholly inside a box or a ball.

    Equation
    --------
    x = c + (k + b) · e,  |x − x'| ≥ d + gap;  edges e of the cell in nearest distances s = d + gap, and places b in it:
    sc 1, 1, 1;  bcc 2/√3 each, with the middle;  fcc √2 each, with the middles of the faces;  hcp 1, √3, √(8/3), four

    Symbols
    -------
    d : ``primary_diameter`` in m; k : whole numbers; c : ``centre`` in m
    Neighbours of a sphere: 6, 8, 12, 12; share of space where they touch: π/6, √3 π/8, π/(3 √2), π/(3 √2)

    Limits
    ------
    Regular packings have weak and strong directions, and split along planes; random ones have none. In a box the
    spheres fill it from side to side as far as whole ones fit, in a ball one sphere is in the middle. Where an edge of
    the box is that of a periodic domain, the lattice goes on across it; the edge must be a whole number of cells.

    Source
    ------
    C. Kittel (2005), Introduction to Solid State Physics, 8th ed., ch. 1.
    """

    material: Annotated[str, Field(examples=["glass"], description="Material of the spheres")]
    lattice: Annotated[Literal["sc", "bcc", "fcc", "hcp"], Field(description="which order")] = "fcc"
    primary_diameter: Annotated[Length, Field(gt=0, examples=["0.25 mm"], description="Diameter of a sphere")]
    gap: Annotated[Length, Field(ge=0, description="Distance between the surfaces of nearest neighbours")] = 0.0
    box: Annotated[Point | None, Field(description="Edges of a box along x, y and z, to be filled")] = None
    diameter: Annotated[
        Annotated[Length, Field(gt=0)] | None,
        Field(examples=["1.2 mm"], description="Diameter of a ball to be filled, instead of a box"),
    ] = None
    centre: Annotated[Point, Field(description="Middle of the box or the ball")] = ZERO

    @model_validator(mode="after")
    def _one_room(self) -> Lattice:
        if (self.box is None) == (self.diameter is None):
            raise ValueError("give exactly one of 'box' and 'diameter'")
        smallest = self.diameter if self.box is None else min(self.box)
        if smallest is not None and smallest < self.primary_diameter:
            raise ValueError(f"a sphere of {self.primary_diameter:g} m does not fit into {smallest:g} m")
        return self


class Cell(NamedTuple):
    """Edges of a cell in nearest distances, and places of its spheres as shares of the edges."""

    edges: tuple[float, float, float]
    places: tuple[tuple[float, float, float], ...]


CORNER = (0.0, 0.0, 0.0)
CELLS = {
    "sc": Cell((1.0, 1.0, 1.0), (CORNER,)),
    "bcc": Cell((2.0 / sqrt(3.0),) * 3, (CORNER, (0.5, 0.5, 0.5))),
    "fcc": Cell((sqrt(2.0),) * 3, (CORNER, (0.5, 0.5, 0.0), (0.5, 0.0, 0.5), (0.0, 0.5, 0.5))),
    "hcp": Cell(
        (1.0, sqrt(3.0), sqrt(8.0 / 3.0)),
        (CORNER, (0.5, 0.5, 0.0), (0.5, 5.0 / 6.0, 0.5), (0.0, 1.0 / 3.0, 0.5)),
    ),
}


def generate(params: Lattice, site: Site) -> Packing:
    """Place the spheres.

    Raises
    ------
    ConfigError
        There would be too many.
    """
    position = in_a_ball(params) if params.box is None else in_a_box(params, params.box, site.box.span)
    n, d = len(position), params.primary_diameter
    room = pi / 6.0 * (params.diameter or 0.0) ** 3 if params.box is None else float(np.prod(params.box))
    return Packing(
        position=position + np.array(params.centre),
        radius=np.full(n, 0.5 * d),
        material=[params.material] * n,
        velocity=np.zeros((n, 3)),
        spin=np.zeros((n, 3)),
        prescribed=np.zeros(n, bool),
        grain=np.zeros(n, np.int64),
        report={"primaries": n, "porosity_reached": 1.0 - n * pi / 6.0 * d**3 / room},
    )


def in_a_box(params: Lattice, box: tuple[float, float, float], span: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the centres in a box about the origin, (n, 3) in m: what fits from one side on, moved to the middle.

    Parameters
    ----------
    params : Lattice
    box : three floats
        Edges in m.
    span : (3,) float64
        Distances in m at which the scene repeats itself; 0 where it does not.
    """
    d, edges = params.primary_diameter, np.array(box)
    goes_on = (span > 0.0) & (np.abs(edges - span) <= FITS * d)
    stretch = np.where(goes_on, _whole_cells(params, edges, goes_on), 1.0)
    free = np.where(goes_on, edges - 0.25 * d, edges - d * (1.0 - FITS))  # what lies at the far face is an image
    places = _points(params, np.zeros(3), free) * stretch
    inside = places[np.all(places <= free, axis=1)]
    return np.asarray(inside - 0.5 * (inside.min(axis=0) + inside.max(axis=0)))


def _whole_cells(params: Lattice, box: NDArray[np.float64], goes_on: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return what the lattice is stretched by, for rounding alone, so that it goes on across some edges of a box.

    Raises
    ------
    ConfigError
        Such an edge is not a whole number of cells.
    """
    cell = (params.primary_diameter + params.gap) * np.array(CELLS[params.lattice].edges)
    whole = np.maximum(np.rint(box / cell), 1.0) * cell
    off = goes_on & (np.abs(box - whole) > MISFIT * params.primary_diameter)
    if off.any():
        k = int(np.argmax(off))
        text = (
            f"the domain repeats itself along {'xyz'[k]} every {box[k]:.12g} m, the lattice every {cell[k]:.12g} m: "
            f"make domain and box {whole[k]:.12g} m long, or the gap another one"
        )
        raise ConfigError(text, at=("box", k))
    return np.asarray(box / whole)


def in_a_ball(params: Lattice) -> NDArray[np.float64]:
    """Return the centres in a ball about the origin, (n, 3) in m, one of them in the middle."""
    assert params.diameter is not None
    d = params.primary_diameter
    free = 0.5 * (params.diameter - d * (1.0 - FITS))
    places = _points(params, np.full(3, -free), np.full(3, free))
    return np.asarray(places[np.sum(places**2, axis=1) <= free**2])


def _points(params: Lattice, low: NDArray[np.float64], high: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return lattice points of whole cells that cover a box from ``low`` to ``high``, a corner at the origin."""
    cell = CELLS[params.lattice]
    edges = (params.primary_diameter + params.gap) * np.array(cell.edges)
    first, last = np.floor(low / edges) - 1.0, np.ceil(high / edges) + 1.0
    first = np.where(low == 0.0, 0.0, first)
    count = float(np.prod(last - first)) * len(cell.places)
    if count > MOST:
        text = f"the lattice would have about {count:.1g} spheres; take larger ones, or a smaller room"
        raise ConfigError(text, at=("primary_diameter",))
    steps = [np.arange(a, b + 1.0) for a, b in zip(first, last, strict=True)]
    corners = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    return np.asarray(((corners + np.array(cell.places)) * edges).reshape(-1, 3))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the lattice."""
    registry.generator(
        "lattice",
        Generator(
            summary="equal spheres on a crystal lattice, in a box or a ball",
            Params=Lattice,
            generate=generate,
        ),
    )

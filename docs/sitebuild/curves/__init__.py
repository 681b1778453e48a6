"""Pictures of how parts answer, one file per kind of part that has any."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from typing import Any, NamedTuple

from matplotlib import rc_context
from matplotlib.figure import Figure

from clast.config.examples import example
from clast.errors import PluginError
from clast.parts.params import Params
from clast.plugins.registered import Registered
from sitebuild.curves import bond_model, contact_law, damping, generator, integrator, motion, rolling_resistance, wall


class Drawing(NamedTuple):
    """A picture as SVG, empty where there is none, and the sentence below it or in its place."""

    svg: bytes
    caption: str


ARTISTS: dict[str, Callable[[Any, Params, Figure], str]] = {
    "bond_model": bond_model.draw,
    "contact_law": contact_law.draw,
    "damping": damping.draw,
    "generator": generator.draw,
    "integrator": integrator.draw,
    "motion": motion.draw,
    "rolling_resistance": rolling_resistance.draw,
    "wall": wall.draw,
}
"""By kind: draws a part with its example parameters into a figure, and returns the caption."""


def drawing(entry: Registered) -> Drawing | None:
    """Draw a part with the examples its parameters state; None for kinds that have no picture."""
    artist = ARTISTS.get(entry.kind)
    if artist is None:
        return None
    try:
        params = example(entry.part.Params)
    except PluginError:
        return Drawing(b"", "There is no picture: its parameters state no examples of all that it needs.")
    figure = Figure(figsize=(7.0, 3.2), layout="constrained")
    caption = artist(entry.part_for(params), params, figure)
    told = " Parameters are those of the scene below." if type(params).model_fields else ""
    return Drawing(as_svg(figure), caption + told)


def as_svg(figure: Figure) -> bytes:
    """Return a figure as SVG, the same bytes for the same figure."""
    file = BytesIO()
    with rc_context({"svg.hashsalt": "clast"}):
        figure.savefig(file, format="svg", metadata={"Date": None})
    return file.getvalue()

"""A box that is stretched at constant rates of strain: how long its sides are, and what it does to a scene."""

from __future__ import annotations

from math import exp

from clast.engine.compiler import inlined
from clast.engine.state import Floats
from clast.maths.vec3 import Vec

from .layout import (
    BOX_POWER,
    BOX_WORK,
    ENGINEERING,
    GROWTH,
    LOGARITHMIC,
    MOST_SHRUNK,
    PER_SPAN,
    SPAN,
    SPAN_AT_SEARCH,
    SPAN_AT_START,
)


@inlined
def span_at(box: Floats, c: int, time: float) -> float:
    """Return how far apart images are along an axis at a time since the start, in m."""
    return box[SPAN_AT_START, c] * (exp(box[LOGARITHMIC, c] * time) + box[ENGINEERING, c] * time)  # type: ignore[no-any-return]


@inlined
def stretch_box(box: Floats, time: float) -> None:
    """Bring the box to a time since the start."""
    for c in range(3):
        span, start = span_at(box, c, time), box[SPAN_AT_START, c]
        box[SPAN, c] = span
        box[PER_SPAN, c] = 1.0 / span if span > 0.0 else 0.0
        box[GROWTH, c] = start * (box[LOGARITHMIC, c] * exp(box[LOGARITHMIC, c] * time) + box[ENGINEERING, c])


@inlined
def since_search(box: Floats, time: float) -> Vec:
    """Return by what the box has been stretched since neighbours were searched; 1 where it does not repeat itself.

    Of the box it reads nothing that changes with the time, so any thread may ask while another stretches it.
    """
    return (stretch_since(box, 0, time), stretch_since(box, 1, time), stretch_since(box, 2, time))


@inlined
def stretch_since(box: Floats, c: int, time: float) -> float:
    """Return by what the box has been stretched along an axis since neighbours were searched."""
    return span_at(box, c, time) / box[SPAN_AT_SEARCH, c] if box[SPAN_AT_SEARCH, c] > 0.0 else 1.0


@inlined
def shrunk(stretch: Vec) -> bool:
    """Tell whether what was too far away to be listed may have come near because the box shrank."""
    return min(stretch[0], stretch[1], stretch[2]) * (1.0 + MOST_SHRUNK) < 1.0


@inlined
def book_box_work(book: Floats, span: float) -> None:
    """Book half of the work of the box on the way from one force evaluation to the next, with the power at one.

    Called before the forces of a chunk are computed, which then sum up the power anew, and after them.
    """
    book[BOX_WORK] += 0.5 * span * book[BOX_POWER]

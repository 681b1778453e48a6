"""When in a step two bodies met."""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.maths.vec3 import Vec, dot


@inlined
def share_since_touch(moved: Vec, n: Vec, overlap: float, held: bool) -> float:
    """Return the share of a displacement that came after touch: all of it, unless it closed more than the overlap.

    What held already, which may be beyond touch, moved all the way.
    """
    closed = -dot(moved, n)
    return overlap / closed if closed > overlap and not held else 1.0

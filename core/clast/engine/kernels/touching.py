"""When in a step two bodies met."""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.maths.vec3 import Vec, dot, scale


@inlined
def since_touch(moved: Vec, n: Vec, overlap: float) -> Vec:
    """Return the part of a displacement that came after touch: all of it, unless it closed more than the overlap."""
    closed = -dot(moved, n)
    return scale(overlap / closed, moved) if closed > overlap else moved

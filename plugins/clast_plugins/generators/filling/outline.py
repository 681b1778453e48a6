"""Outline: the room of a fill as points, against which the walls of a scene are held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from clast.parts.room import FilledRoom
from clast_plugins.generators.filling.room import Room

Floats = NDArray[np.float64]

OUT = np.array([0.0, 0.35, 0.6, 0.8, 0.9, 0.95, 0.98])
"""Where points lie between the middle and the side, as shares of the way."""
UP = np.array([0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98])
"""The same between bottom and top."""
ANGLES = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
AROUND = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])


def outline(room: Room, base: Sequence[float], height: float) -> FilledRoom:
    """Return what of a room lies below a height in m, with the middle of its bottom at ``base``."""
    section = np.vstack([share * AROUND for share in OUT])
    edges = {"side": AROUND}
    if room.radius == 0.0:
        along = np.concatenate([-OUT[:0:-1], OUT])
        section = np.array([(x, y) for x in along for y in along])
        ends = {"left": (-1.0, None), "right": (1.0, None), "front": (None, -1.0), "back": (None, 1.0)}
        edges = {f"{name} side": _line(along, *place) for name, place in ends.items()}
    half = np.array(room.half_widths)
    inside = _stacked(half * section, height * UP)
    faces = {"bottom": _stacked(half * section, np.zeros(1))}
    faces |= {name: _stacked(half * edge, height * UP) for name, edge in edges.items()}
    return FilledRoom(
        text=_text(room, base, height),
        faces={name: points + np.asarray(base) for name, points in faces.items()},
        inside=inside + np.asarray(base),
        depth=replace(room, lid=height).gap(inside),
    )


def _line(along: Floats, x: float | None, y: float | None) -> Floats:
    """Return points (p, 2) along one axis, with the other coordinate given."""
    return np.array([(a if x is None else x, a if y is None else y) for a in along])


def _stacked(section: Floats, heights: Floats) -> Floats:
    """Return every point (p, 2) of the section at every height, (p h, 3)."""
    return np.column_stack([np.tile(section, (len(heights), 1)), np.repeat(heights, len(section))])


def _text(room: Room, base: Sequence[float], height: float) -> str:
    x, y, z = (1e3 * each for each in base)
    width = f"tube {2e3 * room.radius:.4g} mm wide"
    if room.radius == 0.0:
        width = f"box {1e3 * room.width:.4g} by {1e3 * room.depth:.4g} mm wide"
    return f"a {width} from ({x:.4g}, {y:.4g}, {z:.4g}) mm up to z = {z + 1e3 * height:.4g} mm"

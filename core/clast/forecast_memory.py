"""How much memory a run needs: that of the interpreter, and what particles, bonds and the surfaces of walls add."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from clast.config.scene import SceneConfig
from clast.engine.records import is_record

# peak resident memory, measured with Python 3.11, numpy 2.4, numba 0.68: interpreter and libraries, and what compiling
# adds; then of scenes of 428 to 990 584 primaries, most of it the springs of the time step's limit; then of walls of
# 245 000 and 980 000 triangles, 17 numbers each, most of it their rows as lists of Python
LOADED_BYTES, COMPILER_BYTES = 205e6, 110e6
PARTICLE_BYTES, BOND_BYTES, SHAPE_NUMBER_BYTES = 600.0, 720.0, 66.0


def run_memory(particles: float, bonds: float, walls: float) -> float:
    """Return the peak memory of a run in bytes, of which its walls need so many."""
    return LOADED_BYTES + PARTICLE_BYTES * particles + BOND_BYTES * bonds + walls


def wall_memory(config: SceneConfig) -> float:
    """Return about how many bytes the shapes of walls need: next to none, but for surfaces of many triangles."""
    shapes = (wall.shape.part.shape(wall.shape.params) for wall in config.walls.values())
    return SHAPE_NUMBER_BYTES * sum(map(_numbers_in, shapes))


def _numbers_in(record: Any) -> int:
    """Return how many numbers a record holds, those of its lists among them."""
    return sum(map(_numbers_in, record)) if is_record(record) else int(np.size(record))


def memory_concerns(config: SceneConfig, memory: float, walls: float) -> list[str]:
    """Return a line for the user where a run needs more memory than the machine has."""
    there = float(os.sysconf("SC_PAGE_SIZE")) * os.sysconf("SC_PHYS_PAGES")
    if memory <= there:
        return []
    section, advice = (
        ("walls", "make surfaces coarser") if 2.0 * walls > memory else ("particles", "take fewer particles")
    )
    return [
        f"{config.document.where((section,))}: {section}: about {memory / 1e6:,.0f} MB of memory are needed, "
        f"this machine has {there / 1e6:,.0f} MB; {advice}"
    ]

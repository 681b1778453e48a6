"""Pouring: grains as single spheres fall into the room and come to rest, in the same solver as everything else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from clast.config.scene import from_mapping
from clast.errors import ConfigError, PackingError, RunError
from clast_plugins.generators.filling.room import Room
from clast_plugins.generators.packing.room import uniforms

if TYPE_CHECKING:
    from clast import Simulation

Floats = NDArray[np.float64]

GRAVITY = 9.81
DENSITY, POISSON_RATIO = 1000.0, 0.3
STIFFNESS = 5000.0
"""Young's modulus over what the bed weighs on its bottom, per area. Soft spheres fall just the same, and need fewer
steps; at the bottom they overlap by about 0.5 % of a diameter (Hertz)."""
RESTITUTION = 0.3
ROLLING = 0.05
"""Rolling friction: without it a sphere on a plane rolls for ever, as no grain does."""
REST = 1e-6
"""At rest: kinetic energy as a share of what lifts the grains by one diameter."""
LOOK = 0.02
LONGEST = 20.0
"""Times in s: between two looks, and after which pouring is given up."""


def pour(radius: Floats, room: Room, friction: float, stream: np.random.Philox) -> Floats:
    """Return the centres (g, 3) in m of spheres of these radii (g,) that have come to rest in a room.

    Parameters
    ----------
    radius : (g,) float64
        In m, in the order in which they lie from bottom to top.
    room : Room
    friction : float
        Coefficient of sliding friction between spheres, and with the room.
    stream : Philox
        Random numbers.

    Raises
    ------
    PackingError
        If a sphere is wider than the room, or they do not come to rest.
    """
    from clast import Simulation  # not when parts are registered: it brings the compiler

    start = stacked(radius, room, stream)
    try:
        return _fallen(Simulation(from_mapping(_scene(start, radius, room, friction)), threads=1), radius)
    except (ConfigError, RunError) as error:
        raise PackingError(f"the grains could not be poured: {error}") from error


def _fallen(simulation: Simulation, radius: Floats) -> Floats:
    """Return where the spheres of a simulation lie when they have come to rest."""
    every = max(1, round(LOOK / simulation.dt))
    weight = radius**3 / float((radius**3).sum())
    while simulation.step < simulation.last_step:
        simulation.advance_to(min(simulation.last_step, simulation.step + every))
        twist = simulation.world.particles.twist[:, :3]
        energy = 0.5 * float(weight @ (twist**2).sum(axis=1))
        if energy < REST * GRAVITY * 2.0 * float(radius.mean()) and simulation.time > LOOK:
            return simulation.world.particles.pose[:, :3].copy()
    raise PackingError(
        f"the grains did not come to rest within {LONGEST:g} s; give more 'friction', or another 'seed'", ("friction",)
    )


def stacked(radius: Floats, room: Room, stream: np.random.Philox) -> Floats:
    """Return centres (g, 3) of spheres in layers above the bottom, none touching another, each a little off its place.

    Raises
    ------
    PackingError
        If a sphere is wider than the room.
    """
    widest = float(radius.max())
    cell = 2.1 * widest
    wide, deep = room.half_widths
    x, y = np.meshgrid(_row(wide, cell), _row(deep, cell), indexing="ij")
    spots = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    spots = spots[room.side_gap(spots) >= 1.05 * widest]
    if len(spots) == 0:
        spots = np.zeros((1, 3))  # one above the other
    if room.side_gap(spots[:1])[0] < 1.05 * widest:
        raise PackingError(
            f"a grain is {2e3 * widest:.4g} mm wide; the room must be at least 5 % wider than that", ("fractions",)
        )
    layer, spot = np.divmod(np.arange(len(radius)), len(spots))
    place = spots[spot]
    place[:, 2] = cell * (layer + 0.5)
    return place + 0.04 * widest * uniforms(stream, len(radius))


def _row(half: float, cell: float) -> Floats:
    """Return evenly spaced places between −half and half, symmetric about 0."""
    count = max(1, int(2.0 * half / cell))
    return np.asarray(cell * (np.arange(count) - 0.5 * (count - 1)), np.float64)


def _scene(start: Floats, radius: Floats, room: Room, friction: float) -> dict[str, object]:
    """Return the scene of falling spheres as plain data."""
    bed = float((4.0 / 3.0 * np.pi * radius**3).sum()) / room.section
    soft = {
        "density": DENSITY,
        "young_modulus": STIFFNESS * DENSITY * GRAVITY * bed,
        "poisson_ratio": POISSON_RATIO,
    }
    spheres = [{"position": x, "radius": r} for x, r in zip(start.tolist(), radius.tolist(), strict=True)]
    return {
        "name": "pouring",
        "materials": {"grain": soft},
        "particles": {"type": "explicit", "material": "grain", "particles": spheres},
        "contacts": {
            "law": "hertz_mindlin",
            "pairs": {
                "default": {
                    "restitution": RESTITUTION,
                    "sliding_friction": friction,
                    "rolling_friction": ROLLING,
                }
            },
        },
        "walls": {name: {"material": "grain", **wall} for name, wall in room.walls().items()},
        "body_forces": [{"type": "gravity", "acceleration": [0.0, 0.0, -GRAVITY]}],
        "time": {"end": {"time": LONGEST}},
        "output": {"writers": [], "frames": 0},
    }

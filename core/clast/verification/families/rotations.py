"""Rigid rotations: what is stressed turns with its loads, and nothing is gained or lost."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import V, W
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.curves import Floats, order
from clast.verification.finding import Finding
from clast.verification.reading import follow, force, moment, position, spin, velocity
from clast.verification.sketch import Line, Sketch

TURNS, PER_TURN = 100, 120
"""Turns, and steps of one, of the bond that is turned as prescribed."""

AXIS = np.array([2.0, -1.0, 2.0]) / 3.0
"""About which the bond is turned: askew to it and to all coordinates."""

LOADS, DRIFT, SWINGING, ROUNDING = 1e-8, 1e-9, 1e-8, 1e-12
"""Accuracy: of loads after 100 turns, of energies per turn, of an energy that swings so much that its mean is known no
better, and of what only rounding can change."""


def turned(vectors: Floats, angle: float) -> Floats:
    """Return vectors, (..., 3), turned about ``AXIS``."""
    along = (vectors @ AXIS)[..., None] * AXIS
    across = vectors - along
    return np.asarray(along + np.cos(angle) * across + np.sin(angle) * np.cross(AXIS, vectors))


def judge_bond(bench: Bench) -> Findings:
    """Stress a bond, turn its ends rigidly a hundred times, and see its loads turn with it."""
    simulation = bench.run()
    twist, start = simulation.world.particles.twist, position(simulation)
    angle, energy = 2.0 * np.pi / PER_TURN, float(simulation.bond_loads()[0, 7])
    twist[:, W : W + 3] = AXIS * (angle / simulation.dt)
    seen, loads, energies = [], [], []
    for k in range(1, TURNS * PER_TURN + 1):
        twist[:, V : V + 3] = (turned(start, k * angle) - position(simulation)) / simulation.dt
        simulation.advance_to(simulation.step + 1)
        if k % 10 == 1:
            seen.append((k - 0.5) * angle)  # forces are evaluated in the middle of a step
            loads.append([force(simulation)[1], moment(simulation)[1]])
            energies.append(float(simulation.bond_loads()[0, 7]))
    back = np.array([turned(np.array(each), -at) for each, at in zip(loads, seen, strict=True)])
    for name, part in (("force", 0), ("moment", 1)):
        change = np.linalg.norm(back[:, part] - back[0, part], axis=1).max() / np.linalg.norm(back[0, part])
        yield Finding(
            f"{name} that turns with the bond: change in {TURNS} turns, share", 0.0, float(change), LOADS, True
        )
    yield Finding(
        "energy of the bond: change per turn, share", 0.0, abs(energies[-1] / energy - 1.0) / TURNS, DRIFT, True
    )
    yield turning_force(np.array(seen), back[0, 0], np.array(loads)[:, 0])


def turning_force(angles: Floats, at_start: Floats, forces: Floats) -> Sketch:
    """Show the force on one end during the last two turns."""
    fine = np.linspace(TURNS - 2.0, TURNS, 200)
    closed = np.array([turned(at_start, 2.0 * np.pi * each) for each in fine])
    last = angles > 2.0 * np.pi * (TURNS - 2)
    lines = (
        Line("closed form", fine, closed[:, 0]),
        Line("Clast", angles[last] / (2.0 * np.pi), forces[last, 0], dots=True),
    )
    return Sketch("a stressed bond that is turned", "turns", "force on one end along x, N", lines)


def judge_pair(bench: Bench) -> Findings:
    """Let a pair spin and vibrate, by three steps: the energy swings with the square of the step and does not drift."""
    written = bench.start()
    turn = 2.0 * np.pi / float(np.linalg.norm(written.scene.spin.mean(axis=0)))
    steps = written.dt * np.array([4.0, 2.0, 1.0])
    swings = []
    for step in steps:
        simulation = bench.start({"time.step": float(step)})
        energies = follow(simulation, lambda s: budget(s)[0], round(turn / step / 40.0))
        energies /= energies[0]
        swings.append(float(energies.std()))
    tenth = len(energies) // 10
    drift = (energies[-tenth:].mean() - energies[:tenth].mean()) / (0.9 * TURNS)
    yield Finding("energy: change per turn, share", 0.0, abs(float(drift)), SWINGING, True)
    yield Finding("order of the swing of the energy in the step", 2.0, -order(steps, swings), 0.02)
    line = Line("second order", 1e6 * steps, swings[-1] * (steps / steps[-1]) ** 2)
    dots = Line("Clast", 1e6 * steps, np.array(swings), dots=True)
    yield Sketch(
        "a pair that spins and vibrates", "step, µs", "swing of its energy, share", (line, dots), logarithmic=True
    )


def judge_cube(bench: Bench) -> Findings:
    """Let a bonded cube spin freely and see what it keeps."""
    simulation = bench.start()
    scene = simulation.scene
    turn = 2.0 * np.pi / float(np.linalg.norm(scene.spin[0]))
    every = max(1, round(turn / simulation.dt / 20.0))
    energies, momenta, diagonals = follow(simulation, budget, every)
    time = simulation.dt * np.minimum(every * np.arange(len(energies)), simulation.last_step) / turn
    drift = float(np.polyfit(time, energies / energies[0], 1)[0])
    yield Finding("turns", 100.0, float(time[-1]), 0.01)
    yield Finding("energy: change per turn, share", 0.0, abs(drift), DRIFT, True)
    change = np.linalg.norm(momenta - momenta[0], axis=1).max() / np.linalg.norm(momenta[0])
    yield Finding("angular momentum: largest change, share", 0.0, float(change), ROUNDING, True)
    stretch = float(np.abs(diagonals / diagonals[0] - 1.0).max())
    yield Finding("a diagonal: largest change, share", 0.0, stretch, 1e-3, True)
    error = Line("energy / energy at the start - 1", time, energies / energies[0] - 1.0)
    yield Sketch("a spinning cube of 27 spheres", "turns", "change of energy, share", (error,))


def budget(simulation: Simulation) -> tuple[float, Floats, float]:
    """Return energy in J, angular momentum in kg m²/s, and the distance of the first sphere from the last in m."""
    scene = simulation.scene
    x, v, w = position(simulation), velocity(simulation), spin(simulation)
    inertia = 0.4 * scene.mass * scene.radius**2
    kinetic = 0.5 * (scene.mass * (v**2).sum(axis=1) + inertia * (w**2).sum(axis=1)).sum()
    momentum = (scene.mass[:, None] * np.cross(x, v) + inertia[:, None] * w).sum(axis=0)
    return float(kinetic + simulation.bond_loads()[:, 7].sum()), momentum, float(np.linalg.norm(x[-1] - x[0]))


FAMILY = Family(
    "rotations",
    "Rigid rotations",
    "A hundred turns about an axis that is askew to everything. A bond that is stretched, sheared, twisted and bent "
    "keeps its loads, which turn with it; a spinning cube of bonded spheres keeps its energy.",
    (
        Case(
            "rotation_bond",
            "a stressed bond is turned",
            "rotation_bond",
            judge_bond,
            "the same loads in a frame that turns with the bond; the same energy",
        ),
        Case(
            "rotation_pair",
            "a bent pair spins and vibrates freely",
            "rotation_pair",
            judge_pair,
            "the same energy but for swings with the square of the step: the loads are the gradient of one energy",
            (needs.synchronous,),
        ),
        Case(
            "rotation_cube",
            "a tilted cube of 27 spheres spins freely",
            "rotation_cube",
            judge_cube,
            "the same energy and angular momentum",
        ),
    ),
)

"""Periodic boxes: what goes on across their faces goes on as it would inside."""

from __future__ import annotations

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.curves import Floats, frequency
from clast.verification.families.bonds import beam_of
from clast.verification.families.waves import along_the_row
from clast.verification.finding import Finding, worst
from clast.verification.reading import follow, position, spin, velocity
from clast.verification.sketch import Line, Sketch

LOOK = 10
"""Steps between two looks."""

ROUNDING = 1e-9
"""What rounding makes of equal impacts, as a share: overlaps of 1e-5 m are known to 1e-18 m, from positions of 1e-2 m,
and friction takes up their differences."""

DISPERSION = 1e-4
"""Accuracy of a frequency: the step is a hundredth of the time that a wave takes from sphere to sphere."""

MIDDLE = {
    "particles.particles.0.position": [5.7e-3, 4.4e-3, 5e-3],
    "particles.particles.1.position": [4.3e-3, 5.6e-3, 5.3e-3],
}
"""Where the spheres begin that meet in the middle of the box: half a box away from the others."""


def judge_collision(bench: Bench) -> Findings:
    """Let two spheres meet across an edge of the box, and in its middle."""
    across, inside = bench.run(), bench.run(MIDDLE)
    for name, read in (("velocities", velocity), ("spins", spin)):
        expected, got = read(inside), read(across)
        error = float(np.abs(got - expected).max() / np.abs(expected).max())
        yield Finding(f"{name} after the impact: largest difference, share of the largest", 0.0, error, ROUNDING, True)
    start, mass = across.scene.velocity, across.scene.mass
    error = float(np.abs(mass @ (velocity(across) - start)).max() / (mass @ np.abs(start)).max())
    yield Finding("momentum: change, share of that of all spheres", 0.0, error, ROUNDING, True)
    moved = float(np.linalg.norm((velocity(inside) - start)[0]) / np.linalg.norm(start[0]))
    yield Finding("that they met: change of the first one's velocity, at least", 1.0, min(moved, 1.0), 0.5)


def judge_ring(bench: Bench) -> Findings:
    """Knock at one sphere and twist it, and compare the frequencies of all modes of the ring with the dispersion."""
    simulation = bench.start()
    scene, beam = simulation.scene, beam_of(simulation.scene)
    m, r, count = float(scene.mass[0]), float(scene.radius[0]), len(scene.mass)
    yield Finding("bonds", count, len(scene.ends), 0.0)
    stretching, twisting = follow(simulation, along_the_row, LOOK)
    time = simulation.dt * np.minimum(LOOK * np.arange(len(stretching)), simulation.last_step)
    k_a = 2.0 * np.pi * np.arange(1, count // 2 + 1) / count
    lines = []
    for name, motion, fastest in (
        ("stretching", stretching, 2.0 * np.sqrt(beam.axial / m)),
        ("twisting", twisting, 2.0 * np.sqrt(beam.torsion / (0.4 * m * r**2))),
    ):
        got = np.array([frequency(time, motion @ np.cos(x * np.arange(count))) for x in k_a])
        expected = np.asarray(fastest * np.sin(0.5 * k_a))
        yield worst(
            (
                Finding(f"{name}: frequency at k a = {x:.3f}, rad/s", float(a), float(b), DISPERSION)
                for x, a, b in zip(k_a, expected, got, strict=True)
            ),
            f"worst of {len(k_a)} modes, ",
        )
        lines += [
            Line(f"{name}: closed form", k_a, 1e-6 * expected),
            Line(f"{name}: Clast", k_a, 1e-6 * got, dots=True),
        ]
    drift = mean_place(simulation) - float(scene.velocity[0, 0]) / count * simulation.time
    yield Finding("mean way of the ring beside its momentum, m", 0.0, abs(drift), 1e-15, True)
    yield Sketch("waves round a bonded ring", "k a", "ω, 10⁶ rad/s", tuple(lines))


def mean_place(simulation: Simulation) -> float:
    """Return how far all particles have gone along x on average, in m."""
    way: Floats = position(simulation) - simulation.scene.position
    return float(way[:, 0].mean())


FAMILY = Family(
    "periodic",
    "Periodic boxes",
    "What leaves a periodic box at one face comes in at the other; contacts and bonds reach across the faces.",
    (
        Case(
            "periodic_collision",
            "two spheres collide across an edge of the box",
            "periodic_collision",
            judge_collision,
            "what the same impact gives in the middle of the box; momentum stays",
        ),
        Case(
            "periodic_ring",
            "dispersion of waves in a row of bonded spheres without ends",
            "periodic_ring",
            judge_ring,
            "ω = 2 √(EA/(L m)) sin(k a/2), and 2 √(GJ/(L I)) sin(k a/2), with k a = 2 π j/n: L. Brillouin (1946), Wave "
            "Propagation in Periodic Structures",
            (needs.cylinder,),
        ),
    ),
)

"""Waves along a row of bonded spheres."""

from __future__ import annotations

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.curves import Floats, frequency
from clast.verification.families.bonds import beam_of
from clast.verification.finding import Finding, worst
from clast.verification.reading import follow, spin, velocity
from clast.verification.sketch import Line, Sketch

LOOK = 10
"""Steps between two looks."""

DISPERSION = 1e-4
"""Accuracy of a frequency: the step is a hundredth of the time that a wave takes from sphere to sphere."""

NAMED = (1, 10, 20, 40)
"""Modes that the table shows; the worst of all comes after them."""


def judge_bar(bench: Bench) -> Findings:
    """Knock at one end and twist it, and compare the frequencies of all modes of the row with the dispersion."""
    simulation = bench.start()
    scene, beam = simulation.scene, beam_of(simulation.scene)
    m, r = float(scene.mass[0]), float(scene.radius[0])
    stretching, twisting = follow(simulation, along_the_row, LOOK)
    time = simulation.dt * np.minimum(LOOK * np.arange(len(stretching)), simulation.last_step)
    count = len(scene.mass)
    k_a = np.pi * np.arange(1, count) / count
    lines = []
    for name, motion, fastest in (
        ("stretching", stretching, 2.0 * np.sqrt(beam.axial / m)),
        ("twisting", twisting, 2.0 * np.sqrt(beam.torsion / (0.4 * m * r**2))),
    ):
        got = np.array([frequency(time, each) for each in modes(motion)])
        expected = fastest * np.sin(0.5 * k_a)
        found = [
            Finding(f"{name}: frequency at k a = {x:.3f}, rad/s", float(a), float(b), DISPERSION)
            for x, a, b in zip(k_a, expected, got, strict=True)
        ]
        yield from (found[mode - 1] for mode in NAMED)
        yield worst(found, f"worst of {count - 1} modes, ")
        lines += [Line(f"{name}: closed form", k_a, 1e-6 * expected)]
        lines += [Line(f"{name}: Clast", k_a[::2], 1e-6 * got[::2], dots=True)]
    yield Sketch("waves along a bonded row", "k a", "ω, 10⁶ rad/s", tuple(lines))


def along_the_row(simulation: Simulation) -> tuple[Floats, Floats]:
    """Return velocities and spins along the x axis, (n,) each."""
    return velocity(simulation)[:, 0], spin(simulation)[:, 0]


def modes(motion: Floats) -> Floats:
    """Return the share of each mode of a free row but the rigid one: (n - 1, s) from (s, n) motions."""
    count = motion.shape[1]
    places = np.arange(count) + 0.5
    shapes = np.cos(np.pi * np.outer(np.arange(1, count), places) / count)
    return np.asarray(shapes @ motion.T)


FAMILY = Family(
    "waves",
    "Waves",
    "A free row of 41 bonded spheres, struck and twisted at one end. All its modes vibrate together, each with the "
    "frequency that belongs to its wave number k; a is the distance of two spheres.",
    (
        Case(
            "wave_bar",
            "dispersion of waves that stretch and twist",
            "wave_bar",
            judge_bar,
            "ω = 2 √(EA/(L m)) sin(k a/2), and 2 √(GJ/(L I)) sin(k a/2): L. Brillouin (1946), Wave Propagation in "
            "Periodic Structures",
            (needs.cylinder,),
        ),
    ),
)

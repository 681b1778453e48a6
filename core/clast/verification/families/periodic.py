"""Periodic boxes: what goes on across their faces goes on as it would inside."""

from __future__ import annotations

import numpy as np

from clast.results.cell import cell_stress
from clast.scene.scene import strain_rates
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

EXACT = 1e-12
"""Accuracy of lengths that are known at every time."""

STRESS = 1e-8
"""Accuracy of a stress: dashpots see the velocities at the last evaluation of forces, half a step before."""

WORK = 1e-3
"""Accuracy of work and heat, sums over steps of forces that set in at once: the dashpots' at the start."""

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


def judge_stretch(bench: Bench) -> Findings:
    """Stretch a lattice in several ways, and compare stress, work and heat with those of its bonds, one by one."""
    fast = {"boundaries.domain.strain_measure": "engineering"}
    sideways = {"boundaries.domain.strain_rate": [0.0, 0.0, -20.0]}
    for name, changes in (("", {}), ("engineering strain, ", fast), ("pressed along z, ", sideways)):
        simulation = bench.run(changes)
        scene, box, time = simulation.scene, simulation.box, simulation.time
        assert scene.config.bonds is not None
        axis = int(np.argmax(np.abs(strain_rates(scene.config))))
        rate = float(strain_rates(scene.config)[axis])
        stretch = 1.0 + rate * time if changes is fast else np.exp(rate * time)
        yield Finding(f"{name}length of the box, m", scene.box.span[axis] * stretch, float(box.span[axis]), EXACT)
        beam, m, count = beam_of(scene), float(scene.mass[0]), len(scene.mass)
        section = box.volume / (count * float(scene.length[0]) * stretch)
        dashpot = 2.0 * scene.config.bonds.damping * np.sqrt(beam.axial * 0.5 * m)
        grows = scene.length[0] * rate * (1.0 if changes is fast else stretch)
        force = beam.axial * scene.length[0] * (stretch - 1.0) + dashpot * grows
        stress = cell_stress(simulation)
        yield Finding(f"{name}stress along, Pa", float(force / section), float(stress[axis, axis]), STRESS)
        along, stress[axis, axis] = float(stress[axis, axis]), 0.0
        yield Finding(f"{name}other stresses, share of it", 0.0, float(np.abs(stress / along).max()), ROUNDING, True)
        ledger = simulation.ledger()
        stored = count * 0.5 * beam.axial * (scene.length[0] * (stretch - 1.0)) ** 2
        heat = count * dashpot * squares_of_rates(scene.length[0], rate, time, changes is fast)
        yield Finding(f"{name}work of the box, J", float(stored + heat), ledger.box, WORK)
        yield Finding(f"{name}heat of the dashpots, J", float(heat), ledger.bond_viscous, WORK)


def squares_of_rates(length: float, rate: float, time: float, engineering: bool) -> float:
    """Return the integral over time of the squared rate at which a bond grows with the box, in m²/s."""
    if engineering:
        return float((length * rate) ** 2 * time)
    return float(0.5 * length**2 * rate * (np.exp(2.0 * rate * time) - 1.0))


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
        Case(
            "periodic_stretch",
            "a cubic lattice stretched, and pressed, at a constant rate",
            "periodic_stretch",
            judge_stretch,
            "every bond along grows with the box: σ = (EA (λ - 1) + c λ' L)/section of the cell, work = n ½ EA/L "
            "((λ - 1) L)² + n c ∫ (λ' L)² dt, with λ = exp(ε' t) or 1 + ε' t",
            (needs.cylinder,),
        ),
    ),
)

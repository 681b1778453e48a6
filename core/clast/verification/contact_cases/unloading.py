"""A cycle of pressing and shearing in which a tangential spring tightens, or eases."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import V
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Findings
from clast.verification.closed_forms.sticking import effective_tangential_modulus
from clast.verification.curves import Floats
from clast.verification.finding import Finding
from clast.verification.reading import force, velocity
from clast.verification.sketch import Line, Sketch

SHALLOW, DEEP, SHEAR = 2e-3, 8e-3, 2e-3
"""Overlaps and tangential displacement, in radii."""

LEGS = ((0.0, -SHALLOW), (SHEAR, 0.0), (0.0, SHALLOW - DEEP), (-SHEAR, 0.0), (0.0, DEEP))
"""Ways of the cycle along x and z, in radii."""

PER_LEG, ACCURACY = 2000, 2e-3
"""Steps of a leg, and the accepted error, which falls with the step: velocities are set from outside between steps."""


def lead(simulation: Simulation) -> tuple[Floats, float]:
    """Lead the sphere through the cycle; return the tangential forces on it in N, and the work it does in J.

    What leads the sphere changes its velocity between two steps, while a contact counts on one velocity from one force
    evaluation to the next, half-way through each step: a spring across is stretched by whole steps, so its work is a
    sum of means; the overlap is that of half a step, so the work of pressing is a sum of middles.
    """
    twist, radius = simulation.world.particles.twist, float(simulation.scene.radius[0])
    forces, ways = [force(simulation)[0]], []
    shares = (1.0 - np.cos(2.0 * np.pi * (np.arange(PER_LEG) + 0.5) / PER_LEG)) / PER_LEG
    for x, z in LEGS:
        for share in shares:  # of the leg: it begins and ends slowly, so that velocities do not jump
            twist[0, V : V + 3] = share * radius / simulation.dt * np.array([x, 0.0, z])
            simulation.advance_to(simulation.step + 1)
            forces.append(force(simulation)[0])
            ways.append(simulation.dt * velocity(simulation)[0])
    f, way = np.array(forces), np.array(ways)
    work = 0.5 * (f[1:, 0] + f[:-1, 0]) @ way[:, 0] + f[1:, 2] @ way[:, 2]
    return f[1:, 0], -float(work)


def judge(bench: Bench) -> Findings:
    """Compare the work of the cycle with ½ Δk_t ξ², gained without and lost with a spring that keeps its force."""
    start = bench.start()
    own, floor = (start.config.materials["ball"],) * 2
    radius = float(start.scene.radius[0])
    shallow, deep = (8.0 * effective_tangential_modulus(own, floor) * radius * d**0.5 for d in (SHALLOW, DEEP))
    expected = 0.5 * (deep - shallow) * (SHEAR * radius) ** 2
    lines = []
    for memory, sign in (("displacement", -1.0), ("force", 1.0)):
        shear, work = lead(bench.start({"contacts.law.tangential_memory": memory}))
        yield Finding(f"{memory}: work of the cycle, J", sign * expected, work, ACCURACY)
        lines.append(Line(memory, np.arange(float(len(shear))) / PER_LEG, shear))
    yield Sketch("tangential force in the cycle", "leg", "force on the sphere along x, N", tuple(lines))


CASE = Case(
    "tangential_cycle",
    "energy of a cycle of pressing and shearing",
    "contact_cycle",
    judge,
    "∓½ (k_t,deep − k_t,shallow) ξ²: springs that tighten or ease at a stiffness 8 G* a; "
    "Elata and Berryman (1996), Mechanics of Materials 24, 229–240",
    (needs.hertzian, needs.sticks, needs.law_parameters("tangential_memory")),
)

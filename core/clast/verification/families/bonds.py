"""One bond: its stiffnesses, and that it favours neither end and leaves nothing behind."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.scene.scene import Scene
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.beam import Beam
from clast.verification.curves import Floats
from clast.verification.finding import Finding, worst
from clast.verification.reading import evaluation, follow, force, moment, position, spin, velocity
from clast.verification.sketch import Line, Sketch

EXACT = 1e-8
"""Accuracy of stiffnesses: strains of 1e-5 are known to about 1e-9, from positions near 1 mm."""


def model_parameters(scene: Scene) -> Any:
    """Return what is written for the bond model of a scene."""
    assert scene.config.bonds is not None
    return scene.config.bonds.model.params


def beam_of(scene: Scene, bond: int = 0) -> Beam:
    """Return a bond as a cylinder of the material that its model is told of."""
    E, nu = needs.elastic_constants(scene.config)
    return Beam(E, nu, 0.5 * float(scene.diameter[bond]), float(scene.length[bond]))


def split(vector: Floats, axis: Floats) -> tuple[float, float]:
    """Return the part of a vector along a unit vector, and the size of the rest."""
    along = float(vector @ axis)
    return along, float(np.linalg.norm(vector - along * axis))


def judge_stiffness(bench: Bench) -> Findings:
    """Compare what the loads on the ends grow by with what the strains do."""
    simulation = bench.start()
    scene, beam = simulation.scene, beam_of(simulation.scene)
    i, j = scene.ends.T
    forces, moments = follow(simulation, lambda s: (force(s), moment(s)))
    time = simulation.dt * (len(forces) - 2)  # the first row is the start, before loads are known
    pull, turn = forces[-1, i] - forces[1, i], 0.5 * (moments[-1] - moments[1])
    slip, spun = time * (scene.velocity[j] - scene.velocity[i]), time * (scene.spin[j] - scene.spin[i])
    loads = [*pull[:2], *(turn[i] - turn[j])[2:]]  # the levers of a shear force turn both ends alike
    axes = scene.bond_vectors / scene.length[:, None]
    moved = [*slip[:2], *spun[2:]]
    found = [split(loads[b], axes[b])[b % 2] / split(moved[b], axes[b])[b % 2] for b in range(4)]
    expected = {"EA/L, N/m": beam.axial, "GA/L, N/m": beam.shear, "GJ/L, N m": beam.torsion, "EI/L, N m": beam.bending}
    for (name, stiffness), got in zip(expected.items(), found, strict=True):
        yield Finding(name, stiffness, got, EXACT)
    lever = split(2.0 * turn[i[1]], axes[1])[1] / split(pull[1], axes[1])[1]
    yield Finding("sheared: moment on an end over shear force, m", 0.5 * beam.L, lever, EXACT)
    yield Finding("force on both ends together, N", 0.0, float(np.abs(forces[:, i] + forces[:, j]).max()), 0.0, True)


def judge_pull(bench: Bench) -> Findings:
    """Compare what the force grows by in each step."""
    simulation = bench.start()
    beam, speed = beam_of(simulation.scene), simulation.scene.velocity[1, 2]
    expected = beam.axial * speed * simulation.dt
    pulls = follow(simulation, force)[1:, 0, 2]
    grown = np.diff(pulls)
    yield worst(Finding("growth of the force a step, N", expected, float(each), EXACT) for each in grown)
    steps = np.arange(len(pulls), dtype=float)
    yield Sketch(
        "a pair drawn apart",
        "step",
        "force, N",
        (
            Line("1570.8 N a step", steps, pulls[0] + expected * steps),
            Line("Clast", steps[::20], pulls[::20], dots=True),
        ),
    )


def judge_swap(bench: Bench) -> Findings:
    """Run the scene as written, and with its particles in the opposite order."""
    written = bench.scene().document.data["particles"]["particles"]
    reverse: list[Any] = written[::-1]
    one, other = bench.run(), bench.run({"particles.particles": reverse})
    for name, read in (("positions, m", position), ("velocities, m/s", velocity), ("spins, rad/s", spin)):
        yield Finding(f"largest difference of {name}", 0.0, farthest(read(one), read(other)[::-1]), 0.0, absolute=True)


def judge_weak(bench: Bench) -> Findings:
    """Compare spheres whose bond breaks at once with spheres that never had one."""
    apart = bench.start({"particles.bonds": [], "bonds": None})
    plain = follow(apart, motion)
    for touching in (True, False):
        simulation = bench.start({"contacts.bonded_pairs": touching})
        found = follow(simulation, motion)
        kind = "touching" if touching else "not touching"
        step = int(simulation.world.cracks.step[0]) if simulation.bonds_broken else simulation.last_step
        first = 0.0 if evaluation(simulation) > 0.0 else 1.0  # that sees other positions than those of the start
        yield Finding(f"bonded pairs {kind}: step in which the bond breaks", first, float(step), 0.0, absolute=True)
        for name, a, b in zip(("positions, m", "velocities, m/s", "spins, rad/s"), plain, found, strict=True):
            yield Finding(f"bonded pairs {kind}: difference of {name}", 0.0, farthest(a, b), 0.0, absolute=True)
    time = 1e6 * apart.dt * np.arange(len(plain[1]), dtype=float)
    lines = [Line("never bonded", time, plain[1][:, 0, 0]), Line("bond broken", time[::50], found[1][::50, 0, 0], True)]
    yield Sketch("a bond that breaks before a collision", "time, µs", "velocity of a sphere, m/s", tuple(lines))


def motion(simulation: Simulation) -> tuple[Floats, Floats, Floats]:
    """Return positions, velocities and spins, (n, 3) each."""
    return position(simulation), velocity(simulation), spin(simulation)


def farthest(a: Floats, b: Floats) -> float:
    """Return the largest difference of two arrays of numbers."""
    return float(np.abs(a - b).max())


FAMILY = Family(
    "bonds",
    "One bond",
    "Bonds between ends that move as prescribed, and bonds between free spheres. The stiffnesses are those of a "
    "cylinder. A bond favours neither of its ends, and once broken it leaves no trace: both to the last bit.",
    (
        Case(
            "bond_stiffness",
            "a bond stretched, sheared, twisted, bent",
            "bond_stiffness",
            judge_stiffness,
            "EA/L, GA/L, GJ/L, EI/L: Rotter, Dosta and Düster (2023), Eqs. 3–6",
            (needs.cylinder,),
        ),
        Case(
            "bond_pull",
            "a pair drawn apart, step by step",
            "bond_pull",
            judge_pull,
            "E π r²/(2 r) v dt = 1570.8 N a step: a case of the test suite of Kratos Multiphysics",
            (needs.cylinder,),
        ),
        Case(
            "bond_swap",
            "free bonded spheres, written in either order",
            "bond_swap",
            judge_swap,
            "the same bits: the equations are symmetric",
        ),
        Case(
            "bond_weak",
            "a bond that breaks at once equals a plain contact",
            "bond_weak",
            judge_weak,
            "the same bits as without a bond",
            (needs.bond_parameters("normal_strength", "shear_strength"),),
        ),
    ),
)

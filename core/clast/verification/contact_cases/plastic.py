"""Impacts with hysteresis: what is left of the speed after yielding, and after pulling free."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Findings
from clast.verification.closed_forms.plastic import PlasticImpact
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import STARTS, motion
from clast.verification.sketch import Line, Sketch

COHESIVE = {"contacts.law.cohesion_stiffness": "0.5 MN/m"}
ACCURACY = 5e-4
"""Accepted error of v'/v: the stiffness jumps at the turn of the motion, and at touch."""


def closed(simulation: Simulation, i: int) -> PlasticImpact:
    """Return the closed form of particle i and the floor, by the parameters of the law."""
    config, scene = simulation.config, simulation.scene
    assert config.contacts is not None
    names = ("loading_stiffness", "unloading_stiffness", "cohesion_stiffness", "plasticity_depth")
    k_1, k_p, k_c, phi = (float(getattr(config.contacts.law.params, name)) for name in names)
    depth = 2.0 * phi * float(scene.radius[i]) * k_p / (k_p - k_1)
    return PlasticImpact(k_1, k_p, k_c, depth, float(scene.mass[i]), -float(scene.velocity[i, 2]))


def judge(bench: Bench) -> Findings:
    """Compare the rebounds with and without cohesion, each the worst of four starts."""
    for name, changes in (("", {}), ("cohesive: ", COHESIVE)):
        start = bench.start(changes)
        ends = [motion(bench.run({**changes, "time.step": start.dt / each})).across for each in STARTS]
        for i in range(len(start.scene.radius)):
            expected = closed(start, i)
            quantity = f"{name}v'/v at {expected.speed:g} m/s"
            rebounds = [-float(end[i]) / expected.speed for end in ends]
            yield worst(Finding(quantity, expected.restitution, got, ACCURACY) for got in rebounds)
    yield curves(bench)


def curves(bench: Bench) -> Sketch:
    """Show the restitution over the speed, with and without cohesion."""
    speeds, lines = np.linspace(0.1, 10.0, 80), []
    for name, changes in (("k_c = 0", {}), ("k_c = 0.5 MN/m", COHESIVE)):
        start, end = bench.start(changes), bench.run(changes)
        form, own = closed(start, 0), -start.scene.velocity[:, 2]
        values = [replace(form, speed=float(v)).restitution for v in speeds]
        lines.append(Line(name, speeds, np.array(values)))
        lines.append(Line(f"Clast, {name}", own, -motion(end).across / own, dots=True))
    return Sketch("luding: restitution", "speed, m/s", "v'/v", tuple(lines))


CASE = Case(
    "plastic_impact",
    "elastic-plastic spheres that stick: restitution at three speeds",
    "contact_luding",
    judge,
    "√(released − pulled)/v: the force of Luding (2008), doi:10.1007/s10035-008-0099-x, integrated",
    (needs.law_parameters("loading_stiffness", "unloading_stiffness", "cohesion_stiffness", "plasticity_depth"),),
)

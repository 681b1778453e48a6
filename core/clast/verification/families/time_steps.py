"""Time steps: the limit is the true one, and what is below it converges."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np

from clast.engine.kernels.layout import V
from clast.errors import RunError
from clast.simulation import Simulation
from clast.stability.damped_step import stable_step
from clast.stability.springs import bodies_at_start, springs_at_start
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.curves import Floats
from clast.verification.dense_springs import largest
from clast.verification.families.bonds import farthest
from clast.verification.finding import Finding
from clast.verification.reading import position, velocity
from clast.verification.sketch import Line, Sketch

INTEGRATORS = ("midstep", "leapfrog", "velocity_verlet")

NOISE = 1e-9
"""Speed in m/s of every particle at the start."""

LOUD = 100.0
"""Growth of the speed that shows a scene to be unstable."""

TRIED = (0.95, 1.05)
"""Steps between which the smallest unstable one is looked for, as shares of the limit of the dense matrix."""

HALVINGS = 5
"""How often their distance is halved: to 0.3 % of the limit."""

LOOK = 20
"""Steps between two looks."""

WITHIN_DENSE = 0.05
"""How far the limit that Clast finds without a matrix may be from that of the dense one."""

STEPS = (2e-7, 1e-7, 5e-8)
"""Steps in s whose errors are compared."""

FINEST = 6.25e-9
"""Step in s of the run that takes the place of the exact one."""

ORDER = 2.0
"""Of the integrators above."""

SMOOTH_STEPS = (40, 80, 160)
"""Steps to the end of what is watched of the bonded pair."""

SMOOTH_FINEST = 1280
"""Steps of the run that takes the place of the exact one, with the installed integrator of the highest order."""

SMOOTH_END = 4e-5
"""How long the pair is watched, in s."""


def judge_limit(bench: Bench) -> Findings:
    """Compare the limit with that of the dense matrix, and with the step from which on the grain flies apart."""
    lines = []
    for integrator in INTEGRATORS:
        change = {"integrator": integrator}
        dense, found = dense_limit(bench.start(change))
        yield Finding(f"{integrator}: limit found without a matrix, s", dense, found, WITHIN_DENSE)
        quiet, loud, histories = closing_in(bench, change, dense)
        yield Finding(
            f"{integrator}: step at which the grain flies apart, s", dense, 0.5 * (quiet + loud) * dense, 0.01
        )
        if integrator == INTEGRATORS[0]:
            lines = [
                Line(f"{share:.3f} of the limit", LOOK * np.arange(1.0, len(grown)), grown[1:])
                for share, grown in histories.items()
            ]
    yield Sketch(f"a grain at rest, nudged; {INTEGRATORS[0]}", "steps", "speed, share of the nudge", tuple(lines), True)


def closing_in(bench: Bench, change: Mapping[str, Any], dense: float) -> tuple[float, float, dict[float, Floats]]:
    """Return the largest step that stays quiet and the smallest that does not, as shares; and how the speed grows."""
    quiet, loud = TRIED
    histories = {share: growth(bench, {**change, "time.step": share * dense}) for share in TRIED}
    if histories[quiet].max() > LOUD or histories[loud].max() < LOUD:
        return (quiet, quiet, histories) if histories[quiet].max() > LOUD else (loud, loud, histories)
    for _ in range(HALVINGS):
        middle = 0.5 * (quiet + loud)
        histories[middle] = growth(bench, {**change, "time.step": middle * dense})
        quiet, loud = (middle, loud) if histories[middle].max() < LOUD else (quiet, middle)
    return quiet, loud, dict(sorted(histories.items()))


def dense_limit(simulation: Simulation) -> tuple[float, float]:
    """Return the limit of the step in s that the dense matrix gives, and the one that Clast finds without it."""
    scene, plan = simulation.scene, simulation.plan
    bodies, springs = bodies_at_start(scene), springs_at_start(scene, plan)
    factor = plan.damping_factor
    return stable_step(lambda per_time: largest(springs, bodies, per_time), factor), simulation.limits.spectral


def growth(bench: Bench, change: Mapping[str, Any]) -> Floats:
    """Return how much faster particles are than after the nudge, at every look until the run ends or is stopped."""
    simulation = bench.start({**change, "time.allow_unstable": True})
    twist = simulation.world.particles.twist
    twist[:, V : V + 3] = NOISE * np.random.default_rng(1).normal(size=(len(twist), 3))
    told = [float(np.linalg.norm(velocity(simulation)))]
    with suppress(RunError):
        while simulation.step < simulation.last_step:
            simulation.advance_to(simulation.step + LOOK)
            told.append(float(np.linalg.norm(velocity(simulation))))
    return np.asarray(np.array(told) / told[0])


def judge_order(bench: Bench) -> Findings:
    """Halve the step twice, and see the error of the positions fall with its square."""
    lines = []
    for integrator in INTEGRATORS:
        ends = {dt: position(run(bench, integrator, dt)) for dt in (*STEPS, FINEST)}
        way = farthest(ends[FINEST], position(bench.start()))
        errors = np.array([farthest(ends[FINEST], ends[dt]) / way for dt in STEPS])
        got = float(np.polyfit(np.log(STEPS), np.log(errors), 1)[0])
        yield Finding(f"{integrator}: order", ORDER, got, 0.1, True)
        lines.append(Line(integrator, 1e9 * np.array(STEPS), errors, dots=True))
    slope = errors[0] * (np.array(STEPS) / STEPS[0]) ** 2
    lines.append(Line("second order", 1e9 * np.array(STEPS), slope))
    yield Sketch("two cubes that collide", "step, ns", "error, share of the way", tuple(lines), logarithmic=True)


def run(bench: Bench, integrator: str, dt: float) -> Simulation:
    """Return the collision without losses at its end."""
    strong = {"bonds.model.normal_strength": 1e12, "bonds.model.shear_strength": 1e12}
    lossless = {"contacts.pairs.default": {"restitution": 1.0, "sliding_friction": 0.0, "rolling_friction": 0.0}}
    return bench.run(strong | lossless | {"integrator": integrator, "time.step": dt, "time.end": {"time": 4e-4}})


def judge_smooth(bench: Bench) -> Findings:
    """Halve the step twice where no contact and no dashpot spoils the order: for every order but the second."""
    registry = bench.scene().registry
    orders = {name: registry.get("integrator", name).part.order for name in registry.names("integrator")}
    exact = motion(bench, max(orders, key=lambda name: orders[name]), SMOOTH_FINEST)
    steps, lines = np.array(SMOOTH_STEPS), []
    for integrator, order in orders.items():
        if order == ORDER:
            continue
        errors = np.array([np.abs(motion(bench, integrator, n) - exact).max() for n in SMOOTH_STEPS])
        got = -float(np.polyfit(np.log(steps), np.log(errors), 1)[0])
        yield Finding(f"{integrator}: order where forces are smooth", float(order), got, 0.1, True)
        lines.append(Line(integrator, steps, errors, dots=True))
        lines.append(Line(f"order {order}", steps, errors[0] * (steps / steps[0]) ** -float(order)))
    yield Sketch("a bonded pair that spins and vibrates", "steps", "error, share", tuple(lines), logarithmic=True)


def motion(bench: Bench, integrator: str, steps: int) -> Floats:
    """Return positions and velocities of the pair at the end, as shares of the largest."""
    simulation = bench.run({"integrator": integrator, "time.step": SMOOTH_END / steps, "time.end": {"steps": steps}})
    told = (position(simulation), velocity(simulation))
    return np.concatenate([each / np.abs(each).max() for each in told])


FAMILY = Family(
    "time_steps",
    "Time steps",
    "A small bonded grain is nudged: below the largest stable step nothing comes of it, above it the nudge grows. That "
    "step is where the dense matrix of all bonds and their dashpots says, and where Clast finds it without one. "
    "Below it errors fall with the square of the step: two bonded cubes collide without losses, and the run with a "
    "step of 6.25 ns takes the place of the exact one. Integrators of another order than the second show it on a "
    "bonded pair that spins and vibrates without contacts: there forces are smooth.",
    (
        Case(
            "step_limit",
            "the largest stable step",
            "step_grain",
            judge_limit,
            "where the largest eigenvalue of M^-1/2 (K + C g/dt) M^-1/2 is 4/dt^2, from the dense matrix",
        ),
        Case(
            "step_order",
            "errors fall with the square of the step",
            "run_clusters",
            judge_order,
            "second order: E. Hairer, C. Lubich and G. Wanner (2003), Geometric numerical integration illustrated by "
            "the Störmer-Verlet method, Acta Numerica 12",
            (needs.hertzian,),
        ),
        Case(
            "step_smooth",
            "orders where forces are smooth",
            "rotation_pair",
            judge_smooth,
            "the order that the integrator tells: Omelyan, Mryglod and Folk (2002), Computer Physics Communications "
            "146, for PEFRL; Hairer, Lubich and Wanner (2003) for symplectic Euler",
        ),
    ),
)

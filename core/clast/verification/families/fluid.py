"""Fluid: what drags particles, beside closed forms."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.finding import Finding
from clast.verification.reading import follow, spin, velocity
from clast.verification.sketch import Line, Sketch

RESTING, THROWN = 0, 1
"""Numbers of the spheres."""

LOOK = 20
ACCURACY, CLOSURE = 1e-4, 1e-8
NEAR, STEPS = 0.03, 400
"""How far below and above the stable step is tried, and how many steps."""


def drag_of(simulation: Simulation) -> Any:
    """Return what is written for the drag."""
    return simulation.scene.config.body_forces[1].params


def gravity(simulation: Simulation) -> float:
    """Return the acceleration of gravity in m/s²."""
    pull: Any = simulation.scene.config.body_forces[0].params
    return float(-pull.acceleration[2])


def times(simulation: Simulation) -> tuple[float, float]:
    """Return m/(6 π μ r) and 2/5 m r²/(8 π μ r³), in s: how fast motion and spin follow the fluid."""
    m, r = float(simulation.scene.mass[0]), float(simulation.scene.radius[0])
    viscosity = drag_of(simulation).viscosity
    return m / (6.0 * pi * viscosity * r), 0.4 * m * r**2 / (8.0 * pi * viscosity * r**3)


def judge_stokes(bench: Bench) -> Findings:
    """Follow spheres until they go with the fluid: everything decays exponentially."""
    simulation = bench.start()
    tau, tau_spin = times(simulation)
    start, turning = simulation.scene.velocity, simulation.scene.spin
    told, spins = follow(simulation, lambda at: (velocity(at), spin(at)), LOOK)
    time = np.minimum(LOOK * np.arange(len(told)), simulation.last_step) * simulation.dt
    at_last = np.array(drag_of(simulation).fluid_velocity) - [0.0, 0.0, gravity(simulation) * tau]
    left, left_spin = np.exp(-time / tau)[:, None, None], np.exp(-time / tau_spin)[:, None, None]
    expected, expected_spin = at_last + left * (start - at_last), left_spin * turning
    size = np.abs(start[THROWN]).max()
    yield Finding(
        "velocity: largest error, share of the first", 0.0, float(np.abs(told - expected).max() / size), ACCURACY, True
    )
    error = float(np.abs(spins - expected_spin).max() / np.abs(turning).max())
    yield Finding("spin: largest error, share of the first", 0.0, error, ACCURACY, True)
    yield Finding("closure of the energy ledger", 0.0, abs(simulation.ledger().closure), CLOSURE, True)
    lines = (
        Line("exponential", 1e3 * time, 1e3 * expected[:, THROWN, 1]),
        Line("Clast", 1e3 * time[::5], 1e3 * told[::5, THROWN, 1], dots=True),
        Line("Stokes, sinking", 1e3 * time, 1e3 * expected[:, RESTING, 2]),
        Line("Clast, sinking", 1e3 * time[::5], 1e3 * told[::5, RESTING, 2], dots=True),
    )
    yield Sketch("spheres in flowing oil", "time, ms", "velocity, mm/s", lines)


def judge_fast(bench: Bench) -> Findings:
    """Let a sphere sink in thinner and thinner fluid: the drag coefficient at its last velocity carries its weight."""
    for viscosity, duration, step in ((0.1, 0.2, 1e-5), (0.01, 0.5, 5e-5), (0.001, 0.8, 1e-4), (1e-4, 0.8, 1e-4)):
        fluid = {"viscosity": viscosity, "fluid_density": 1000.0, "fluid_velocity": [0, 0, 0]}
        changes = {f"body_forces.1.{key}": value for key, value in fluid.items()}
        simulation = bench.run({**changes, "time.step": step, "time.end": {"time": duration}})
        m, r = float(simulation.scene.mass[RESTING]), float(simulation.scene.radius[RESTING])
        speed = -float(velocity(simulation)[RESTING, 2])
        reynolds = 2.0 * r * 1000.0 * speed / viscosity
        standard = max(24.0 / reynolds * (1.0 + 0.15 * reynolds**0.687), 0.44)
        carried = 0.5 * 1000.0 * pi * r**2 * standard * speed**2
        yield Finding(f"weight carried at Re = {reynolds:.3g}, N", m * gravity(simulation), carried, ACCURACY)


def judge_step(bench: Bench) -> Findings:
    """Take steps just below and above the limit that Clast tells: what spins fades, and grows."""
    limit = bench.start().limits.spectral
    for share, fades in ((1.0 - NEAR, 1.0), (1.0 + NEAR, 0.0)):
        simulation = bench.run({"time.step": share * limit, "time.allow_unstable": True, "time.end": {"steps": STEPS}})
        left = np.abs(spin(simulation)[THROWN, 2] / simulation.scene.spin[THROWN, 2])
        yield Finding(f"at {share:.2f} of the limit the spin fades", fades, float(left < 1.0), 0.0, True)


FAMILY = Family(
    "fluid",
    "Drag of a fluid",
    "Spheres sink in oil that flows: Stokes's drag lets every difference from the flow decay exponentially. In thinner "
    "fluids the drag coefficient depends on the Reynolds number. Drag is a dashpot to the ground, and limits the step "
    "as one.",
    (
        Case(
            "drag_stokes",
            "spheres in a viscous flow",
            "drag",
            judge_stokes,
            "Stokes, Kirchhoff for the torque: exp(-6 π μ r t/m) to u + m g/(6 π μ r), exp(-20 π μ r t/m) for spins",
            (needs.synchronous,),
        ),
        Case(
            "drag_fast",
            "a sphere that sinks in thin fluids",
            "drag",
            judge_fast,
            "standard drag: 24/Re (1 + 0.15 Re^0.687) of Schiller and Naumann, and 0.44 beyond (Clift et al. 1978)",
        ),
        Case(
            "drag_step",
            "the stable step of drag alone",
            "drag",
            judge_step,
            "what is below the limit fades, what is above grows",
        ),
    ),
)

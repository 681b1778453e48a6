"""Contacts: stiffness, sizes, overlaps, restitution, friction and plates between the extremes."""

from __future__ import annotations

from math import acos, cos, radians, sin, sqrt
from typing import Any

import numpy as np

from clast import Simulation
from clast.config.scene import SceneConfig
from clast.engine.kernels.layout import V, W
from tests.stability.entry import ACCURATE, REFUSED, STOPPED, Answer, Entry, Group, Ran
from tests.stability.measures import kinetic, rebound, worst
from tests.stability.scenes import impact_duration, pair, particle, rule, spheres

G = 9.81
FAR = 5.0


def contrast(ratio: float) -> SceneConfig:
    """Return two spheres of which the second is ``ratio`` times as stiff."""
    modulus = 2.0 * 100e6 * ratio / (1.0 + ratio)
    lasts = impact_duration(0.02, (1e-3, 1e-3), modulus)
    changes = {
        "materials.second.young_modulus": 100e6 * ratio,
        "time.end.time": 1e-5 / 0.02 + 3.0 * lasts,
        "time.step": rule(0.02),
    }
    return pair(0.01, changes=changes)


def resolved(steps: float, expected: str) -> Entry:
    """Return a head-on impact that lasts so many steps."""
    step = impact_duration(2.0, (1e-3, 1e-3)) / steps
    changes = {"time.step": step, "contacts.pairs.default": {"restitution": 0.8}}
    changes["time.end.time"] = 1e-5 + 40 * step + 3.0 * steps * step

    def judge(ran: Ran) -> Answer:
        return rebound(ran, 0.8, 0.05)

    return Entry(f"{steps:g} steps", lambda: pair(changes=changes), judge, expected, steps in (6, 4), 1.0 / steps)


def faster_and_faster(height: float, expected: str) -> Entry:
    """Return a sphere that falls on a floor with a fixed step, which resolves an impact at 0.1 m/s with 10 steps."""

    def make() -> SceneConfig:
        made = [particle([0, 0, 1e-3 + height], 1e-3), particle([0, 0, FAR], 1e-3, material="second")]
        changes = {
            "walls.floor.point": [0, 0, 0],
            "body_forces.0.acceleration": [0, 0, -G],
            "time.step": 0.1 * impact_duration(0.1, (1e-3,)),
            "time.end.time": 1.5 * sqrt(2.0 * height / G),
            "output.samples": 2000,
        }
        return spheres(made, changes, "falling")

    def judge(ran: Ran) -> Answer:
        z, v = ran.particles["position"][:, 0, 2], ran.particles["velocity"][:, 0]
        gained = 0.5 * (v[-1] @ v[-1]) + G * (z[-1] - z[0])
        return Answer("energy stays", worst(np.array([gained / (G * height)])), 0.05)

    return Entry(f"falls from {height:g} m", make, judge, expected, short=expected == STOPPED)


def restitution(e: float) -> Entry:
    """Return a head-on impact with a restitution."""
    lasts = impact_duration(2.0, (1e-3, 1e-3))
    changes = {"contacts.pairs.default": {"restitution": e}, "time.end.time": 5e-6 + 10.0 * lasts}
    return Entry(f"e = {e:g}", lambda: pair(changes=changes), lambda ran: rebound(ran, e, 0.01), short=e in (0, 0.5))


def overlapping(share: float, allowed: bool) -> Entry:
    """Return two resting spheres that overlap by a share of their radius, and what they do with that energy."""
    k = 4.0 / 3.0 * 0.5 * 100e6 / (1.0 - 0.25**2) * sqrt(0.5e-3)
    m = 0.5 * 2500.0 * 4.0 / 3.0 * np.pi * 1e-9
    speed = sqrt(0.8 * k * (share * 1e-3) ** 2.5 / m)
    changes: dict[str, Any] = {"time.end.time": 3.0 * impact_duration(speed, (1e-3, 1e-3)), "time.step": rule(speed)}
    if allowed:
        changes["contacts.start_overlap"] = 0.6

    def judge(ran: Ran) -> Answer:
        v = ran.particles["velocity"][-1, :, 0]
        return Answer("all of Hertz's energy becomes motion", worst(np.array([(v[1] - v[0]) / speed - 1.0])), 0.01)

    name = f"{share:.0%} of the radius{', start_overlap: 0.6' if allowed else ''}"
    expected = ACCURATE if allowed or share <= 0.05 else REFUSED
    return Entry(name, lambda: pair(0.0, gap=-share, changes=changes), judge, expected, short=share == 0.5)


def oblique(friction: float, spin: float = 0.0, expected: str = ACCURATE) -> Entry:
    """Return an oblique impact with friction; the answer is that of a 16 times finer step."""
    changes = {"contacts.pairs.default": {"restitution": 0.7, "sliding_friction": friction}}

    def make() -> SceneConfig:
        config = pair(changes=changes)
        sides = {f"particles.particles.{k}.velocity": [s, -s, 0] for k, s in ((0, 1.0), (1, -1.0))}
        spins = {f"particles.particles.{k}.spin": [0, spin, spin] for k in (0, 1)}
        return config.changed(sides | spins)

    name = f"μ = {friction:g}" + (f", spins of {spin:g} rad/s" if spin else "")
    return Entry(name, make, as_with_a_finer_step, expected, short=friction == 10.0)


def as_with_a_finer_step(ran: Ran) -> Answer:
    """Ask for the velocities and surface speeds that a 16 times finer step gives."""
    coarse = ran.simulation
    fine = Simulation(coarse.config.changed({"time.step": coarse.dt / 16.0}))
    fine.advance_to(fine.last_step)
    ends = [
        np.hstack([each.world.particles.twist[:, V : V + 3], 1e-3 * each.world.particles.twist[:, W : W + 3]])
        for each in (coarse, fine)
    ]
    size = float(np.abs(ends[1]).max())
    return Answer("as with a 16 times finer step", worst((ends[0] - ends[1]) / size), 0.03)


def rolling_off(ratio: float) -> Entry:
    """Return a small sphere that rolls off a large one: it leaves at 10/17 of the cosine at which it started."""
    R, r, start = 10e-3, 10e-3 / ratio, radians(5.0)
    top = (R + r) * np.array([sin(start), 0.0, cos(start)])

    def make() -> SceneConfig:
        made = [particle([0, 0, 0], R, prescribed=True), particle(top, r, material="second")]
        changes = {
            "contacts.pairs.default": {"restitution": 0.5, "sliding_friction": 10},
            "body_forces.0.acceleration": [0, 0, -G],
            "time.step": rule(0.1),
            "time.end.time": 7.0 * sqrt((R + r) / G),
            "output.samples": 4000,
        }
        return spheres(made, changes, "falling")

    def judge(ran: Ran) -> Answer:
        x = ran.particles["position"][:, 1]
        distance = np.linalg.norm(x, axis=1)
        last = int(np.nonzero(distance <= R + r)[0][-1])
        expected = acos(10.0 / 17.0 * cos(start))
        return Answer("leaves at cos θ = 10/17", abs(acos(x[last, 2] / distance[last]) / expected - 1.0), 0.03)

    return Entry(f"rolls off, 1 : {ratio:g}", make, judge, short=ratio == 30)


def through_a_pore(ratio: float) -> Entry:
    """Return a small grain that falls through the pore of three large ones, bouncing on the way."""
    R, r = 10e-3, 10e-3 / ratio
    angles = np.radians([90.0, 210.0, 330.0])
    centres = 2.0 / sqrt(3.0) * R * np.column_stack([np.cos(angles), np.sin(angles), 0.0 * angles])

    def make() -> SceneConfig:
        made = [particle(x, R, prescribed=True) for x in centres]
        made.append(particle([0.15 * R, 0.1 * R, 1.2 * R], r, material="second"))
        changes = {
            "contacts.pairs.default": {"restitution": 0.5, "sliding_friction": 0.5},
            "body_forces.0.acceleration": [0, 0, -G],
            "time.step": rule(0.5),
            "time.end.time": 0.3,
            "output.samples": 2000,
        }
        return spheres(made, changes, "falling")

    def judge(ran: Ran) -> Answer:
        z = ran.particles["position"][:, 3, 2]
        total = kinetic(ran) / ran.simulation.scene.mass[3] + G * z
        if not z[-1] < -R:
            return Answer("falls through", np.inf, 1e-3)
        return Answer(
            "falls through, energy never grows", worst(np.maximum.accumulate(total) - total[0]) / (G * R), 1e-3
        )

    return Entry(f"falls through a pore, 1 : {ratio:g}", make, judge)


def plate(speed: float, e: float, expected: str = ACCURATE, step: Any = None) -> Entry:
    """Return a sphere at rest that a plate hits; with the step that suits the speed, or another one."""
    lasts = impact_duration(speed, (1e-3,))

    def make() -> SceneConfig:
        made = [particle([0, 0, 1.01e-3], 1e-3), particle([0, 0, FAR], 1e-3, material="second")]
        changes = {
            "contacts.pairs.default": {"restitution": e},
            "walls.floor.point": [0, 0, 0],
            "walls.floor.motion.velocity": [0, 0, speed],
            "time.step": rule(speed) if step is None else step,
            "time.end.time": 1e-5 / speed + 3.0 * lasts,
        }
        return spheres(made, changes, "falling")

    def judge(ran: Ran) -> Answer:
        v = ran.particles["velocity"][-1, 0, 2]
        return Answer(
            f"leaves at {1.0 + e:g} times the plate's speed", worst(np.array([v / (1 + e) / speed - 1.0])), 0.01
        )

    name = f"{speed:g} m/s, e = {e:g}{'' if step is None else ', default step'}"
    return Entry(name, make, judge, expected, short=speed in (1e-4, 10.0, 1e3) and e == 1.0)


GROUPS = (
    Group(
        "stiffness",
        "Stiffness contrast of contacts",
        "Two spheres meet at 1 cm/s each, elastic; the second is softer or stiffer than the first.",
        tuple(
            Entry(f"{ratio:g}", lambda ratio=ratio: contrast(ratio), lambda ran: rebound(ran, 1.0, 0.01))
            for ratio in (1e-3, 1e-2, 0.1, 1.0, 10.0, 1e3, 1e6)
        ),
    ),
    Group(
        "sizes",
        "Size ratio with friction",
        "A sphere rolls off a fixed one of 10 mm (μ = 10); a small grain falls through a pore between three (μ = 0.5). "
        "Where friction takes velocities from another instant than positions, small grains stay trapped.",
        (*map(rolling_off, (1, 3, 10, 30, 100)), *map(through_a_pore, (10, 30, 100))),
    ),
    Group(
        "overlaps",
        "Overlaps at the start",
        "Two spheres at rest, pressed into each other; by default 5 % of the radius are allowed.",
        (
            *(overlapping(share, False) for share in (0.01, 0.05, 0.1, 0.5)),
            *(overlapping(share, True) for share in (0.1, 0.2, 0.5)),
        ),
    ),
    Group(
        "impacts",
        "Time step: impacts",
        "Two spheres meet at 1 m/s each with a restitution of 0.8: how many steps their impact lasts without "
        "damping. Then a sphere falls on a floor with a step that resolves an impact at 0.1 m/s with 10 steps.",
        (
            *(resolved(steps, ACCURATE) for steps in (200, 100, 50, 20, 10, 6)),
            *(resolved(steps, REFUSED) for steps in (4, 3, 2, 1)),
            *(faster_and_faster(height, ACCURATE) for height in (1e-4, 1e-2, 0.2)),
            *(faster_and_faster(height, STOPPED) for height in (1.0, 4.0)),
        ),
    ),
    Group(
        "restitution",
        "Restitution",
        "Two spheres meet at 1 m/s each.",
        tuple(map(restitution, (0, 0.001, 0.01, 0.1, 0.3, 0.5, 0.8, 0.95, 1))),
    ),
    Group(
        "friction",
        "Friction",
        "Two spheres meet at 45°, with a restitution of 0.7.",
        (
            *map(oblique, (0.0, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0)),
            oblique(0.3, 1e4),
            oblique(10.0, 1e4),
            oblique(0.3, 1e6, REFUSED),
        ),
    ),
    Group(
        "plates",
        "Plate speed",
        "A plate hits a sphere at rest.",
        (
            *(plate(speed, e) for e in (1.0, 0.5) for speed in (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0)),
            plate(10.0, 1.0, step={"rule": "spectral"}),
            plate(1e3, 1.0, STOPPED),
        ),
    ),
)

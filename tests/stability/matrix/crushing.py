"""Crushing: a grain that breaks between plates of very different speed."""

from __future__ import annotations

import numpy as np

from clast.config.scene import SceneConfig, build
from clast.config.yaml_loader import parse_document
from clast.engine.kernels.layout import V
from tests.scenes import CRUSH
from tests.stability.entry import STOPPED, Answer, Entry, Group, Ran
from tests.stability.matrix.steps import UNSTABLE, at_share


def crushed(speed: float, strain: float) -> Entry:
    """Return a grain of 55 primaries that is crushed; what the plates push is the momentum it gets."""

    def make() -> SceneConfig:
        changes = {
            "walls.upper.motion.velocity": [0, 0, -speed],
            "time.end": {"strain": strain},
            "output": {"samples": 200, "frames": 0, "writers": [], "force": "mean"},
        }
        return build(parse_document(CRUSH)).changed(changes)

    def judge(ran: Ran) -> Answer:
        curves, simulation = ran.curves, ran.simulation
        push = np.diff(curves["time_s"]) @ (curves["force_lower_N"] - curves["force_upper_N"])[1:]
        v = simulation.world.particles.twist[:, V + 2]
        size = float(simulation.scene.mass @ np.abs(v))
        missing = abs(push - simulation.scene.mass @ v) / size if np.isfinite(v).all() else np.inf
        broke = bool(curves["bonds_broken"][-1] > 0)
        return Answer("bonds break; plates give the grain its momentum", missing if broke else np.inf, 1e-6)

    return Entry(f"{speed:g} m/s to {strain:.0%} strain", make, judge, short=speed == 10.0)


def crushed_unstably(share: float) -> Entry:
    """Return the same at 1 cm/s with a step above its limit: bonds would break that nothing has loaded."""
    stable = crushed(0.01, 0.3)
    name = f"{stable.name}, {share:g} × limit, allow_unstable"
    return Entry(name, lambda: at_share(stable.scene().changed, share, UNSTABLE), stable.judge, STOPPED, share == 1.1)


GROUPS = (
    Group(
        "crushing",
        "Crushing",
        "A grain of 55 primaries of Model 3 between two plates, with masses scaled by 100.",
        (
            *(crushed(speed, 0.3 if speed > 1e-3 else 0.1) for speed in (1e-3, 1e-2, 0.1, 1.0, 10.0)),
            *map(crushed_unstably, (1.02, 1.1, 1.2, 1.3, 2.0)),
        ),
    ),
)

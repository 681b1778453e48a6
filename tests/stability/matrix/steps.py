"""The time step, from a twentieth of the true limit to three times of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from clast.building import build_scene
from clast.config.scene import SceneConfig
from clast.scene.plan import blueprint
from clast.stability.time_step import limits
from tests.stability.entry import ACCURATE, REFUSED, STOPPED, Answer, Entry, Group, Ran
from tests.stability.measures import drift, kinetic
from tests.stability.scenes import block, bonded, particle, spheres

BELOW = (0.05, 0.2, 0.5, 0.8, 0.95)
ABOVE = (1.05, 1.5, 2.0, 3.0)
UNSTABLE: dict[str, Any] = {"time.allow_unstable": True}


def shaken_block(changes: dict[str, Any]) -> SceneConfig:
    """Return 27 bonded spheres with random velocities."""
    centres, bonds = block(3, 2.1e-3)
    velocity = 0.01 * np.random.default_rng(1).normal(size=centres.shape)
    made = [particle(x, 1e-3, v) for x, v in zip(centres, velocity - velocity.mean(axis=0), strict=True)]
    return bonded(made, bonds, changes)


def pressed_chain(restitution: float, changes: dict[str, Any]) -> SceneConfig:
    """Return ten spheres pressed between two that are held, with random velocities."""
    velocity = 0.01 * np.random.default_rng(2).normal(size=12)
    made = [
        particle([1.98e-3 * k, 0, 0], 1e-3, [velocity[k], 0, 0])
        if 0 < k < 11
        else particle([1.98e-3 * k, 0, 0], 1e-3, prescribed=True)
        for k in range(12)
    ]
    made[1]["material"] = "second"
    settings = {"contacts.pairs.default": {"restitution": restitution}, "time.end": {"steps": 20_000}}
    return spheres(made, settings | changes)


def at_share(make: Callable[[dict[str, Any]], SceneConfig], share: float, changes: dict[str, Any]) -> SceneConfig:
    """Return a scene whose step is a share of its true limit."""
    scene = build_scene(make({}))
    return make({"time.step": share * limits(scene, blueprint(scene)).spectral, **changes})


def comes_to_rest(ran: Ran) -> Answer:
    """Ask that damped motion dies out."""
    energy = kinetic(ran)
    return Answer("comes to rest", float(energy[-1] / energy[0]) if np.isfinite(energy[-1]) else np.inf, 1e-3)


def sweep(
    make: Callable[[dict[str, Any]], SceneConfig], judge: Callable[[Ran], Answer], what: str = ""
) -> tuple[Entry, ...]:
    """Return a scene at every share of its true limit; above it as it stands, and with ``allow_unstable``."""

    def entry(share: float, expected: str, changes: dict[str, Any]) -> Entry:
        name = f"{what}{share:g} × limit{', allow_unstable' if changes else ''}"
        short = share in (0.95, 1.05)
        return Entry(name, lambda: at_share(make, share, changes), judge, expected, short, share)

    return (
        *(entry(share, ACCURATE, {}) for share in BELOW),
        *(entry(share, REFUSED, {}) for share in ABOVE),
        *(entry(share, STOPPED, UNSTABLE) for share in ABOVE),
    )


GROUPS = (
    Group(
        "step_bonds",
        "Time step: bonds",
        "27 spheres in a cubic grid, 54 elastic bonds, random velocities of 1 cm/s, no damping, 20 000 steps. The "
        "limit is `spectral`.",
        sweep(shaken_block, lambda ran: drift(ran, 0.01)),
    ),
    Group(
        "step_contacts",
        "Time step: contacts",
        "Ten spheres pressed together by 1 % of their diameter between two that are held, elastic, 20 000 steps.",
        sweep(lambda changes: pressed_chain(1.0, changes), lambda ran: drift(ran, 0.01)),
    ),
    Group(
        "step_damped",
        "Time step: damped contacts",
        "The same chain with a restitution of 0.5, and of 0.",
        (
            *sweep(lambda changes: pressed_chain(0.5, changes), comes_to_rest, "e = 0.5: "),
            *sweep(lambda changes: pressed_chain(0.0, changes), comes_to_rest, "e = 0: "),
        ),
    ),
)

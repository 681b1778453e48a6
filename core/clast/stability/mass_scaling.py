"""Selective mass scaling: the few particles that hold the time step back are made heavier."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from clast.scene.plan import blueprint
from clast.scene.scene import Scene
from clast.stability.damped_step import sensitivity
from clast.stability.local_bounds import local_bounds
from clast.stability.springs import bodies_at_start, springs_at_start

Floats = NDArray[np.float64]
MOST, OVER = 300, 1.001


def with_heavier_particles(scene: Scene, step: float) -> Scene:
    """Return the scene with masses raised until every particle's own bound allows a step.

    A particle's bound falls with its mass, but those of its neighbours weigh it by its mass too: the masses are
    raised again and again by the ratio that is missing, until none is missing more than 0.1 %. The bounds are safe,
    so the scene's true limit is then at least the step. Weights stay what they were.

    Parameters
    ----------
    scene : Scene
    step : float
        In s.

    Raises
    ------
    ConfigError
        If no such masses are found.
    """
    plan = blueprint(scene)
    factor = plan.damping_factor
    most, per_time = (2.0 * factor(0.0) / step) ** 2, sensitivity(factor) / step
    for _ in range(MOST):
        bounds = local_bounds(springs_at_start(scene, plan), bodies_at_start(scene), per_time)
        missing = np.maximum(bounds / most, 1.0)
        if missing.max(initial=1.0) <= OVER:
            return scene
        scene = replace(scene, mass=scene.mass * missing)
    text = f"no masses were found with which every particle allows {step:.4g} s; take a smaller step"
    raise scene.config.problem(("time", "selective_mass_scaling"), text)


def added_mass(scene: Scene) -> Floats:
    """Return what scaling, of all or of some, has added to the mass of each particle, (n,) in kg."""
    return np.asarray(scene.mass - scene.true_mass)

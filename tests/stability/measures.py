"""What is measured of a scene that ran: momentum, energy, and how they changed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast import Simulation
from tests.stability.entry import Answer, Ran

Floats = NDArray[np.float64]


def kinetic(ran: Ran) -> Floats:
    """Return the kinetic energy at every sample, in J."""
    scene = ran.simulation.scene
    inertia = 0.4 * scene.mass * scene.radius**2
    v, w = ran.particles["velocity"], ran.particles["spin"]
    movable = ~scene.prescribed
    each = 0.5 * scene.mass * (v**2).sum(axis=2) + 0.5 * inertia * (w**2).sum(axis=2)
    return np.asarray(each[:, movable].sum(axis=1))


def energy(ran: Ran) -> Floats:
    """Return kinetic energy and that of bonds and Hertz contacts at every sample, in J."""
    bonds = ran.bonds["energy"].sum(axis=1) if "energy" in ran.bonds else 0.0
    return np.asarray(kinetic(ran) + bonds + hertz_energy(ran))


def hertz_energy(ran: Ran) -> Floats:
    """Return the elastic energy 2/5 · 4/3 E* √R* δ^2.5 of equally stiff pairs at every sample."""
    scene, x = ran.simulation.scene, ran.particles["position"]
    first = scene.config.materials[next(iter(scene.config.materials))]
    E_star = 0.5 * first.young_modulus / (1.0 - first.poisson_ratio**2)
    i, j = np.triu_indices(len(scene.radius), 1)
    r_i, r_j = scene.radius[i], scene.radius[j]
    free = ~(scene.prescribed[i] & scene.prescribed[j])
    overlap = np.maximum(r_i + r_j - np.linalg.norm(x[:, j] - x[:, i], axis=2), 0.0)
    each = 8.0 / 15.0 * E_star * np.sqrt(r_i * r_j / (r_i + r_j)) * overlap**2.5
    return np.asarray(each[:, free].sum(axis=1))


def momentum(ran: Ran) -> Floats:
    """Return the momentum at every sample, (s, 3) in kg m/s."""
    return np.asarray((ran.simulation.scene.mass[:, None] * ran.particles["velocity"]).sum(axis=1))


def angular_momentum(ran: Ran) -> Floats:
    """Return the angular momentum about the origin at every sample, (s, 3) in kg m²/s."""
    scene = ran.simulation.scene
    inertia = 0.4 * scene.mass * scene.radius**2
    orbit = scene.mass[:, None] * np.cross(ran.particles["position"], ran.particles["velocity"])
    return np.asarray((orbit + inertia[:, None] * ran.particles["spin"]).sum(axis=1))


def momentum_error(ran: Ran) -> float:
    """Return the largest change of momentum, as a share of the momentum of all parts at the start."""
    p = momentum(ran)
    speeds = np.linalg.norm(ran.particles["velocity"], axis=2)
    size = float((ran.simulation.scene.mass * speeds).sum(axis=1).max())
    return worst(np.linalg.norm(p - p[0], axis=1)) / size if size else 0.0


def growth(values: Floats) -> float:
    """Return how much larger the mean of the last quarter is than that of the first, as a share; −1 to infinity."""
    quarter = max(1, len(values) // 4)
    first, last = float(values[:quarter].mean()), float(values[-quarter:].mean())
    return last / first - 1.0 if np.isfinite(last) else np.inf


def worst(values: Floats) -> float:
    """Return the largest size of some numbers; infinite if one is none."""
    return float(np.abs(values).max()) if np.isfinite(values).all() else np.inf


def drift(ran: Ran, bound: float) -> Answer:
    """Ask that energy neither grows nor falls, from the first quarter of a run to its last."""
    return Answer("energy stays", abs(growth(energy(ran))), bound)


def rebound(ran: Ran, restitution: float, bound: float) -> Answer:
    """Ask for the restitution of a head-on impact along x, and that momentum stays."""
    v = ran.particles["velocity"][:, :, 0]
    asked = f"restitution {restitution:g}, momentum kept"
    found = (v[-1, 1] - v[-1, 0]) / (v[0, 0] - v[0, 1])
    wrong = abs(found - restitution) if np.isfinite(found) else np.inf
    return Answer(asked, max(wrong, momentum_error(ran)), bound)


def limit(simulation: Simulation) -> float:
    """Return the true limit of the step at the start, in s."""
    return simulation.limits.spectral

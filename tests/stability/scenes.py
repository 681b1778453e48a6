"""Base scenes, and the particles that are put into them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.config.scene import SceneConfig, load

HERE = Path(__file__).parent
Floats = NDArray[np.float64]


def scene(base: str, changes: Mapping[str, Any]) -> SceneConfig:
    """Return a base scene with some values changed."""
    return load(HERE / f"{base}.yaml").changed(changes)


def particle(
    position: Iterable[float],
    radius: float,
    velocity: Iterable[float] = (0.0, 0.0, 0.0),
    spin: Iterable[float] = (0.0, 0.0, 0.0),
    **more: Any,
) -> dict[str, Any]:
    """Return one particle as a scene has it."""
    vectors = {"position": position, "velocity": velocity, "spin": spin}
    return {name: [float(x) for x in vector] for name, vector in vectors.items()} | {"radius": float(radius)} | more


def spheres(particles: Sequence[Mapping[str, Any]], changes: Mapping[str, Any], base: str = "spheres") -> SceneConfig:
    """Return free spheres, all of them tracked; they are of the material ``first`` where they do not say."""
    each = [{"material": "first", **one} for one in particles]
    tracks = list(range(len(each)))
    return scene(base, {"particles.particles": each, "output.tracks.particles": tracks, **changes})


def pair(
    speed: float = 1.0,
    radii: tuple[float, float] = (1e-3, 1e-3),
    gap: float = 1e-2,
    offset: float = 0.0,
    changes: Mapping[str, Any] | None = None,
) -> SceneConfig:
    """Return two spheres that meet head-on along x with equal and opposite speeds.

    Parameters
    ----------
    speed : float
        Of each, in m/s.
    radii : two floats
        In m.
    gap : float
        Between the surfaces, as a share of the smaller radius; negative for an overlap.
    offset : float
        Where they meet: all three coordinates, in m.
    """
    apart = 0.5 * gap * min(radii)
    at = np.full(3, offset)
    ends = ((-1.0, radii[0], "first"), (1.0, radii[1], "second"))
    made = [
        particle(at + np.array([side * (r + apart), 0, 0]), r, [-side * speed, 0, 0], material=name)
        for side, r, name in ends
    ]
    time_until = 2.0 * apart / (2.0 * speed) if speed > 0.0 else 0.0
    lasts = impact_duration(max(2.0 * speed, 1e-12), radii)
    given = {"time.end.time": max(time_until, 0.0) + 3.0 * lasts, "time.step": rule(2.0 * speed)}
    return spheres(made, given | dict(changes or {}))


def rule(impact_speed: float, factor: float = 0.8) -> dict[str, Any]:
    """Return the default rule for impacts of a given speed in m/s."""
    return {"rule": "spectral", "factor": factor, "impact_speed": max(impact_speed, 1e-9)}


def impact_duration(speed: float, radii: Sequence[float], modulus: float = 100e6, density: float = 2500.0) -> float:
    """Return how long Hertz's impact of two equal materials (ν = 0.25) lasts, in s; an infinite radius is a wall."""
    masses = [density * 4.0 / 3.0 * np.pi * r**3 for r in radii]
    m = 1.0 / sum(1.0 / each for each in masses)
    R = 1.0 / sum(1.0 / each for each in radii)
    k = 4.0 / 3.0 * 0.5 * modulus / (1.0 - 0.25**2) * np.sqrt(R)
    return float(2.9432 * (5.0 * m / (4.0 * k)) ** 0.4 * speed**-0.2)


def block(n: int, spacing: float, radius: float = 1e-3) -> tuple[Floats, list[tuple[int, int]]]:
    """Return the centres of n³ spheres on a cubic grid about the origin, and the pairs of next neighbours."""
    grid = np.array(np.meshgrid(*[range(n)] * 3, indexing="ij")).reshape(3, -1).T
    number = {tuple(at): k for k, at in enumerate(grid.tolist())}
    steps = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    found = [
        (k, number[neighbour])
        for at, k in number.items()
        for step in steps
        if (neighbour := (at[0] + step[0], at[1] + step[1], at[2] + step[2])) in number
    ]
    return (grid - 0.5 * (n - 1)) * spacing, found


def bonded(
    particles: Sequence[Mapping[str, Any]],
    bonds: Sequence[tuple[int, int]],
    changes: Mapping[str, Any],
    diameter: float = 1e-3,
) -> SceneConfig:
    """Return bonded spheres, all particles and bonds tracked."""
    joined = [{"between": list(ends), "diameter": diameter} for ends in bonds]
    given = {
        "particles.particles": list(particles),
        "particles.bonds": joined,
        "output.tracks": {"particles": list(range(len(particles))), "bonds": list(range(len(bonds)))},
    }
    return scene("bonded", given | dict(changes))

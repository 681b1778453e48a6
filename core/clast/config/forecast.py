"""Forecast: what a scene will cost, told in milliseconds and without packing."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, isfinite, pi, sqrt

import numpy as np

from clast.config.beside import WallChoice
from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.config.sections import StepRule
from clast.parts.bond_model import BondGeometry

INTERPRETER_BYTES = 150e6
BYTES_PER_BODY = 400.0
BOND_STEPS_PER_SECOND = 10e6
BONDS_PER_PARTICLE = 6.0
"""Taken where a generator cannot tell its bonds beforehand."""


@dataclass(frozen=True)
class Forecast:
    """What a run will cost; None where only packing can tell.

    Attributes
    ----------
    particles : int
    bonds : int or None
    memory : float
        In bytes.
    time_step : float or None
        In s.
    steps : int or None
    seconds : float or None
        Wall-clock time on one core.
    notes : tuple of str
        Where the numbers come from.
    """

    particles: int
    bonds: int | None
    memory: float
    time_step: float | None
    steps: int | None
    seconds: float | None
    notes: tuple[str, ...] = field(default=())

    def text(self) -> str:
        """Forecast as lines to print."""
        rows = [
            ("particles", str(self.particles)),
            ("bonds", "known after packing" if self.bonds is None else f"about {self.bonds}"),
            ("memory", f"about {self.memory / 1e6:.0f} MB"),
            ("time step", _or_unknown(self.time_step, "{:.3g} s")),
            ("steps", _or_unknown(self.steps, "{:,}")),
            ("time", _or_unknown(self.seconds, "about {:.3g} s on one core (an estimate)")),
        ]
        return "\n".join([*(f"{name:10} {value}" for name, value in rows), *self.notes])


def forecast(scene: SceneConfig) -> Forecast:
    """Predict counts, memory, time step, steps and run time of a scene."""
    predictions = [each.part.predict(each.params, scene.folder) for each in scene.generators]
    particles = sum(each.particles for each in predictions)
    bonds = 0 if scene.bonds is None else _sum_or_none([each.bonds for each in predictions])
    assumed = bonds if bonds is not None else int(BONDS_PER_PARTICLE * particles)
    step, notes = _time_step(scene)
    steps = _steps(scene, step)
    return Forecast(
        particles=particles,
        bonds=bonds,
        memory=INTERPRETER_BYTES + BYTES_PER_BODY * (particles + assumed),
        time_step=step,
        steps=steps,
        seconds=None if steps is None else steps * (particles + assumed) / BOND_STEPS_PER_SECOND,
        notes=notes,
    )


def _sum_or_none(counts: list[int | None]) -> int | None:
    known = [count for count in counts if count is not None]
    return sum(known) if len(known) == len(counts) else None


def _time_step(scene: SceneConfig) -> tuple[float | None, tuple[str, ...]]:
    step = scene.time.step
    if not isinstance(step, StepRule):
        return step, ()
    limits = [_pair_limit(scene, each) for each in scene.generators]
    smallest = min(limits, default=inf)
    if not isfinite(smallest) or any(limit == 0.0 for limit in limits):
        note = f"the time step follows from the rule {step.rule!r} after packing: clast check --build"
        return None, (note,)
    note = f"time step from the rule {step.rule!r} for touching primaries; exactly: clast check --build"
    return step.factor * smallest, (note,)


def _pair_limit(scene: SceneConfig, generator: Chosen) -> float:
    """Limit of two touching primaries, Eqs. 14-17 of Rotter et al. (2023); 0 where the size is not known."""
    diameter = getattr(generator.params, "primary_diameter", None)
    material = scene.materials.get(str(getattr(generator.params, "material", "")))
    if not isinstance(diameter, float) or material is None:
        return 0.0
    radius = diameter / 2
    density = material.density * scene.time.mass_scaling
    shear_modulus = material.young_modulus / (2 * (1 + material.poisson_ratio))
    rayleigh = pi * radius * sqrt(density / shear_modulus) / (0.1631 * material.poisson_ratio + 0.8766)
    stiffness = _bond_stiffness(scene, radius)
    mass = density * 4 / 3 * pi * radius**3
    return min(rayleigh, 2 * sqrt(mass / stiffness)) if stiffness > 0 else rayleigh


def _bond_stiffness(scene: SceneConfig, radius: float) -> float:
    """Largest stiffness in N/m of a bond between two touching particles; 0 without bonds."""
    if scene.bonds is None:
        return 0.0
    between = scene.bonds.between
    R = between.diameter / 2 if between is not None and between.diameter is not None else radius
    geometry = BondGeometry(L0=np.array([2 * radius]), R=R, A=pi * R**2, I=pi * R**4 / 4)
    stiffness = scene.bonds.model.part.stiffness(scene.bonds.model.params, geometry)
    return float(max(np.max(stiffness.axial), np.max(stiffness.shear)))


def _steps(scene: SceneConfig, step: float | None) -> int | None:
    end = scene.time.end
    if end.steps is not None:
        return end.steps
    duration = end.time if end.time is not None else _duration(scene)
    return None if duration is None or step is None else round(duration / step)


def _duration(scene: SceneConfig) -> float | None:
    """Time to the strain asked for, as long as the plates keep their first speed."""
    if scene.compression is None or scene.time.end.strain is None:
        return None
    upper, lower = (_velocity(scene.walls[name]) for name in (scene.compression.upper, scene.compression.lower))
    speed = sqrt(sum((a - b) ** 2 for a, b in zip(upper, lower, strict=True)))
    return scene.time.end.strain * scene.compression.height / speed if speed > 0 else None


def _velocity(wall: WallChoice) -> tuple[float, float, float]:
    if wall.motion is None:
        return (0.0, 0.0, 0.0)
    part = wall.motion.part
    x, y, z = part.velocity(part.course(wall.motion.params), 0.0)
    return (x, y, z)


def _or_unknown(value: float | None, pattern: str) -> str:
    return "known after packing" if value is None else pattern.format(value)

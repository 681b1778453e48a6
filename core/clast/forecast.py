"""Forecast: what a scene will cost, told without packing it.

A forecast looks at a sample of the scene: of what is written down everything, of what must be packed two touching
primaries. Materials, contact settings and the rule of the time step are then those of the scene itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from clast.building import generated, join
from clast.config.scene import SceneConfig
from clast.forecast_memory import COMPILER_BYTES, memory_concerns, run_memory, wall_memory
from clast.forecast_results import results_text, size_concerns
from clast.forecast_step import step_notes, sure_factors, time_step, with_stiffest_bond
from clast.parts.generator import Estimate, Gaps, Packing, Prediction
from clast.scene.bodies import odd_bodies
from clast.scene.compression import Gauge
from clast.scene.concerns import concerns_of_parts, rooms_left_open
from clast.scene.foretold import bonded_gaps, foretold
from clast.scene.narrow_plates import narrow_plates
from clast.scene.scatter import refuse_beyond_bounds
from clast.scene.scene import Scene
from clast.scene.start import check_bonds, check_contacts, check_start, check_tracks
from clast.soundness.swift_walls import swift_walls

# seconds a step, measured on one core of an AMD EPYC (family 25, model 1) with grains of 361 to 17 700 primaries:
# 30 ns a bond where everything fits into the cache, 45 ns where not
PARTICLE_SECONDS, BOND_SECONDS, PAIR_SECONDS = 12e-9, 40e-9, 12e-9
# pairs that may touch, beside the bonded ones: half the coordination number of a loose random packing
PAIRS_PER_PARTICLE = 3.0
# taken where nobody can tell
BONDS_PER_PARTICLE = 6.0
STAND_INS = 2
"""Particles that stand for a packing in the sample."""
MANY_STEPS = 1e9
LONG_SECONDS = 2 * 86400.0


@dataclass(frozen=True)
class Forecast:
    """What a run will cost; None where only packing can tell.

    Attributes
    ----------
    particles : int
    bonds : Estimate or None
    memory : float
        Peak in bytes, of a scene whose step loop is compiled already and without what draws afterwards.
    time_step : float
        In s.
    steps : int
    seconds : float
        Wall-clock time of the steps on one core.
    notes : tuple of str
        Where the numbers come from.
    concerns : tuple of str
        What will probably keep the run from ending, and what to do.
    results : str
        How large the results become.
    particles_band : float
        How sure ``particles`` is, as ``Estimate.band``.
    results : str
        How large the results become.
    """

    particles: int
    bonds: Estimate | None
    memory: float
    time_step: float
    steps: int
    seconds: float
    notes: tuple[str, ...] = ()
    concerns: tuple[str, ...] = ()
    particles_band: float = 0.0
    results: str = ""

    def text(self) -> str:
        """Forecast as lines to print."""
        rows = [
            ("particles", estimate_text(Estimate(self.particles, self.particles_band))),
            ("bonds", _bonds_text(self.bonds, self.particles)),
            ("memory", f"about {self.memory / 1e6:,.0f} MB, {COMPILER_BYTES / 1e6:.0f} MB more while compiling"),
            ("time step", f"{self.time_step:.3g} s"),
            ("steps", count_text(self.steps)),
            ("results", self.results),
            ("time", f"about {duration(max(self.seconds, 1.0))} on one core, up to half a minute more with compiling"),
        ]
        lines = [f"{name:10} {value}" for name, value in rows]
        return "\n".join([*lines, "a new kind of scene is compiled when it first runs", *self.notes, *self.concerns])


def forecast(config: SceneConfig) -> Forecast:
    """Predict counts, memory, time step, steps and run time of a scene.

    Raises
    ------
    ConfigError
        What would keep the scene from starting, as far as it shows without packing.
    """
    told = [foretold(config, chosen) for chosen in config.generators]
    packed = [each for each in told if each is not None]
    sample = _sample(config, told)
    (check_contacts if packed else check_start)(sample)
    particles = len(sample.radius) + sum(each.particles - STAND_INS for each in packed)
    band = sum(each.particles * each.particles_band for each in packed) / particles
    bonds = _bonds(sample, told)
    check_bonds(config, math.inf if bonds is None else bonds.value)
    count = BONDS_PER_PARTICLE * particles if bonds is None else bonds.value
    stiffest = sample
    if packed:
        factors = sure_factors(config, bonds)
        refuse_beyond_bounds(config, factors)
        stiffest = with_stiffest_bond(sample, factors)
    step = time_step(stiffest, 2.0 * count / particles if packed else None)
    steps = Gauge(config).last_step(step)
    check_tracks(config, _sure(Estimate(particles, band)), _sure(bonds))
    seconds = run_seconds(config, particles, count, steps)
    walls = wall_memory(config)
    memory = run_memory(particles, count, walls)
    return Forecast(
        particles=particles,
        bonds=bonds,
        memory=memory,
        time_step=step,
        steps=steps,
        seconds=seconds,
        notes=step_notes(config, bool(packed), count > 0.0, scattered=stiffest is not sample),
        concerns=(
            *concerns_of_parts(config, told),
            *rooms_left_open(config, told),
            *narrow_plates(config, 2.0 * float(sample.radius.min())),
            *odd_bodies(sample),
            *swift_walls(config, float(sample.radius.min()), step, steps),
            *time_concerns(config, steps, seconds),
            *memory_concerns(config, memory, walls),
            *size_concerns(config, particles, count),
        ),
        particles_band=band,
        results=results_text(config, particles, count),
    )


def run_seconds(config: SceneConfig, particles: float, bonds: float, steps: int) -> float:
    """Return about how long the steps of a scene take on one core, in s."""
    pairs = PAIRS_PER_PARTICLE * particles if config.contacts is not None else 0.0
    return steps * (PARTICLE_SECONDS * particles + BOND_SECONDS * bonds + PAIR_SECONDS * pairs)


def time_concerns(config: SceneConfig, steps: int, seconds: float) -> list[str]:
    """Return a line for the user where a run is absurdly long."""
    if steps <= MANY_STEPS and seconds <= LONG_SECONDS:
        return []
    return [
        f"{config.document.where(('time',))}: time: {count_text(steps)} steps, about {duration(seconds)} on one core; "
        "take a larger time.step (time.mass_scaling raises its limit), end earlier, or move walls faster"
    ]


def _sample(config: SceneConfig, told: list[Prediction | None]) -> Scene:
    gaps = bonded_gaps(config)
    packings = [
        generated(config, chosen) if prediction is None else _two_neighbours(prediction, gaps)
        for chosen, prediction in zip(config.generators, told, strict=True)
    ]
    return join(config, list(zip(config.generators, packings, strict=True)))


def _two_neighbours(told: Prediction, gaps: Gaps | None) -> Packing:
    """Return two particles that touch, or are as near as the scene bonds them."""
    gap = 0.5 * (gaps.least + gaps.of(2.0 * told.radius).most) if gaps is not None and gaps.least > 0.0 else 0.0
    return Packing(
        position=np.array([[0.0, 0.0, 0.0], [2.0 * told.radius + gap, 0.0, 0.0]]),
        radius=np.full(2, told.radius),
        material=[told.material] * 2,
        velocity=np.zeros((2, 3)),
        spin=np.zeros((2, 3)),
        prescribed=np.zeros(2, np.bool_),
        grain=np.zeros(2, np.int64),
    )


def _sure(estimate: Estimate | None) -> float:
    """Return a count that is known, infinity where it is not."""
    return math.inf if estimate is None or estimate.band > 0.0 else estimate.value


def _bonds(sample: Scene, told: list[Prediction | None]) -> Estimate | None:
    """Return the bonds of what is written, counted, and of what will be packed, estimated."""
    if sample.config.bonds is None:
        return Estimate(0.0)
    first = [origin.first for origin in sample.origins]
    owner = np.searchsorted(first, sample.ends[:, 0], side="right") - 1
    written = np.array([each is None for each in told])
    estimates = [Estimate(float(np.count_nonzero(written[owner])))]
    for each in told:
        if each is not None:
            if each.bonds is None:
                return None
            estimates.append(each.bonds)
    total = sum(each.value for each in estimates)
    return Estimate(total, sum(each.value * each.band for each in estimates) / max(total, 1.0))


def _bonds_text(bonds: Estimate | None, particles: int) -> str:
    if bonds is None:
        return "known after packing: clast check --build"
    each = f", {2 * bonds.value / particles:.1f} a particle" if bonds.band > 0.0 else ""
    return estimate_text(bonds) + each


def estimate_text(estimate: Estimate) -> str:
    """Return a count as sure as it is known.

    >>> estimate_text(Estimate(2481.7, 0.08)), estimate_text(Estimate(361.0))
    ('about 2,480 (±8%)', '361')
    """
    if estimate.band == 0.0:
        return f"{estimate.value:,.0f}"
    digits = -max(int(math.log10(max(estimate.value, 1.0))) - 2, 0)
    return f"about {round(estimate.value, digits):,.0f} (±{estimate.band:.0%})"


def count_text(count: int) -> str:
    """Return a count as a user reads it.

    >>> count_text(113542), count_text(3 * 10**11)
    ('113,542', '3e+11')
    """
    return f"{count:,}" if count < 1e10 else f"{count:.3g}"


def duration(seconds: float) -> str:
    """Return a time span in words.

    >>> duration(5), duration(200), duration(8000), duration(3e6), duration(1e10)
    ('5 s', '3 min 20 s', '2 h 13 min', '35 days', '317 years')
    """
    s = round(seconds)
    if s < 60:
        return f"{s} s"
    if s < 3600:
        return f"{s // 60} min {s % 60} s"
    if s < 2 * 86400:
        return f"{s // 3600} h {s % 3600 // 60} min"
    days = s / 86400
    return f"{days:.0f} days" if days < 1000 else f"{days / 365.25:,.0f} years"

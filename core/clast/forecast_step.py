"""The time step of a forecast: what its rule will take, told from a sample of the scene."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from clast.config.scene import SceneConfig
from clast.config.sections import StepRule
from clast.parts.generator import Estimate
from clast.scene.plan import blueprint, bond_stiffness, damping_coefficients
from clast.scene.scatter import Factors, draw_factors, scatter_entries
from clast.scene.scene import Scene
from clast.stability.damped_step import stable_step
from clast.stability.time_step import (
    asked_step,
    bond_limit,
    contact_limit,
    drag_limit,
    local_limit,
    pair_limit,
    rayleigh_limit,
)

MOST_DRAWN = 100_000
"""Bonds among which the stiffest is looked for."""


def sure_factors(config: SceneConfig, bonds: Estimate | None) -> Factors:
    """Return the factors of the bonds that will surely be there: they depend on nothing but the bonds' numbers."""
    count = MOST_DRAWN if bonds is None else min(MOST_DRAWN, math.floor(bonds.value * (1.0 - bonds.band)))
    return draw_factors(scatter_entries(config), count)


def with_stiffest_bond(sample: Scene, factors: Factors) -> Scene:
    """Return the sample as stiff as the stiffest bond with these factors; as it is where all are alike."""
    count = len(factors[0]) if factors else 0
    if len(sample.ends) == 0 or count == 0:
        return sample
    first = np.zeros(count, np.int64)
    sizes = {name: getattr(sample, name)[first] for name in ("ends", "diameter", "length")}
    stiffness = bond_stiffness(replace(sample, factors=factors, **sizes))
    largest = np.broadcast_to(np.maximum(stiffness.axial, stiffness.shear), count)
    if largest.max() == largest.min():
        return sample
    bond = int(np.argmax(largest))
    return replace(sample, factors=tuple(np.full(len(sample.ends), each[bond]) for each in factors))


def time_step(sample: Scene, coordination: float | None) -> float:
    """Return the step a scene asks for; ``coordination`` is that of its bonds where they are not all in the sample.

    Raises
    ------
    ConfigError
        Two neighbours alone are unstable with it, and so is every scene they are in.
    """
    config, contact = sample.config, contact_limit(sample)
    drag = drag_limit(sample)
    spectral = local_limit(sample) if coordination is None else min(packed_limit(sample, coordination), drag)
    if config.time.selective_mass_scaling is not None:
        spectral = max(spectral, config.time.selective_mass_scaling)
    step = asked_step(config, min(rayleigh_limit(sample), bond_limit(sample)), spectral, contact)
    pair = pair_limit(sample) if config.time.selective_mass_scaling is None else math.inf
    most = min(pair, 10.0 * contact, drag)
    if step > most and not config.time.allow_unstable:
        what = "a particle in its body_forces alone is" if most == drag else "two neighbours alone are"
        raise config.problem(
            ("time", "step"),
            f"{step:.4g} s is above {most:.4g} s, with which {what} unstable; take a smaller step, raise "
            "time.mass_scaling, or set time.allow_unstable",
        )
    return step


def packed_limit(sample: Scene, coordination: float) -> float:
    """Return about the stable step of a random packing in s, from two of its primaries and its bonds per primary.

    Bonds in all directions hold a primary against moving with Z/3 (k_n + 2 k_t)/m, against turning with
    Z (2/3 k_t L²/4 + (k_tor + 2 k_b)/3)/I; in the fastest mode its neighbours do the opposite, which doubles it. Of 14
    packings (porosity 0.45 to 0.75, 4 to 30 bonds a primary) 13 gave 0.93 to 1.12 of the exact limit of their bonds,
    one in which only gaps were bonded 1.31. Dashpots hold as springs do: see :mod:`clast.stability.damped_step`.
    """
    if len(sample.ends) == 0:
        return math.inf
    mass, inertia = sample.mass.min(), (0.4 * sample.mass * sample.radius**2).min()
    springs, dashpots = np.column_stack(bond_stiffness(sample)), damping_coefficients(sample)
    lever = 0.5 * sample.length

    def eigenvalue(per_time: float) -> float:
        axial, shear, torsion, bending = (springs + per_time * dashpots).T
        moving = coordination / 3.0 * (axial + 2.0 * shear) / mass
        turning = coordination / 3.0 * (2.0 * shear * lever**2 + torsion + 2.0 * bending) / inertia
        return 2.0 * max(float(np.max(moving)), float(np.max(turning)))

    return stable_step(eigenvalue, blueprint(sample).damping_factor)


def step_notes(config: SceneConfig, packed: bool, bonded: bool, scattered: bool) -> tuple[str, ...]:
    """Return how sure the time step of a rule is."""
    rule = config.time.step
    if not isinstance(rule, StepRule) or not (packed or (bonded and rule.rule == "spectral")):
        return ()
    if scattered:
        return ("time step as if all bonds were as stiff as the stiffest; exactly: clast check --build",)
    if rule.rule == "paper":
        return ("time step from the rule for touching primaries; exactly: clast check --build",)
    if packed:
        return ("time step within about 15 %, from the bonds a primary has; exactly: clast check --build",)
    return ("time step from bounds of single particles, at most a third too small; exactly: clast check --build",)

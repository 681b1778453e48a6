"""Time step: how large a step bonds, contacts and walls of a scene allow, and which one its rule takes.

The true limit of a scene is ``limits(scene, blueprint(scene)).spectral``, with ``scene`` from
:func:`clast.scene.scene.build_scene` and ``blueprint`` from :mod:`clast.scene.plan`; that of a scene as it runs is
``Simulation.stable_step()``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from clast.config.scene import SceneConfig
from clast.config.sections import IMPACT_SPEED, StepRule
from clast.engine.blueprint import Blueprint
from clast.engine.records import build, width
from clast.maths.vec3 import ZERO
from clast.parts.contact_law import Touch
from clast.scene.plan import blueprint, bond_stiffness, damping_coefficients, giving_way, material_pairs, share_of_walls
from clast.scene.scene import Scene
from clast.stability.impact import impact_duration

if TYPE_CHECKING:
    from clast.stability.springs import Bodies, Springs


class Limits(NamedTuple):
    """Limits of the time step in s at the start of a scene; infinite where they do not apply.

    Attributes
    ----------
    rayleigh : float
        Time of a Rayleigh wave over the smallest particle, Eq. 15.
    bond : float
        2 √(m_min/K_max) of the stiffest bond, Eqs. 16–17.
    network : float
        2/ω_max of the bonds alone, without damping.
    local : float
        A bound for every particle by itself; never above ``spectral``.
    spectral : float
        The true limit of bonds, contacts and walls as they stand, with their damping and the scene's integrator.
    contact : float
        A twentieth of the duration of the shortest impact: what accuracy asks for.
    """

    rayleigh: float
    bond: float
    network: float
    local: float
    spectral: float
    contact: float

    @property
    def paper(self) -> float:
        """The smaller of the paper's two limits."""
        return min(self.rayleigh, self.bond)

    @property
    def stable(self) -> float:
        """The step beyond which the scene is unstable, or an impact is over within two steps."""
        return min(self.spectral, 10.0 * self.contact)


def limits(scene: Scene, plan: Blueprint) -> Limits:
    """Return all limits of a scene at its start."""
    from clast.stability.damped_step import stable_step
    from clast.stability.springs import bodies_at_start, bond_springs, springs_at_start
    from clast.stability.vibration import largest_eigenvalue

    bodies, springs = bodies_at_start(scene), springs_at_start(scene, plan)
    bonds = bond_springs(scene, bodies, np.ones(len(scene.ends), bool))
    factor = plan.damping_factor
    return Limits(
        rayleigh=rayleigh_limit(scene),
        bond=bond_limit(scene),
        network=stable_step(lambda per_time: largest_eigenvalue(bonds, bodies), lambda zeta: 1.0),
        local=_local(springs, bodies, factor),
        spectral=stable_step(lambda per_time: largest_eigenvalue(springs, bodies, per_time), factor),
        contact=contact_limit(scene),
    )


def local_limit(scene: Scene) -> float:
    """Return a bound that is never above the true limit of what holds at the start, for one particle at a time."""
    from clast.stability.springs import bodies_at_start, springs_at_start

    plan = blueprint(scene)
    return _local(springs_at_start(scene, plan), bodies_at_start(scene), plan.damping_factor)


def drag_limit(scene: Scene) -> float:
    """Return the largest step in s that is stable with the dashpots of body forces alone; infinite without any."""
    from clast.stability.springs import bodies_at_start, drag_springs

    bodies = bodies_at_start(scene)
    return _local(drag_springs(scene, bodies, scene.velocity), bodies, blueprint(scene).damping_factor)


def _local(springs: Springs, bodies: Bodies, factor: Callable[[float], float]) -> float:
    from clast.stability.damped_step import stable_step
    from clast.stability.local_bounds import local_bounds

    return stable_step(lambda per_time: float(local_bounds(springs, bodies, per_time).max()), factor)


def rayleigh_limit(scene: Scene) -> float:
    """Return the smallest π r √(ρ/G)/(0.1631 ν + 0.8766), with scaled density; Eq. 15."""
    materials = list(scene.config.materials.values())
    found = np.inf
    for k in np.unique(scene.material):
        each = materials[k]
        G = each.young_modulus / (2.0 * (1.0 + each.poisson_ratio))
        slowness = np.sqrt(each.density * scene.config.time.mass_scaling / G)
        radius = scene.radius[scene.material == k].min()
        found = min(found, np.pi * radius * slowness / (0.1631 * each.poisson_ratio + 0.8766))
    return float(found)


def bond_limit(scene: Scene) -> float:
    """Return 2 √(m_min/K_max); Eqs. 16–17."""
    if len(scene.ends) == 0:
        return np.inf
    k = bond_stiffness(scene)
    return float(2.0 * np.sqrt(scene.mass.min() / max(k.axial.max(), k.shear.max())))


def contact_limit(scene: Scene) -> float:
    """Return a twentieth of the shortest impact: of the smallest particles of two materials, or of one and a wall.

    The closing speed is the rule's ``impact_speed``. An impact of all particles at once on a wall that gives way is
    shorter, as the stable step is: of that it is a fifth.
    """
    plan = blueprint(scene)
    if plan.contacts is None or scene.config.contacts is None:
        return np.inf
    law, chosen, choices = plan.contacts.law, scene.config.contacts.law, plan.contacts.choices
    rule = scene.config.time.step
    speed = rule.impact_speed if isinstance(rule, StepRule) else IMPACT_SPEED
    history = None if law.History is None else build(law.History, [0.0] * width(law.History))
    names, walls = list(scene.config.materials), scene.config.walls.values()
    at_once = 4.0 * share_of_walls(scene)
    shortest = np.inf
    for i, j, pair in material_pairs(scene):
        constants = law.constants(chosen.params, pair)
        partners = [(*smallest(scene, j), 1.0)] if j in scene.material and len(scene.radius) > 1 else []
        for wall in (each for each in walls if each.material == names[j]):
            partners += [(np.inf, giving_way(wall), 1.0), (np.inf, 0.0, at_once)]
        r, per_mass = smallest(scene, i)
        for r_j, per_mass_j, share in partners:
            radius, mass = 1.0 / (1.0 / r + 1.0 / r_j), 1.0 / (per_mass + per_mass_j)
            behind = r_j if r_j < np.inf else 0.0
            touch = Touch(0.0, (0.0, 0.0, 1.0), ZERO, ZERO, ZERO, radius, r, behind, 1.0 / mass, 1.0)

            def energy(overlap: float, touch: Touch = touch, constants: object = constants) -> float:
                return float(law.energy(touch._replace(overlap=overlap), constants, history, choices))

            shortest = min(shortest, share * impact_duration(energy, mass, speed, radius))
    return 0.05 * float(shortest)


def smallest(scene: Scene, material: int) -> tuple[float, float]:
    """Return radius and inverse mass of the lightest particle of a material, in m and 1/kg."""
    mine = np.nonzero(scene.material == material)[0]
    k = mine[np.argmin(scene.mass[mine])]
    return float(scene.radius[k]), 1.0 / float(scene.mass[k])


def pair_limit(scene: Scene) -> float:
    """Return the stable step of the stretching of a bond whose ends are free otherwise: the scene's is never above.

    Without dashpots the smallest 2/√(K (1/m_i + 1/m_j)). The other bonds only add energy to the stretching of this one,
    so ω_max of the scene is at least as large.
    """
    from clast.stability.damped_step import stable_step

    if len(scene.ends) == 0:
        return np.inf
    inverse_mass = np.where(scene.prescribed, 0.0, 1.0 / scene.mass)[scene.ends].sum(axis=1)
    k, c = bond_stiffness(scene).axial, damping_coefficients(scene)[:, 0]
    factor = blueprint(scene).damping_factor
    return stable_step(lambda per_time: float(np.max((k + per_time * c) * inverse_mass)), factor)


def choose_step(scene: Scene, found: Limits) -> float:
    """Return the time step a config asks for.

    Raises
    ------
    ConfigError
        If it is above the limit, or no rule gives a finite one.
    """
    step = asked_step(scene.config, found.paper, found.spectral, found.contact)
    if step > found.stable and not scene.config.time.allow_unstable:
        dragged = any(chosen.part.damping is not None for chosen in scene.config.body_forces)
        held = "bonds, contacts and body forces" if dragged else "bonds and contacts"
        cause = held if found.spectral == found.stable else "impacts"
        raise scene.config.problem(
            ("time", "step"),
            f"{step:.4g} s is above the stability limit of the {cause}, {found.stable:.4g} s; take a smaller step, "
            "raise time.mass_scaling, or set time.allow_unstable",
        )
    return step


def asked_step(config: SceneConfig, paper: float, spectral: float, contact: float) -> float:
    """Return the fixed step of a config, or what its rule makes of the limits, in s.

    Raises
    ------
    ConfigError
        If no rule gives a finite one.
    """
    rule = config.time.step
    if isinstance(rule, float):
        return rule
    step = rule.factor * paper if rule.rule == "paper" else min(rule.factor * spectral, contact)
    if not np.isfinite(step):
        text = "no limit applies to this scene, so the rule gives no step; write one, for instance 'step: 1e-6 s'"
        raise config.problem(("time", "step"), text)
    return float(step)


def ruling(config: SceneConfig, found: Limits) -> str | None:
    """Return the name of the limit that a rule takes its step from; None where the step is fixed."""
    rule = config.time.step
    if isinstance(rule, float):
        return None
    if rule.rule == "paper":
        return "bond" if found.bond < found.rayleigh else "rayleigh"
    return "contact" if found.contact < rule.factor * found.spectral else "spectral"

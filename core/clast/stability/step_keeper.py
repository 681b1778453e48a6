"""Keeps the time step below what a scene allows as it runs: contacts stiffen while it is pressed together."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.config.sections import StepRule
from clast.engine.blueprint import Blueprint
from clast.engine.kernels.layout import FIRST, INVERSE_INERTIA, INVERSE_MASS, RADIUS, V, X
from clast.engine.state import World
from clast.engine.tables import box_now, intact
from clast.engine.wall_frames import now
from clast.errors import RunError
from clast.scene.scene import Scene
from clast.stability.damped_step import sensitivity, stable_step
from clast.stability.local_bounds import rough_bound
from clast.stability.springs import (
    Bodies,
    Springs,
    bond_springs,
    contact_responses,
    contact_springs,
    counts_as_held,
    drag_springs,
    joined,
    wall_springs,
)
from clast.stability.vibration import largest_eigenvalue

EVERY, PARTICLE_STEPS = 4000, 40_000
"""Steps between two looks: a look costs about 20 steps of a grain of a few hundred particles, and more of fewer."""
SOON = 64
SMALLEST = 1e-3


class Present(NamedTuple):
    """Particles and springs as they stand."""

    bodies: Bodies
    bonds: Springs
    contacts: Springs


class StepKeeper:
    """Looks at the contacts at fixed steps, and estimates the limit anew when they have stiffened.

    Breaking bonds only raise the limit, and no law makes a bond stiffer than it was; so bonds alone need no look.
    Contacts are summed up to a bound; while that is within ``allowance``, the step is safe and nothing is estimated.
    With ``time.allow_unstable`` a step above the limit is only noted.

    Attributes
    ----------
    allowance : float
        Bound of the contacts in rad²/s² up to which the last estimate serves; −1 before the first.
    estimates : int
        How often the limit was estimated while running.
    above : float
        Largest step found so far as a share of the limit that held then; below 1 without ``time.allow_unstable``.
    """

    def __init__(self, scene: Scene, plan: Blueprint) -> None:
        self.scene, self.plan = scene, plan
        self.factor = plan.damping_factor
        self.sensitivity = sensitivity(self.factor)
        self.responses = contact_responses(scene, plan)
        self.bonded_pairs_touch = plan.contacts is not None and plan.contacts.bonded_pairs
        rule = scene.config.time.step
        self.rule = rule if isinstance(rule, StepRule) and rule.rule == "spectral" else None
        self.tolerated = 0.5 * (1.0 + min(self.rule.factor, 1.0)) if self.rule else 1.0
        self.every = max(EVERY, PARTICLE_STEPS // len(scene.radius))
        self.freed = scene.prescribed & ~counts_as_held(scene)
        self.unstable = scene.config.time.allow_unstable
        self.allowance = -1.0
        self.estimates = 0
        self.above = 0.0

    @property
    def warning(self) -> str | None:
        """The sentence that says that a step was too large, None where none was."""
        if self.above <= 1.0:
            return None
        return f"do not trust these results: the step was up to {self.above:.4g} times the largest stable one"

    def next_look(self, step: int) -> int | None:
        """Return the next step at which to look; None in scenes whose limit cannot fall."""
        if self.plan.contacts is None and not any(force.damping for force in self.plan.body_forces):
            return None
        if step < self.every:  # first contacts stiffen fast: look after 64, 128, 256, … steps
            return min(self.every, max(SOON, 1 << int(step).bit_length()))
        return (step // self.every + 1) * self.every

    def look(self, world: World, dt: float, first_dt: float) -> float:
        """Return the step to go on with in s: the present one while it is safe.

        Raises
        ------
        RunError
            If a step that the user fixed is above the limit, or the limit is a thousandth of what it was.
        """
        bodies, contacts = self.bodies(world), self.contacts(world)
        bound = rough_bound(contacts, bodies, self.sensitivity / dt)
        if bound <= self.allowance:
            return dt
        self.estimates += 1
        present = Present(bodies, self.bonds(world), contacts)
        if self.unstable:
            self.above = max(self.above, dt / self.limit(present))
            self.allowance = bound  # no worse until contacts have stiffened further
            return dt
        fastest = self._fastest(present, dt)
        if fastest > self._most(dt):
            dt = self._smaller(dt, self.limit(present), first_dt)
            bound, fastest = rough_bound(contacts, bodies, self.sensitivity / dt), self._fastest(present, dt)
        # contacts that grow by one ratio raise the eigenvalue by no more; and it is below the sum of both parts', of
        # which bonds have no more than everything has now
        ratio = self._most(dt) / fastest if fastest > 0.0 else 0.0
        self.allowance = max(self._most(dt) - fastest, ratio * bound)
        return dt

    def _most(self, dt: float) -> float:
        """Return the largest eigenvalue in rad²/s² that is tolerated with a step."""
        return (2.0 * self.tolerated * self.factor(0.0) / dt) ** 2

    def _fastest(self, present: Present, dt: float) -> float:
        """Return the largest eigenvalue of everything in rad²/s², with dashpots as they count with a step."""
        springs = joined(present.bonds, present.contacts)
        return largest_eigenvalue(springs, present.bodies, self.sensitivity / dt)

    def limit(self, present: Present) -> float:
        """Return the largest stable step of everything that holds and touches, in s."""
        springs = joined(present.bonds, present.contacts)
        return stable_step(lambda per_time: largest_eigenvalue(springs, present.bodies, per_time), self.factor)

    def present(self, world: World) -> Present:
        """Return the particles and springs of a world as they stand."""
        return Present(self.bodies(world), self.bonds(world), self.contacts(world))

    def bodies(self, world: World) -> Bodies:
        """Return where the particles of a world are, and how heavy."""
        pose, body = world.particles.pose, world.particles.body
        radius, per_mass, per_inertia = (
            column.copy() for column in (pose[:, RADIUS], body[:, INVERSE_MASS], body[:, INVERSE_INERTIA])
        )
        freed = self.freed & (world.particles.present != 0)
        per_mass[freed] = 1.0 / self.scene.mass[freed]
        per_inertia[freed] = 2.5 * per_mass[freed] / radius[freed] ** 2
        position = np.ascontiguousarray(pose[:, X : X + 3])
        return Bodies(position, radius, per_mass, per_inertia, box_now(self.scene.box, world.particles))

    def bonds(self, world: World) -> Springs:
        """Return the springs of the bonds that hold."""
        return bond_springs(self.scene, self.bodies(world), intact(world.bonds))

    def contacts(self, world: World) -> Springs:
        """Return the springs of everything that touches, and the dashpots of body forces."""
        bodies, pairs, near = self.bodies(world), world.pairs, world.wall_pairs
        once = (pairs.sides & FIRST) > 0
        candidates = np.column_stack([pairs.first[once], pairs.second[once]]).astype(np.int64)
        near_walls = np.column_stack([near.wall, near.particle]).astype(np.int64)[near.slot == 0]
        holds = intact(world.bonds) if not self.bonded_pairs_touch else np.zeros(len(self.scene.ends), bool)
        return joined(
            contact_springs(self.scene, self.responses, bodies, candidates, pairs.rest[once], holds),
            wall_springs(self.scene, self.responses, bodies, near_walls, now(world.walls)),
            drag_springs(self.scene, bodies, world.particles.twist[:, V : V + 3]),
        )

    def _smaller(self, dt: float, limit: float, first_dt: float) -> float:
        place = self.scene.config.document.where(("time", "step"))
        if self.rule is None:
            raise RunError(
                f"{place}: time.step: the step of {dt:.4g} s is above what the scene allows by now, {limit:.4g} s: "
                "contacts have become stiffer. Take a smaller step or the rule 'spectral', which follows the limit, "
                "raise time.mass_scaling, or set time.allow_unstable"
            )
        smaller = self.rule.factor * limit
        if smaller < SMALLEST * first_dt:
            raise RunError(
                f"{place}: time.step: the stable step fell from {first_dt:.4g} s to {limit:.4g} s: particles are "
                "pressed far into each other or into a wall. Look at the last frames; end earlier or move walls slower"
            )
        return smaller

"""Contact laws: force over overlap while two spheres collide, and over sideways displacement while they are pressed."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clast.maths.vec3 import ZERO, Vec, dot
from clast.parts.contact_law import ContactLaw, MaterialPair, Touch
from clast.parts.params import Params
from clast.testing.contacts import contact

Floats = NDArray[np.float64]
GLASS = MaterialPair(70e9, 0.22, 70e9, 0.22, restitution=0.7, sliding_friction=0.3, rolling_friction=0.01)
R, DENSITY, SPEED = 1e-3, 2500.0, 0.1
MASS = 4.0 / 3.0 * math.pi * R**3 * DENSITY
TOUCH = Touch(
    overlap=0.0,
    normal=(0.0, 0.0, 1.0),
    velocity=ZERO,
    spin_i=ZERO,
    spin_j=ZERO,
    radius=0.5 * R,
    radius_i=R,
    radius_j=R,
    inverse_mass=2.0 / MASS,
    inverse_inertia=5.0 / (MASS * R**2),
)
STEPS_PER_RADIAN, MOST_STEPS = 100, 50_000


class Impact(NamedTuple):
    """Overlap in m, repulsion in N and velocity of approach in m/s from touch to parting."""

    overlap: Floats
    force: Floats
    approach: Floats


class Law:
    """A contact law between two glass spheres, with everything that materials can ask for."""

    def __init__(self, law: ContactLaw, params: Params, pair: MaterialPair = GLASS) -> None:
        self.contact = contact(law, params, pair=pair)
        self.history = self.contact.fresh

    def force(self, overlap: float, velocity: Vec, dt: float) -> Vec:
        """Return the force on j in N after a step in which the bodies moved on by ``velocity * dt``."""
        moved = (velocity[0] * dt, velocity[1] * dt, velocity[2] * dt)
        touch = TOUCH._replace(overlap=overlap, velocity=velocity, moved=moved)
        load, self.history = self.contact.answer(touch, self.history, dt)
        force: Vec = load.force
        return force

    def step(self, overlap: float) -> float:
        """Return a time in which the contact hardly changes in s."""
        law, constants, _ = self.contact
        stiffness = max(float(law.stiffness(constants, TOUCH.radius, max(overlap, 1e-6 * R))), 1e-30)
        return min(1.0 / math.sqrt(stiffness * TOUCH.inverse_mass), 1e-3 * R / SPEED) / STEPS_PER_RADIAN


def draw(law: ContactLaw, params: Params, figure: Figure) -> str:
    """Draw an impact and a sideways cycle."""
    left, right = figure.subplots(1, 2)
    struck = impact(Law(law, params))
    left.plot(1e6 * struck.overlap, struck.force)
    left.set(xlabel="overlap [µm]", ylabel="repulsion [N]")
    overlap = 0.5 * float(struck.overlap.max())
    way, force = sideways(Law(law, params), overlap)
    right.plot(1e6 * way, force)
    right.set(xlabel="sideways displacement [µm]", ylabel="resistance [N]")
    left.axhline(0.0, color="grey", linewidth=0.5)
    return (
        f"Two glass spheres of {2e3 * R:g} mm, coefficient of restitution {GLASS.restitution:g}, friction "
        f"{GLASS.sliding_friction:g}: head-on with {SPEED:g} m/s (left; leaving with {-struck.approach[-1]:.3g} m/s); "
        f"pushed to and fro across at an overlap of {1e6 * overlap:.2g} µm (right)."
    )


def impact(law: Law) -> Impact:
    """Let two spheres meet with ``SPEED``; velocities by steps of second order."""
    rows = [(0.0, 0.0, SPEED)]
    overlap, approach = 0.0, SPEED
    for _ in range(MOST_STEPS):
        dt = law.step(overlap)
        middle = overlap + 0.5 * dt * approach
        if middle <= 0.0:
            break
        force = dot(law.force(middle, (0.0, 0.0, -approach), dt), TOUCH.normal)
        before, approach = approach, approach - dt * force * TOUCH.inverse_mass
        overlap += 0.5 * dt * (before + approach)
        rows.append((middle, force, approach))
    return Impact(*np.array(rows).T)


def sideways(law: Law, overlap: float) -> tuple[Floats, Floats]:
    """Push j across at one overlap, forth, back and forth again; return displacements in m and what resists in N."""
    reach = 3.0 * overlap
    way = np.concatenate([np.linspace(0, reach), np.linspace(reach, -reach, 100), np.linspace(-reach, reach, 100)])
    slow = 1.0
    resisting = [-law.force(overlap, (step / slow, 0.0, 0.0), slow)[0] for step in np.diff(way, prepend=0.0)]
    return way, np.array(resisting)

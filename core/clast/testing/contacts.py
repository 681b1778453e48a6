"""One contact on its own: touches that can be drawn, their mirror images and rotations."""

from __future__ import annotations

from typing import Any, NamedTuple

from hypothesis import strategies as st

from clast.engine.records import build, width
from clast.maths.rotation import Quat
from clast.maths.vec3 import ZERO, dot, scale, sub
from clast.parts.contact_law import ContactLaw, ContactLoad, Features, MaterialPair, Touch
from clast.testing.draws import directions, negated, numbers, rotate, vectors

GLASS = MaterialPair(420e6, 0.2, 210e9, 0.3, restitution=0.5, sliding_friction=0.3, rolling_friction=0.05)
EVERYTHING = Features(damping=True, sliding=True, rolling=True)
NOTHING = Features(damping=False, sliding=False, rolling=False)
RADIUS, MASS = 0.125e-3, 8e-9
DT = 1e-7


class Contact(NamedTuple):
    """A law with parameters, the numbers of one pair of materials, and what the scene needs of it."""

    law: ContactLaw
    constants: Any
    choices: Any

    @property
    def fresh(self) -> Any:
        """What a contact remembers when it begins."""
        return None if self.law.History is None else build(self.law.History, [0.0] * width(self.law.History))

    def answer(self, touch: Touch, history: Any, dt: float = DT) -> tuple[ContactLoad, Any]:
        """Return the load and what is remembered."""
        load, after = self.law.load(touch, self.constants, history, dt, self.choices)
        return load, after

    def energy(self, touch: Touch, history: Any) -> float:
        """Return the elastic energy in J."""
        return float(self.law.energy(touch, self.constants, history, self.choices))


def contact(law: ContactLaw, params: Any, features: Features = EVERYTHING, pair: MaterialPair = GLASS) -> Contact:
    """Return one contact of a law."""
    return Contact(law, law.constants(params, pair), law.choices(params, features))


def resting(overlap: float) -> Touch:
    """Return two equal spheres that overlap by a length in m and do not move."""
    return Touch(
        overlap, (0.0, 0.0, 1.0), ZERO, ZERO, ZERO, 0.5 * RADIUS, RADIUS, RADIUS, 2.0 / MASS, 5.0 / (MASS * RADIUS**2)
    )


def overlaps() -> st.SearchStrategy[float]:
    """Draw overlaps in m, up to a twentieth of a radius."""
    return numbers(1e-6 * RADIUS, 0.05 * RADIUS)


def touches() -> st.SearchStrategy[Touch]:
    """Draw contacts of spheres of about 0.1 mm, or of one with a wall, that touch, slide, roll and spin."""

    def make(overlap: float, n: Any, velocity: Any, spins: Any, radii: Any, masses: Any) -> Touch:
        (radius_i, radius_j), (mass_i, mass_j) = radii, masses
        share = 1.0 / radius_j if radius_j else 0.0
        heavy = 1.0 / mass_j if radius_j else 0.0
        return Touch(
            overlap=overlap * radius_i,
            normal=n,
            velocity=velocity,
            spin_i=spins[0],
            spin_j=spins[1] if radius_j else ZERO,
            radius=1.0 / (1.0 / radius_i + share),
            radius_i=radius_i,
            radius_j=radius_j,
            inverse_mass=1.0 / mass_i + heavy,
            inverse_inertia=2.5 / (mass_i * radius_i**2) + (2.5 * heavy * share**2),
            moved=scale(DT, velocity),
        )

    radius, mass = numbers(1e-5, 1e-3), numbers(1e-12, 1e-6)
    return st.builds(
        make,
        numbers(1e-6, 0.05),
        directions(),
        vectors(2.0),
        st.tuples(vectors(500.0), vectors(500.0)),
        st.tuples(radius, st.one_of(st.just(0.0), radius)),
        st.tuples(mass, mass),
    )


def mirrored(touch: Touch) -> Touch:
    """Return the same contact with the names of the bodies swapped."""
    return touch._replace(
        normal=negated(touch.normal),
        velocity=negated(touch.velocity),
        moved=negated(touch.moved),
        spin_i=touch.spin_j,
        spin_j=touch.spin_i,
        radius_i=touch.radius_j,
        radius_j=touch.radius_i,
    )


def turned(touch: Touch, q: Quat) -> Touch:
    """Return the same contact in a rotated world."""
    return touch._replace(
        normal=rotate(q, touch.normal),
        velocity=rotate(q, touch.velocity),
        moved=rotate(q, touch.moved),
        spin_i=rotate(q, touch.spin_i),
        spin_j=rotate(q, touch.spin_j),
    )


def repulsion(load: ContactLoad, touch: Touch) -> float:
    """Return the force that pushes the bodies apart in N."""
    return dot(load.force, touch.normal)


def across(a: Any, n: Any) -> Any:
    """Return the part of a vector across a unit vector."""
    return sub(a, scale(dot(a, n), n))

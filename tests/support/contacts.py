"""One contact on its own: touches, their mirror images and rotations, and the options of Hertz–Mindlin."""

from __future__ import annotations

from typing import Any, NamedTuple

from hypothesis import strategies as st

from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec, dot, scale, sub
from clast.parts.contact_law import ContactLoad, Features, MaterialPair, Touch
from clast_plugins.contact_laws.hertz_mindlin import HertzMindlin, History, choices, constants, load
from tests.support.strategies import directions, negated, numbers, rotate, vectors

GLASS = MaterialPair(420e6, 0.2, 210e9, 0.3, restitution=0.5, sliding_friction=0.3, rolling_friction=0.05)
EVERYTHING = Features(damping=True, sliding=True, rolling=True)
LIMITS = ("elastic", "total", "musen")
REST: Vec = (0.0, 0.0, 0.0)
DT = 1e-7


class Contact(NamedTuple):
    """A contact law with the numbers of one pair of materials and the choices of a scene."""

    constants: Any
    choices: Any

    def load(self, touch: Touch, xi: Vec = REST, dt: float = DT) -> tuple[ContactLoad, Vec]:
        """Return the load and the new tangential displacement."""
        told, history = load(touch, self.constants, History(xi), dt, self.choices)
        return told, history.xi


def contact(pair: MaterialPair = GLASS, features: Features = EVERYTHING, **options: Any) -> Contact:
    params = HertzMindlin(**options)
    return Contact(constants(params, pair), choices(params, features))


def touches() -> st.SearchStrategy[Touch]:
    """Draw contacts of spheres of about 0.1 mm, or of one with a wall, that touch, slide, roll and spin."""
    radii = numbers(1e-5, 1e-3)

    def make(overlap, normal, velocity, spin_i, spin_j, radius_i, radius_j, masses):
        mass_i, mass_j = masses
        other = 1.0 / radius_j if radius_j else 0.0
        heavy = 1.0 / mass_j if radius_j else 0.0
        inertia_j = 2.5 / (mass_j * radius_j**2) if radius_j else 0.0
        return Touch(
            overlap=overlap * radius_i,
            normal=normal,
            velocity=velocity,
            spin_i=spin_i,
            spin_j=spin_j if radius_j else REST,
            radius=1.0 / (1.0 / radius_i + other),
            radius_i=radius_i,
            radius_j=radius_j,
            inverse_mass=1.0 / mass_i + heavy,
            inverse_inertia=2.5 / (mass_i * radius_i**2) + inertia_j,
            moved=scale(DT, velocity),
        )

    return st.builds(
        make,
        overlap=numbers(1e-6, 0.05),
        normal=directions(),
        velocity=vectors(2.0),
        spin_i=vectors(500.0),
        spin_j=vectors(500.0),
        radius_i=radii,
        radius_j=st.one_of(st.just(0.0), radii),
        masses=st.tuples(numbers(1e-12, 1e-6), numbers(1e-12, 1e-6)),
    )


@st.composite
def sliding_contacts(draw) -> tuple[Touch, Vec]:
    """Draw a touch and a tangential displacement it has come to."""
    touch = draw(touches())
    return touch, across(draw(vectors(0.02 * touch.radius)), touch.normal)


def across(a: Vec, n: Vec) -> Vec:
    return sub(a, scale(dot(a, n), n))


def tangential(told: ContactLoad, touch: Touch) -> Vec:
    return across(told.force, touch.normal)


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
    names = ("normal", "velocity", "moved", "spin_i", "spin_j")
    return touch._replace(**{name: rotate(q, getattr(touch, name)) for name in names})

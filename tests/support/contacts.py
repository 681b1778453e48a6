"""One contact on its own: touches, their mirror images and rotations, and the options of Hertz–Mindlin."""

from __future__ import annotations

from typing import Any, NamedTuple

from hypothesis import strategies as st

from clast.maths.vec3 import Vec
from clast.parts.contact_law import ContactLoad, Features, MaterialPair, Touch
from clast.testing.contacts import DT, EVERYTHING, GLASS, across, mirrored, touches, turned
from clast_plugins.contact_laws.hertz_mindlin import HertzMindlin, History, choices, constants, load
from tests.support.strategies import vectors

__all__ = [
    "DT",
    "EVERYTHING",
    "GLASS",
    "Contact",
    "across",
    "contact",
    "mirrored",
    "sliding_contacts",
    "touches",
    "turned",
]
LIMITS = ("elastic", "total", "musen")
REST: Vec = (0.0, 0.0, 0.0)


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


@st.composite
def sliding_contacts(draw) -> tuple[Touch, Vec]:
    """Draw a touch and a tangential displacement it has come to."""
    touch = draw(touches())
    return touch, across(draw(vectors(0.02 * touch.radius)), touch.normal)


def tangential(told: ContactLoad, touch: Touch) -> Vec:
    return across(told.force, touch.normal)

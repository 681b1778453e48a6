"""Wall: a rigid surface that particles touch; motion: how it moves; body force: what pulls everywhere."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.errors import PluginError
from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec
from clast.parts.params import Params

Floats = NDArray[np.float64]


class Nearest(NamedTuple):
    """The nearest point of a wall, seen from a particle's centre.

    Attributes
    ----------
    distance : float
        From the centre to the surface in m; negative behind it.
    normal : vector
        Unit vector from the centre towards the surface.
    """

    distance: float
    normal: Vec


class Pressed(NamedTuple):
    """What a wall feels, for motions that answer to it.

    Attributes
    ----------
    force : vector
        Force of the particles on the wall at the last force evaluation in N.
    mass : float
        Mass of all particles of the scene in kg, as they are moved: with whatever mass scaling adds.
    velocity : vector
        Velocity with which the wall came there in m/s.
    span : float
        Time to the next force evaluation in s: so long the wall keeps the velocity that the motion answers with.
    since : float
        Time since the force evaluation before in s, for which the wall kept ``velocity``; 0 at the start. It is twice
        the time since the middle of the span that was foreseen there: where the step was just changed, a little more or
        less.
    """

    force: Vec
    mass: float
    velocity: Vec
    span: float
    since: float = 0.0


class Turned(NamedTuple):
    """How a wall turns and what turns it, for motions that answer to it.

    Attributes
    ----------
    moment : vector
        Moment of the particles on the wall about its pivot, at the last force evaluation, in N m.
    orientation : quaternion
        How the wall is turned there, w first; it begins with (1, 0, 0, 0).
    spin : vector
        Angular velocity with which it came there in rad/s.
    span, since : float
        As in :class:`Pressed`.
    """

    moment: Vec
    orientation: Quat
    spin: Vec
    span: float
    since: float = 0.0


def never(params: Any) -> bool:
    """Return False, whatever the parameters: what a wall is of which nothing else is known."""
    return False


def once(params: Any) -> int:
    """Return 1: so many contacts a particle has with a wall of which nothing else is known."""
    return 1


def nothing_to_tell(params: Any) -> tuple[str, ...]:
    """Return no sentence, whatever the parameters."""
    return ()


@dataclass(frozen=True)
class Wall:
    """The part a plugin registers with ``registry.wall(name, Wall(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        Shape, as the user writes it under ``walls.NAME``.
    Shape : NamedTuple type
        The numbers the compiled loop needs; arrays of float64 too.
    shape : (params) -> Shape
    nearest : (shape, x) -> Nearest
        For a centre x given in the wall's own frame: its motion is already taken off.
    centre : (params) -> vector
        Point about which the wall's moment is reported, unless it turns: then it is about the pivot of its motion.
    touches : (shape, x, reach, found) -> int, optional
        For surfaces that a sphere can touch in several places. Writes distance and normal, one row each, of every place
        that is nearer to x than ``reach`` and than the surface around it, the nearest first; returns how many there
        are, at most as many as ``found`` has rows.
    slots : (params) -> int, optional
        Most contacts that a particle has with such a wall at a time, 1 to 64.
    mesh : (params, size) -> (points, triangles)
        For pictures: (p, 3) float64 in m and (t, 3) int64; ``size`` in m bounds what is drawn of infinite walls.
    flat : (params) -> bool, optional
        Whether all its normals are one, so that what presses on it is a component of the force on it. On other walls
        forces from opposite sides cancel: there what presses is summed up too.
    girth : (params) -> float, optional
        Length in m of the closed line that a tube's inner face is in its cross-section; None for what is no tube.
    section : (params) -> float, optional
        Area in m² inside that line; with it a compression in the tube is held against it.
    concerns : (params) -> sequence of str, optional
        What the user should know before the run, one sentence each, such as what was left out of a file.
    """

    summary: str
    Params: type[Params]
    Shape: type
    shape: Callable[[Any], Any]
    nearest: Callable[..., Nearest]
    centre: Callable[[Any], Vec]
    mesh: Callable[[Any, float], tuple[NDArray[np.float64], NDArray[np.int64]]]
    flat: Callable[[Any], bool] = never
    girth: Callable[[Any], float] | None = None
    section: Callable[[Any], float] | None = None
    touches: Callable[..., int] | None = None
    slots: Callable[[Any], int] = once
    concerns: Callable[[Any], Sequence[str]] = nothing_to_tell


@dataclass(frozen=True)
class Motion:
    """The part a plugin registers with ``registry.motion(name, Motion(...))``.

    A motion knows its velocity beforehand, or answers to what presses on the wall: it has either ``velocity`` or
    ``answer``. From one force evaluation to the next a wall keeps one velocity.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``walls.NAME.motion``.
    Course : NamedTuple type
        The numbers the compiled loop needs; arrays of float64 too.
    course : (params) -> Course
    velocity : (course, time) -> vector, optional
        Velocity of the wall in m/s.
    way : (course, begin, end) -> vector, optional
        How far a wall that knows its velocity comes between two times, in m: where that has a closed form. With it the
        wall is where it should be at every force evaluation, to rounding; without, its velocity in the middle of a span
        stands for the span.
    answer : (course, time, pressed) -> vector, optional
        Velocity in m/s of a wall that was :class:`Pressed`; ``time`` in s is in the middle of the span. Before the
        first force evaluation the wall rests, or has the velocity of ``start``.
    start : (course) -> vector, optional
        Velocity in m/s of a wall that answers, before any force is known.
    spin : (course, time) -> vector, optional
        Angular velocity of the wall in rad/s, about its pivot; from one force evaluation to the next it keeps that of
        the middle.
    answer_spin : (course, time, turned) -> vector, optional
        Angular velocity in rad/s of a wall that was :class:`Turned`, in the place of ``spin``; ``time`` as in
        ``answer``, which goes with it.
    start_spin : (course) -> vector, optional
        Angular velocity in rad/s of such a wall, before any force is known.
    pivot : (params) -> vector, optional
        Point in m about which it turns, as it stands at the start; it moves with the wall's velocity.
    lasts : (course) -> float, optional
        Time in s up to which it tells how the wall moves; scenes that end later are refused.
    step_share : (course, mass, arm) -> float, optional
        Share of the stable step at walls that stand still which is safe with this motion; ``mass`` in kg is that of
        all particles that forces can move, ``arm`` in m how far from the pivot they can touch the wall.

    Raises
    ------
    PluginError
        If it has neither or both, a way and no velocity, a pivot and nothing that turns about it or the other way
        round, or a spin that answers and no velocity that does.
    """

    summary: str
    Params: type[Params]
    Course: type
    course: Callable[[Any], Any]
    velocity: Callable[..., Vec] | None = None
    answer: Callable[..., Vec] | None = None
    start: Callable[[Any], Vec] | None = None
    step_share: Callable[[Any, float, float], float] | None = None
    way: Callable[..., Vec] | None = None
    lasts: Callable[[Any], float] | None = None
    spin: Callable[[Any, float], Vec] | None = None
    pivot: Callable[[Any], Vec] | None = None
    answer_spin: Callable[..., Vec] | None = None
    start_spin: Callable[[Any], Vec] | None = None

    @property
    def turns(self) -> bool:
        """Whether it turns the wall."""
        return self.spin is not None or self.answer_spin is not None

    def __post_init__(self) -> None:
        if (self.velocity is None) == (self.answer is None):
            raise PluginError(f"motion {self.summary!r} needs either 'velocity' or 'answer'")
        if self.way is not None and self.velocity is None:
            raise PluginError(f"motion {self.summary!r} has a 'way', and no 'velocity' to go with it")
        if self.turns != (self.pivot is not None) or (self.spin is not None and self.answer_spin is not None):
            text = "needs both 'spin' or 'answer_spin' and 'pivot', or neither"
            raise PluginError(f"motion {self.summary!r} {text}")
        if self.answer is None and self.answer_spin is not None:
            raise PluginError(f"motion {self.summary!r} has an 'answer_spin', and no 'answer' to go with it")


@dataclass(frozen=True)
class BodyForce:
    """The part a plugin registers with ``registry.body_force(name, BodyForce(...))``.

    It is known as an acceleration, the same for all particles in one place, or as a load on each: it has either
    ``acceleration`` or ``load``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes in the list ``body_forces``.
    Numbers : NamedTuple type
        The numbers the compiled loop needs.
    numbers : (params, mass_scaling) -> Numbers
        ``mass_scaling`` is the factor on all masses of the scene. Forces stay what they are without it, so an
        acceleration is divided by it, and a load is not.
    acceleration : (numbers, x, v, time) -> vector, optional
        Acceleration of a particle in m/s².
    load : (numbers, x, v, w, radius, time) -> (vector, vector), optional
        Force in N and torque in N m on a particle that moves with v and spins with w.
    damping : (numbers, radius, velocity) -> (array, array), optional
        How much more force a load takes for more velocity, in N s/m, and how much more torque for more spin, in N m s:
        (n,) each, from radii (n,) and velocities (n, 3); at least the largest for any direction. It enters the stable
        step.

    Raises
    ------
    PluginError
        If it has neither or both of acceleration and load.
    """

    summary: str
    Params: type[Params]
    Numbers: type
    numbers: Callable[[Any, float], Any]
    acceleration: Callable[..., Vec] | None = None
    load: Callable[..., tuple[Vec, Vec]] | None = None
    damping: Callable[[Any, Floats, Floats], tuple[Floats, Floats]] | None = None

    def __post_init__(self) -> None:
        if (self.acceleration is None) == (self.load is None):
            raise PluginError(f"body force {self.summary!r} needs either 'acceleration' or 'load'")

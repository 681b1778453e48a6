"""Motion: how a wall moves and turns, as known beforehand or as an answer to what presses on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from clast.errors import PluginError
from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec
from clast.parts.params import Params


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


class Pushed(NamedTuple):
    """Where and which way a contact pushes a wall, for motions whose walls have a mass.

    Attributes
    ----------
    normal : vector
        Unit vector along which it pushes.
    arm : vector
        From the wall's pivot to where it pushes, in m.
    orientation : quaternion
        How the wall is turned, w first.
    mass : float
        Mass of all particles of the scene in kg, as in :class:`Pressed`.
    """

    normal: Vec
    arm: Vec
    orientation: Quat
    mass: float


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
    inverse_mass : (course, pushed) -> float, optional
        Of a wall that answers: its velocity along the normal of a contact, where that pushes, for an impulse there, in
        1/kg; 0 where the push cannot move it. Without it the wall counts as endlessly heavy in contacts, and passes
        through particles that nothing moves either.
    step_share : (course, mass, arm) -> float, optional
        Share of the stable step at walls that stand still which is safe with this motion; ``mass`` in kg is that of
        all particles, ``arm`` in m how far from the pivot they can touch the wall.

    Raises
    ------
    PluginError
        If it has neither or both, a way and no velocity, a pivot and nothing that turns about it or the other way
        round, or a spin or an inverse mass that answers and no velocity that does.
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
    inverse_mass: Callable[[Any, Pushed], float] | None = None

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
        for name in ("answer_spin", "inverse_mass"):
            if self.answer is None and getattr(self, name) is not None:
                raise PluginError(f"motion {self.summary!r} has '{name}', and no 'answer' to go with it")

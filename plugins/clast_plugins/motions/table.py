"""A wall that follows a table of displacements or velocities over time."""

from __future__ import annotations

from math import floor, inf
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PrivateAttr, model_validator

from clast import hookimpl
from clast.config.files import InputFile
from clast.config.problems import wrong
from clast.config.quantities import Direction, Length, Time, Velocity
from clast.errors import ConfigError
from clast.maths.vec3 import Vec, norm, scale
from clast.parts.motion import Motion
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.motions.measured import Rows, read_course

WIDTH = 6
"""Numbers of one piece: when it begins, and the five coefficients of the displacement."""


class Table(Params):
    r"""A course along a direction, given as rows of time and displacement, or of time and velocity.

    Equation
    --------
    x(t) on [t_k, t_k+1]: a polynomial of t − t_k through the rows; v = dx/dt

    Symbols
    -------
    x, v : displacement in m and velocity in m/s along ``direction``; t_k : time of row k in s, from 0 on
    ``between: linear`` : straight lines between the rows, of displacement or of velocity, whichever the rows hold
    ``between: smooth`` : piecewise cubics without overshoot through the same rows

    Limits
    ------
    Straight lines of displacement have jumps of velocity at the rows: each is a small impact. Take ``smooth``, or rows
    of velocity, where that matters. Displacements count from that of the first row. At every force
    evaluation the wall is where the table has it, to rounding, whatever the time step.

    After the last row the last value holds (``after: hold``): a displacement stays, a velocity is kept; or the table is
    ``repeat``-ed for ever; or a run that would last longer is refused (``refuse``).

    Source
    ------
    Cubics without overshoot: F. N. Fritsch, J. Butland (1984), doi:10.1137/0905021, as in ``scipy.interpolate``.
    """

    direction: Annotated[Direction, Field(examples=[[0, 0, -1]], description="Direction that values count along")]
    displacement: Annotated[
        tuple[tuple[Time, Length], ...] | None,
        Field(
            examples=[[[0, 0], ["1 s", "0.2 mm"], ["2 s", 0]]],
            description="Rows [time, displacement]; the first is 0",
        ),
    ] = None
    velocity: Annotated[tuple[tuple[Time, Velocity], ...] | None, Field(description="Rows [time, velocity]")] = None
    file: Annotated[
        InputFile | None,
        Field(description="CSV file with such rows; units stand in its header: time [s],displacement [mm]"),
    ] = None
    between: Annotated[Literal["linear", "smooth"], Field(description="how values change between two rows")] = "linear"
    after: Annotated[Literal["hold", "repeat", "refuse"], Field(description="what comes after the last row")] = "hold"
    _kind: str = PrivateAttr(default="")
    _rows: Rows = PrivateAttr(default=())

    @model_validator(mode="after")
    def _read(self) -> Table:
        given = {
            name: rows for name in ("displacement", "velocity", "file") if (rows := getattr(self, name)) is not None
        }
        if len(given) != 1:
            text = "exactly one of displacement, velocity and file is needed; given "
            names = list(given)
            raise wrong(names[1], f"{text}{' and '.join(names)}") if names else ValueError(f"{text}none of them")
        ((key, rows),) = given.items()
        kind, where = key, ""
        if self.file is not None:
            where = f"{self.file}: "
            try:
                kind, rows = read_course(self.file)
            except ConfigError as error:
                raise wrong(key, str(error)) from None
        told = _bad_rows(kind, rows, self.after)
        if told:
            raise wrong(key, where + told)
        self._kind, self._rows = kind, rows
        return self


def _bad_rows(kind: str, rows: Rows, after: str) -> str:
    """Return what is wrong with rows; nothing where they are a course."""
    if len(rows) < 2:
        return f"at least two rows are needed; given {len(rows)}"
    if rows[0][0] != 0.0:
        return f"the first row must be at the time 0; given {rows[0][0]:g} s: shift the times"
    for k in range(1, len(rows)):
        if not rows[k][0] > rows[k - 1][0]:
            told = f"row {k + 1} is at {rows[k][0]:g} s, the one before at {rows[k - 1][0]:g} s"
            return f"times must rise from row to row; {told}"
    if after == "repeat" and kind == "displacement" and rows[-1][1] != rows[0][1]:
        told = f"{rows[0][1]:g} m at first and {rows[-1][1]:g} m at last"
        return f"a displacement that is repeated must end where it begins; given {told}"
    return ""


class Course(NamedTuple):
    """Unit direction, pieces in rows of ``WIDTH``, when they end in s, and what follows.

    ``shift`` is the displacement at the end in m, ``kept`` the velocity from then on in m/s; ``again`` is 1 where the
    table is repeated, ``last`` the time in s up to which it is followed.
    """

    direction: Vec
    pieces: NDArray[np.float64]
    duration: float
    shift: float
    kept: float
    again: float
    last: float


def course(params: Table) -> Course:
    """Return the numbers of the motion."""
    from scipy.interpolate import PchipInterpolator

    time, value = np.array(params._rows).T
    if params.between == "smooth" and len(time) > 2:
        c: Any = PchipInterpolator(time, value).c
    else:
        c = np.array([np.diff(value) / np.diff(time), value[:-1]])
    kept = 0.0
    if params._kind == "velocity":
        kept = float(value[-1])
        c = np.vstack([c / np.arange(len(c), 0, -1)[:, None], np.zeros(len(time) - 1)])
    ends = _continuous(c, np.diff(time))
    rows = np.zeros((len(time) - 1, WIDTH))
    rows[:, 0] = time[:-1]
    rows[:, 1 : 1 + len(c)] = c[::-1].T
    direction = scale(1.0 / norm(params.direction), params.direction)
    duration, last = float(time[-1]), float(time[-1]) if params.after == "refuse" else inf
    return Course(direction, rows.ravel(), duration, ends, kept, 1.0 if params.after == "repeat" else 0.0, last)


def _continuous(c: NDArray[np.float64], width: NDArray[np.float64]) -> float:
    """Let every piece begin where the one before ends, the first at 0; return where the last ends."""
    gained = sum(c[-1 - k] * width**k for k in range(1, len(c)))
    c[-1] = np.concatenate([[0.0], np.cumsum(gained)[:-1]])
    return float(np.sum(gained))


def piece_at(pieces: NDArray[np.float64], time: float) -> int:
    """Return where in the row of pieces the one begins that a time falls into; the first for times before."""
    low, high = 0, len(pieces) // WIDTH
    while high - low > 1:
        middle = (low + high) // 2
        if pieces[WIDTH * middle] <= time:
            low = middle
        else:
            high = middle
    return WIDTH * low


def place(course: Course, time: float) -> float:
    """Return the displacement at a time in m.

    >>> up_and_down = course(Table(direction=(0, 0, 1), displacement=((0, 0), (1, 2), (2, 0))))
    >>> [float(place(up_and_down, time)) for time in (0.5, 1.5, 7.0)]
    [1.0, 1.0, 0.0]
    """
    turns, over = 0.0, 0.0
    if course.again > 0.0:
        turns = floor(time / course.duration)
        time -= turns * course.duration
    elif time > course.duration:
        over, time = time - course.duration, course.duration
    time = max(time, 0.0)
    c = course.pieces
    k = piece_at(c, time)
    s = time - c[k]
    inside: float = c[k + 1] + s * (c[k + 2] + s * (c[k + 3] + s * (c[k + 4] + s * c[k + 5])))
    return turns * course.shift + inside + over * course.kept


def velocity(course: Course, time: float) -> Vec:
    """Return the velocity in m/s; before the table, and after one of displacements, 0."""
    if course.again > 0.0:
        time -= floor(time / course.duration) * course.duration
    elif time >= course.duration:
        return scale(course.kept, course.direction)
    c = course.pieces
    k = piece_at(c, time)
    s = max(time - c[k], 0.0)
    speed = c[k + 2] + s * (2.0 * c[k + 3] + s * (3.0 * c[k + 4] + s * 4.0 * c[k + 5]))
    return scale(speed, course.direction)


def way(course: Course, begin: float, end: float) -> Vec:
    """Return how far the wall comes between two times, in m."""
    return scale(place(course, end) - place(course, begin), course.direction)


def lasts(course: Course) -> float:
    """Return the time in s up to which the table is followed."""
    return course.last


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the table."""
    registry.motion(
        "table",
        Motion(
            summary="follows a table of displacements or velocities over time",
            Params=Table,
            Course=Course,
            course=course,
            velocity=velocity,
            way=way,
            lasts=lasts,
        ),
    )

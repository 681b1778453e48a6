"""Oblique impacts on the floor, compared in numbers that the tests of Chung and Ooi (2011) name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from clast.verification.case import Findings
from clast.verification.closed_forms.sliding import Motion, after_sliding, friction_impulse, slides
from clast.verification.curves import Floats, order
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import Row, starts
from clast.verification.sketch import Line, Sketch

COARSE, FINE = 50, 400
"""Steps per contact at which accuracy is asked for."""

REFERENCE = 16 * FINE
"""Steps per contact of the run that stands for the exact answer where there is no closed form."""

COUNTS = (COARSE, 100, 200, FINE, 800)
"""Steps per contact at which errors are shown."""

WITHOUT_DAMPING: Mapping[int, float] = {COARSE: 1e-3}
WITH_DAMPING: Mapping[int, float] = {COARSE: 1e-2, FINE: 1e-3}
"""Steps per contact, and the share of a measure's scale by which it may be wrong there."""


@dataclass(frozen=True)
class Measure:
    """A number that tells how a sphere leaves.

    Attributes
    ----------
    text : str
        Its symbol and unit.
    of : (row, after) -> array
        The number for each sphere of a row, from its motion after the impact.
    scale : (row) -> array
        What its errors are shares of.
    """

    text: str
    of: Callable[[Row, Motion], Floats]
    scale: Callable[[Row], Floats]


@dataclass(frozen=True)
class Answer:
    """How the spheres of a row should leave.

    Attributes
    ----------
    motion : Motion
        By the closed form where a sphere slides all through, else by a run with ``REFERENCE`` steps per contact.
    slides : array
        (n,) whether a sphere slides all through.
    """

    motion: Motion
    slides: np.ndarray[tuple[int], np.dtype[np.bool_]]

    @property
    def parts(self) -> tuple[tuple[str, np.ndarray[tuple[int], np.dtype[np.bool_]]], ...]:
        """Both kinds of spheres: what they do, and which they are."""
        return (("slides", self.slides), ("sticks", ~self.slides))


def answer(row: Row) -> Answer:
    """Return how the spheres of a row should leave."""
    given = (row.before, row.friction, row.restitution)
    through = slides(*given)
    both = zip(after_sliding(*given), row.reference(REFERENCE), strict=True)
    return Answer(Motion(*(np.where(through, closed, run) for closed, run in both)), through)


def impulse(row: Row) -> Floats:
    """Return μ (1 + e) v_n of each sphere in m/s."""
    return friction_impulse(row.before, row.friction, row.restitution)


def compare(
    name: str, row: Row, exact: Answer, measures: tuple[Measure, ...], accuracy: Mapping[int, float], at: list[str]
) -> Findings:
    """Compare a row with what it should do: for each measure the worst of all spheres that slide, and that stick.

    Parameters
    ----------
    name : str
        Set in front of each quantity.
    row : Row
    exact : Answer
    measures : tuple of Measure
    accuracy : mapping
        Steps per contact -> accepted error, as a share of the measure's scale.
    at : list of str
        How each sphere is named, for instance by its angle.
    """
    for count, bound in accuracy.items():
        after = starts(row, count)
        for what, spheres in exact.parts:
            for measure in measures:
                expected, scale = measure.of(row, exact.motion), measure.scale(row)
                got = [measure.of(row, each) for each in after]
                found = (
                    Finding(f"{measure.text}, {at[k]}", expected[k], each[k], bound * scale[k], absolute=True)
                    for each in got
                    for k in np.nonzero(spheres)[0]
                )
                yield worst(found, f"{name}{what}, {count} steps: ")


def curve(title: str, x_label: str, x: Floats, row: Row, exact: Answer, measure: Measure) -> Sketch:
    """Show a measure of all spheres of a row against a number x of each, which grows along the row."""
    expected, through = measure.of(row, exact.motion), exact.slides
    up_to_sliding = slice(0, int(np.argmax(through)) + 1)
    got = measure.of(row, row.after(COARSE))
    return Sketch(
        title,
        x_label,
        measure.text,
        (
            Line("slides all through: closed form", x[through], expected[through]),
            Line(f"sticks: run with {REFERENCE} steps", x[up_to_sliding], expected[up_to_sliding]),
            Line(f"Clast, {COARSE} steps per contact", x, got, dots=True),
        ),
    )


def convergence(title: str, row: Row, exact: Answer) -> Sketch:
    """Show the error of the tangential impulse against the number of steps."""
    errors = np.array([[(each.along - exact.motion.along) / impulse(row) for each in starts(row, n)] for n in COUNTS])
    lines = []
    for what, spheres in exact.parts:
        size = np.sqrt(np.mean(errors[:, :, spheres] ** 2, axis=(1, 2)))
        lines.append(Line(f"{what}: order {order(COUNTS, size):.1f}", np.array(COUNTS, float), size))
    text = "error of the impulse / sliding impulse, RMS"
    return Sketch(title, "steps per contact", text, tuple(lines), logarithmic=True)

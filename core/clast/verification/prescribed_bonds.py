"""Single bonds whose ends move as prescribed, judged: their stresses all the way, and the step in which each breaks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np

from clast.simulation import Simulation
from clast.verification.bench import Bench
from clast.verification.case import Findings
from clast.verification.closed_forms.bond_curves import Course
from clast.verification.curves import Floats
from clast.verification.families.bonds import beam_of, split
from clast.verification.finding import Finding
from clast.verification.reading import evaluation, follow
from clast.verification.sketch import Line, Sketch

EXACT = 1e-9
"""Accuracy of a stress, as a share of the strength or the yield stress."""

EVERY = 10
"""Steps between two looks at the stresses."""

SHOWN = ("tension", "shear")
"""Bonds whose curves are shown."""


@dataclass(frozen=True)
class Model:
    """What a bond model promises.

    Attributes
    ----------
    normal, shear : (course, time, bond) -> stress in Pa
        On the axis of the bond, until it breaks.
    criterion : (course, time) -> number
        The bond breaks at 1.
    scale : float
        Strength or yield stress in Pa.
    accuracy : float
        Of a stress, as a share of it.
    """

    normal: Callable[[Course, Floats, int], Floats]
    shear: Callable[[Course, Floats, int], Floats]
    criterion: Callable[[Course, Any], Any]
    scale: float
    accuracy: float = EXACT

    def stresses(self, course: Course, t: Floats, bond: int) -> Floats:
        """Return both stresses at (k,) times, (k, 2) in Pa."""
        return np.column_stack([self.normal(course, t, bond), self.shear(course, t, bond)])


def courses(simulation: Simulation) -> list[Course]:
    """Return how the ends of every bond of a scene move."""
    scene = simulation.scene
    i, j = scene.ends.T
    axes = scene.bond_vectors / scene.length[:, None]
    slips = [split(v, n) for v, n in zip(scene.velocity[j] - scene.velocity[i], axes, strict=True)]
    turns = [split(w, n) for w, n in zip(scene.spin[j] - scene.spin[i], axes, strict=True)]
    sizes = zip(scene.length, 0.5 * scene.diameter, strict=True)
    return [Course(float(L), float(R), *slip, *turn) for (L, R), slip, turn in zip(sizes, slips, turns, strict=True)]


def step_of_breaking(simulation: Simulation, course: Course, model: Model) -> int:
    """Return the number of the step that first sees the criterion fulfilled; that of the end, where none does."""
    from scipy.optimize import brentq

    end = simulation.last_step * simulation.dt
    if model.criterion(course, end) < 1.0:
        return simulation.last_step
    time = brentq(lambda t: model.criterion(course, t) - 1.0, 0.0, end, xtol=1e-6 * simulation.dt)
    return ceil(time / simulation.dt - evaluation(simulation))


def judge(bench: Bench, names: Sequence[str], model: Model) -> Findings:
    """Compare the stresses of bonds, and the steps in which they break, with what their model promises."""
    simulation = bench.start()
    loads = follow(simulation, Simulation.bond_loads, EVERY)
    time, cracks = simulation.dt * EVERY * np.arange(len(loads)), simulation.world.cracks
    broken = dict(zip(cracks.bond[: simulation.bonds_broken].tolist(), cracks.step.tolist(), strict=False))
    lines: list[Line] = []
    for b, (name, course) in enumerate(zip(names, courses(simulation), strict=True)):
        expected, got = step_of_breaking(simulation, course, model), broken.get(b, simulation.last_step)
        what = "step in which it breaks" if expected < simulation.last_step else "holds to the last step"
        yield Finding(f"{name}: {what}", expected, got, 0.0, absolute=True)
        holds = loads[:, b, 0] > 0.0
        stresses = loads[holds, b, 2:4] / beam_of(simulation.scene).A
        wanted, before = (model.stresses(course, t, b) for t in (time[holds], time[holds] - simulation.dt))
        smooth = np.abs(wanted - before).max(axis=1) < 0.01 * model.scale  # a drop may be due at the next evaluation
        error = float(np.abs(stresses - wanted)[smooth].max()) / model.scale
        yield Finding(
            f"{name}: largest error of a stress, share of {model.scale:.3g} Pa", 0.0, error, model.accuracy, True
        )
        if name in SHOWN:
            strain = course.axial(time[holds]) if name == "tension" else course.shear(time[holds])
            component = SHOWN.index(name)
            lines += shown(name, 100.0 * strain, 1e-6 * wanted[:, component], 1e-6 * stresses[:, component])
    if lines:
        yield Sketch(bench.scene().bonds.model.name, "strain, %", "stress, MPa", tuple(lines))  # type: ignore[union-attr]


def shown(name: str, strain: Floats, wanted: Floats, got: Floats) -> Iterator[Line]:
    """Show a curve of closed form, and every tenth of the stresses that were computed."""
    yield Line(f"{name}, closed form", strain, wanted)
    yield Line(f"{name}, Clast", strain[::10], got[::10], dots=True)

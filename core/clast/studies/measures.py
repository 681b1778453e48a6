"""Measures: the numbers that a study compares, taken from the curve and the summary of a run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.results.run import Run, open_run
from clast.results.summary import peak_inside, secant_modulus

Floats = NDArray[np.float64]

DROP = 0.1
"""Share of the peak by which the stress falls in what counts as a drop."""

WINDOW = 0.01
"""Strain within which a fall counts as one drop."""

COLUMNS = ("strain", "stress_Pa", "force_upper_N", "bonds_broken")

FROM_SUMMARY = (
    "hertz_modulus_at_2_percent_Pa",
    "fragments",
    "largest_fragment_particles",
    "bonds_broken",
    "steps",
    "time_step_s",
    "wall_time_s",
)


class Curve(NamedTuple):
    """Stress and bonds broken over strain, (s,) each, and how many bonds there were."""

    strain: Floats
    stress: Floats
    force: Floats
    broken: Floats
    bonds: int

    @property
    def peak(self) -> int:
        """Row of the highest stress."""
        return int(np.argmax(self.stress))


def secant(low: float, high: float) -> Callable[[Curve], float | None]:
    """Return a measure: the slope of the stress between two strains in Pa; None where the curve ends before."""

    def slope(curve: Curve) -> float | None:
        if curve.strain[-1] < high:
            return None
        ends = np.interp((low, high), curve.strain, curve.stress)
        return float((ends[1] - ends[0]) / (high - low))

    return slope


def stress_at(strain: float) -> Callable[[Curve], float | None]:
    """Return a measure: the stress at a strain in Pa; None where the curve ends before."""

    def stress(curve: Curve) -> float | None:
        return float(np.interp(strain, curve.strain, curve.stress)) if curve.strain[-1] >= strain else None

    return stress


def largest_drop(curve: Curve) -> float | None:
    """Return the largest fall of the stress within 1 % strain as a share of the peak."""
    top = curve.stress[curve.peak]
    if top <= 0.0:
        return None
    window = max(1, int(np.searchsorted(curve.strain, curve.strain[0] + WINDOW)))
    falls = [(curve.stress[:-k] - curve.stress[k:]).max() for k in range(1, min(window, len(curve.stress) - 1) + 1)]
    return float(max(0.0, *falls) / top)


def drops(curve: Curve) -> float:
    """Return how often the stress falls by more than a tenth of the peak before it rises again by as much."""
    least = DROP * curve.stress[curve.peak]
    count, high, low, falling = 0, curve.stress[0], curve.stress[0], False
    for stress in curve.stress:
        if falling:
            low = min(low, stress)
            if stress > low + least:
                falling, high = False, stress
        else:
            high = max(high, stress)
            if stress < high - least:
                count, falling, low = count + 1, True, stress
    return float(count)


def broken_share(row: Callable[[Curve], int]) -> Callable[[Curve], float | None]:
    """Return a measure: the share of bonds broken at a row of the curve."""

    def share(curve: Curve) -> float | None:
        return float(curve.broken[row(curve)] / curve.bonds) if curve.bonds else None

    return share


MEASURES: dict[str, Callable[[Curve], float | None]] = {
    "peak_stress_Pa": lambda curve: float(curve.stress[curve.peak]),
    "peak_force_N": lambda curve: float(curve.force[curve.peak]),
    "strain_at_peak": lambda curve: float(curve.strain[curve.peak]),
    "peak_inside": lambda curve: float(peak_inside(curve.stress, curve.peak)),
    "slope_20_80_Pa": lambda curve: secant_modulus(curve.strain, curve.stress, curve.peak),
    "slope_1_4_Pa": secant(0.01, 0.04),
    "slope_5_15_Pa": secant(0.05, 0.15),
    "stress_at_5_Pa": stress_at(0.05),
    "stress_at_10_Pa": stress_at(0.10),
    "stress_at_15_Pa": stress_at(0.15),
    "stress_at_20_Pa": stress_at(0.20),
    "largest_drop": largest_drop,
    "drops": drops,
    "broken_at_peak": broken_share(lambda curve: curve.peak),
    "broken_at_end": broken_share(lambda curve: -1),
    "work_J_per_m3": lambda curve: float(np.trapezoid(curve.stress, curve.strain)),
}
"""By name: of the stress-strain curve of one run, in SI; docs/studies.md tells what each is."""


UNITS = {"_J_per_m3": "J/m3", "_Pa": "Pa", "_N": "N", "_s": "s"}
"""By the end of a measure's name; what ends otherwise is a plain number."""


def unit_of(name: str) -> str:
    """Return the unit of a measure in SI.

    >>> unit_of("peak_stress_Pa"), unit_of("strain_at_peak")
    ('Pa', '1')
    """
    return next((unit for end, unit in UNITS.items() if name.endswith(end)), "1")


def measure(folder: Path) -> tuple[dict[str, float | None], Curve | None]:
    """Return all measures of a finished run, and its curve where it was a compression.

    Raises
    ------
    RunError
        If the folder holds no readable results.
    """
    with open_run(folder) as run:
        curve = curve_of(run)
        found = {} if curve is None else {name: of(curve) for name, of in MEASURES.items()}
        return found | {name: _number(run.summary.get(name)) for name in FROM_SUMMARY}, curve


def curve_of(run: Run) -> Curve | None:
    """Return the curve of a compression; None of another scene."""
    if "stress_Pa" not in run.curves or len(run.curves["stress_Pa"]) < 2:
        return None
    strain, stress, force, broken = (run.curves[name] for name in COLUMNS)
    return Curve(strain, stress, force, broken, len(run.bond_ends))


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) else None

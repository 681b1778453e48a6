"""What a run tells of the wall around a compression: an oedometer's tube."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Curves = dict[str, NDArray[np.float64]]

LOADED = 0.2
"""Share of the peak stress from which on the loading counts."""


def side_results(curves: Curves) -> dict[str, Any]:
    """Return stresses, lateral pressure coefficient and wall friction; nothing without a wall around.

    Each at the peak of the stress on the upper wall and at the end, and the two ratios over the loading: the sums of
    what stands above and below their fraction bars over all samples from a fifth of the peak to the peak, so that
    samples count as they are loaded. Likewise what lower wall and side carry more or less than the upper wall presses
    with, as a share of that: at rest and without weight 0. None where there was no load.
    """
    if "stress_side_Pa" not in curves:
        return {}
    peak = int(np.argmax(curves["stress_Pa"]))
    return {
        "side_wall": {
            "at_peak": _at(curves, peak),
            "at_the_end": _at(curves, -1),
            "over_the_loading": _over_the_loading(curves, peak),
        }
    }


def _at(curves: Curves, k: int) -> dict[str, float]:
    told = {
        "stress_Pa": "stress_upper_Pa",
        "stress_lower_Pa": "stress_lower_Pa",
        "stress_side_Pa": "stress_side_Pa",
        "lateral_pressure_coefficient": "lateral_pressure_coefficient",
        "wall_friction_share": "wall_friction_share",
    }
    return {key: float(curves[column][k]) for column, key in told.items()}


def _over_the_loading(curves: Curves, peak: int) -> dict[str, float | None]:
    upper = curves["stress_Pa"][: peak + 1]
    if upper[peak] <= 0.0:
        return {"lateral_pressure_coefficient": None, "wall_friction_share": None, "unbalanced_share": None}
    rows = slice(int(np.argmax(upper >= LOADED * upper[peak])), peak + 1)
    upper = upper[rows]
    lower = curves["stress_lower_Pa"][rows]
    carried = curves["wall_friction_share"][rows] * upper
    return {
        "lateral_pressure_coefficient": float(curves["stress_side_Pa"][rows].sum() / (0.5 * (upper + lower)).sum()),
        "wall_friction_share": float(carried.sum() / upper.sum()),
        "unbalanced_share": float(np.abs(upper - lower - carried).sum() / upper.sum()),
    }


def side_rows(told: dict[str, Any]) -> list[tuple[str, str]]:
    """Return what a summary tells of the wall around, as pairs of what it is and the text for it."""
    peak, end, loading = told["at_peak"], told["at_the_end"], told["over_the_loading"]
    if loading["lateral_pressure_coefficient"] is None:
        return [("side wall", "nothing pressed on the plates")]
    rows = [
        (name, f"{peak[key] / 1e6:.3f} MPa at the peak, {end[key] / 1e6:.3f} MPa at the end")
        for key, name in (
            ("stress_lower_Pa", "stress on the lower wall"),
            ("stress_side_Pa", "stress on the side wall"),
        )
    ]
    for key, name, form in (
        ("lateral_pressure_coefficient", "side over mean axial stress", ".3f"),
        ("wall_friction_share", "carried by wall friction", ".1%"),
    ):
        text = f"{loading[key]:{form}} over the loading, {peak[key]:{form}} at the peak, {end[key]:{form}} at the end"
        rows.append((name, text))
    if loading.get("unbalanced_share") is not None:
        text = f"mean {loading['unbalanced_share']:.1%} of the force on the upper wall over the loading"
        rows.append(("upper - lower - side wall", text))
    return rows

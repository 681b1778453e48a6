"""Stress–strain curve of a recording, drawn in a 2D view because the viewer has no x–y plot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.reference import Reference
from clast.results.run import Run
from clast_viz.curves import has_compression

WIDTH, HEIGHT = 160.0, 100.0
LINE = 11.0  # height of a line of text
_CURVE_POINTS = 600  # per frame; keeps a recording of thousands of frames linear in size

AXIS_COLOUR = (150, 158, 168)
GRID_COLOUR = (58, 63, 70)
FAINT_COLOUR = (120, 80, 74)
CURVE_COLOUR = (244, 120, 95)
NOW_COLOUR = (255, 255, 255)
REFERENCE_COLOUR = (90, 180, 235)


@dataclass(frozen=True)
class Plot:
    """Scales of the drawing: strain runs to the right, stress upwards (where y of the view is negative).

    Attributes
    ----------
    strain_top, stress_top : float
        Ends of the axes; stress in Pa.
    """

    strain_top: float
    stress_top: float

    @classmethod
    def of(cls, run: Run) -> Plot | None:
        """Choose round axes that hold the curve and the reference points; None without a curve."""
        if not has_compression(run):
            return None
        strains = [np.nanmax(run.curves["strain"]), *(r.strain + r.strain_deviation for r in run.reference)]
        stresses = [
            np.nanmax(run.curves["stress_Pa"]),
            *(r.stress + r.stress_deviation for r in run.reference),
        ]
        top_strain, top_stress = float(max(strains)), float(max(stresses))
        if top_strain <= 0.0 or top_stress <= 0.0:
            return None
        return cls(_round_up(top_strain), _round_up(top_stress))

    def place(self, strain: Any, stress: Any) -> NDArray[np.float32]:
        """Return where points lie in the view, (k, 2) float32."""
        x = np.asarray(strain, dtype=np.float64) / self.strain_top * WIDTH
        y = np.asarray(stress, dtype=np.float64) / self.stress_top * -HEIGHT
        return np.stack(np.broadcast_arrays(x, y), axis=-1).astype(np.float32)


def log_plot(stream: Any, run: Run, plot: Plot | None) -> None:
    """Log what does not change: axes, the whole curve faintly, the reference points."""
    import rerun as rr

    if plot is None:
        return
    _log_axes(stream, plot)
    chosen = _thinned(len(run.curves["strain"]))
    whole = plot.place(run.curves["strain"][chosen], run.curves["stress_Pa"][chosen])
    stream.log("stress_strain/whole", rr.LineStrips2D([whole], colors=FAINT_COLOUR, radii=-0.75), static=True)
    for k, reference in enumerate(run.reference):
        _log_reference(stream, plot, k, reference)


def log_plot_until(stream: Any, run: Run, plot: Plot | None, time: float) -> None:
    """Log the curve up to ``time`` and a mark at its end."""
    import rerun as rr

    if plot is None:
        return
    length = int(np.searchsorted(run.curves["time_s"], time * (1.0 + 1e-9), side="right"))
    if length == 0:
        return
    chosen = _thinned(length)
    points = plot.place(run.curves["strain"][chosen], run.curves["stress_Pa"][chosen])
    stream.log("stress_strain/curve", rr.LineStrips2D([points], colors=CURVE_COLOUR, radii=-1.5))
    stream.log("stress_strain/now", rr.Points2D(points[-1:], colors=NOW_COLOUR, radii=-4.0, draw_order=50.0))


def _log_reference(stream: Any, plot: Plot, k: int, reference: Reference) -> None:
    import rerun as rr

    entity = f"stress_strain/reference/{k}"
    strain, stress = reference.strain, reference.stress
    across = plot.place(strain + np.array([-1, 1]) * reference.strain_deviation, stress)
    upright = plot.place(strain, stress + np.array([-1, 1]) * reference.stress_deviation)
    bars = rr.LineStrips2D([across, upright], colors=REFERENCE_COLOUR, radii=-1.0)
    stream.log(f"{entity}/scatter", bars, static=True)
    point = rr.Points2D(plot.place([strain], stress), colors=REFERENCE_COLOUR, radii=-4.5)
    stream.log(f"{entity}/point", point, static=True)
    # above the axes, where it covers no curve
    above = [[0.62 * WIDTH, -HEIGHT - 15.0 - LINE * k]]
    label = rr.Points2D(above, radii=0.0, colors=REFERENCE_COLOUR, labels=[f"● {reference.label}"], show_labels=True)
    stream.log(f"{entity}/label", label, static=True)


def _log_axes(stream: Any, plot: Plot) -> None:
    import rerun as rr

    strains, stresses = ticks(plot.strain_top), ticks(plot.stress_top)
    lines = [plot.place([0, plot.strain_top], stress) for stress in stresses[1:]]
    lines += [plot.place(strain, [0, plot.stress_top]) for strain in strains[1:]]
    stream.log("stress_strain/grid", rr.LineStrips2D(lines, colors=GRID_COLOUR, radii=-0.5), static=True)
    frame = [plot.place([0, plot.strain_top], 0), plot.place(0, [0, plot.stress_top])]
    stream.log("stress_strain/axes", rr.LineStrips2D(frame, colors=AXIS_COLOUR, radii=-0.75), static=True)
    below = plot.place(strains, 0)
    left = plot.place(0, stresses) + np.array([-6.0, -5.0])
    marks = rr.Points2D(
        np.concatenate([below, left, [[WIDTH / 2, 10], [0, -HEIGHT - 15]]]),
        radii=0.0,
        colors=AXIS_COLOUR,
        labels=[
            *(f"{100 * strain:g}" for strain in strains),
            *(f"{stress / 1e6:g}" for stress in stresses),
            "strain [%]",
            "stress [MPa]",
        ],
        show_labels=True,
    )
    stream.log("stress_strain/marks", marks, static=True)


def ticks(top: float) -> NDArray[np.float64]:
    """Return three to six round values from 0 to ``top``, which must be a value that ``_round_up`` gives.

    Examples
    --------
    >>> ticks(0.25).tolist()
    [0.0, 0.05, 0.1, 0.15, 0.2, 0.25]
    """
    step = _step(top)
    return np.round(np.arange(round(top / step) + 1) * step, 12 - int(np.floor(np.log10(step))))


def _round_up(value: float) -> float:
    step = _step(value)
    return float(np.ceil(value / step - 1e-9) * step)


def _step(value: float) -> float:
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * next(size for size in (0.2, 0.5, 1.0, 2.0) if value / power <= 6.0 * size))


def _thinned(length: int) -> NDArray[np.intp]:
    """Choose at most `_CURVE_POINTS` of ``length`` samples, always with the last."""
    return np.unique(np.linspace(0, length - 1, min(length, _CURVE_POINTS)).astype(np.intp))

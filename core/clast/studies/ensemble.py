"""Ensembles: what many grains that differ by accident have in common, with how sure that is."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from math import gamma
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import StrMethodFormatter
from numpy.typing import NDArray

from clast.results.whole_file import whole_file
from clast.studies.plots import LINES, STYLE
from clast.studies.statistics import LEVEL, statistic, values_of
from clast.studies.table import Table

SHOWN = ("peak_force_N", "peak_stress_Pa", "strain_at_peak", "hertz_modulus_at_2_percent_Pa", "work_J_per_m3")
CRUSHING = "peak_force_N"
LEAST = 8
"""Grains below which the scatter of a sample tells next to nothing."""

SAMPLES = 2000
"""Bootstrap samples behind an interval."""

Floats = NDArray[np.float64]


class Weibull(NamedTuple):
    """Weibull distribution P = 1 - exp(-(x/scale)^modulus) of a sample."""

    modulus: float
    scale: float

    @property
    def mean(self) -> float:
        """Mean of the distribution."""
        return self.scale * gamma(1.0 + 1.0 / self.modulus)


def weibull(sample: Sequence[float]) -> Weibull:
    """Return the distribution of greatest likelihood; Weibull (1951), J. Appl. Mech. 18, 293.

    >>> round(weibull(np.random.default_rng(1).weibull(3.0, 5000)).modulus, 1)
    3.0
    """
    from scipy.stats import weibull_min

    modulus, _, scale = weibull_min.fit(np.asarray(sample, float), floc=0.0)
    return Weibull(float(modulus), float(scale))


class Summary(NamedTuple):
    """Mean, deviation and Weibull modulus of a sample, each with its 95 % interval (bootstrap, percentiles)."""

    grains: int
    mean: float
    mean_low: float
    mean_high: float
    deviation: float
    deviation_low: float
    deviation_high: float
    weibull_modulus: float
    weibull_scale: float


def summarise(sample: Sequence[float]) -> Summary:
    """Return what a sample of at least :data:`LEAST` grains says."""
    values = np.asarray(sample, float)
    found = statistic(sample)
    drawn = np.random.default_rng(1).choice(values, (SAMPLES, len(values)))
    ends = 50.0 * (1.0 - LEVEL), 50.0 * (1.0 + LEVEL)
    low, high = np.percentile(drawn.std(axis=1, ddof=1), ends)
    shape = weibull(sample) if values.min() > 0.0 and np.ptp(values) > 0.0 else Weibull(np.nan, np.nan)
    return Summary(found.runs, found.mean, found.low, found.high, found.deviation, float(low), float(high), *shape)


def samples(table: Table) -> dict[str, list[float]]:
    """Return the crushing forces of every variant that has enough grains."""
    every = {variant: values_of(table.done(variant), CRUSHING) for variant in table.variants}
    return {variant: sample for variant, sample in every.items() if len(sample) >= LEAST}


def write_ensemble(table: Table, path: Path) -> bool:
    """Write one line a variant and measure; False where there are too few grains."""
    if not samples(table):
        return False
    with whole_file(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["variant", "measure", *Summary._fields])
        for variant in samples(table):
            for name in SHOWN:
                sample = values_of(table.done(variant), name)
                if len(sample) >= LEAST:
                    told = [f"{x:.9g}" if isinstance(x, float) else x for x in summarise(sample)]
                    writer.writerow([variant, name, *told])
    return True


def draw_weibull(table: Table, path: Path) -> bool:
    """Draw the crushing forces on Weibull paper; False where there are too few grains."""
    found = samples(table)
    if not found:
        return False
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(5.4, 4.2), layout="constrained")
        FigureCanvasAgg(figure)
        axis = figure.subplots()
        for (variant, sample), colour in zip(found.items(), LINES, strict=False):
            _draw_sample(axis, variant, np.sort(sample), colour)
        axis.set(xlabel="crushing force, N", ylabel="ln(-ln(1 - P))", xscale="log")
        axis.legend(loc="upper left")
        axis.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.xaxis.set_minor_formatter(StrMethodFormatter("{x:g}"))
        with whole_file(path) as draft:
            figure.savefig(draft, format="png", dpi=110, metadata={"Software": None})
    return True


def _draw_sample(axis: Any, variant: str, forces: Floats, colour: str) -> None:
    share = (np.arange(len(forces)) + 0.5) / len(forces)  # Hazen's plotting position
    shape = weibull(forces.tolist())
    grid = np.geomspace(0.9 * forces[0], 1.1 * forces[-1], 50)
    label = f"{variant}: " if variant else ""
    axis.plot(forces, np.log(-np.log1p(-share)), "o", color=colour, markersize=3.5)
    axis.plot(
        grid,
        shape.modulus * np.log(grid / shape.scale),
        color=colour,
        linewidth=1.0,
        label=f"{label}modulus {shape.modulus:.1f}, scale {shape.scale:.3g} N, {len(forces)} grains",
    )

"""The page about a sweep: its study, how its runs ended, the points, the plots and the verdicts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from math import floor, isfinite, log10
from pathlib import Path
from typing import Any, NamedTuple

from clast.studies.layout import run_of
from clast.studies.outcome import COLUMNS
from clast.studies.verdict import NOT_REPRODUCED, OPEN, REPRODUCED
from clast.studies.work import DONE
from clast_viz.report.links import address, data_address
from clast_viz.report.parameters import sections, text_of
from clast_viz.report.sweep import Record, Sweep

TEMPLATE = "sweep.html"
UNITS = (("_J_per_m3", "kJ/m³", 1e-3), ("_Pa", "MPa", 1e-6), ("_N", "N", 1.0), ("_s", "s", 1.0))
SHARES = ("strain_at_peak", "largest_drop", "broken_at_peak", "broken_at_end")
CLASSES = {REPRODUCED: "good", NOT_REPRODUCED: "bad", OPEN: "doubt"}


class Measure(NamedTuple):
    """How a measure is shown: its name, the text over its column, and the factor from SI."""

    name: str
    head: str
    factor: float


class Ended(NamedTuple):
    """How a run ended: the folder it lies in, and the cells of its row."""

    name: str
    folder: str
    cells: list[str]
    state: str
    reason: str


def values_of_sweep(sweep: Sweep, page: Path) -> dict[str, Any]:
    """Return what the template of sweeps is filled with."""
    measures = [measure(name) for name in dict.fromkeys(row["measure"] for row in sweep.statistics)]
    main = [each for each in measures if each.name in COLUMNS] or measures  # as the command's own table has them
    ended = [_ended(row, sweep, page) for row in sweep.runs]
    return {
        "title": str(sweep.study.get("study") or sweep.folder.resolve().name),
        "description": str(sweep.study.get("description") or ""),
        "counts": Counter(each.state for each in ended).most_common(),
        "ended": ended,
        "undone": [each for each in ended if each.state != DONE],
        "run_heads": [*_shown(sweep), "repeat"],
        "verdicts": [row | {"class": CLASSES.get(row["verdict"], "doubt")} for row in sweep.verdicts],
        "main": _points(sweep, main),
        "others": _points(sweep, [each for each in measures if each not in main]),
        "pictures": [(path.stem.replace("_", " "), data_address(path)) for path in sweep.pictures],
        "study": sections(sweep.study),
        "folder": address(sweep.folder, page),
        "place": sweep.folder.resolve().name,
    }


def _shown(sweep: Sweep) -> list[str]:
    """Return the columns that tell points apart."""
    named = any(row["variant"] for row in sweep.runs)
    return [*(["variant"] if named else []), *(sweep.axes or ["point"])]


def _ended(row: Record, sweep: Sweep, page: Path) -> Ended:
    cells = [*(number(row[name]) for name in _shown(sweep)), row["repeat"]]
    folder = run_of(sweep.folder, row["run"])
    link = address(folder, page) if folder.is_dir() else ""
    return Ended(row["run"], link, cells, row["state"], row["reason"])


def _points(sweep: Sweep, measures: Sequence[Measure]) -> list[list[str]]:
    """Return a table with one row a point, its heads first; nothing where there is nothing to show."""
    points: dict[tuple[str, str], dict[str, Record]] = {}
    for row in sweep.statistics:
        points.setdefault((row["variant"], row["point"]), {})[row["measure"]] = row
    shown, rows = _shown(sweep), []
    for found in points.values():
        one = next(iter(found.values()))
        runs = max((row["runs"] for row in found.values()), key=lambda text: (len(text), text))
        cells = [_cell(found.get(each.name), each.factor) for each in measures]
        rows.append([*(number(one.get(name, "")) for name in shown), runs, *cells])
    return [[*shown, "runs", *(each.head for each in measures)], *rows] if measures else []


def _cell(row: Record | None, factor: float) -> str:
    return "" if row is None else scattered(row["mean"], row["deviation"], row["runs"], factor)


def measure(name: str) -> Measure:
    """Return how a measure is shown, by the unit at the end of its name.

    >>> measure("slope_5_15_Pa")
    Measure(name='slope_5_15_Pa', head='slope 5 15 [MPa]', factor=1e-06)
    """
    if name in SHARES:
        return Measure(name, f"{name.replace('_', ' ')} [%]", 100.0)
    for end, unit, factor in UNITS:
        if name.endswith(end):
            return Measure(name, f"{name.removesuffix(end).replace('_', ' ')} [{unit}]", factor)
    return Measure(name, name.replace("_", " "), 1.0)


def scattered(mean: str, deviation: str, runs: str, factor: float) -> str:
    """Return a mean and its deviation, to two digits of the deviation; the mean alone of a single run.

    >>> scattered("3755429.5", "512000", "5", 1e-6), scattered("0.15343", "0", "1", 100)
    ('3.76 ± 0.51', '15.34')
    """
    try:
        value, spread = factor * float(mean), factor * float(deviation)
    except ValueError:
        return mean
    if runs == "1" or not isfinite(spread):
        return f"{value:.4g}"
    if spread == 0.0:
        return f"{value:.4g} ± 0"
    decimals = max(0, 1 - floor(log10(abs(spread))))
    return f"{value:.{decimals}f} ± {spread:.{decimals}f}"


def number(text: str) -> str:
    """Return a value of an axis, numbers to six digits.

    >>> number("0.00025000000000000001"), number("paper")
    ('0.00025', 'paper')
    """
    try:
        return text_of(float(f"{float(text):.6g}"))
    except ValueError:
        return text

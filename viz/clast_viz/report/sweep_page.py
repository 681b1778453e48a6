"""The page about a sweep: its study, how its runs ended, the points, the plots and the verdicts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from clast.studies.outcome import COLUMNS, INSIDE, open_peaks
from clast.studies.verdict import NOT_REPRODUCED, OPEN, REPRODUCED
from clast.studies.work import DONE
from clast_viz.report.ended import ended
from clast_viz.report.links import address, data_address
from clast_viz.report.measured import Measure, measure, number, scattered, within
from clast_viz.report.parameters import sections
from clast_viz.report.sweep import Sweep
from clast_viz.report.tables import Record

TEMPLATE = "sweep.html"
CLASSES = {REPRODUCED: "good", NOT_REPRODUCED: "bad", OPEN: "doubt"}


def values_of_sweep(sweep: Sweep, page: Path) -> dict[str, Any]:
    """Return what the template of sweeps is filled with."""
    measures = [measure(name) for name in dict.fromkeys(row["measure"] for row in sweep.statistics)]
    main = [each for each in measures if each.name in COLUMNS] or measures  # as the command's own table has them
    runs = ended(sweep.runs, _shown(sweep), sweep.folder, page)
    return {
        "title": str(sweep.study.get("study") or sweep.folder.resolve().name),
        "description": str(sweep.study.get("description") or ""),
        "counts": Counter(each.state for each in runs).most_common(),
        "ended": runs,
        "open_peaks": open_peaks([float(row[INSIDE]) for row in sweep.runs if row.get(INSIDE)]),
        "undone": [each for each in runs if each.state != DONE],
        "run_heads": [*_shown(sweep), "repeat"],
        "verdicts": [row | {"class": CLASSES.get(row["verdict"], "doubt")} for row in sweep.verdicts],
        "main": _points(sweep, main),
        "others": _points(sweep, [each for each in measures if each not in main]),
        "ensemble": _ensemble(sweep.ensemble),
        "pictures": [(path.stem.replace("_", " "), data_address(path)) for path in sweep.pictures],
        "study": sections(sweep.study),
        "folder": address(sweep.folder, page),
        "place": sweep.folder.resolve().name,
    }


def _shown(sweep: Sweep) -> list[str]:
    """Return the columns that tell points apart."""
    named = any(row["variant"] for row in sweep.runs)
    return [*(["variant"] if named else []), *(sweep.axes or ["point"])]


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


def _ensemble(records: Sequence[Record]) -> list[list[str]]:
    """Return a table with one row a variant and measure, its heads first; nothing where there is no ensemble."""
    named = any(row["variant"] for row in records)
    rows = [[*([row["variant"]] if named else []), *_spread(row)] for row in records]
    heads = ["measure", "grains", "mean [95 % interval]", "deviation [95 % interval]", "Weibull modulus"]
    return [[*(["variant"] if named else []), *heads], *rows] if rows else []


def _spread(row: Record) -> list[str]:
    """Return how a measure is spread over the grains of an ensemble."""
    _, head, factor = measure(row["measure"])
    told = [within(row[key], row[f"{key}_low"], row[f"{key}_high"], factor) for key in ("mean", "deviation")]
    return [head, row["grains"], *told, _modulus(row["weibull_modulus"])]


def _modulus(text: str) -> str:
    """Return a Weibull modulus; nothing of a sample that has none."""
    return "" if text == "nan" else within(text, text, text, 1.0)


def _cell(row: Record | None, factor: float) -> str:
    return "" if row is None else scattered(row["mean"], row["deviation"], row["runs"], factor)

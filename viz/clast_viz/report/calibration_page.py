"""The page about a calibration: what was fitted, how well, how surely, and all points on the way."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from clast.calibration import layout
from clast.calibration.record import Record as Account
from clast.studies.work import DONE
from clast_viz.report.calibration import Calibration
from clast_viz.report.ended import axes, ended
from clast_viz.report.links import address, data_address, links
from clast_viz.report.measured import number
from clast_viz.report.parameters import sections
from clast_viz.report.tables import Record

TEMPLATE = "calibration.html"
FILES = {
    layout.FITTED: "the scene with the fitted parameters, for clast run",
    layout.PAGE: "the account as text",
    layout.ACCOUNT: "the account as data",
    layout.HISTORY: "all points",
    layout.RUNS: "all runs",
    layout.ASKED: "the calibration as it was asked for",
}


def values_of_calibration(found: Calibration, page: Path) -> dict[str, Any]:
    """Return what the template of calibrations is filled with."""
    told = found.account
    runs = ended(found.runs, ["point", *axes(found.runs)], found.folder, page)
    named = told.name if told is not None else found.asked.get("calibration")
    return {
        "title": str(named or found.folder.resolve().name),
        "description": str(found.asked.get("description") or ""),
        "account": told,
        "targets": _targets(told) if told is not None else [],
        "ended": runs,
        "undone": [each for each in runs if each.state != DONE],
        "run_heads": ["point", *axes(found.runs), "repeat"],
        "begun": [(address(each, page), each.name) for each in found.begun],
        "history": _history(found.history),
        "picture": data_address(found.picture) if found.picture is not None else "",
        "asked": sections(found.asked),
        "folder": address(found.folder, page),
        "place": found.folder.resolve().name,
        "links": links(found.folder, page, FILES),
    }


def _targets(told: Account) -> list[tuple[list[str], str]]:
    """Return the rows of the targets, each with its class: good where it is met within its tolerance."""
    classes = ["good" if abs(distance) <= 1.0 else "bad" for distance in told.distances]
    return list(zip(told.targets.rows, classes, strict=True))


def _history(rows: Sequence[Record]) -> list[list[str]]:
    """Return a table with one row a point, its heads first; nothing where there is none."""
    return [list(rows[0]), *([number(text) for text in row.values()] for row in rows)] if rows else []

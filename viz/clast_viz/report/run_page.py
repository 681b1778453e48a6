"""The page about runs: what of each, and of all beside each other, goes into its template."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from clast_viz import picture
from clast_viz.report import words
from clast_viz.report.links import Link, address, data_address, links
from clast_viz.report.opened import Opened
from clast_viz.report.parameters import MISSING, Row, differences, sections
from clast_viz.report.section import members
from clast_viz.report.sections import chart_sections

TEMPLATE = "runs.html"


class View(NamedTuple):
    """What a page shows of one run by itself."""

    label: str
    name: str
    description: str
    versions: str
    style: dict[str, str] | None
    warnings: list[str]
    headline: list[words.Figure]
    folder: str
    place: str
    links: list[Link]
    picture: str
    pictured: str
    parameters: dict[str, list[Row]]


def values_of_runs(opened: Sequence[Opened], page: Path) -> dict[str, Any]:
    """Return what the template of runs is filled with."""
    readable = members([(each.run, each.label) for each in opened if each.run is not None])
    styles = {member.label: member.style for member in readable}
    views = [_view(each, styles.get(each.label), page) for each in opened]
    configured = [each for each in opened if each.config]
    differing = differences([each.config for each in configured])
    return {
        "title": _title(views),
        "views": views,
        "table_rows": _table(opened),
        "compared": [each.label for each in configured],
        "differing": [[row.key, *row.values] for row in differing if MISSING not in row.values],
        "only_some": [[row.key, *row.values] for row in differing if MISSING in row.values],
        "sections": list(chart_sections(readable)),
    }


def _title(views: Sequence[View]) -> str:
    names = dict.fromkeys(view.name for view in views)
    together = ", ".join(list(names)[:3]) + (", …" if len(names) > 3 else "")
    return together if len(views) == 1 else f"{together}: {len(views)} runs"


def _view(opened: Opened, style: dict[str, str] | None, page: Path) -> View:
    run, config = opened.run, opened.config
    png = opened.folder / picture.FILE
    return View(
        label=opened.label,
        name=run.name if run is not None else str(config.get("name") or opened.label),
        description=str(config.get("description") or ""),
        versions=_versions(run.summary if run is not None else {}),
        style=style,
        warnings=words.warnings(opened),
        headline=words.headline(run) if run is not None else [],
        folder=address(opened.folder, page),
        place=opened.folder.resolve().name,
        links=links(opened.folder, page),
        picture=data_address(png) if png.is_file() else "",
        pictured=picture.meaning(run) if run is not None else "",
        parameters=sections(config),
    )


def _versions(summary: dict[str, Any]) -> str:
    """Return what computed a run, as its summary tells it."""
    versions = summary.get("versions")
    return ", ".join(f"{name} {each}" for name, each in versions.items()) if isinstance(versions, dict) else ""


def _table(opened: Sequence[Opened]) -> list[Row]:
    told = [words.rows(each) for each in opened]
    keys = dict.fromkeys(key for rows in told for key in rows)
    return [Row(key, [rows.get(key, "") for rows in told]) for key in keys]

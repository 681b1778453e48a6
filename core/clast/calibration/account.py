"""Account of a calibration: what was fitted, how well, how surely, and what each parameter does."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from clast.calibration.fit import Fit, Floats
from clast.calibration.identify import LOOSE
from clast.calibration.layout import ACCOUNT, FITTED, HISTORY, PAGE, PICTURE, RUNS
from clast.calibration.proposal import misfit
from clast.calibration.record import Grid, Record, write_record
from clast.calibration.responses import Goal
from clast.config.yaml_loader import dump_yaml
from clast.reproduce.section import table
from clast.results.whole_file import whole_file
from clast.studies.plots import STYLE, axis_label, few_ticks
from clast.studies.readable import readable
from clast.studies.table import write_csv
from clast.studies.work import DONE

AT_THE_END = 0.01
"""Share of a range that counts as its end."""


def parameter_rows(fit: Fit) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows of the table of parameters."""
    rows = []
    for axis, setting, place, share in zip(
        fit.axes, fit.point, fit.shares[fit.best], fit.identified.deviation, strict=True
    ):
        low, high = (axis.at(end).number or 0.0 for end in (0.0, 1.0))
        told = f"± {share * abs(axis.slope(float(place))):.2g}" if share < LOOSE else "not determined"
        rows.append([axis.name, f"{low:.4g} to {high:.4g}", f"{setting.number:.4g}", told])
    return ["parameter (SI)", "range", "fitted", "standard deviation"], rows


def target_rows(fit: Fit) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows of the table of targets, at the point that was found."""
    rows = []
    for goal, found, mean, sure in zip(fit.goals, fit.responses[fit.best], *fit.expected(), strict=True):
        expected = f"{goal.value + goal.scale * mean:.4g} ± {goal.scale * sure:.2g}"
        got = f"{found.value:.4g} ± {found.error:.2g}"
        rows.append([goal.name, f"{goal.value:.4g} ± {goal.scale:.2g}", got, expected, f"{mean:+.2f}"])
    return ["target (SI)", "wanted ± within", "runs there", "by all runs", "off, in tolerances"], rows


def slope_rows(fit: Fit) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows of the table of sensitivities at the optimum."""
    slopes = fit.surrogate.slopes(fit.shares[fit.best])
    rows = [[goal.name, *(f"{slope:+.1f}" for slope in row)] for goal, row in zip(fit.goals, slopes, strict=True)]
    return ["tolerances over the whole range", *(axis.name for axis in fit.axes)], rows


def confusions(fit: Fit) -> list[str]:
    """Return what the targets leave open, in words: sentences without their full stop."""
    told = []
    names = [axis.name for axis in fit.axes]
    for members in fit.identified.loose:
        if len(members) == 1:
            told.append(f"{names[members[0]]} is hardly determined: near the optimum the targets do not notice it")
        else:
            listed = " and ".join(names[k] for k in members)
            told.append(f"{listed} cannot be told apart: they can change together without the targets noticing")
    for axis, share, sure in zip(fit.axes, fit.shares[fit.best], fit.identified.deviation, strict=True):
        if not AT_THE_END < share < 1.0 - AT_THE_END:
            wider = "a wider range may fit better" if sure < LOOSE else "but there the targets hardly notice it"
            told.append(f"{axis.name} lies at the end of its range: {wider}")
    if len(fit.goals) < len(names):
        told.append(f"{len(names)} parameters, {len(fit.goals)} targets: some of the former are not determined")
    return told


def page(fit: Fit) -> str:
    """Return the account as Markdown."""
    config, runs, failed = fit.config, len(fit.table.rows), _failed(fit)
    lost = f", {failed} of them failed" if failed else ""
    parts = [
        f"# {config.calibration}",
        config.description,
        f"{len(fit.shares)} points of {config.repeats} runs, {runs} runs in all{lost}: {config.first_points} points "
        "fill the space (Sobol), the others promised most improvement by a Gaussian process of every target, the last "
        f"is its optimum. `{FITTED}` is the scene with the fitted parameters.",
        "## Parameters",
        table(*parameter_rows(fit)),
        "The standard deviation is what the targets leave of the range, from the Fisher information at the optimum, "
        "with the larger of tolerance and standard error as their error.",
        *(f"- {told}." for told in confusions(fit)),
        "## Targets",
        table(*target_rows(fit)),
        "## Sensitivities",
        "How much each target changes, in units of its tolerance, when a parameter goes through its whole range with "
        "the slope that it has at the optimum.",
        table(*slope_rows(fit)),
        f"![Targets along each parameter]({PICTURE})",
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _failed(fit: Fit) -> int:
    return sum(row.state != DONE for row in fit.table.rows)


def record(fit: Fit) -> Record:
    """Return the account as data."""
    grids = [Grid(heads=heads, rows=rows) for heads, rows in (parameter_rows(fit), target_rows(fit), slope_rows(fit))]
    return Record(
        name=fit.config.calibration,
        description=fit.config.description,
        points=len(fit.shares),
        repeats=fit.config.repeats,
        runs=len(fit.table.rows),
        failed=_failed(fit),
        best=fit.best,
        parameters=grids[0],
        targets=grids[1],
        sensitivities=grids[2],
        distances=fit.expected()[0].tolist(),
        left_open=[f"{told}." for told in confusions(fit)],
    )


def write(fit: Fit, folder: Path) -> list[Path]:
    """Write the fitted scene, the history, all runs, the account and its picture; last what says that all is there."""
    paths = [folder / name for name in (FITTED, PAGE, HISTORY, RUNS, PICTURE, ACCOUNT)]
    head = f"# Fitted by: clast calibrate, {fit.config.calibration}; see {PAGE}\n"
    for path, text in ((paths[0], head + dump_yaml(fit.scene.resolved())), (paths[1], page(fit))):
        with whole_file(path) as draft:
            draft.write_text(text, encoding="utf-8")
    write_history(fit, paths[2])
    write_csv(fit.table, paths[3])
    draw(fit, paths[4])
    write_record(record(fit), paths[5])
    return paths


def write_history(fit: Fit, path: Path) -> None:
    """Write one line a point: its parameters, the response of every goal with its error, and the misfit."""
    with whole_file(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        pairs = [text for goal in fit.goals for text in (goal.name, f"error of {goal.name}")]
        writer.writerow(["point", *(axis.name for axis in fit.axes), *pairs, "misfit"])
        for k, (shares, told) in enumerate(zip(fit.shares, fit.responses, strict=True)):
            numbers = [setting.number for setting in fit.settings(shares)]
            residuals = [(each.value - goal.value) / goal.scale for each, goal in zip(told, fit.goals, strict=True)]
            values = [x for each in told for x in each]
            writer.writerow([k, *map(repr, numbers), *map(_text, values), _text(float(misfit(np.array(residuals))))])


def _text(value: float) -> str:
    return f"{value:.9g}" if np.isfinite(value) else ""


def draw(fit: Fit, path: Path) -> None:
    """Draw every goal along every parameter through the optimum, with the points that were run."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(3.0 * len(fit.axes), 2.6 * len(fit.goals)), layout="constrained")
        FigureCanvasAgg(figure)
        panels = figure.subplots(len(fit.goals), len(fit.axes), sharex="col", sharey="row", squeeze=False)
        for row, k in zip(panels, range(len(fit.goals)), strict=True):
            for panel, axis in zip(row, range(len(fit.axes)), strict=True):
                _draw_one(panel, fit, k, axis)
            row[0].set_ylabel(_label(fit.goals[k]))
        for panel, axis_ in zip(panels[-1], fit.axes, strict=True):
            few_ticks(panel)
            panel.set_xlabel(axis_label(axis_.name, axis_.unit))
        with whole_file(path) as draft:
            figure.savefig(draft, format="png", dpi=110, metadata={"Software": None})


def _label(goal: Goal) -> str:
    words, unit, _ = readable(goal.measure)
    told = goal.name.replace(goal.measure, words)
    return f"{told}, {unit}" if unit else told


def _draw_one(panel: Any, fit: Fit, k: int, axis: int) -> None:
    goal, grid, factor = fit.goals[k], np.linspace(0.0, 1.0, 61), readable(fit.goals[k].measure).factor
    line = np.repeat(fit.shares[fit.best][None], len(grid), axis=0)
    line[:, axis] = grid
    mean, deviation = (factor * goal.scale * each[:, k] for each in fit.surrogate.predict(line))
    value, scale = factor * goal.value, factor * goal.scale
    x = _numbers(fit, axis, grid)
    if fit.axes[axis].config.spacing == "log":
        panel.set_xscale("log")
    panel.axhspan(value - scale, value + scale, color="#ee6677", alpha=0.25, linewidth=0.0)
    panel.plot(x, value + mean, color="#4477aa", linewidth=1.4)
    panel.fill_between(x, value + mean - deviation, value + mean + deviation, color="#4477aa", alpha=0.2, linewidth=0.0)
    told = factor * np.array([each[k] for each in fit.responses])
    panel.errorbar(
        _numbers(fit, axis, fit.shares[:, axis]),
        told[:, 0],
        yerr=told[:, 1],
        fmt="o",
        color="#777777",
        markersize=2.5,
        linewidth=0.7,
    )
    panel.plot(_numbers(fit, axis, fit.shares[fit.best, axis : axis + 1]), told[fit.best, :1], "o", color="black")


def _numbers(fit: Fit, axis: int, shares: Floats) -> list[float]:
    return [fit.axes[axis].at(float(share)).shown or 0.0 for share in shares]

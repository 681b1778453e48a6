"""Comparison of runs: several stress–strain curves in one figure."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from clast.errors import RunError
from clast.results.reference import Reference
from clast.results.run import Run
from clast.results.whole_file import whole_file
from clast_viz.curves import has_compression
from clast_viz.figure import STYLE, draw_references, finish_axes, new_axes, save

# Tol's "bright" scheme (personal.sron.nl/~pault), told apart by colour-blind readers;
# its blue is left to the measurement.
COLOURS = ("#ee6677", "#228833", "#aa3377", "#ccbb44", "#66ccee", "#555555")
DASHES = ("-", "--", ":", "-.")


class Line(NamedTuple):
    """A run in a comparison: its label in the legend, none where empty, and how its curves are drawn."""

    run: Run
    label: str
    style: dict[str, str]


def line_style(k: int) -> dict[str, str]:
    """Return colour and dashes of the k-th run: the same colour comes again with other dashes.

    >>> line_style(0)["color"] == line_style(6)["color"], line_style(6)["linestyle"]
    (True, '--')
    """
    return {"color": COLOURS[k % len(COLOURS)], "linestyle": DASHES[k // len(COLOURS) % len(DASHES)]}


def plot_stress_strain(
    runs: Sequence[Run],
    labels: Sequence[str],
    path: Path,
    *,
    dpi: int = 200,
    title: str = "",
    reference: bool = True,
) -> Path:
    """Draw the stress–strain curves of several runs over each other, with the bonds broken below.

    Parameters
    ----------
    runs : sequence of Run
        Runs with a compression curve.
    labels : sequence of str
        One label per run.
    path : Path
        PNG file to write.
    dpi : int
        Resolution in dots per inch.
    title : str
        Heading, none when empty.
    reference : bool
        Whether to draw the measured points that the first run names.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    RunError
        If a run has no compression curve, or there is not one label per run.
    """
    if not runs or len(runs) != len(labels):
        raise RunError(f"a comparison needs one label per run; got {len(runs)} runs and {len(labels)} labels")
    without = [str(run.folder) for run in runs if not has_compression(run)]
    if without:
        raise RunError(f"no compression curve in {', '.join(without)}; only runs with `compression` compare")
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        lines = [Line(run, label, line_style(k)) for k, (run, label) in enumerate(zip(runs, labels, strict=True))]
        figure = comparison_figure(lines, runs[0].reference if reference else [])
        if title:
            figure.suptitle(title, x=0.02, ha="left", fontsize=11.0)
        with whole_file(path) as draft:
            save(figure, draft, dpi)
    return path


def comparison_figure(lines: Sequence[Line], references: Sequence[Reference]) -> Any:
    """Return a figure of stress–strain curves over each other, the bonds broken below; every run must have a curve."""
    figure, upper, lower = new_axes(with_bonds=any(len(line.run.bond_ends) for line in lines))
    for run, label, style in lines:
        percent = 100.0 * run.curves["strain"]
        upper.plot(percent, run.curves["stress_Pa"] / 1e6, linewidth=1.5, label=label, **style)
        if lower is not None:
            lower.plot(percent, run.curves["bonds_broken"], linewidth=1.3, **style)
    draw_references(upper, references)
    finish_axes(upper, lower)
    return figure

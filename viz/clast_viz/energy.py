"""Energy: where the work that goes into a scene stays, stacked over strain or time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.curves import energies
from clast.results.run import Run
from clast_viz.curves import has_compression, time_axis
from clast_viz.figure import STYLE, save

FILE = "energy.png"
Energies = dict[str, NDArray[np.float64]]
SMALL = 1e-3
"""Share of the largest sum below which a term is left out of the picture."""


class Band(NamedTuple):
    """One band of the stack: a colour, and the terms of the ledger it sums up."""

    label: str
    colour: str
    terms: tuple[str, ...]


BANDS = (
    Band("elastic: bonds", "#2166ac", ("bond_elastic",)),
    Band("elastic: contacts", "#67a9cf", ("contact_elastic",)),
    Band("kinetic", "#fdb863", ("kinetic",)),
    Band("micro-crack drops", "#b2182b", ("drops",)),
    Band("plastic work, damage", "#d6604d", ("plastic",)),
    Band("broken bonds", "#7f3b08", ("broken",)),
    Band("sliding and rolling", "#5aae61", ("sliding", "rolling", "contact_stiffening")),
    Band("dashpots of contacts", "#a6dba0", ("contact_viscous",)),
    Band("dashpots of bonds", "#c2a5cf", ("bond_viscous",)),
    Band("damping of motion", "#dfc27d", ("braked",)),
    Band("left with particles", "#bababa", ("left",)),
)
WORK = ("start", "walls", "driven", "applied", "body", "box", "woken")


class EnergyParams(Params):
    """What the user can choose about the figure."""

    dpi: Annotated[int, Field(ge=50, le=1200, description="Resolution in dots per inch")] = 200


def write_energy(run: Run, params: EnergyParams, path: Path) -> Written:
    """Write ``energy.png``: the terms of the ledger stacked, the work done on the scene as a line over them."""
    energy = energies(run.curves)
    if not energy:
        return Written(None, "the energies were not booked; set output.ledger: true")
    if len(run.curves["time_s"]) < 2:
        return Written(None, "fewer than two samples were taken")
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        figure = energy_figure(*energy_axis(run), energy)
        figure.axes[0].set_title(f"{run.name}: {closing(energy)}", fontsize=10, loc="left")
        save(figure, path, params.dpi)
    return Written(path)


def energy_axis(run: Run) -> tuple[NDArray[np.float64], str]:
    """Return what energies are drawn over, and its label: strain, or time where there is none."""
    if has_compression(run):
        return 100.0 * run.curves["strain"], "strain [%]"
    return time_axis(run.curves["time_s"])


def closing(energy: Energies) -> str:
    """Return how well a ledger closes, as a sentence."""
    error = float(np.abs(energy["error"]).max()) / _top(_work(energy))
    return f"the ledger closes to {error:.0e} of the work"


def energy_figure(x: NDArray[np.float64], label: str, energy: Energies) -> Any:
    """Return a figure of the bands stacked over (s,) values of strain or time, with the work as a line over them."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.6, 4.4), layout="constrained")
    _draw(figure.subplots(), x, label, energy)
    return figure


def _work(energy: Energies) -> NDArray[np.float64]:
    return sum((energy[name] for name in WORK if name in energy), np.zeros_like(energy["kinetic"]))


def _top(work: NDArray[np.float64]) -> float:
    return max(float(np.abs(work).max()), 1e-300)


def _draw(axes: Any, x: NDArray[np.float64], label: str, energy: Energies) -> None:
    work = _work(energy)
    bands = {band: sum((energy[name] for name in band.terms if name in energy), np.zeros_like(work)) for band in BANDS}
    top = _top(work)
    shown = {band: values for band, values in bands.items() if np.abs(values).max() > SMALL * top}
    scale, unit = unit_of(top)
    axes.stackplot(
        x,
        *(scale * np.maximum(values, 0.0) for values in shown.values()),
        labels=[band.label for band in shown],
        colors=[band.colour for band in shown],
        linewidth=0.0,
    )
    axes.plot(x, scale * work, color="black", linewidth=1.3, label="work put in")
    axes.set_xlabel(label)
    axes.set_ylabel(f"energy [{unit}]")
    axes.margins(x=0.0)
    axes.set_ylim(bottom=0.0)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="upper left", bbox_to_anchor=(1.0, 1.0))


def unit_of(joules: float) -> tuple[float, str]:
    """Return the factor and the name of a unit in which an energy reads well.

    >>> unit_of(3e-3)
    (1000.0, 'mJ')
    """
    for factor, name in ((1.0, "J"), (1e3, "mJ"), (1e6, "µJ"), (1e9, "nJ")):
        if joules * factor >= 1.0:
            return factor, name
    return 1e12, "pJ"

"""What a report says of a run: warnings, the numbers that matter most, and the table of all of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from clast.results.in_words import summary_rows
from clast.results.reference import Reference
from clast.results.run import Run
from clast_viz.curves import has_compression, peak
from clast_viz.report.opened import Opened

WARNING = "WARNING"
CLOSES = 0.01
"""Share of the work up to which a ledger closes without a warning."""


class Figure(NamedTuple):
    """A number that matters: what it is, the number, and what to compare it with."""

    what: str
    value: str
    note: str


def rows(opened: Opened) -> dict[str, str]:
    """Return all that a run tells of itself, by what it is; nothing of a run that cannot be read."""
    if opened.run is None:
        return {}
    told = _summary_rows(opened.run)
    return told if told is not None else _rows_so_far(opened.run)


def _summary_rows(run: Run) -> dict[str, str] | None:
    """Return the rows of a summary, None where there is none or it is not of this version."""
    try:
        told = dict(summary_rows(run.summary))
    except (KeyError, TypeError, ValueError):
        return None
    told.pop(WARNING, None)  # stands at the top of the page
    return told


def _rows_so_far(run: Run) -> dict[str, str]:
    told = {"particles, bonds": f"{len(run.radius)}, {len(run.bond_ends)}"}
    if "time_s" in run.curves and len(run.curves["time_s"]):
        told["simulated until"] = f"{run.curves['time_s'][-1]:.4g} s"
    if has_compression(run):
        top = peak(run)
        told["strain reached"] = f"{np.nanmax(run.curves['strain']):.2%}"
        told["peak stress"] = f"{top.stress / 1e6:.3f} MPa at {top.strain:.2%}"
    if len(run.bond_ends):
        told["bonds broken"] = f"{_broken(run)} ({_broken(run) / len(run.bond_ends):.1%})"
    return told


def _broken(run: Run) -> int:
    broken = run.curves.get("bonds_broken")
    return int(broken[-1]) if broken is not None and len(broken) else 0


def warnings(opened: Opened) -> list[str]:
    """Return what a reader must know before looking at any number."""
    if opened.run is None:
        return [opened.damage]
    run = opened.run
    told = list(_of_the_end(run))
    summary, energy = run.summary, run.summary.get("energy") or {}
    if summary.get("time_step_warning"):
        told.append(str(summary["time_step_warning"]))
    told += map(str, summary.get("warnings") or ())
    if summary.get("particles_removed"):
        told.append(f"{summary['particles_removed']} particles left the domain and were removed.")
    return told + (list(_of_energy(energy)) if isinstance(energy, dict) else [])


def _of_the_end(run: Run) -> Iterator[str]:
    if not run.complete:
        yield "The run has not come to its end: this is what it wrote until then. Go on with clast run --resume."
    elif _summary_rows(run) is None:
        yield "The run has no summary that this version can read; what follows is read off its curves."
    if run.complete and run.summary.get("peak_inside_run") is False and run.summary.get("peak_stress_Pa") != 0.0:
        yield "The stress had not fallen by a fifth when the run ended: its highest value need not be the peak."


def _of_energy(energy: dict[str, Any]) -> Iterator[str]:
    closure = energy.get("closure")
    if energy.get("incomplete"):
        yield f"Energy ledger: {energy['incomplete']}."
    elif isinstance(closure, float) and abs(closure) > CLOSES:
        yield f"The energy ledger closes to no better than {abs(closure):.1%} of the work."
    if energy.get("quasi_static") is False:
        yield (
            f"Not quasi-static before the peak: kinetic over elastic energy "
            f"{_short(energy.get('kinetic_per_elastic_before_peak'))}, inertial number "
            f"{_short(energy.get('inertial_number_at_peak'))}."
        )


def _short(value: Any) -> str:
    return f"{value:.1e}" if isinstance(value, float) else "unknown"


def headline(run: Run) -> list[Figure]:
    """Return the numbers that a reader looks for first, measured ones beside them."""
    told = [*_of_curve(run, run.reference), *_of_bonds(run)]
    energy = run.summary.get("energy")
    if isinstance(energy, dict) and isinstance(energy.get("closure"), float):
        calm = {True: "; quasi-static", False: "; not quasi-static"}.get(energy.get("quasi_static"), "")  # type: ignore[arg-type]
        told.append(Figure("energy unaccounted for", f"{100 * abs(energy['closure']):.2g} %", f"of the work{calm}"))
    return told


def _of_curve(run: Run, references: Sequence[Reference]) -> Iterator[Figure]:
    if not has_compression(run):
        return
    top = peak(run)
    if top.stress <= 0.0:
        yield Figure("peak stress", "none", "the upper wall met nothing")
        return
    stress = strain = ""
    if references:
        first = references[0]
        stress = f"measured {_scattered(first.stress / 1e6, first.stress_deviation / 1e6, '.2f')} MPa"
        strain = f"measured {_scattered(100 * first.strain, 100 * first.strain_deviation, '.1f')} %"
    yield Figure("peak stress", f"{top.stress / 1e6:.2f} MPa", stress)
    yield Figure("strain at peak", f"{100 * top.strain:.1f} %", strain)
    for key, what, note in (
        ("secant_modulus_20_80_Pa", "secant modulus", "from 20 to 80 % of the peak"),
        ("hertz_modulus_at_2_percent_Pa", "Hertz modulus", "at 2 % strain"),
    ):
        if isinstance(run.summary.get(key), float):
            yield Figure(what, f"{_rounded(run.summary[key] / 1e6)} MPa", note)


def _rounded(value: float) -> str:
    return f"{value:,.0f}" if abs(value) >= 100.0 else f"{value:.1f}"


def _scattered(value: float, deviation: float, form: str) -> str:
    return f"{value:{form}} ± {deviation:{form}}" if deviation else f"{value:{form}}"


def _of_bonds(run: Run) -> Iterator[Figure]:
    count = len(run.bond_ends)
    if not count:
        return
    yield Figure("bonds broken", f"{_broken(run) / count:.1%}".replace("%", " %"), f"{_broken(run)} of {count}")
    pieces, largest = run.summary.get("fragments"), run.summary.get("largest_fragment_particles")
    if isinstance(pieces, int) and isinstance(largest, int):
        share = f"{100 * largest / len(run.radius):.0f} %"
        yield Figure("fragments", f"{pieces}", f"the largest has {share} of the particles")

"""What a summary says, in words: what ``clast run`` prints at its end, and what a report shows."""

from __future__ import annotations

from typing import Any

from clast.forecast import duration
from clast.results.energy import sentence
from clast.results.side import side_rows


def summary_rows(summary: dict[str, Any]) -> list[tuple[str, str]]:
    """Return what a summary tells, as pairs of what it is and the text for it."""
    counts = summary["counts"]
    rows = [("particles, bonds", f"{counts['particles']}, {counts['bonds']}")]
    if "peak_stress_Pa" in summary:
        rows.append(("peak stress", peak_text(summary)))
        for key, text in (
            ("secant_modulus_20_80_Pa", "secant modulus, 20 to 80 %"),
            ("hertz_modulus_at_2_percent_Pa", "Hertz modulus at 2 %"),
        ):
            if summary[key] is not None:
                rows.append((text, f"{summary[key] / 1e6:.1f} MPa"))
    if "side_wall" in summary:
        rows += side_rows(summary["side_wall"])
    if counts["bonds"]:
        rows.append(("bonds broken", f"{summary['bonds_broken']} ({summary['bonds_broken'] / counts['bonds']:.1%})"))
        rows.append(("fragments", f"{summary['fragments']}"))
    if "grains" in summary:
        told = summary["grains"]
        rows.append(("grains intact, damaged, crushed", f"{told['intact']}, {told['damaged']}, {told['crushed']}"))
    if summary["particles_removed"]:
        rows.append(("particles that left", f"{summary['particles_removed']}"))
    if "energy" in summary:
        rows.append(("energy ledger", sentence(summary["energy"])))
    rate = summary["steps_per_s"]
    rows.append(("steps", steps_text(summary)))
    if summary.get("ended_by"):
        rows.append((f"ended by {summary['ended_by']['by']}", summary["ended_by"]["reason"]))
    if summary["time_step_warning"]:
        rows.append(("WARNING", summary["time_step_warning"]))
    rows += [("WARNING", text) for text in summary.get("warnings", ())]
    if summary.get("particles_made_heavier"):
        share = summary["added_mass_share_of_kinetic_energy"]
        text = f"{summary['particles_made_heavier']} particles, {summary['added_mass_kg']:.3g} kg more in all"
        rows.append(("made heavier", text + (f", {share:.1%} of the kinetic energy" if share is not None else "")))
    rows.append(("run time", f"{duration(summary['wall_time_s'])}, {rate:,.0f} steps/s" if rate else "none"))
    rows.append(("memory", f"{summary['memory_MB']:.0f} MB"))
    return rows


def peak_text(summary: dict[str, Any]) -> str:
    """Return how large the peak of a compression was, and where.

    >>> peak_text({"peak_stress_Pa": 2e6, "strain_at_peak": 0.05, "peak_inside_run": True})
    '2.000 MPa at 5.00%'
    """
    if summary["peak_stress_Pa"] <= 0.0:
        return "none: the upper wall met nothing"
    where = "" if summary["peak_inside_run"] else " (still rising or not yet fallen by a fifth)"
    return f"{summary['peak_stress_Pa'] / 1e6:.3f} MPa at {summary['strain_at_peak']:.2%}{where}"


def steps_text(summary: dict[str, Any]) -> str:
    """Return how many steps were taken, how long they were, and which limit ruled.

    >>> changes = [{"step": 50, "time": 0.1, "dt": 0.001}]
    >>> told = {"steps": 90, "time_step_s": 0.002, "time_step_changes": changes, "time_step_ruled_by": "spectral"}
    >>> steps_text(told)
    '90 of 0.002 s (limit: spectral), shortened once to 0.001 s'
    """
    rule, changes = summary["time_step_ruled_by"], summary["time_step_changes"]
    text = f"{summary['steps']} of {summary['time_step_s']:.3g} s" + (f" (limit: {rule})" if rule else "")
    if not changes:
        return text
    times = "once" if len(changes) == 1 else f"{len(changes)} times"
    return f"{text}, shortened {times} to {changes[-1]['dt']:.3g} s"

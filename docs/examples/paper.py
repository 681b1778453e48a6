"""Run the paper's single grains: ``python docs/examples/paper.py``.

Prints the tables of docs/paper.md and draws its figures: Figs. 5, 9 and 23 of Rotter, Dosta and Düster (2023) in both
settings and several packings; about ten minutes on two cores. Runs that are there already are not repeated.
"""

import argparse
import json
import shutil
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

import numpy as np

import clast
from clast_viz.compare import COLOURS, plot_stress_strain

ROOT = Path(__file__).parents[2]
CONFIGS, IMAGES = ROOT / "configs", ROOT / "docs" / "img"
MODELS = (1, 2, 3)
SETTINGS = {"paper": "", "paper-text": "_text"}
PRINTED = {"bonds.model.compressive_break": 0, "bonds.model.weakening_factor": 1}
"""Equations as printed: no break in compression, Eq. 12 without a factor."""
COLUMNS = (
    "peak MPa",
    "at strain %",
    "slope MPa",
    "slope 5–15 % MPa",
    "largest fall within 1 % strain, % of peak",
    "broken at peak / 25 %, %",
)


class Job(NamedTuple):
    """One run: its name is that of its folder."""

    name: str
    scene: str
    changes: dict


def jobs() -> list[Job]:
    """Return all runs, those of one compiled loop one after the other."""
    grains = [
        Job(f"fig09_model{model}{text}_{seed}", f"paper/fig09_model{model}{text}.yaml", {"particles.seed": seed})
        for model in MODELS
        for text in SETTINGS.values()
        for seed in (1, 2)
    ]
    best = [Job(f"crush_grain_{seed}", "crush_grain.yaml", {"particles.seed": seed}) for seed in (1, 2, 3)]
    bonds = [Job(f"fig05_model{model}", f"paper/fig05_model{model}.yaml", {}) for model in MODELS]
    return [*bonds, *grains, *best, Job("crush_grain_text", "crush_grain.yaml", PRINTED)]


def run(job: Job, folder: Path) -> str:
    """Run one job unless its results are there."""
    place = folder / job.name
    if not (place / "summary.json").exists():
        scene = clast.load(CONFIGS / job.scene).changed(job.changes)
        clast.run_scene(scene, place, resume=(place / "results.h5").exists(), threads=1)
    return job.name


def row(folder: Path, name: str, label: str) -> str:
    """Return one line of the table of a grain."""
    told = json.loads((folder / name / "summary.json").read_text())
    with clast.open_run(folder / name) as found:
        strain, stress, broken = (found.curves[key] for key in ("strain", "stress_Pa", "bonds_broken"))
    peak, bonds = int(np.argmax(stress)), told["counts"]["bonds"]
    rising = "" if told["peak_inside_run"] else " (rising)"
    shares = f"{100 * broken[peak] / bonds:.0f} / {100 * broken[-1] / bonds:.0f}"
    return (
        f"| {label} | {stress[peak] / 1e6:.2f} | {100 * strain[peak]:.1f}{rising} "
        f"| {told['secant_modulus_20_80_Pa'] / 1e6:.1f} | {slope(strain, stress):.1f} "
        f"| {100 * largest_fall(strain, stress) / stress[peak]:.0f} | {shares} |"
    )


def slope(strain: np.ndarray, stress: np.ndarray) -> float:
    """Return the secant modulus from 5 to 15 % strain in MPa."""
    low, high = np.interp((0.05, 0.15), strain, stress)
    return float(high - low) / 0.1 / 1e6


def largest_fall(strain: np.ndarray, stress: np.ndarray) -> float:
    """Return the largest fall of the stress within 1 % strain in Pa."""
    window = max(1, int(np.searchsorted(strain, strain[0] + 0.01)))
    return float(max((stress[:-k] - stress[k:]).max() for k in range(1, window + 1)))


def print_head(name: str) -> None:
    """Print the head of a table."""
    print(f"\n| {' | '.join((name, *COLUMNS))} |\n|{'---|' * (1 + len(COLUMNS))}")


def print_grains(folder: Path) -> None:
    """Print the table of Fig. 9 for each packing, and of Fig. 23."""
    for seed in (1, 2):
        with clast.open_run(folder / f"fig09_model1_{seed}") as found:
            head = f"seed {seed} ({len(found.bond_ends)} bonds)"
        print_head(head)
        for setting, text in SETTINGS.items():
            for model in MODELS:
                print(row(folder, f"fig09_model{model}{text}_{seed}", f"`{setting}`, Model {model}"))
    print_head("Fig. 23")
    for name in ("1", "2", "3", "text"):
        print(row(folder, f"crush_grain_{name}", "as printed, seed 1" if name == "text" else f"seed {name}"))
    peaks = [json.loads((folder / f"crush_grain_{k}" / "summary.json").read_text()) for k in (1, 2, 3)]
    for key, factor in (("peak_stress_Pa", 1e-6), ("strain_at_peak", 100.0), ("hertz_modulus_at_2_percent_Pa", 1e-6)):
        values = factor * np.array([each[key] for each in peaks])
        print(f"{key}: {values.mean():.2f} ± {values.std(ddof=1):.2f}, seeds {np.round(values, 2).tolist()}")


def draw_grains(folder: Path) -> None:
    """Draw Fig. 9 in both settings, and keep the pictures of the optimised grain."""
    labels = [f"Model {model}" for model in MODELS]
    for setting, text in SETTINGS.items():
        runs = [clast.open_run(folder / f"fig09_model{model}{text}_1") for model in MODELS]
        path = IMAGES / f"fig09_{setting.replace('-', '_')}.png"
        plot_stress_strain(runs, labels, path, dpi=110, title=f"Fig. 9, setting {setting}")
        for each in runs:
            each.close()
    for ours, there in (("picture", ""), ("stress_strain", "_curve"), ("energy", "_energy")):
        shutil.copyfile(folder / "crush_grain_1" / f"{ours}.png", IMAGES / f"crush_grain{there}.png")


def draw_bonds(folder: Path) -> None:
    """Draw Fig. 5: the stress in one bond against its strain."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.8, 3.8), layout="constrained")
    axes = figure.add_subplot(xlabel="axial strain of the bond [%]", ylabel="normal stress [MPa]")
    for model, colour in zip(MODELS, COLOURS, strict=False):
        with clast.open_run(folder / f"fig05_model{model}") as found:
            track = found.tracks["bonds"]
        stress = np.where(track["intact"][:, 0] > 0, track["normal_stress"][:, 0], 0.0)
        axes.plot(100 * track["axial_strain"][:, 0], stress / 1e6, color=colour, label=f"Model {model}")
    axes.set(xlim=(0, None), ylim=(0, None))
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, loc="upper left")
    figure.savefig(IMAGES / "fig05.png", dpi=100)


def main() -> None:
    """Run what is missing, print the tables, draw the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=Path, default=Path("runs/paper"), help="folder of the runs")
    given = parser.parse_args()
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        for name in pool.map(run, (found := jobs()), [given.runs] * len(found)):
            print(name, flush=True)
    print_grains(given.runs)
    draw_grains(given.runs)
    draw_bonds(given.runs)


if __name__ == "__main__":
    main()

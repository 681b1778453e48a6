"""Compare Clast with MUSEN on one grain: ``python docs/examples/parity.py`` prints the tables and draws the figure.

Runs the grain with MUSEN's choices, with Clast's defaults and with one default at a time; about ten minutes on two
cores. Runs that are there already are not repeated. docs/parity.md says what comes out and why.
"""

import argparse
import csv
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

import numpy as np

import clast

ROOT = Path(__file__).parents[2]
SCENE = ROOT / "configs" / "parity" / "musen_grain_a.yaml"
MUSEN = ROOT / "tests" / "data" / "musen" / "grain_a"
REPEATS = range(5)
STRAINS = (0.025, 0.05, 0.10, 0.15, 0.20)
SCATTER = (0.054, 0.07, 0.085, 0.10, 0.11, 0.12)
LABELS = {"musen": "Clast, MUSEN's choices", "defaults": "Clast, defaults"}
COLOURS = ("black", "tab:blue", "tab:orange")

GLASS = {"young_modulus": "564.26 MPa", "poisson_ratio": 0.2}
YIELDS = GLASS | {"yield_stress": "2 MPa"}
MODELS = {
    "model1": GLASS | {"type": "elastic", "normal_strength": "4.05 MPa", "shear_strength": "4.05 MPa"},
    "model2": YIELDS | {"type": "elastic_plastic", "breakage_strain": 0.03},
    "model3": YIELDS | {"type": "micro_cracking", "breakage_strain": 0.0075, "drop_from": "trial"},
}
SWITCHES = {
    "integrator": {"integrator": "midstep", "walls.upper.point": [0, 0, "1.08 mm"]},
    "bond_kinematics": {"bonds.kinematics": "total"},
    "coulomb_limit": {"contacts.law.coulomb_limit": "elastic"},
    "rolling": {"contacts.rolling.spin": "relative"},
    "lever": {"contacts.lever": "contact_point"},
}
"""From MUSEN's choices to Clast's defaults, one at a time."""

DEFAULTS = {key: value for switch in SWITCHES.values() for key, value in switch.items()}


class Job(NamedTuple):
    """One run: its name is that of its folder."""

    name: str
    changes: dict


class Curve(NamedTuple):
    """Strain, force on the upper plate in N, and bonds broken; each (S,) float64."""

    strain: np.ndarray
    force: np.ndarray
    broken: np.ndarray


def jobs() -> list[Job]:
    """Return all runs, those of one compiled loop one after the other."""
    found = []
    for model, law in MODELS.items():
        for name, choices in {"musen": {}, "defaults": DEFAULTS}.items():
            repeats = REPEATS if model != "model2" else [0]
            found += [Job(f"{model}/{name}_{k}", choices | repeat(model, law, choices, k)) for k in repeats]
        if model != "model3":
            found += [Job(f"{model}/{name}_0", {"bonds.model": law} | SWITCHES[name]) for name in SWITCHES]
    return found


def repeat(model: str, law: dict, choices: dict, k: int) -> dict:
    """Return the changes of repetition ``k``: another seed, or without one a plate k picometres lower."""
    if model == "model3":
        drop = {"drop_from": "yield"} if choices else {}
        return {"bonds.model": law | drop | {"seed": k + 1}}
    z = (1.08e-3 if choices else 1.079995e-3) - k * 1e-12
    return {"bonds.model": law, "walls.upper.point": [0, 0, z]}


def run(job: Job, folder: Path) -> str:
    """Run one job unless its results are there."""
    place = folder / job.name
    if not (place / "summary.json").exists():
        scene = clast.load(SCENE).changed(job.changes | {"output.frames": 2})
        clast.run_scene(scene, place, resume=(place / "results.h5").exists())
    return job.name


def read(folder: Path, name: str) -> Curve:
    """Read the curve of a run."""
    with clast.open_run(folder / name) as found:
        return Curve(found.curves["strain"], found.curves["force_upper_N"], found.curves["bonds_broken"])


def band(folder: Path, name: str) -> tuple[Curve, Curve]:
    """Return mean and sample standard deviation of repeated runs."""
    runs = [read(folder, f"{name}_{k}") for k in REPEATS]
    columns = [np.array(column) for column in zip(*runs, strict=True)]
    return Curve(*(c.mean(axis=0) for c in columns)), Curve(*(c.std(axis=0, ddof=1) for c in columns))


def table(name: str) -> dict[str, np.ndarray]:
    """Read one of MUSEN's tables."""
    with (MUSEN / f"{name}.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def musen(name: str) -> Curve:
    """Read MUSEN's curve of a model."""
    found = table(f"curve_{name}")
    return Curve(found["strain"], found["force_upper_N"], found["bonds_broken"])


def musen_band(name: str) -> tuple[Curve, Curve]:
    """Read mean and sample standard deviation of MUSEN's repeated runs."""
    found = table(f"curve_{name}_mean_std")
    mean, deviation = (
        Curve(found["strain"], found[f"force_upper_N_{kind}"], found[f"bonds_broken_{kind}"])
        for kind in ("mean", "std")
    )
    return mean, deviation


def at(curve: Curve, column: np.ndarray, strain: float) -> float:
    """Return a column at the sample nearest to a strain."""
    return float(column[np.argmin(np.abs(curve.strain - strain))])


def first_break(folder: Path, name: str) -> float:
    """Return the strain at the first break of a run: plates approach at 10 mm/s, the height is 2.16 mm."""
    with clast.open_run(folder / name) as found:
        return float(found.cracks["time"][0]) * 0.01 / 2.16e-3


def row(name: str, curve: Curve, first: float) -> str:
    """Return one line of the table of choices."""
    peak = int(np.argmax(curve.force))
    forces = " | ".join(f"{at(curve, curve.force, strain):.4f}" for strain in (0.025, 0.05))
    return f"| {name} | {forces} | {curve.force[peak]:.2f} | {100 * curve.strain[peak]:.1f} | {100 * first:.3f} |"


def print_agreement(folder: Path) -> None:
    """Print the difference from MUSEN with MUSEN's choices and with the defaults."""
    print("\n| model, choices | up to strain % | rms mN | largest mN |\n|---|---|---|---|")
    for model, limits in {"model1": (0.05402, 0.085), "model2": (0.10, 0.20)}.items():
        theirs = musen(model)
        for choices in ("musen", "defaults"):
            ours = read(folder, f"{model}/{choices}_0")
            for limit in limits:
                away = 1e3 * (ours.force - theirs.force)[theirs.strain < limit]
                size = f"{np.sqrt(np.mean(away**2)):.2f} | {np.abs(away).max():.2f}"
                print(f"| {model}, {LABELS[choices]} | {100 * limit:.1f} | {size} |")


def print_choices(folder: Path) -> None:
    """Print what each choice changes."""
    for model in ("model1", "model2"):
        print(f"\n| {model} | N at 2.5 % | N at 5 % | peak N | at strain % | first break % |")
        print("|---|---|---|---|---|---|")
        print(row("MUSEN", musen(model), table(f"breaks_{model}")["strain"][0]))
        for name in ("musen", *SWITCHES, "defaults"):
            label = LABELS.get(name, f"+ {name.replace('_', ' ')}")
            print(row(label, read(folder, f"{model}/{name}_0"), first_break(folder, f"{model}/{name}_0")))


def print_statistics(folder: Path) -> None:
    """Print mean and standard deviation of repeated runs at some strains."""
    heads = " | ".join(f"N at {100 * strain:g} %" for strain in STRAINS)
    print(f"\n| five runs each | {heads} | broken at 20 % |\n|---|{'---|' * len(STRAINS)}---|")
    for model, name in {"model1": "model1", "model3": "model3_eps0075"}.items():
        found = {"MUSEN": musen_band(name)}
        found |= {label: band(folder, f"{model}/{choices}") for choices, label in LABELS.items()}
        for label, (mean, deviation) in found.items():
            cells = [f"{at(mean, mean.force, e):.2f} ± {at(mean, deviation.force, e):.2f}" for e in STRAINS]
            cells.append(f"{mean.broken[-1]:.0f} ± {deviation.broken[-1]:.0f}")
            print(f"| {model}, {label} | {' | '.join(cells)} |")


def print_scatter(folder: Path) -> None:
    """Print how far five runs of Model 1 that differ by next to nothing are apart."""
    heads = " | ".join(f"{100 * strain:g} %" for strain in SCATTER)
    print(f"\n| standard deviation in N at | {heads} |\n|---|{'---|' * len(SCATTER)}")
    found = {"MUSEN": musen_band("model1")}
    found |= {label: band(folder, f"model1/{name}") for name, label in LABELS.items()}
    for label, (mean, deviation) in found.items():
        print(f"| {label} | {' | '.join(f'{at(mean, deviation.force, strain):.1e}' for strain in SCATTER)} |")


def draw(folder: Path, path: Path) -> None:
    """Draw curves above, differences and broken bonds below."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 7), layout="constrained")
    axes = figure.subplots(2, 3, sharex="col")
    for column, model in enumerate(("model1", "model2")):
        draw_model(axes[:, column], folder, model)
    bands = {"MUSEN": musen_band("model3_eps0075")}
    bands |= {label: band(folder, f"model3/{name}") for name, label in LABELS.items()}
    for (label, (mean, deviation)), colour in zip(bands.items(), COLOURS, strict=True):
        for axis, k in ((axes[0, 2], 1), (axes[1, 2], 2)):
            axis.plot(100 * mean.strain, mean[k], color=colour, label=label)
            axis.fill_between(
                100 * mean.strain, mean[k] - deviation[k], mean[k] + deviation[k], color=colour, alpha=0.2, lw=0
            )
    axes[0, 2].set(title="Model 3, five seeds: mean ± deviation", ylabel="force on the upper plate [N]")
    axes[1, 2].set(ylabel="bonds broken")
    for axis in axes[1]:
        axis.set_xlabel("strain [%]")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False)
    figure.savefig(path, dpi=120)


def draw_model(axes: np.ndarray, folder: Path, model: str) -> None:
    """Draw force and difference from MUSEN of one model."""
    theirs = musen(model)
    axes[0].plot(100 * theirs.strain, theirs.force, color=COLOURS[0], label="MUSEN")
    for (name, label), colour in zip(LABELS.items(), COLOURS[1:], strict=True):
        ours = read(folder, f"{model}/{name}_0")
        axes[0].plot(100 * ours.strain, ours.force, color=colour, label=label, lw=1)
        axes[1].semilogy(100 * ours.strain, np.abs(ours.force - theirs.force) + 1e-9, color=colour, label=label, lw=1)
    first = 100 * table(f"breaks_{model}")["strain"][0]
    axes[1].axvline(first, color="grey", lw=0.8, ls=":")
    axes[1].text(first, 2e-6, " first break in MUSEN", fontsize="small", color="grey")
    axes[0].set(title=f"Model {model[-1]}", ylabel="force on the upper plate [N]")
    axes[1].set(ylabel="difference from MUSEN [N]", ylim=(1e-6, 30))


def main() -> None:
    """Run what is missing, print the tables, draw the figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=Path, default=Path("runs/parity"), help="folder of the runs")
    parser.add_argument("--figure", type=Path, default=ROOT / "docs" / "img" / "parity.png")
    given = parser.parse_args()
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        for name in pool.map(run, (found := jobs()), [given.runs] * len(found)):
            print(name, flush=True)
    print_agreement(given.runs)
    print_choices(given.runs)
    print_statistics(given.runs)
    print_scatter(given.runs)
    draw(given.runs, given.figure)


if __name__ == "__main__":
    main()

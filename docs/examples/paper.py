"""Draw what no study of the paper draws: ``python docs/examples/paper.py``.

Fig. 5 of Rotter, Dosta and Düster (2023), the stress in one bond, and the pictures of the optimised grain of Fig. 23;
a minute on two cores. Runs that are there already are not repeated. ``clast reproduce paper`` does the other figures.
"""

import argparse
import shutil
from pathlib import Path

import numpy as np

import clast
from clast_viz.compare import COLOURS

ROOT = Path(__file__).parents[2]
CONFIGS, IMAGES = ROOT / "configs", ROOT / "docs" / "img"
MODELS = (1, 2, 3)
SCENES = {f"fig05_model{model}": f"paper/fig05_model{model}.yaml" for model in MODELS}
SCENES["crush_grain"] = "crush_grain.yaml"


def run(name: str, folder: Path) -> None:
    """Run one scene unless its results are there."""
    place = folder / name
    if not (place / "summary.json").exists():
        clast.run_scene(clast.load(CONFIGS / SCENES[name]), place, resume=(place / "results.h5").exists())


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
    """Run what is missing, draw the figure, copy the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=Path, default=Path("runs/paper_pictures"), help="folder of the runs")
    given = parser.parse_args()
    for name in SCENES:
        run(name, given.runs)
        print(name, flush=True)
    draw_bonds(given.runs)
    for ours, there in (("picture", ""), ("stress_strain", "_curve"), ("energy", "_energy")):
        shutil.copyfile(given.runs / "crush_grain" / f"{ours}.png", IMAGES / f"crush_grain{there}.png")


if __name__ == "__main__":
    main()

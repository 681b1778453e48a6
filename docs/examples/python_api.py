"""Load a scene, change it, run it, read the results, draw them: ``python docs/examples/python_api.py``."""

from pathlib import Path

import clast

SCENE = Path(__file__).parents[2] / "configs" / "crush_grain.yaml"
CHANGES = {
    "name": "coarse_grain",
    "particles.primary_diameter": "0.35 mm",
    "bonds.between.max_gap": "0.175 mm",
    "time.end.strain": 0.08,
    "output.writers": [],
}


def main(folder: Path) -> Path:
    """Crush a coarse grain into ``folder``; return the figure's path."""
    scene = clast.load(SCENE).changed(CHANGES)  # raises clast.errors.ConfigError, with all problems at once
    outcome = clast.run_scene(scene, folder)
    print(f"peak: {outcome.summary['peak_stress_Pa'] / 1e6:.2f} MPa")

    with clast.open_run(folder) as run:
        strain, stress = run.curves["strain"], run.curves["stress_Pa"]  # (samples,) float64
        opened = run.cracks["position"]  # (cracks, 3) float64, in m
        last = run.frame(-1)
        held = last.bond_stress[last.bond_intact]  # in Pa, tension positive
    print(f"{len(opened)} cracks; {(held > 0).mean():.0%} of the other bonds are in tension")
    return draw(strain, stress, folder / "curve.png")


def draw(strain, stress, path: Path) -> Path:
    """Draw a stress–strain curve."""
    from matplotlib.figure import Figure

    figure = Figure(layout="constrained")
    axes = figure.subplots()
    axes.plot(100 * strain, stress / 1e6)
    axes.set(xlabel="strain [%]", ylabel="stress [MPa]")
    figure.savefig(path)
    return path


if __name__ == "__main__":
    print(main(Path("runs/python_api")))

"""Write docs/time-step.md: every limit as a share of that of the dense matrix."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from clast import load
from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.scene.plan import blueprint
from clast.stability.damped_step import stable_step
from clast.stability.springs import bodies_at_start, springs_at_start
from clast.stability.time_step import limits
from clast.verification.dense_springs import largest

PAGE = Path("docs/time-step.md")
HEAD = """# How far each limit is from the true one

Made by `python -m tests.limits`. Bonded spheres of the paper's glass (diameter 0.25 mm), contacts of bonded pairs
included; pair, chain and block overlap by 2 % of a radius. Numbers are shares of the largest stable step of the dense
matrix (bonds, contacts, rotations, damping), integrator `midstep`; above 1 is unstable.
`tests/core/test_stable_step.py` runs scenes at 0.95 and 1.05 of the limit: the first stay quiet, the others blow up.

| scene | restitution | 0.1 × bond (paper) | bond | Rayleigh | network | local | spectral |
|---|---|---|---|---|---|---|---|
"""
R = 0.125e-3


def row_of(count: int) -> np.ndarray:
    return np.column_stack([1.98 * R * np.arange(count), np.zeros(count), np.zeros(count)])


def fcc(cells: int) -> np.ndarray:
    corner = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    base = np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])
    return 1.98 * R * np.sqrt(2.0) * (corner[:, None, :] + base).reshape(-1, 3)


def placed(positions: np.ndarray) -> SceneConfig:
    """Return bonded spheres at given places, with the materials of the paper's grain."""
    grain = load("configs/paper/fig09_model1.yaml").resolved()
    spheres = [{"position": x, "radius": R} for x in positions.tolist()]
    kept = {key: grain[key] for key in ("materials", "contacts")}
    bonds = grain["bonds"] | {"between": {"max_gap": 1e-6}}
    particles = {"type": "explicit", "material": "glass", "particles": spheres}
    time = {"mass_scaling": grain["time"]["mass_scaling"], "end": {"steps": 1}}
    return from_mapping({**kept, "bonds": bonds, "particles": particles, "time": time})


SCENES: dict[str, Callable[[], SceneConfig]] = {
    "pair": lambda: placed(row_of(2)),
    "chain of 20": lambda: placed(row_of(20)),
    "fcc block of 108": lambda: placed(fcc(3)),
    "base grain": lambda: load("configs/paper/fig09_model1.yaml"),
}


def line(name: str, config: SceneConfig, restitution: float) -> str:
    """Return one row of the table."""
    pairs = {"default": {"restitution": restitution, "sliding_friction": 0.05}}
    scene = build_scene(config.changed({"contacts.pairs": pairs}))
    plan = blueprint(scene)
    springs, bodies, found = springs_at_start(scene, plan), bodies_at_start(scene), limits(scene, plan)
    exact = stable_step(lambda per_time: largest(springs, bodies, per_time), plan.integrator.damping_factor)
    steps = (0.1 * found.bond, found.bond, found.rayleigh, found.network, found.local, found.spectral)
    return f"| {name} | {restitution:g} | " + " | ".join(f"{step / exact:.2f}" for step in steps) + " |"


if __name__ == "__main__":
    lines = [line(name, make(), e) for name, make in SCENES.items() for e in (1.0, 0.5, 0.0)]
    PAGE.write_text(HEAD + "\n".join(lines) + "\n")
    print(PAGE.read_text())

"""MUSEN's grain, bonds and impacts as scenes, with that program's choices throughout.

The bonds are the grain's own scene with other particles, so that they run in the grain's compiled loop; the dropped
sphere runs in that of the impacts.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import clast
from clast.config.scene import SceneConfig
from tests.parity.musen import CASES, table

CONFIGS = Path(__file__).parents[2] / "configs" / "parity"
GRAIN, IMPACTS = CONFIGS / "musen_grain_a.yaml", CONFIGS / "musen_impacts.yaml"
OBLIQUE_SPEEDS = (20, 50, 100, 200, 300, 500)
"""Tangential speeds in mm/s of spheres 2 to 7 of the impacts; 0 and 1 meet head-on."""

GLASS = {"young_modulus": "564.26 MPa", "poisson_ratio": 0.2}
YIELDS = GLASS | {"yield_stress": "2 MPa", "breakage_strain": 0.03}
MODEL_1 = GLASS | {"type": "elastic", "normal_strength": "4.05 MPa", "shear_strength": "4.05 MPa"}
MODEL_2 = YIELDS | {"type": "elastic_plastic"}
MODEL_3_ETA05 = YIELDS | {"type": "micro_cracking", "fixed_drop": 0.49999999977, "drop_from": "trial"}
MODELS = {
    "ModelSBElastic": MODEL_1,
    "ModelSBElasticPerfectlyPlastic": MODEL_2,
    "ModelSBWeakening": MODEL_3_ETA05,
}


def bond(name: str) -> SceneConfig:
    """Return the scene of a bond between two spheres that do not touch.

    The density is MUSEN's: so large that the speeds of all but the free bond stay constant to better than 1e-5. A
    second, idle bond is longer than the first: where all bonds are of one length, the compiled loop is another.
    """
    case, common = CASES[name], CASES["bond_common"]
    scene = clast.load(GRAIN)
    spheres = [
        {
            "position": common[f"{which}_sphere_m"],
            "velocity": case[f"velocity_{which}_m_s"],
            "spin": case[f"spin_{which}_rad_s"],
            "radius": common["sphere_radius_m"],
        }
        for which in ("first", "second")
    ]
    idle = [{"position": [x, 1e-3, 0], "radius": common["sphere_radius_m"]} for x in (-0.2e-3, 0.2e-3)]
    links = [{"between": ends, "diameter": common["bond_diameter_m"]} for ends in ([0, 1], [2, 3])]
    changes = {
        "name": name,
        "materials.glass.density": case["density_kg_m3"] / scene.time.mass_scaling,
        "particles": {"type": "explicit", "material": "glass", "particles": spheres + idle, "bonds": links},
        "bonds.model": MODELS[case["law"]["law"]],
        "output.tracks": {"particles": [0, 1], "bonds": [0]},
    }
    if case["law"]["law"] == "ModelSBWeakening":  # no grain to share with: a smaller loop compiles faster
        changes |= {"contacts": None, "walls": {}, "compression": None}
    return scene.changed(changes | timing(name, case["step_s"]))


def impacts() -> SceneConfig:
    """Return the scene of the head-on and the oblique impacts."""
    return clast.load(IMPACTS)


def drop() -> SceneConfig:
    """Return the scene of a sphere that is dropped on a plate; the other one, high above, keeps the loop the same."""
    case = CASES["drop_gravity"]
    dropped = {"position": case["start_centre_m"], "radius": 1e-3, "velocity": case["velocity_in_m_s"]}
    changes = {
        "name": "drop_gravity",
        "particles.particles": [dropped, {"position": [0, 0, 20e-3], "radius": 1e-3}],
        "body_forces": [{"type": "gravity", "acceleration": case["gravity_m_s2"]}],
        "output.tracks": {"particles": [0]},
    }
    return impacts().changed(changes | timing("drop_gravity", case["step_s"]))


def timing(name: str, step: float) -> dict[str, Any]:
    """Return step, end and samples, so that there is a sample at each of MUSEN's."""
    times = table(f"micro/{name}")["time_s"]
    steps, every = round(times[-1] / step), round(times[1] / step)
    return {"time.step": step, "time.end": {"steps": steps}, "output.samples": steps // every, "output.frames": 2}

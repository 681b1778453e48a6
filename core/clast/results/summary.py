"""Summary of a run: what was computed, how, and what came out."""

from __future__ import annotations

import json
import platform
from importlib.metadata import version
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.about import VERSION
from clast.engine.tables import crack_rows
from clast.granular.damage import grain_results
from clast.results.energy import energy_results
from clast.results.fragments import fragments
from clast.results.memory import peak_memory
from clast.results.run import Run
from clast.results.side import side_results
from clast.results.stages import unfinished
from clast.results.warnings import warnings
from clast.results.whole_file import whole_file
from clast.simulation import Simulation
from clast.stability.mass_scaling import added_mass
from clast.stability.time_step import ruling

FILE = "summary.json"
LIBRARIES = ("numpy", "numba", "h5py", "scipy")
Curves = dict[str, NDArray[np.float64]]


def summarise(simulation: Simulation, curves: Curves, wall_time: float) -> dict[str, Any]:
    """Return the summary of a run.

    Parameters
    ----------
    simulation : Simulation
        At its end.
    curves : mapping of (s,) arrays
        The sampled curves.
    wall_time : float
        Seconds spent in the step loop and its observers, over all sessions of the run.
    """
    scene = simulation.scene
    intact = simulation.bond_loads()[:, 0] > 0.0
    label = fragments(len(scene.radius), scene.ends, intact)
    present = simulation.world.particles.present != 0
    sizes = np.bincount(label[present])
    broken = np.zeros(len(scene.ends), bool)
    broken[simulation.world.cracks.bond[crack_rows(simulation.world.cracks)]] = True
    held = np.where(present, label, -1)
    pressed = {**compression_results(simulation, curves), **side_results(curves)}
    return {
        "name": simulation.config.name,
        "versions": versions(),
        "parts": simulation.parts,
        "kernel": simulation.kernel.digest,
        "counts": {
            "particles": len(scene.radius),
            "bonds": len(scene.ends),
            "grains": int(scene.grain.max()) + 1,
            "walls": len(simulation.config.walls),
        },
        "generators": {name: dict(report) for name, report in scene.report.items()},
        "time_step_s": simulation.timeline.spans[0].dt,
        "time_step_changes": [span._asdict() for span in simulation.timeline.spans[1:]],
        "time_step_estimates": simulation.keeper.estimates,
        "time_step_limits_s": limits_table(simulation),
        "time_step_ruled_by": ruling(simulation.config, simulation.limits),
        "time_step_warning": simulation.keeper.warning,
        "warnings": [*warnings(scene, pressed), *unfinished(simulation)],
        "steps": simulation.step,
        "simulated_time_s": simulation.time,
        "ended_by": simulation.ended._asdict() if simulation.ended else None,
        "wall_time_s": wall_time,
        "steps_per_s": simulation.step / wall_time if wall_time > 0 else None,
        "neighbour_lists_made": simulation.lists.made,
        "neighbour_lists_mended": simulation.lists.mended,
        "bonds_broken": simulation.bonds_broken,
        "bonds_intact": simulation.bonds_intact,
        "particles_removed": simulation.removed,
        "bonds_removed": len(scene.ends) - simulation.bonds_broken - simulation.bonds_intact,
        "fragments": int(np.count_nonzero(sizes)),
        "largest_fragment_particles": int(sizes.max(initial=0)),
        **grain_results(scene.grain, scene.true_mass, held, scene.ends, broken),
        "memory_MB": peak_memory(),
        **pressed,
        **energy_results(simulation, curves),
    }


def mass_scaling_results(simulation: Simulation, run: Run) -> dict[str, Any]:
    """Return what mass scaling adds, in kg and as a share, and its share of the kinetic energy; else nothing.

    The kinetic energy is that of translation, summed over all frames.
    """
    scene = simulation.scene
    added = added_mass(scene)
    if not (added > 1e-9 * scene.true_mass).any():
        return {}
    extra = whole = 0.0
    for k in range(run.n_frames):
        square = np.sum(run.frame(k).velocity.astype(float) ** 2, axis=1)
        extra, whole = extra + float(np.sum(added * square)), whole + float(np.sum(scene.mass * square))
    uniform = scene.config.time.mass_scaling * scene.true_mass
    return {
        "added_mass_kg": float(added.sum()),
        "added_mass_share": float(added.sum() / scene.true_mass.sum()),
        "particles_made_heavier": int(np.count_nonzero(scene.mass > uniform * (1.0 + 1e-9))),
        "heaviest_factor": float((scene.mass / scene.true_mass).max()),
        "added_mass_share_of_kinetic_energy": extra / whole if whole > 0.0 else None,
    }


def versions() -> dict[str, str]:
    """Return the versions of Clast, Python and the libraries that compute."""
    return {"clast": VERSION, "python": platform.python_version()} | {name: version(name) for name in LIBRARIES}


def limits_table(simulation: Simulation) -> dict[str, float | None]:
    """Return all limits of the time step in s, None where one does not apply."""
    found = simulation.limits
    table = found._asdict() | {"paper": found.paper, "stable": found.stable}
    return {name: float(value) if np.isfinite(value) else None for name, value in table.items()}


def compression_results(simulation: Simulation, curves: Curves) -> dict[str, Any]:
    """Return peak, slope and Hertz modulus of a compression; nothing for other scenes."""
    config = simulation.config
    if config.compression is None or "stress_Pa" not in curves:
        return {}
    strain, stress, force = curves["strain"], curves["stress_Pa"], curves["force_upper_N"]
    k, height, nu = int(np.argmax(stress)), config.compression.height, poisson(simulation)
    return {
        "peak_stress_Pa": float(stress[k]),
        "strain_at_peak": float(strain[k]),
        "peak_inside_run": bool(peak_inside(stress, k)),
        "secant_modulus_20_80_Pa": secant_modulus(strain, stress, k),
        "hertz_modulus_at_2_percent_Pa": hertz_modulus(strain, force, 0.02, height, nu),
    }


def peak_inside(stress: NDArray[np.float64], k: int) -> bool:
    """Tell whether the stress fell to four fifths of its peak before the run ended."""
    return bool(stress[k] > 0 and (stress[k:] <= 0.8 * stress[k]).any())


def secant_modulus(strain: NDArray[np.float64], stress: NDArray[np.float64], k: int) -> float | None:
    """Return the slope between the first 20 % and the first 80 % of the peak in Pa."""
    if stress[k] <= 0.0:
        return None
    low = int(np.argmax(stress[: k + 1] >= 0.2 * stress[k]))
    high = int(np.argmax(stress[: k + 1] >= 0.8 * stress[k]))
    if strain[high] == strain[low]:
        return None
    return float((stress[high] - stress[low]) / (strain[high] - strain[low]))


def hertz_modulus(
    strain: NDArray[np.float64], force: NDArray[np.float64], at: float, height: float, nu: float
) -> float | None:
    """Return E of a Hertzian sphere between two plates with the same force at a strain, in Pa.

    F = 4/3 E/(1 − ν²) √R (δ/2)^1.5 with R half the height and δ the plates' approach; the force is the mean over a
    tenth of the strain on either side. None where the run ends before, or nothing presses there.
    """
    if strain[-1] < at:
        return None
    near = np.abs(strain - at) <= 0.1 * at
    mean = float(force[near].mean()) if near.any() else float(np.interp(at, strain, force))
    if mean <= 0.0:
        return None
    return float(mean * 0.75 * (1.0 - nu**2) / (sqrt(0.5 * height) * (0.5 * at * height) ** 1.5))


def poisson(simulation: Simulation) -> float:
    """Return Poisson's ratio of the first particle's material."""
    materials = list(simulation.config.materials.values())
    return float(materials[simulation.scene.material[0]].poisson_ratio)


def write(folder: Path, summary: dict[str, Any]) -> Path:
    """Write the summary as JSON."""
    path = folder / FILE
    with whole_file(path) as draft:
        draft.write_text(json.dumps(summary, indent=2) + "\n")
    return path

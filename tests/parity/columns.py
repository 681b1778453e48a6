"""Clast's results of the one- and two-sphere cases, arranged in MUSEN's columns.

Two things about MUSEN's rows: positions and velocities are those after the step, forces those of the evaluation before
it, as in Clast's tracks with leapfrog; and the first row, before any evaluation, holds no forces.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import h5py
import numpy as np

import clast
from tests.parity import scenes
from tests.parity.musen import CASES, Table, table

BONDS = [name for name in CASES if name.startswith("bond_") and name != "bond_common"]
OBLIQUE = [f"oblique_vx{speed:03d}" for speed in scenes.OBLIQUE_SPEEDS]
NAMES = ["headon", *OBLIQUE, "drop_gravity", *BONDS]
"""Every case: the name of its table."""


class Tracks(NamedTuple):
    """Results of a run: times, tracks of particles and bonds, and the table of cracks; arrays by name."""

    time: np.ndarray
    particles: Table
    bonds: Table
    cracks: Table


def run(name: str, folder: Path) -> Tracks:
    """Run a case; the head-on and the oblique impacts are one scene."""
    scene = scenes.bond(name) if name in BONDS else scenes.drop() if name == "drop_gravity" else scenes.impacts()
    clast.run_scene(scene, folder)
    return read(folder)


def read(folder: Path) -> Tracks:
    """Read what the results hold of the followed particles and bonds."""
    with h5py.File(folder / "results.h5") as file:
        groups = [file.get(f"tracks/{kind}", {}) for kind in ("particles", "bonds")]
        tables = [{key: data[:] for key, data in group.items()} for group in (*groups, file["cracks"])]
        return Tracks(file["curves/time_s"][:], *tables)


def columns(name: str, found: Tracks) -> Table:
    """Return the columns of a case, arranged and corrected so that they can be compared."""
    if name in BONDS:
        ours = bond_columns(found, CASES[name]["step_s"])
        return with_history_untilted(ours, name) if "shear" in name else ours
    if name == "headon":
        return head_on_columns(found)
    if name == "drop_gravity":
        return with_weight(sphere_columns(found, 0))
    return sphere_columns(found, 2 + OBLIQUE.index(name))


def head_on_columns(found: Tracks) -> Table:
    """Return MUSEN's columns of two spheres that meet head-on; the overlap is that of the force evaluation."""
    rows = slice(len(table("micro/headon")["time_s"]))
    x, v, f = (found.particles[name][rows, :2, 0] for name in ("position", "velocity", "force"))
    distance = x[:, 1] - x[:, 0] - (v[:, 1] - v[:, 0]) * CASES["headon"]["step_s"]
    return {
        "time_s": found.time[rows],
        "x1_m": x[:, 0],
        "x2_m": x[:, 1],
        "vx1_m_s": v[:, 0],
        "vx2_m_s": v[:, 1],
        "overlap_force_m": 2.0 * CASES["headon"]["spheres"]["radius_m"] - distance,
        "fx1_N": f[:, 0],
        "fx2_N": f[:, 1],
    }


def sphere_columns(found: Tracks, k: int) -> Table:
    """Return MUSEN's columns of sphere k above a plate."""
    position, velocity, spin, force = (
        found.particles[name][:, k] for name in ("position", "velocity", "spin", "force")
    )
    return {
        "time_s": found.time,
        "x_m": position[:, 0],
        "z_m": position[:, 2],
        "vx_m_s": velocity[:, 0],
        "vz_m_s": velocity[:, 2],
        "wy_rad_s": spin[:, 1],
        "fx_N": force[:, 0],
        "fz_N": force[:, 2],
    }


def with_weight(ours: Table) -> Table:
    """Add the weight to the force, as in all of MUSEN's rows but the first."""
    weight = 2500 * 4 / 3 * np.pi * 1e-3**3 * 9.81
    return ours | {"fz_N": ours["fz_N"] - np.where(ours["time_s"] > 0.0, weight, 0.0)}


def bond_columns(found: Tracks, step: float) -> Table:
    """Return MUSEN's columns: axial strain now and a step before, and loads from those on the two spheres."""
    d, v, moment = (np.diff(found.particles[name], axis=1)[:, 0] for name in ("position", "velocity", "moment"))
    before = d - v * step * (found.time > 0.0)[:, None]
    length = np.linalg.norm(before, axis=1)
    n, force = before / length[:, None], found.particles["force"][:, 0]
    normal = np.einsum("tc,tc->t", force, n)
    across = force - normal[:, None] * n
    area = np.pi / 4 * CASES["bond_common"]["bond_diameter_m"] ** 2
    return {
        "time_s": found.time,
        "strain": np.linalg.norm(d, axis=1) / CASES["bond_common"]["initial_length_m"] - 1.0,
        "strain_force": length / CASES["bond_common"]["initial_length_m"] - 1.0,
        "normal_force_N": normal,
        "normal_stress_Pa": normal / area,
        "fy1_N": force[:, 1],
        "shear_stress_Pa": np.linalg.norm(across, axis=1) / area,
        "moment_magnitude_Nm": 0.5 * np.linalg.norm(moment, axis=1),  # the shear force turns both ends alike
        "rel_velocity_x_m_s": v[:, 0],
        "intact": found.bonds["intact"][:, 0],
    }


def with_history_untilted(ours: Table, name: str) -> Table:
    """Correct three columns of a sheared bond for MUSEN's history, which stays behind while the bond tilts.

    Clast's shear displacement u is always across the bond's direction n; MUSEN's is a sum in fixed directions, so that
    k u·n pulls along the bond.
    """
    case, common = CASES[name], CASES["bond_common"]
    rows = np.round(ours["time_s"] / case["step_s"]).astype(int)
    pull, impulse = along_bond(name)
    area = np.pi / 4 * common["bond_diameter_m"] ** 2
    mass = case["density_kg_m3"] * 4 / 3 * np.pi * common["sphere_radius_m"] ** 3
    return ours | {
        "normal_force_N": ours["normal_force_N"] + pull[rows],
        "normal_stress_Pa": ours["normal_stress_Pa"] + pull[rows] / area,
        "rel_velocity_x_m_s": ours["rel_velocity_x_m_s"] - 2.0 * impulse[rows] / mass,
    }


def along_bond(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Return k u·n in N, and its impulse along x in N s, after every step of a bond sheared at constant speed."""
    case, common = CASES[name], CASES["bond_common"]
    L0, dt, speed = common["initial_length_m"], case["step_s"], 2.0 * case["velocity_second_m_s"][1]
    G = common["young_modulus_Pa"] / (2.0 * (1.0 + common["poisson_ratio"]))
    k = G * np.pi / 4 * common["bond_diameter_m"] ** 2 / L0
    most = common["yield_strength_Pa"] * L0 / G if "model2" in name else np.inf
    end = case["result"]["break_time_s"] or np.inf
    u, pull, impulse = np.zeros(2), [0.0], [0.0]
    for step in range(round(table(f"micro/{name}")["time_s"][-1] / dt)):
        tilt = np.arctan(speed * dt * step / L0)
        n, across = np.array([np.cos(tilt), np.sin(tilt)]), np.array([-np.sin(tilt), np.cos(tilt)])
        u = u + (2.0 if step == 0 else 1.0) * dt * speed * np.cos(tilt) * across  # one increment too many
        u = u * min(1.0, most / np.hypot(*u))
        pull.append(k * float(u @ n) if step * dt < end - 0.5 * dt else 0.0)
        impulse.append(impulse[-1] + pull[-1] * np.cos(tilt) * dt)
    return np.array(pull), np.array(impulse)

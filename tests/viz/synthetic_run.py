"""Run folders made up without any simulation: laid out like a real results.h5, small, the same every time."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np
import yaml
from numpy.typing import NDArray

HEIGHT = 2.16e-3
FRAMES = 12
LEAVES_AT = 8  # the frame from which particle 0 is gone
MODES = ["tension", "shear", "strain"]

REFERENCE = {
    "label": "experiment, 94 grains",
    "strain": 0.1649,
    "strain_deviation": 0.0412,
    "stress": 4.05e6,
    "stress_deviation": 1.45e6,
}


class Scene(NamedTuple):
    """Everything that goes into one results.h5."""

    radius: NDArray[np.float64]
    ends: NDArray[np.uint32]
    bond_diameter: NDArray[np.float64]
    bond_length: NDArray[np.float64]
    walls: Mapping[str, tuple[NDArray[np.float64], NDArray[np.int64]]]
    frames: Mapping[str, NDArray[Any]]
    curves: Mapping[str, NDArray[np.float64]]
    cracks: Mapping[str, NDArray[Any]]
    grain: NDArray[np.int64] | None = None
    contacts: Mapping[str, NDArray[Any]] | None = None


def three_grains() -> Scene:
    """Cut the small grain into three from left to right; they push on each other, and on the upper plate.

    In frame k the first 2 k pairs of particles touch whose bonds were cut, and particle 40 touches the upper plate.
    """
    whole = small_grain()
    start = _ball(0.36e-3, 0.9e-3)
    grain = np.digitize(start[:, 0], [-0.2e-3, 0.2e-3])
    kept = grain[whole.ends[:, 0]] == grain[whole.ends[:, 1]]
    ends, cut = whole.ends[kept], whole.ends[~kept]
    breaks_in = 4 + np.arange(len(ends)) % 29
    frames = dict(whole.frames)
    for name in ("bond_intact", "bond_stress", "bond_failure"):
        frames[name] = frames[name][:, kept]
    frames["bond_intact"] = (np.arange(FRAMES)[:, None] < breaks_in).astype(np.uint8)
    found = [_contacts(cut[: 2 * k], frames["position"][k]) for k in range(FRAMES)]
    frames["contacts_end"] = np.cumsum([len(each["i"]) for each in found])
    return whole._replace(
        ends=ends,
        bond_diameter=whole.bond_diameter[kept],
        bond_length=whole.bond_length[kept],
        frames=frames,
        cracks=_cracks(frames, ends, breaks_in),
        grain=grain,
        contacts={name: np.concatenate([each[name] for each in found]) for name in found[0]},
    )


def _contacts(pairs: NDArray[np.uint32], position: NDArray[np.float32]) -> dict[str, NDArray[Any]]:
    """Let pairs push along the line between them, each harder than the one before, and particle 40 up on wall 0."""
    i, j = np.append(pairs[:, 0], 40).astype(np.uint32), np.append(pairs[:, 1].astype(np.int32), -1).astype(np.int32)
    way = np.where((j >= 0)[:, None], position[j] - position[i], np.float32([0.0, 0.0, 1e-4]))
    normal = np.arange(1.0, len(i) + 1.0, dtype=np.float32)
    force = normal[:, None] * np.nan_to_num(way / np.linalg.norm(way, axis=1)[:, None])
    return {
        "i": i,
        "j": j,
        "position": np.nan_to_num(position[i] + 0.5 * way).astype(np.float32),
        "force": force.astype(np.float32),
        "normal_force": normal,
        "tangential_force": np.zeros_like(normal),
    }


def small_grain() -> Scene:
    """Compress eighty-one spheres between two plates: bonds break in turn, one particle leaves."""
    start = _ball(0.36e-3, 0.9e-3)
    ends = _neighbours(start, 0.5e-3)
    strain = np.linspace(0.0, 0.25, FRAMES)
    breaks_in = 4 + np.arange(len(ends)) % 29
    position = _squeeze(start, strain)
    position[LEAVES_AT:, 0] = np.nan
    intact = np.arange(FRAMES)[:, None] < breaks_in
    side = np.where(np.arange(len(ends)) % 3 == 0, 1.0, -0.5)
    failure = np.clip(np.arange(FRAMES)[:, None] / breaks_in, 0.0, 1.0) * intact
    frames = {
        "time": strain * HEIGHT / 0.01,
        "step": np.arange(FRAMES) * 1000,
        "strain": strain,
        "position": position.astype(np.float32),
        "velocity": np.gradient(position, strain * HEIGHT / 0.01, axis=0).astype(np.float32),
        "bond_intact": intact.astype(np.uint8),
        "bond_stress": (failure * side * 5.6e6).astype(np.float32),
        "bond_failure": failure.astype(np.float32),
        "wall_displacement": plate_displacement(strain),
    }
    diameter = np.full(len(ends), 0.1e-3)
    length = np.linalg.norm(start[ends[:, 0]] - start[ends[:, 1]], axis=1)
    radius = np.full(len(start), 0.18e-3)
    curves = compression_curves(strain, breaks_in)
    return Scene(radius, ends, diameter, length, plates(), frames, curves, _cracks(frames, ends, breaks_in))


def two_spheres() -> Scene:
    """Let two unbonded spheres pass each other: no bonds, no plates, no compression curve."""
    time = np.linspace(0.0, 1e-3, 5)
    position = np.zeros((5, 2, 3), np.float32)
    position[:, 0, 0], position[:, 1, 0] = -2e-3 + time, 2e-3 - time
    frames: dict[str, NDArray[Any]] = {
        "time": time,
        "step": np.arange(5),
        "strain": np.zeros(5),
        "position": position,
        "velocity": np.zeros((5, 2, 3), np.float32),
        "bond_intact": np.zeros((5, 0), np.uint8),
        "bond_stress": np.zeros((5, 0), np.float32),
        "bond_failure": np.zeros((5, 0), np.float32),
        "wall_displacement": np.zeros((5, 0, 3)),
    }
    ends = np.zeros((0, 2), np.uint32)
    curves = {"time_s": time, "bonds_intact": np.zeros(5), "bonds_broken": np.zeros(5)}
    cracks = _cracks(frames, ends, np.zeros(0, np.int64))
    return Scene(np.array([1e-3, 0.8e-3]), ends, np.zeros(0), np.zeros(0), {}, frames, curves, cracks)


def write_run(folder: Path, scene: Scene, *, reference: bool = True, complete: bool = True) -> Path:
    """Write ``scene`` as a run folder and return it."""
    folder.mkdir(parents=True, exist_ok=True)
    with h5py.File(folder / "results.h5", "w") as file:
        file.attrs.update({"schema": 1, "name": "synthetic", "clast_version": "0", "complete": complete})
        _write_particles(file, scene)
        file["bonds/ends"], file["bonds/diameter"] = scene.ends, scene.bond_diameter
        file["bonds/length"] = scene.bond_length
        for index, (name, (points, triangles)) in enumerate(scene.walls.items()):
            group = file.create_group(f"walls/{name}")
            group["points"], group["triangles"] = points, triangles
            group.attrs["index"] = index
        _write_columns(file.create_group("frames"), scene.frames)
        _write_columns(file.create_group("curves"), scene.curves)
        if scene.contacts is not None:
            _write_columns(file.create_group("contacts"), scene.contacts)
        _write_columns(file.create_group("cracks"), scene.cracks)
        file["cracks/mode"].attrs["modes"] = MODES
    materials = {"glass": {"density": 2500.0}}
    config = {"name": "synthetic", "materials": materials, "reference": [REFERENCE] if reference else []}
    (folder / "config.yaml").write_text(yaml.safe_dump(config), encoding="utf-8")
    (folder / "summary.json").write_text('{"steps": 11000}', encoding="utf-8")
    return folder


def plates(half: float = 1.6e-3) -> dict[str, tuple[NDArray[np.float64], NDArray[np.int64]]]:
    """Two square plates at plus and minus half the height."""
    corners = np.array([[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    shift = np.array([0.0, 0.0, HEIGHT / 2])
    return {"upper": (corners + shift, triangles), "lower": (corners - shift, triangles)}


def plate_displacement(strain: NDArray[np.float64]) -> NDArray[np.float64]:
    """Let the upper plate move down and the lower one rest: (F, 2, 3)."""
    displacement = np.zeros((len(strain), 2, 3))
    displacement[:, 0, 2] = -strain * HEIGHT
    return displacement


def compression_curves(
    frame_strain: NDArray[np.float64], breaks_in: NDArray[np.int64]
) -> dict[str, NDArray[np.float64]]:
    """Rise to 4.2 MPa at 18 % strain, then collapse; 10 samples per frame."""
    strain = np.linspace(0.0, frame_strain[-1], 10 * (len(frame_strain) - 1) + 1)
    stress = np.where(strain < 0.18, 4.2e6 * (strain / 0.18) ** 1.3, 4.2e6 - 3e7 * (strain - 0.18))
    frame = np.interp(strain, frame_strain, np.arange(len(frame_strain)))
    broken = (breaks_in[None, :] <= frame[:, None]).sum(axis=1).astype(np.float64)
    area = np.pi * HEIGHT**2 / 4
    return {
        "time_s": strain * HEIGHT / 0.01,
        "displacement_m": strain * HEIGHT,
        "strain": strain,
        "stress_Pa": stress,
        "force_upper_N": stress * area,
        "force_lower_N": stress * area,
        "bonds_intact": len(breaks_in) - broken,
        "bonds_broken": broken,
    }


def _write_particles(file: h5py.File, scene: Scene) -> None:
    file["particles/radius"] = scene.radius
    file["particles/grain"] = np.zeros(len(scene.radius), np.int64) if scene.grain is None else scene.grain
    file["particles/material"] = np.zeros(len(scene.radius), np.uint8)
    file["particles/material"].attrs["names"] = ["glass"]


def _write_columns(group: h5py.Group, columns: Mapping[str, NDArray[Any]]) -> None:
    for name, values in columns.items():
        chunks = (1, *values.shape[1:]) if values.ndim > 1 and 0 not in values.shape else True
        group.create_dataset(name, data=values, maxshape=(None, *values.shape[1:]), chunks=chunks)


def _ball(spacing: float, radius: float) -> NDArray[np.float64]:
    axis = np.arange(-3, 4) * spacing
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    return points[np.linalg.norm(points, axis=1) < radius]


def _neighbours(points: NDArray[np.float64], reach: float) -> NDArray[np.uint32]:
    distance = np.linalg.norm(points[:, None] - points[None], axis=-1)
    return np.argwhere(np.triu(distance < reach, k=1)).astype(np.uint32)


def _squeeze(start: NDArray[np.float64], strain: NDArray[np.float64]) -> NDArray[np.float64]:
    stretch = np.stack([1 + strain / 2, 1 + strain / 2, 1 - strain], axis=1)
    shift = np.stack([0 * strain, 0 * strain, -strain * HEIGHT / 2], axis=1)
    moved: NDArray[np.float64] = start[None] * stretch[:, None] + shift[:, None]
    return moved


def _cracks(
    frames: Mapping[str, NDArray[Any]], ends: NDArray[np.uint32], breaks_in: NDArray[np.int64]
) -> dict[str, NDArray[Any]]:
    broken = np.flatnonzero(breaks_in < len(frames["time"]))
    broken = broken[np.argsort(breaks_in[broken], kind="stable")]
    last = breaks_in[broken] - 1
    i, j = ends[broken].T.astype(np.int64)
    middle = 0.5 * (frames["position"][last, i] + frames["position"][last, j])
    return {
        "time": 0.5 * (frames["time"][last] + frames["time"][last + 1]),
        "bond": broken,
        "i": i,
        "j": j,
        "position": np.nan_to_num(middle.astype(np.float64)).reshape(-1, 3),
        "mode": (broken % 3).astype(np.uint8),
        "normal_stress": np.full(len(broken), 5.6e6),
        "shear_stress": np.full(len(broken), 1.0e6),
        "energy": np.full(len(broken), 1e-9),
    }

"""Scenes of the benchmarks: one body of bonded particles, as tables that Clast and the peer both load."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import yaml
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from clast.building import build_scene
from clast.config.scene import from_mapping


class Numbers(NamedTuple):
    """Numbers both codes use, in SI: Table 2 of Rotter, Dosta and Düster (2023)."""

    young_modulus: float = 564.26e6
    poisson_ratio: float = 0.2
    density: float = 1720.0
    restitution: float = 0.5
    sliding_friction: float = 0.05
    strength: float = 4.05e6
    yield_stress: float = 2.0e6
    breakage_strain: float = 0.0075
    step: float = 7e-8
    plate_speed: float = 0.01
    skin_per_diameter: float = 0.2


NUMBERS = Numbers()
GRAIN_DIAMETER = 2.16e-3
PRIMARY_DIAMETER = 0.25e-3
MAX_GAP = 0.125e-3
POROSITY = 0.44
SMALL_GRAIN_PRIMARIES, SMALL_GRAIN_BONDS = 200, 1140
GRAINS_PER_SIDE = 5
SPACING = 1.01


class Size(NamedTuple):
    """Name of a body, and how many particles and bonds it has."""

    name: str
    particles: int
    bonds: int


@dataclass(frozen=True)
class Body:
    """Bonded spheres of one size.

    Attributes
    ----------
    name : str
        Stem of its files.
    position : (n, 3) float64
        Centres in m.
    ends : (m, 2) int64
        Particles of each bond.
    diameter : float
        Of particles and bonds, in m.
    """

    name: str
    position: NDArray[np.float64]
    ends: NDArray[np.int64]
    diameter: float

    @property
    def size(self) -> Size:
        """Name and counts."""
        return Size(self.name, len(self.position), len(self.ends))

    @property
    def lengths(self) -> NDArray[np.float64]:
        """Initial length of every bond in m."""
        vectors = self.position[self.ends[:, 1]] - self.position[self.ends[:, 0]]
        return np.asarray(np.linalg.norm(vectors, axis=1), np.float64)

    @property
    def bottom(self) -> float:
        """Height of the lower plate in m: it just touches."""
        return float(self.position[:, 2].min() - 0.5 * self.diameter)

    @property
    def top(self) -> float:
        """Height of the upper plate in m: it just touches."""
        return float(self.position[:, 2].max() + 0.5 * self.diameter)


def base_grain() -> Body:
    """Return the grain of the paper: 361 primaries of 0.25 mm, every gap up to half a primary bonded."""
    x = _packed({"primary_diameter": PRIMARY_DIAMETER, "porosity": POROSITY})
    ends = cKDTree(x).query_pairs(PRIMARY_DIAMETER + MAX_GAP, output_type="ndarray").astype(np.int64)
    return Body("grain", x, _ordered(ends), PRIMARY_DIAMETER)


def grain_array() -> Body:
    """Return 125 copies of a grain of 200 primaries with its 1140 shortest bonds, 1.01 diameters apart."""
    d = GRAIN_DIAMETER * ((1.0 - POROSITY) / SMALL_GRAIN_PRIMARIES) ** (1.0 / 3.0)
    x = _packed({"primary_diameter": d, "primaries": SMALL_GRAIN_PRIMARIES})
    near = cKDTree(x).query_pairs(2.0 * d, output_type="ndarray").astype(np.int64)
    gaps = np.linalg.norm(x[near[:, 0]] - x[near[:, 1]], axis=1)
    ends = _ordered(near[np.argsort(gaps, kind="stable")[:SMALL_GRAIN_BONDS]])
    steps = np.stack(np.meshgrid(*3 * [np.arange(GRAINS_PER_SIDE)], indexing="ij"), axis=-1).reshape(-1, 3)
    position = (steps[:, None] * SPACING * GRAIN_DIAMETER + x).reshape(-1, 3)
    offsets = SMALL_GRAIN_PRIMARIES * np.arange(len(steps))
    return Body("array", position, (offsets[:, None, None] + ends).reshape(-1, 2), d)


def _packed(asked: Mapping[str, float]) -> NDArray[np.float64]:
    """Return the centres of a spherical agglomerate packed by Clast."""
    generator = {"type": "spherical_agglomerate", "material": "glass", "diameter": GRAIN_DIAMETER, "seed": 1}
    scene = from_mapping(
        {
            "materials": {"glass": _material()},
            "particles": generator | dict(asked),
            "time": {"step": NUMBERS.step, "end": {"steps": 1}},
        }
    )
    return build_scene(scene).position


def _ordered(ends: NDArray[np.int64]) -> NDArray[np.int64]:
    ends = np.sort(ends, axis=1)
    return ends[np.lexsort((ends[:, 1], ends[:, 0]))]


def _material() -> dict[str, float]:
    return {
        "density": NUMBERS.density,
        "young_modulus": NUMBERS.young_modulus,
        "poisson_ratio": NUMBERS.poisson_ratio,
    }


def bond_model(name: str) -> dict[str, Any]:
    """Return the settings of a bond model with the numbers of Table 2."""
    shared = {"type": name, "young_modulus": NUMBERS.young_modulus, "poisson_ratio": NUMBERS.poisson_ratio}
    if name == "elastic":
        return shared | {"normal_strength": NUMBERS.strength, "shear_strength": NUMBERS.strength}
    return shared | {"yield_stress": NUMBERS.yield_stress, "breakage_strain": NUMBERS.breakage_strain}


def scene(body: Body, model: str = "micro_cracking") -> dict[str, Any]:
    """Return the scene of a body between two plates, the upper one moving, as the peer computes it."""
    plate = {"type": "plane", "material": "glass"}
    motion = {"type": "constant_velocity", "velocity": [0.0, 0.0, -NUMBERS.plate_speed]}
    pair = {"restitution": NUMBERS.restitution, "sliding_friction": NUMBERS.sliding_friction}
    return {
        "name": body.name,
        "materials": {"glass": _material()},
        "particles": {
            "type": "from_file",
            "material": "glass",
            "particles": f"{body.name}_particles.csv",
            "bonds": f"{body.name}_bonds.csv",
        },
        "bonds": {"model": bond_model(model)},
        "contacts": {"law": "hertz_mindlin", "bonded_pairs": True, "pairs": {"default": pair}},
        "walls": {
            "upper": plate | {"point": [0.0, 0.0, body.top], "normal": [0, 0, -1], "motion": motion},
            "lower": plate | {"point": [0.0, 0.0, body.bottom], "normal": [0, 0, 1]},
        },
        "neighbours": {"skin": NUMBERS.skin_per_diameter * body.diameter},
        "time": {"step": NUMBERS.step, "end": {"steps": 100_000_000}},
        "output": {"writers": []},
    }


def write_tables(body: Body, folder: Path) -> None:
    """Write the particles and bonds of a body as CSV."""
    rows = [f"{k},{x:.17g},{y:.17g},{z:.17g},{0.5 * body.diameter:.17g}" for k, (x, y, z) in enumerate(body.position)]
    (folder / f"{body.name}_particles.csv").write_text("\n".join(["id,x,y,z,radius", *rows, ""]))
    bonds = [f"{i},{j},{body.diameter:.17g}" for i, j in body.ends]
    (folder / f"{body.name}_bonds.csv").write_text("\n".join(["i,j,diameter", *bonds, ""]))


def write_scene(data: Mapping[str, Any], file: Path) -> Path:
    """Write a scene beside the tables it names."""
    file.write_text(yaml.safe_dump(copy.deepcopy(dict(data)), sort_keys=False))
    return file

"""Features of the step, switched off or exchanged one at a time."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

from clast.bench.measure import Spread, say, spread, worker
from clast.bench.scenes import Body, bond_model, scene, write_scene

SceneData = dict[str, Any]
EVERYTHING = "everything"
COMPILERS = 2


class Variant(NamedTuple):
    """One change of the scene: file name, what a reader is told, and what it does to the scene."""

    name: str
    title: str
    change: Callable[[SceneData], None]


class Cost(NamedTuple):
    """What a step of a variant costs, in ns."""

    title: str
    step: Spread


def _pairs(**settings: float) -> Callable[[SceneData], None]:
    return lambda data: data["contacts"]["pairs"]["default"].update(settings)


def _bonds(**settings: Any) -> Callable[[SceneData], None]:
    return lambda data: data["bonds"].update(settings)


def _without_contacts(data: SceneData) -> None:
    del data["contacts"], data["walls"]


def _without_bonds(data: SceneData) -> None:
    del data["bonds"], data["particles"]["bonds"]


def _set(key: str, value: Any) -> Callable[[SceneData], None]:
    return lambda data: data.__setitem__(key, value)


def _nothing(data: SceneData) -> None:
    """Leave the scene as it is."""


def _only_motion(data: SceneData) -> None:
    _without_contacts(data)
    _without_bonds(data)


VARIANTS = (
    Variant(
        EVERYTHING, "the scene of the first table: Model 3, contacts with friction and damping, two plates", _nothing
    ),
    Variant("no_friction", "no friction", _pairs(sliding_friction=0.0)),
    Variant("no_contact_damping", "no damping in contacts (restitution 1)", _pairs(restitution=1.0)),
    Variant("no_walls", "no plates", _set("walls", {})),
    Variant(
        "no_bonded_contact", "no contact of bonded pairs", lambda data: data["contacts"].update(bonded_pairs=False)
    ),
    Variant("no_contacts", "no contacts, so no plates either", _without_contacts),
    Variant("no_bonds", "no bonds", _without_bonds),
    Variant("only_motion", "neither bonds nor contacts: motion alone", _only_motion),
    Variant("elastic", "Model 1 instead of Model 3", _bonds(model=bond_model("elastic"))),
    Variant("elastic_plastic", "Model 2 instead of Model 3", _bonds(model=bond_model("elastic_plastic"))),
    Variant("incremental", "incremental kinematics instead of total", _bonds(kinematics="incremental")),
    Variant("rolling", "rolling friction on", _pairs(rolling_friction=0.05)),
    Variant("bond_damping", "bond damping on", _bonds(damping=0.05)),
    Variant("ledger", "energy ledger on", lambda data: data["output"].update(ledger=True)),
    Variant("gravity", "gravity on", _set("body_forces", [{"type": "gravity", "acceleration": [0.0, 0.0, -9.81]}])),
)
BREAKDOWN = (EVERYTHING, "no_contacts", "only_motion")
"""Variants that tell what bonds, contacts and motion cost."""


def write_variants(body: Body, folder: Path, names: Sequence[str] | None = None) -> dict[str, Path]:
    """Write the scene of every variant of a body, or of those named."""
    files = {}
    for variant in VARIANTS:
        if names is None or variant.name in names:
            data = copy.deepcopy(scene(body))
            variant.change(data)
            files[variant.name] = write_scene(data, folder / f"{body.name}-{variant.name}.yaml")
    return files


def compile_all(files: Sequence[Path]) -> None:
    """Compile the loops of all scenes beforehand, on two cores, so that no measurement contains it."""
    shares = [files[k::COMPILERS] for k in range(COMPILERS) if files[k::COMPILERS]]
    with ThreadPoolExecutor(COMPILERS) as pool:
        list(pool.map(lambda share: worker("compile_scenes", *share), shares))


def measure_costs(files: dict[str, Path], first: int, steps: int, rounds: int) -> dict[str, Cost]:
    """Return what a step of every variant costs; all run in one process, by turns."""
    say(f"features: {len(files)} variants")
    _, times = worker("compare_scenes", first, steps, rounds, *files.values())
    known = {variant.name: variant for variant in VARIANTS}
    costs = {}
    for name, file in files.items():
        costs[name] = Cost(known[name].title, spread([1e9 * t for t in times[file.stem]]))
    return costs


class Shares(NamedTuple):
    """Where a step's time goes, in ns: differences between variants."""

    step: float
    bonds: float
    contacts: float
    motion: float

    @property
    def largest(self) -> str:
        """The largest of them, in words."""
        named = {"the bonds": self.bonds, "the contacts": self.contacts, "the motion of particles": self.motion}
        return max(named, key=lambda name: named[name])


def shares(costs: dict[str, Cost]) -> Shares:
    """Return where the time goes: bonds alone, what contacts and plates add, and motion alone."""
    step, bonded, motion = (costs[name].step.median for name in (EVERYTHING, "no_contacts", "only_motion"))
    return Shares(step, bonded - motion, step - bonded, motion)

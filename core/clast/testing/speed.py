"""What a law costs in the compiled loop of a grain, and whether its arithmetic is done on vectors."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from clast.parts.params import Params
from clast.plugins.registered import Registered

SIZE, PRIMARY = 1.4e-3, 0.25e-3
STEPS, REPEATS = 200, 300
VECTOR = re.compile(r"= (?:fadd|fsub|fmul|fdiv) <\d+ x double>")
SCALAR = re.compile(r"= (?:fadd|fsub|fmul|fdiv) double")
BESIDE = {"bond_model": ("elastic", "micro_cracking"), "contact_law": ("hertz_mindlin",)}


class Cost(NamedTuple):
    """What a law costs.

    Attributes
    ----------
    name : str
    law : float
        CPU ns that kinematics and law of a bond, or the law of a touching pair, take.
    whole : float
        CPU ns of a step for each bond or pair of the list, with gathering and scattering.
    vectorised : bool
        Whether the compiled loop over lanes works on vectors.
    """

    name: str
    law: float
    whole: float
    vectorised: bool


def cost(entry: Registered, params: Params) -> Cost:
    """Measure a bond model or contact law in the step loop of a grain that is pressed, on one thread."""
    from clast.bench.phases import Kernels, bond_phases, contact_phases, nanoseconds, sweeps

    with tempfile.TemporaryDirectory() as place:
        simulation = _pressed_grain(entry, params, Path(place))
        kernels, world = Kernels(simulation), simulation.world
        if entry.kind == "bond_model":
            arithmetic, items = bond_phases(kernels)["kinematics and law"], len(simulation.scene.ends)
            sweep, of_all = sweeps(kernels)["bonds"], items
        else:
            touching = np.resize(np.nonzero(world.pairs.touching)[0].astype(np.uint32), 2048)
            arithmetic, items = contact_phases(kernels, touching)["law"], len(touching)
            sweep, of_all = sweeps(kernels)["contacts"], len(world.pairs.first)
        whole = nanoseconds(sweep, world, of_all, REPEATS)
        return Cost(entry.name, nanoseconds(arithmetic, world, items, REPEATS), whole, _vectorised(arithmetic, world))


def _vectorised(work: Callable[..., None], world: Any) -> bool:
    """Tell whether most of a loop's arithmetic is done on vectors."""
    from numba import njit

    from clast.engine.compiler import INNER

    call = njit(**INNER | {"no_cpython_wrapper": False})(work.py_func)  # type: ignore[attr-defined]
    call(world, 1)
    text = "\n".join(call.inspect_llvm().values())
    return 2 * len(VECTOR.findall(text)) > len(SCALAR.findall(text))


def _pressed_grain(entry: Registered, params: Params, folder: Path) -> Any:
    from clast import Simulation
    from clast.config.plain import plain_data
    from clast.config.scene import from_mapping

    chosen: Mapping[str, Any] = {"type": entry.name} | plain_data(params, folder)
    scene = _scene(entry.kind, chosen)
    if entry.kind == "contact_law" and entry.part.damping is not None:  # it has no restitution then
        del scene["contacts"]["pairs"]["default"]["restitution"]
    if not entry.source.version:
        scene["plugins"] = [entry.source.origin]
    simulation = Simulation(from_mapping(scene), 1)
    simulation.advance_to(STEPS)
    return simulation


def _scene(kind: str, chosen: Mapping[str, Any]) -> dict[str, Any]:
    """Return a grain of some 150 primaries between two plates that has just been pressed a little."""
    plate = {"type": "plane", "material": "glass"}
    down = {"type": "constant_velocity", "velocity": [0, 0, "-1 m/s"]}
    scene: dict[str, Any] = {
        "materials": {"glass": {"density": 1720.0, "young_modulus": "564.26 MPa", "poisson_ratio": 0.2}},
        "particles": {
            "type": "spherical_agglomerate",
            "material": "glass",
            "diameter": SIZE,
            "primary_diameter": PRIMARY,
            "porosity": 0.5,
        },
        "contacts": {
            "law": dict(chosen) if kind == "contact_law" else "hertz_mindlin",
            "pairs": {"default": {"restitution": 0.5, "sliding_friction": 0.3}},
        },
        "walls": {
            "upper": plate | {"point": [0, 0, 0.5 * SIZE], "normal": [0, 0, -1], "motion": down},
            "lower": plate | {"point": [0, 0, -0.5 * SIZE], "normal": [0, 0, 1]},
        },
        "time": {"step": "20 ns", "end": {"steps": 10_000_000}},
        "output": {"writers": []},
    }
    if kind == "bond_model":
        scene["bonds"] = {"between": {"relative_gap": 0.5}, "model": dict(chosen)}
    return scene

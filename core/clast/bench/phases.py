"""Where a step's time goes: each phase of the sweeps alone, and the arithmetic the laws need.

``python -m clast.bench.phases`` prints the tables of ``docs/performance.md``.
"""

from __future__ import annotations

import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numba import njit

from clast import Simulation, load
from clast.bench.scenes import Body, base_grain, grain_array, scene, write_scene, write_tables
from clast.engine.compiler import INNER, STRICT
from clast.engine.kernels.layout import LANES

REPEATS = 7
ARITHMETIC = re.compile(r"= (fadd|fsub|fmul|fdiv) <\d+ x double>|\w+ <\d+ x double> @llvm\.(sqrt)")


def start(body: Body, steps: int, folder: Path) -> Simulation:
    """Return a simulation of a body between plates after some steps, on one thread."""
    write_tables(body, folder)
    simulation = Simulation(load(write_scene(scene(body), folder / f"{body.name}.yaml")), 1)
    simulation.advance_to(steps)
    return simulation


class Kernels:
    """The compiled functions of one scene's loop, to be called one by one."""

    def __init__(self, simulation: Simulation) -> None:
        self._package = f"clast_kernel_{simulation.kernel.digest}"

    def get(self, module: str, name: str) -> Any:
        """Return a function for compiled code to call."""
        found = getattr(sys.modules[f"{self._package}.{module}"], name)
        return getattr(found, "dispatcher", found)


def sweeps(kernels: Kernels) -> dict[str, Callable[..., None]]:
    """Return functions of (world, repeats) that sweep the bonds or the contacts of all chunks."""
    sweep_bonds, sweep_contacts = (
        kernels.get("bond_sweep", "sweep_bonds"),
        kernels.get("contact_sweep", "sweep_contacts"),
    )

    @njit(**INNER)  # type: ignore[untyped-decorator]
    def bonds(world: Any, repeats: int) -> None:
        numbers = world.numbers
        for _ in range(repeats):
            for c in range(len(world.chunks) - 1):
                scratch, book = world.scratch[c], world.ledger[c]
                sweep_bonds(world.bonds, c, world.particles, world.cracks, numbers, scratch, book, numbers.dt, 1)

    @njit(**STRICT)  # type: ignore[untyped-decorator]
    def contacts(world: Any, repeats: int) -> None:
        numbers, active = world.numbers, np.empty(LANES, np.uint32)
        for _ in range(repeats):
            for c in range(len(world.chunks) - 1):
                scratch, book, dt = world.scratch[c], world.ledger[c], numbers.dt
                sweep_contacts(world.pairs, c, world.bonds, world.particles, numbers, scratch, active, book, dt)

    return {"bonds": bonds, "contacts": contacts}


def bond_phases(kernels: Kernels) -> dict[str, Callable[..., None]]:
    """Return functions of (world, repeats) that do one phase of the bond sweep; scenes of one chunk."""
    gather, lane_work, scatter = (kernels.get("bond_lane", name) for name in ("gather", "bond_lane", "scatter"))
    read_uniforms = kernels.get("slots", "read_uniforms")

    @njit(**INNER)  # type: ignore[untyped-decorator]
    def gathering(world: Any, repeats: int) -> None:
        for _ in range(repeats):
            for b in range(len(world.bonds.first)):
                for lane in range(LANES):
                    first, second = world.bonds.first[b, lane], world.bonds.second[b, lane]
                    gather(world.particles, first, second, world.scratch[0], lane)

    @njit(**INNER)  # type: ignore[untyped-decorator]
    def arithmetic(world: Any, repeats: int) -> None:
        uniforms = read_uniforms(world.numbers.bond_uniforms)
        for _ in range(repeats):
            for b in range(len(world.bonds.first)):
                data = world.bonds.data[b]
                for lane in range(LANES):
                    lane_work(world.scratch[0], data, lane, uniforms, world.numbers.dt)

    @njit(**INNER)  # type: ignore[untyped-decorator]
    def scattering(world: Any, repeats: int) -> None:
        for _ in range(repeats):
            for b in range(len(world.bonds.first)):
                for lane in range(LANES):
                    first, second = world.bonds.first[b, lane], world.bonds.second[b, lane]
                    scatter(world.particles, first, second, 3, world.scratch[0], lane, 1.0)

    return {"gather": gathering, "kinematics and law": arithmetic, "scatter": scattering}


def contact_phases(kernels: Kernels, touching: Any) -> dict[str, Callable[..., None]]:
    """Return functions of (world, repeats) that do one phase of the contact sweep for the pairs ``touching``."""
    gather, lane_work, scatter = (kernels.get("contact_lane", name) for name in ("gather", "contact_lane", "scatter"))
    constants = kernels.get("slots", "row_constants")

    @njit(**INNER)  # type: ignore[untyped-decorator]
    def gathering(world: Any, repeats: int) -> None:
        for _ in range(repeats):
            for k in range(len(touching)):
                gather(world.particles, world.pairs, touching[k], world.numbers, world.scratch[0], k % LANES)

    @njit(**INNER)  # type: ignore[untyped-decorator]
    def arithmetic(world: Any, repeats: int) -> None:
        shared, numbers = constants(world.numbers.contact_table[0, 0]), world.numbers
        for _ in range(repeats):
            for _ in range(0, len(touching), LANES):
                for lane in range(LANES):
                    lane_work(world.scratch[0], lane, shared, numbers, numbers.dt)

    @njit(**INNER)  # type: ignore[untyped-decorator]
    def scattering(world: Any, repeats: int) -> None:
        for _ in range(repeats):
            for k in range(len(touching)):
                scatter(world.particles, world.pairs, touching[k], world.scratch[0], k % LANES, world.ledger[0])

    return {"gather": gathering, "law": arithmetic, "scatter": scattering}


def nanoseconds(work: Callable[..., None], world: Any, items: int, repeats: int) -> float:
    """Return the CPU ns per item and repeat, the least of several goes."""
    call = njit(**INNER | {"no_cpython_wrapper": False})(work.py_func)  # type: ignore[attr-defined]
    call(world, 1)
    found = []
    for _ in range(REPEATS):
        world.particles.load[:] = 0.0
        begun = time.process_time()
        call(world, repeats)
        found.append(time.process_time() - begun)
    return 1e9 * min(found) / (repeats * items)


def operations(work: Callable[..., None], world: Any) -> Counter[str]:
    """Count the operations on vectors in what the compiler makes of a loop over lanes: so many has each lane."""
    call = njit(**INNER | {"no_cpython_wrapper": False})(work.py_func)  # type: ignore[attr-defined]
    call(world, 1)
    return Counter(a or b for text in call.inspect_llvm().values() for a, b in ARITHMETIC.findall(text))


def table(title: str, rows: dict[str, float]) -> None:
    """Print times as a table."""
    print(f"\n| {title} | ns |\n| --- | ---: |")
    for name, value in rows.items():
        print(f"| {name} | {value:.1f} |")


def main() -> None:
    """Print all tables."""
    with tempfile.TemporaryDirectory() as place:
        _grain(start(base_grain(), 3000, Path(place)))
        _array(start(grain_array(), 10, Path(place)))


def _grain(simulation: Simulation) -> None:
    world, kernels = simulation.world, Kernels(simulation)
    bonds, touching = len(simulation.scene.ends), np.nonzero(world.pairs.touching)[0].astype(np.uint32)
    touching = touching[: len(touching) // LANES * LANES]
    print(f"one grain: {bonds} bonds, {len(world.pairs.touching)} pairs, {world.pairs.touching.sum()} of them touch")
    whole = {name: nanoseconds(work, world, bonds, 2000) for name, work in sweeps(kernels).items()}
    table("per bond", whole)
    phases = bond_phases(kernels)
    table("per bond", {name: nanoseconds(work, world, bonds, 2000) for name, work in phases.items()})
    print(dict(operations(phases["kinematics and law"], world)))
    phases = contact_phases(kernels, touching)
    table("per touching pair", {name: nanoseconds(work, world, len(touching), 4000) for name, work in phases.items()})
    print(dict(operations(phases["law"], world)))


def _array(simulation: Simulation) -> None:
    world, bonds = simulation.world, len(simulation.scene.ends)
    tables: Sequence[Any] = (world.particles, world.bonds, world.pairs)
    sizes = [sum(array.nbytes for array in table) / 1e6 for table in tables]
    print(f"\n125 grains: particles {sizes[0]:.1f} MB, bonds {sizes[1]:.1f} MB, pairs {sizes[2]:.1f} MB")
    table("per bond", {n: nanoseconds(work, world, bonds, 10) for n, work in sweeps(Kernels(simulation)).items()})


if __name__ == "__main__":
    main()

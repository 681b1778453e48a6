"""A bond model, compiled and in plain Python: along one path both give the same bits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from clast.engine.records import build, numbers
from clast.parts.bond_model import RandomKey, Strain
from clast.testing.bits import same_bits
from clast.testing.bonds import SIZES, Bond


def compiled_alike(law: Bond, rows: int = 500) -> None:
    """Compare load, index, energy and mode along a random path, compiled and in plain Python."""
    draw = np.random.default_rng(7)
    strains = draw.normal(size=(rows, 8)) * SIZES * law.size
    strains[::10, draw.integers(0, 8, len(strains[::10]))] = 0.0
    constants = build(type(law.constants), numbers(law.constants))
    strains[0] = 0.0
    sweep, functions = _sweep(law)
    same_bits(sweep, functions, (rows, 12), strains, constants)


def _no_flow(strain: Strain, constants: Any, state: Any) -> Any:
    return state


def _no_overload(strain: Strain, constants: Any, state: Any) -> float:
    return 0.0


def _no_event(strain: Strain, constants: Any, state: Any, key: RandomKey) -> Any:
    return state


def _sweep(law: Bond) -> tuple[Callable[..., None], list[Callable[..., Any]]]:
    """Return a loop that takes a bond along strains, and the functions of the law that it calls."""
    load, energy, failure, mode = law.model.load, law.model.energy, law.model.failure, law.model.mode
    flow, first = law.model.flow or _no_flow, law.start
    overload, on_event = law.model.overload or _no_overload, law.model.on_event or _no_event

    def sweep(strains: Any, constants: Any, out: Any) -> None:
        state = first
        for k in range(len(strains)):
            s = strains[k]
            strain = Strain(s[0], (s[1], s[2], s[3]), s[4], (s[5], s[6], s[7]))
            state = flow(strain, constants, state)
            out[k, 8] = overload(strain, constants, state)
            if out[k, 8] > 1.0:
                state = on_event(strain, constants, state, RandomKey(1, k % 7))
            told = load(strain, constants, state)
            out[k, 0], out[k, 4] = told.normal, told.torsion
            out[k, 1], out[k, 2], out[k, 3] = told.shear
            out[k, 5], out[k, 6], out[k, 7] = told.bending
            out[k, 9] = failure(strain, told, constants, state)
            out[k, 10] = energy(strain, constants, state)
            out[k, 11] = mode(strain, told, constants, state)

    return sweep, [load, energy, failure, mode, flow, overload, on_event]

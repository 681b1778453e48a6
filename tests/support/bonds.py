"""One bond on its own: models with sensible numbers, and the order in which the engine asks a law."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from hypothesis import strategies as st

from clast.engine.records import build, width
from clast.maths.counter_random import uniform
from clast.maths.vec3 import ZERO, Vec, scale
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, RandomKey, Strain
from clast.plugins.discovery import discover
from tests.support.strategies import negated, numbers, unit, vectors

L0, R = 0.26e-3, 0.125e-3
GEOMETRY = BondGeometry(L0, R, math.pi * R**2, math.pi * R**4 / 4.0)  # type: ignore[arg-type]
E, NU = 564.26e6, 0.2
G = E / (2.0 * (1.0 + NU))
STRENGTH, SHEAR_STRENGTH, YIELD, BREAKAGE, SHEAR_BREAKAGE = 4.05e6, 3.0e6, 2.0e6, 0.0075, 0.02
KEY = RandomKey(1, 17)

_BEAM = {"young_modulus": E, "poisson_ratio": NU}
_PLASTIC = _BEAM | {"yield_stress": YIELD, "breakage_strain": BREAKAGE}
_FIBRE = {
    "moment_limit": "outer_fibre",
    "breakage_strain_at": "outer_fibre",
    "breakage_shear_strain": SHEAR_BREAKAGE,
    "compressive_break": 2.0,
}
WRITTEN: dict[str, tuple[str, dict[str, Any]]] = {
    "elastic": ("elastic", _BEAM | {"normal_strength": STRENGTH, "shear_strength": SHEAR_STRENGTH}),
    "elastic, absolute": ("elastic", _BEAM | {"normal_strength": STRENGTH, "normal_term": "absolute"}),
    "timoshenko": ("timoshenko", _BEAM | {"normal_strength": STRENGTH, "shear_strength": SHEAR_STRENGTH}),
    "kelvin": (
        "kelvin",
        _BEAM | {"normal_strength": STRENGTH, "shear_strength": SHEAR_STRENGTH, "retardation_time": 2e-6},
    ),
    "mohr_coulomb": (
        "mohr_coulomb",
        {
            "effective_modulus": 500e6,
            "stiffness_ratio": 2.5,
            "tensile_strength": 4e6,
            "cohesion": 6e6,
            "friction_angle": math.radians(30.0),
            "moment_contribution": 0.5,
        },
    ),
    "cohesive": (
        "cohesive",
        _BEAM
        | {
            "tensile_strength": 2e6,
            "shear_strength": 3e6,
            "fracture_energy": 4.0,
            "shear_fracture_energy": 9.0,
        },
    ),
    "elastic_plastic": ("elastic_plastic", _PLASTIC),
    "elastic_plastic, K": ("elastic_plastic", _PLASTIC | {"compressive_break": 2.0}),
    "micro_cracking": ("micro_cracking", _PLASTIC),
    "micro_cracking, fixed": ("micro_cracking", _PLASTIC | {"fixed_drop": 0.4, "compressive_break": 2.0}),
    "micro_cracking, trial": ("micro_cracking", _PLASTIC | {"drop_from": "trial", "weakening_factor": 0.5}),
    "elastic_plastic, fibre": ("elastic_plastic", _PLASTIC | _FIBRE),
    "elastic_plastic, section": ("elastic_plastic", _PLASTIC | {"moment_limit": "full_section"}),
    "elastic_plastic, break": ("elastic_plastic", _PLASTIC | {"breakage_strain_at": "outer_fibre"}),
    "micro_cracking, fibre": ("micro_cracking", _PLASTIC | _FIBRE),
    "micro_cracking, section": (
        "micro_cracking",
        _PLASTIC | {"moment_limit": "full_section", "drop_from": "trial", "fixed_drop": 0.3},
    ),
}
SHAPE_FACTORS = {"fibre": (1.0, 1.0), "section": (16.0 / (3.0 * math.pi), 4.0 / 3.0)}


class Law(NamedTuple):
    """A bond model, the constants of one bond, and the state it starts in."""

    model: BondModel
    constants: Any
    start: Any


def law(name: str, **options: Any) -> Law:
    """Return a law of ``WRITTEN`` with some options changed."""
    part, written = WRITTEN[name]
    entry = discover().get("bond_model", part)
    params = entry.part.Params(**written | options)
    model: BondModel = entry.part_for(params)
    start = None if model.State is None else build(model.State, [0.0] * width(model.State))
    return Law(model, model.constants(params, GEOMETRY), start)


class Response(NamedTuple):
    """What a bond does at one strain."""

    state: Any
    load: BondLoad
    index: float


def respond(law: Law, strain: Strain, state: Any, key: RandomKey = KEY) -> Response:
    """Return the response to one strain in the order of the step loop: flow, events unless it fails, load."""
    model, c, _ = law
    state = model.flow(strain, c, state) if model.flow else state
    load = model.load(strain, c, state)
    if model.overload and model.failure(strain, load, c, state) < 1.0:
        while model.overload(strain, c, state) > 1.0:
            state = model.on_event(strain, c, state, key)
        load = model.load(strain, c, state)
    return Response(state, load, model.failure(strain, load, c, state))


def follow(law: Law, path: Iterable[Strain], key: RandomKey = KEY) -> list[Response]:
    """Return the responses along a path of strains."""
    state, told = law.start, []
    for strain in path:
        told.append(respond(law, strain, state, key))
        state = told[-1].state
    return told


def stretch(epsilon: float, gamma: float = 0.0, across: Vec = (0.0, 1.0, 0.0)) -> Strain:
    """Return the strain measures of an axial and a shear strain."""
    side = unit(across)
    slip = (gamma * L0 * side[0], gamma * L0 * side[1], gamma * L0 * side[2])
    return Strain(epsilon * L0, slip, 0.0, (0.0, 0.0, 0.0))


def ramp(end: Strain, steps: int) -> list[Strain]:
    """Return a straight path from nothing to a strain."""
    return [scaled(end, k / steps) for k in range(1, steps + 1)]


def scaled(strain: Strain, factor: float) -> Strain:
    def times(a: Vec) -> Vec:
        return (factor * a[0], factor * a[1], factor * a[2])

    return Strain(factor * strain.axial, times(strain.shear), factor * strain.twist, times(strain.bending))


def strains(size: float = 0.01) -> st.SearchStrategy[Strain]:
    """Return strains that each reach about ``size``: axial and shear, and of the surface by twist and by bending."""
    angle = size * L0 / R
    return st.builds(Strain, numbers(-size * L0, size * L0), vectors(size * L0), numbers(-angle, angle), vectors(angle))


def swapped(strain: Strain) -> Strain:
    """Return the same deformation with the names of the ends swapped."""
    return Strain(strain.axial, negated(strain.shear), strain.twist, negated(strain.bending))


def bent(epsilon: float, about: Vec = (0.0, 1.0, 0.0)) -> Strain:
    """Return the bending that strains the outermost fibre by ``epsilon``."""
    return Strain(0.0, ZERO, 0.0, scale(epsilon * L0 / R, unit(about)))


def twisted(gamma: float) -> Strain:
    """Return the twist that shears the surface by ``gamma``."""
    return Strain(0.0, ZERO, gamma * L0 / R, ZERO)


def normal_stress(load: BondLoad) -> float:
    return load.normal / float(GEOMETRY.A)


def shear_stress(load: BondLoad) -> float:
    return math.hypot(*load.shear) / float(GEOMETRY.A)


def bending_stress(load: BondLoad) -> float:
    """Return |M_b| R/I."""
    return math.hypot(*load.bending) * R / float(GEOMETRY.I)


def torsion_stress(load: BondLoad) -> float:
    """Return M_t R/J."""
    return load.torsion * R / (2.0 * float(GEOMETRY.I))


def shares(count: int, weakening: float = 1.0, key: RandomKey = KEY, component: int = 0) -> list[float]:
    """Return what the first drops of a bond leave of the stress."""
    return [weakening * uniform(key.seed, key.bond, component, k) for k in range(count)]

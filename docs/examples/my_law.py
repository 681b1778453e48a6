# ruff: noqa: D101, D103
"""A bond that softens before it breaks, and a linear contact."""

from math import log, pi, sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress, Unit
from clast.maths.vec3 import ZERO, dot, scale
from clast.parts.bond_model import BondLoad, BondModel
from clast.parts.contact_law import ContactLaw, ContactLoad
from clast.parts.params import Params
from clast_plugins.bond_models.beam import beam_energy, beam_stiffness

CLAST_API = 1


class Softening(Params):
    """(1 - D) times an elastic beam; D goes from 0 at the axial strain eps_0 to 1 at eps_f and never back."""

    young_modulus: Annotated[Stress, Field(gt=0, examples=["100 MPa"], description="Young's modulus E")]
    damage_strain: Annotated[Number, Field(gt=0, examples=[0.001], description="Strain eps_0 where damage begins")]
    breakage_strain: Annotated[Number, Field(gt=0, examples=[0.004], description="Strain eps_f where it breaks")]


class BondConstants(NamedTuple):
    per_L: float
    axial: float
    shear: float
    torsion: float
    bending: float
    eps_0: float
    eps_f: float


class BondState(NamedTuple):
    largest: float  # the largest axial strain so far; every state starts at 0


def stiffness(params, bond):
    return beam_stiffness(params.young_modulus, 0.2, bond)


def constants(params, bond):
    return BondConstants(1 / bond.L0, *stiffness(params, bond), params.damage_strain, params.breakage_strain)


def flow(strain, c, state):
    return BondState(max(state.largest, c.per_L * strain.axial))


def load(strain, c, state):
    peak = max(state.largest, c.eps_0)
    kept = max(c.eps_0 * (c.eps_f - peak) / (peak * (c.eps_f - c.eps_0)), 0.0)  # 1 - D: a straight way down
    return BondLoad(
        normal=(kept if strain.axial > 0 else 1.0) * c.axial * strain.axial,  # pressed cracks close
        shear=scale(kept * c.shear, strain.shear),
        torsion=kept * c.torsion * strain.twist,
        bending=scale(kept * c.bending, strain.bending),
    )


def failure(strain, load, c, state):
    return state.largest / c.eps_f


def mode(strain, load, c, state):
    return 0


def energy(strain, c, state):
    return beam_energy(strain, load(strain, c, state))


class Linear(Params):
    """F = k delta + c v without friction; c gives the pair's coefficient of restitution."""

    stiffness: Annotated[float, Unit("N/m"), Field(gt=0, examples=["10 kN/m"], description="Stiffness k")]


class ContactConstants(NamedTuple):
    k: float
    damping_ratio: float


def contact_constants(params, pair):
    ln_e = log(max(pair.restitution, 1e-6))
    return ContactConstants(params.stiffness, -ln_e / sqrt(pi**2 + ln_e**2))


def choices(params, features):
    return features


def contact_load(touch, c, history, dt, choices):
    damping = 2 * c.damping_ratio * sqrt(c.k / touch.inverse_mass)
    force = c.k * touch.overlap - damping * dot(touch.velocity, touch.normal)
    return ContactLoad(scale(force, touch.normal), ZERO, ZERO), history


def contact_energy(touch, c, history, choices):
    return 0.5 * c.k * touch.overlap * touch.overlap


def contact_stiffness(c, radius, overlap):
    return c.k


@hookimpl
def clast_register(registry):
    bond = {"constants": constants, "stiffness": stiffness, "load": load, "energy": energy, "flow": flow}
    bond |= {"failure": failure, "mode": mode, "modes": ("tension",)}
    registry.bond_model("softening", BondModel("softens", Softening, BondConstants, State=BondState, **bond))
    contact = {"constants": contact_constants, "choices": choices, "load": contact_load}
    contact |= {"energy": contact_energy, "stiffness": contact_stiffness}
    registry.contact_law("spring_dashpot", ContactLaw("spring and dashpot", Linear, ContactConstants, **contact))

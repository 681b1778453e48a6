"""Cohesive bond: beyond its strength it softens, and breaking it takes a given energy for each area."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

import numpy as np
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress, Unit
from clast.maths.vec3 import dot, scale
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Stiffness, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.bond_models.beam import Springs, beam_energy, beam_stiffness, spring_load

MODES = ("opening", "sliding")
SMALLEST = 1e-300
"""Stands in for the energy of a bond that is not strained at all, so that nothing is divided by 0."""


class Cohesive(Params):
    r"""Elastic bond with linear softening: its damage grows until the energy of fracture is spent.

    Equation
    --------
    N = (1 − D) EA/L0 u (D = 0 where u < 0),  T = (1 − D) GA/L0 w,  M_t = (1 − D) GJ/L0 θ_t,  M_b = (1 − D) EI/L0 θ_b
    D = f/(f − 1) (1 − 1/r), the largest so far, 0 up to r = 1;  breaks when r ≥ f, where D = 1
    r² = (E a/L0/σ_c)² + (G b/L0/τ_c)²,  f = 2 r²/(E a²/L0/G_n + G b²/L0/G_s)

    Symbols
    -------
    u, w, θ_t, θ_b : elongation, displacement across, twist and bending
    a, b : opening and sliding, root mean squares over the section: a² = max(u, 0)² + I/A θ_b², b² = |w|² + J/A θ_t²
    r : the elastic stress as a multiple of that at which damage begins; f : that at which nothing is left
    σ_c, τ_c : strengths; G_n, G_s : energies of fracture by opening and by sliding, for each area of the section
    D : damage, the state of the bond; it never falls, and a bond unloads towards its undeformed state

    Limits
    ------
    Loaded in one proportion of opening to sliding, a bond has taken exactly G_n, G_s, or W_n/G_n + W_s/G_s = 1 of both
    when it breaks; where the proportion changes on the way, about that. Bonds so long that they hold more than the
    energy of fracture at their strength, σ_c² L0/(2 E) > G_n or τ_c² L0/(2 G) > G_s, would snap back and are refused.
    In pure bending and torsion damage begins where the stress of the outermost fibre is 2 σ_c and √2 τ_c. Pressure
    neither damages a bond nor keeps it from sliding.

    Source
    ------
    P. P. Camanho, C. G. Dávila (2002), NASA/TM-2002-211737: quadratic onset, linear softening, linear criterion of the
    energies (their power law with exponent 1), here with the stiffness of the bond in the place of a penalty. Crack
    band: Z. P. Bažant, B. H. Oh (1983), Matériaux et Constructions 16, 155–177, doi:10.1007/BF02486267.
    """

    young_modulus: Annotated[Stress, Field(gt=0, examples=["500 MPa"], description="Young's modulus E of the bond")]
    poisson_ratio: Annotated[Number, Field(gt=-1, lt=0.5, examples=[0.2], description="Poisson's ratio of the bond")]
    tensile_strength: Annotated[
        Stress, Field(gt=0, examples=["4 MPa"], description="Normal stress at which damage begins, sigma_c")
    ]
    shear_strength: Annotated[
        Stress, Field(gt=0, examples=["4 MPa"], description="Shear stress at which damage begins, tau_c")
    ]
    fracture_energy: Annotated[
        float, Unit("J/m2"), Field(gt=0, examples=["20 J/m2"], description="Energy to break by opening, G_n")
    ]
    shear_fracture_energy: Annotated[
        float, Unit("J/m2"), Field(gt=0, examples=["40 J/m2"], description="Energy to break by sliding, G_s")
    ]


class Constants(NamedTuple):
    """Numbers of one bond.

    ``bending_arm`` and ``torsion_arm`` are I/A and J/A; ``opening`` and ``sliding`` make the squares of opening and
    sliding parts of r², ``opening_energy`` and ``sliding_energy`` shares of the energy of fracture.
    """

    k: Springs
    bending_arm: float
    torsion_arm: float
    opening: float
    sliding: float
    opening_energy: float
    sliding_energy: float


class State(NamedTuple):
    """Damage: 0 intact, 1 broken."""

    damage: float


def stiffness(params: Cohesive, bond: BondGeometry) -> Stiffness:
    """Return EA/L0, GA/L0, GJ/L0, EI/L0 of all bonds: those of the undamaged ones."""
    return beam_stiffness(params.young_modulus, params.poisson_ratio, bond)


def constants(params: Cohesive, bond: BondGeometry) -> Constants:
    """Compute the constants of all bonds."""
    k = stiffness(params, bond)
    normal, shear = k.axial / bond.A, k.shear / bond.A
    return Constants(
        k=Springs._make(k),
        bending_arm=bond.I / bond.A,
        torsion_arm=2.0 * bond.I / bond.A,
        opening=(normal / params.tensile_strength) ** 2,
        sliding=(shear / params.shear_strength) ** 2,
        opening_energy=normal / params.fracture_energy,
        sliding_energy=shear / params.shear_fracture_energy,
    )


def misfit(params: Cohesive, bond: BondGeometry) -> str | None:
    """Tell of a bond that holds more than its energy of fracture when damage begins, if there is one."""
    k = stiffness(params, bond)
    opening = ("tensile_strength", params.tensile_strength, k.axial, "fracture_energy", params.fracture_energy)
    sliding = ("shear_strength", params.shear_strength, k.shear, "shear_fracture_energy", params.shear_fracture_energy)
    for strength_name, strength, stiff, energy_name, energy in (opening, sliding):
        held = np.atleast_1d(0.5 * bond.A * np.asarray(strength) ** 2 / stiff)
        share = held / energy
        worst = int(np.argmax(share))
        if share[worst] >= 1.0:
            length = np.ravel(bond.L0)[worst]
            return (
                f"bond {worst}, {length:.4g} m long, holds {held[worst]:.4g} J/m2 at its {strength_name}, but "
                f"{energy_name} is {held[worst] / share[worst]:.4g} J/m2: it would snap back. Raise {energy_name} or "
                f"young_modulus, lower {strength_name}, or make the bonds shorter"
            )
    return None


def separations(strain: Strain, c: Constants) -> tuple[float, float]:
    """Return the squares of opening and sliding, means over the section, in m²."""
    opened = max(strain.axial, 0.0)
    return (
        opened * opened + c.bending_arm * dot(strain.bending, strain.bending),
        dot(strain.shear, strain.shear) + c.torsion_arm * strain.twist * strain.twist,
    )


def overstress(strain: Strain, c: Constants) -> tuple[float, float]:
    """Return r and f: the elastic stress as a multiple of that where damage begins, and where it is complete."""
    a, b = separations(strain, c)
    square = c.opening * a + c.sliding * b
    energy = c.opening_energy * a + c.sliding_energy * b
    return sqrt(square), 2.0 * square / max(energy, SMALLEST)


def flow(strain: Strain, c: Constants, state: State) -> State:
    """Let damage grow to what the strain asks for."""
    r, f = overstress(strain, c)
    beyond = max(r, 1.0)
    asked = f * (beyond - 1.0) / (beyond * max(f - 1.0, SMALLEST))
    return State(max(state.damage, min(asked, 1.0)))


def load(strain: Strain, c: Constants, state: State) -> BondLoad:
    """Return what is left of stiffness times strain measure; a bond that is pressed is closed and whole."""
    kept = 1.0 - state.damage
    whole = spring_load(strain, c.k)
    return BondLoad(
        normal=(kept if strain.axial > 0.0 else 1.0) * whole.normal,
        shear=scale(kept, whole.shear),
        torsion=kept * whole.torsion,
        bending=scale(kept, whole.bending),
    )


def failure(strain: Strain, load: BondLoad, c: Constants, state: State) -> float:
    """Return r/f: how far the strain is on the way to that at which nothing is left."""
    r, f = overstress(strain, c)
    return r / max(f, 1.0)


def mode(strain: Strain, load: BondLoad, c: Constants, state: State) -> int:
    """Return 0 where opening has the larger share of the energy, 1 where sliding has."""
    a, b = separations(strain, c)
    return 1 if c.sliding_energy * b > c.opening_energy * a else 0


def energy(strain: Strain, c: Constants, state: State) -> float:
    """Return the elastic energy in J."""
    return beam_energy(strain, load(strain, c, state))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the cohesive bond."""
    registry.bond_model(
        "cohesive",
        BondModel(
            summary="softens beyond its strengths, breaks once its energy of fracture is spent",
            Params=Cohesive,
            Constants=Constants,
            constants=constants,
            stiffness=stiffness,
            load=load,
            failure=failure,
            mode=mode,
            energy=energy,
            modes=MODES,
            State=State,
            flow=flow,
            misfit=misfit,
        ),
    )

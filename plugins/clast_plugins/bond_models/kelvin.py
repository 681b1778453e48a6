"""Kelvin–Voigt bond: elastic with a dashpot beside each spring, so that it creeps under a load that stays."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Time
from clast.parts.bond_model import BondGeometry, Dashpots
from clast.plugins.registry import Registry
from clast_plugins.bond_models import elastic
from clast_plugins.bond_models.strength import BrittleBond


class Kelvin(BrittleBond):
    r"""Viscoelastic bond: each strain measure has a spring and, beside it, a dashpot with the same time of retardation.

    Equation
    --------
    F = k (e + τ de/dt) for e each of elongation, displacement across, twist and bending
    breaks when σ ≥ σ_br or τ_s ≥ τ_br, the stresses of the springs: see ``elastic``

    Symbols
    -------
    k : EA/L0, GA/L0, GJ/L0, EI/L0
    τ : time of retardation; the viscosity of the material is η = E τ. Under a load that stays a bond creeps towards its
        elastic strain, 1 − exp(−t/τ) of it after a time t
    σ, τ_s : normal and shear stress of the outermost fibre, by the elastic part of the loads

    Limits
    ------
    Breakage, failure index and the loads that are told see the springs alone: a bond breaks by how far it is deformed.
    So a load F above what a spring can bear, F_br, breaks it with a delay of τ ln(F/(F − F_br)), and a fast blow may be
    borne by the dashpots. Without a spring in series a bond is stiff against sudden motion: the stable step falls to
    about 1/(τ ω²) where τ ω is large.

    Source
    ------
    W. N. Findley, J. S. Lai, K. Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials, North-Holland (1976),
    Chapter 5; the springs and strengths are those of Rotter, Dosta, Düster (2023), Eqs. 3–8.
    """

    retardation_time: Annotated[
        Time, Field(gt=0, examples=["0.1 us"], description="tau: time in which 63 % of the elastic strain is reached")
    ]


def dashpots(params: Kelvin, bond: BondGeometry) -> Dashpots:
    """Return τ EA/L0, τ GA/L0, τ GJ/L0, τ EI/L0 of all bonds."""
    k = elastic.stiffness(params, bond)
    tau = params.retardation_time
    return Dashpots(tau * k.axial, tau * k.shear, tau * k.torsion, tau * k.bending)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the Kelvin–Voigt bond."""
    registry.bond_model(
        "kelvin",
        replace(
            elastic.MODEL,
            summary="Kelvin-Voigt: elastic with dashpots, creeps under load, breaks by how far it is deformed",
            Params=Kelvin,
            dashpots=dashpots,
        ),
    )

"""Time step limits: how large a step the bonds and contacts of a scene allow."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.config.scene import SceneConfig
from clast.engine.blueprint import Blueprint
from clast.scene.plan import bond_stiffness, material_pairs
from clast.scene.scene import Scene

IMPACT_SPEED = 1.0


class Limits(NamedTuple):
    """Limits of the time step in s; infinite where they do not apply.

    Attributes
    ----------
    rayleigh : float
        Time of a Rayleigh wave over the smallest particle, Eq. 15.
    bond : float
        2 √(m_min/K_max) of the stiffest bond, Eqs. 16–17.
    network : float
        2/ω_max of the undeformed bond network, every degree of freedom included: the exact limit of an undamped
        elastic agglomerate.
    contact : float
        A twentieth of the duration of a Hertz impact of the two lightest particles at 1 m/s: an accuracy bound.
    damping : float
        Share of ``network`` that the integrator keeps with the scene's bond damping.
    """

    rayleigh: float
    bond: float
    network: float
    contact: float
    damping: float

    @property
    def paper(self) -> float:
        """The smaller of the paper's two limits."""
        return min(self.rayleigh, self.bond)

    @property
    def stable(self) -> float:
        """The step beyond which bonds are unstable, or an impact at 1 m/s is over within two steps."""
        return min(self.network * self.damping, 10.0 * self.contact)


def limits(scene: Scene, plan: Blueprint) -> Limits:
    """Return all limits of a scene at its start."""
    zeta = scene.config.bonds.damping if scene.config.bonds else 0.0
    return Limits(
        rayleigh=rayleigh_limit(scene),
        bond=bond_limit(scene),
        network=network_limit(scene),
        contact=contact_limit(scene),
        damping=plan.integrator.damping_factor(zeta),
    )


def rayleigh_limit(scene: Scene) -> float:
    """Return the smallest π r √(ρ/G)/(0.1631 ν + 0.8766), with scaled density; Eq. 15."""
    materials = list(scene.config.materials.values())
    found = np.inf
    for k in np.unique(scene.material):
        each = materials[k]
        G = each.young_modulus / (2.0 * (1.0 + each.poisson_ratio))
        slowness = np.sqrt(each.density * scene.config.time.mass_scaling / G)
        radius = scene.radius[scene.material == k].min()
        found = min(found, np.pi * radius * slowness / (0.1631 * each.poisson_ratio + 0.8766))
    return float(found)


def bond_limit(scene: Scene) -> float:
    """Return 2 √(m_min/K_max); Eqs. 16–17."""
    if len(scene.ends) == 0:
        return np.inf
    k = bond_stiffness(scene)
    return float(2.0 * np.sqrt(scene.mass.min() / max(k.axial.max(), k.shear.max())))


def contact_limit(scene: Scene) -> float:
    """Return a twentieth of 2.94 (5 m*/(4 k_H))^0.4 v^-0.2 for the two lightest particles at 1 m/s."""
    if scene.config.contacts is None:
        return np.inf
    pairs = [pair for i, j, pair in material_pairs(scene) if i == j]
    if not pairs:
        return np.inf
    E = max(pair.young_modulus_i / (2.0 * (1.0 - pair.poisson_ratio_i**2)) for pair in pairs)
    k_hertz = 4.0 / 3.0 * E * np.sqrt(0.5 * scene.radius.min())
    return float(0.05 * 2.94 * (5.0 * 0.5 * scene.mass.min() / (4.0 * k_hertz)) ** 0.4 * IMPACT_SPEED**-0.2)


def network_limit(scene: Scene) -> float:
    """Return 2/ω_max of the undeformed bonds, from the largest eigenvalue of M⁻½ K M⁻½."""
    if len(scene.ends) == 0:
        return np.inf
    from clast.engine.network import largest_frequency

    frequency = largest_frequency(scene)
    return float(2.0 / frequency) if frequency > 0.0 else np.inf


def pair_limit(scene: Scene) -> float:
    """Return the smallest 2/√(K (1/m_i + 1/m_j)) of a bond whose ends are free otherwise: ``network`` is never above.

    The other bonds only add energy to the stretching of this one, so the network's ω_max is at least as large.
    """
    if len(scene.ends) == 0:
        return np.inf
    inverse_mass = np.where(scene.prescribed, 0.0, 1.0 / scene.mass)
    square = float(np.max(bond_stiffness(scene).axial * inverse_mass[scene.ends].sum(axis=1)))
    return float(2.0 / np.sqrt(square)) if square > 0.0 else np.inf


def choose_step(scene: Scene, found: Limits) -> float:
    """Return the time step a config asks for.

    Raises
    ------
    ConfigError
        If a fixed step is above the limit, or no rule gives a finite one.
    """
    step = asked_step(scene.config, found.paper)
    if step > found.stable and not scene.config.time.allow_unstable:
        cause = "bonds" if found.network * found.damping == found.stable else "contacts"
        raise scene.config.problem(
            ("time", "step"),
            f"{step:.4g} s is above the stability limit of the {cause}, {found.stable:.4g} s; take a smaller step, "
            "raise time.mass_scaling, or set time.allow_unstable",
        )
    return step


def asked_step(config: SceneConfig, limit: float) -> float:
    """Return the fixed step of a config, or what its rule makes of the paper's limit, in s.

    Raises
    ------
    ConfigError
        If no rule gives a finite one.
    """
    rule = config.time.step
    if isinstance(rule, float):
        return rule
    if not np.isfinite(limit):
        text = "no limit applies to this scene, so the rule gives no step; write one, for instance 'step: 1e-6 s'"
        raise config.problem(("time", "step"), text)
    return rule.factor * limit

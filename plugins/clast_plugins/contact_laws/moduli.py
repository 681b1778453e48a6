"""Effective moduli of two elastic bodies in contact."""

from __future__ import annotations

from clast.parts.contact_law import MaterialPair


def normal_modulus(pair: MaterialPair) -> float:
    """Return E* in Pa: 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j; Hertz (1882)."""
    nu_i, nu_j = pair.poisson_ratio_i, pair.poisson_ratio_j
    return 1.0 / ((1.0 - nu_i**2) / pair.young_modulus_i + (1.0 - nu_j**2) / pair.young_modulus_j)


def tangential_modulus(pair: MaterialPair) -> float:
    """Return G* in Pa: 1/G* = (2 − ν_i)/G_i + (2 − ν_j)/G_j; Mindlin and Deresiewicz (1953)."""
    nu_i, nu_j = pair.poisson_ratio_i, pair.poisson_ratio_j
    G_i = pair.young_modulus_i / (2.0 * (1.0 + nu_i))
    G_j = pair.young_modulus_j / (2.0 * (1.0 + nu_j))
    return 1.0 / ((2.0 - nu_i) / G_i + (2.0 - nu_j) / G_j)

"""Closed form of an oblique elastic impact of a Hertzian sphere whose contact point never slides.

The tangential spring stiffens with the contact radius, as the normal one does: with y = δ/δ_max the tangential
displacement ξ obeys

    (1 − y^(5/2)) ξ'' − 5/4 y^(3/2) ξ' + 5/4 λ y^(1/2) ξ = 0,        λ = 7/2 · 8 G* / (4/3 E*) = 21 G*/E*,

7/2 because a tangential force moves the contact point of a sphere by translation and by rotation. In s = y^(5/2) this
is the hypergeometric equation: with a + b = 9/10 and c = 7/5 the solutions that begin as ξ = y and ξ = 1 are

    y F(a, b; 7/5; s)        F(a − 2/5, b − 2/5; 3/5; s).

At the turning point s = 1 each is p + q √(1 − s). The impact is symmetric in time about it, so the even solution, the
one without √(1 − s), tells how the contact point leaves: slip'/slip = (p0 q1 + p1 q0)/(p0 q1 − p1 q0).

Source: the stiffness 8 G* a is that of R. D. Mindlin and H. Deresiewicz (1953), doi:10.1115/1.4010702, without slip.
N. Maw, J. R. Barber and J. N. Fawcett (1976), doi:10.1016/0043-1648(76)90201-5, treat the same impact with slip.
"""

from __future__ import annotations

from math import sqrt

from scipy.special import gamma, rgamma

from clast.config.sections import Material


def slip_ratio(tangential_modulus: float, modulus: float) -> float:
    """Return slip'/slip of a homogeneous sphere.

    Parameters
    ----------
    tangential_modulus, modulus : float
        G* and E* in Pa.

    Examples
    --------
    A tangential spring that is hardly there leaves the slip as it is; 21 G* = E* makes it as stiff against the contact
    point as the normal one is against the centre, and all of the slip is reversed.

    >>> round(slip_ratio(1e-9, 1.0), 6), round(slip_ratio(1.0 / 21.0, 1.0), 6)
    (1.0, -1.0)
    """
    root = sqrt(1.0 / 16.0 + 105.0 * tangential_modulus / modulus)
    a, b = 0.4 * (1.125 - 0.5 * root), 0.4 * (1.125 + 0.5 * root)
    p1, q1 = at_turning(a, b, 1.4)
    p0, q0 = at_turning(a - 0.4, b - 0.4, 0.6)
    return (p0 * q1 + p1 * q0) / (p0 * q1 - p1 * q0)


def effective_tangential_modulus(a: Material, b: Material) -> float:
    """Return G* of two materials in Pa: 1/G* = (2 − ν_a)/G_a + (2 − ν_b)/G_b, G = E/(2(1 + ν))."""
    compliance = sum(
        2.0 * (2.0 - each.poisson_ratio) * (1.0 + each.poisson_ratio) / each.young_modulus for each in (a, b)
    )
    return 1.0 / compliance


def at_turning(a: float, b: float, c: float) -> tuple[float, float]:
    """Return p and q of F(a, b; c; s) = p + q √(1 − s) near s = 1, where c = a + b + 1/2."""
    p = gamma(c) * gamma(0.5) * rgamma(c - a) * rgamma(c - b)
    q = gamma(c) * gamma(-0.5) * rgamma(a) * rgamma(b)
    return float(p), float(q)

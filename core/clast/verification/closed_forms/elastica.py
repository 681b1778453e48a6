"""The elastica: a slender cantilever under a load at its tip that keeps its direction.

Source: K. E. Bisshopp and D. C. Drucker (1945), Quarterly of Applied Mathematics 3, doi:10.1090/qam/13360, in elliptic
integrals; the beam neither stretches nor shears.
"""

from __future__ import annotations

from math import asin, sqrt
from typing import NamedTuple


class Tip(NamedTuple):
    """Where the tip is, as shares of the length: across the beam at rest, and along it."""

    across: float
    along: float


def tip(load: float) -> Tip:
    """Return where the tip is under P L²/EI.

    With p² = (1 + sin φ)/2 for the slope φ of the tip and sin ψ = 1/(p √2): √(P L²/EI) = K(p) − F(p, ψ),
    w/L = 1 − 2 (E(p) − E(p, ψ))/√(P L²/EI) and x/L = √(2 sin φ)/√(P L²/EI).

    Examples
    --------
    A small load deflects it by a third of P L²/EI:

    >>> round(tip(1e-3).across, 9)
    0.000333333
    >>> [round(tip(load).across, 4) for load in (1, 2, 5, 10)]
    [0.3017, 0.4935, 0.7138, 0.8106]
    """
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

    def root_of_load(m: float) -> float:
        return float(ellipk(m) - ellipkinc(asin(sqrt(0.5 / m)), m))

    m = brentq(lambda m: root_of_load(m) - sqrt(load), 0.5 + 1e-15, 1.0 - 1e-12, xtol=1e-15)
    psi, root = asin(sqrt(0.5 / m)), sqrt(load)
    return Tip(1.0 - 2.0 * float(ellipe(m) - ellipeinc(psi, m)) / root, sqrt(2.0 * (2.0 * m - 1.0)) / root)

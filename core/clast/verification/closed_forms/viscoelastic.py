"""Closed form of the coefficient of restitution of viscoelastic spheres.

Source: T. Schwager and T. Pöschel (1998), doi:10.1103/PhysRevE.57.650; the first two terms also R. Ramírez, T. Pöschel,
N. V. Brilliantov and T. Schwager (1999), doi:10.1103/PhysRevE.60.4465.
"""

from __future__ import annotations

from math import gamma, pi, sqrt

C1 = sqrt(pi) * gamma(0.6) / (2.0**0.2 * 5.0**0.4 * gamma(2.1))
COEFFICIENTS = (1.0, -C1, 0.6 * C1**2, -0.483582, 0.285279)
"""Of the powers of x = A κ^(2/5) v^(1/5); the contact ends when the overlap does."""


def restitution(modulus: float, radius: float, mass: float, dissipative_time: float, speed: float) -> float:
    """Return v'/v.

    Parameters
    ----------
    modulus, radius, mass : float
        Effective ones: E* in Pa, R* in m, m* in kg.
    dissipative_time : float
        A in s.
    speed : float
        Approach v in m/s.

    Examples
    --------
    It falls with the fifth root of the speed:

    >>> [round(restitution(1.0, 1.0, 1.0, 0.05, v), 4) for v in (1e-5, 1.0)]
    [0.9904, 0.9083]
    """
    kappa = 1.5**2.5 * 4.0 / 3.0 * modulus * sqrt(radius) / mass
    x = dissipative_time * kappa**0.4 * speed**0.2
    return float(sum(c * x**k for k, c in enumerate(COEFFICIENTS)))

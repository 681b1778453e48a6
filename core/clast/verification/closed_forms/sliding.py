"""Closed forms of oblique impacts that slide all through.

A sphere that meets a much heavier body loses the tangential impulse μ (1 + e) m v_n, whatever the normal law, as long
as its contact point slides the same way to the end. Its moment of inertia is 2/5 m r², so the spin gains 5/2 of that
and the slip loses 7/2.

Source: Coulomb's law and the balances of momentum and of moments; N. Maw, J. R. Barber and J. N. Fawcett (1976),
doi:10.1016/0043-1648(76)90201-5, call it gross slip.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.verification.curves import Floats


class Motion(NamedTuple):
    """How spheres move over a plane below them: each (n,) in m/s.

    Attributes
    ----------
    across : array
        Speed towards the plane.
    along : array
        Velocity of the centre along x.
    turning : array
        Radius times spin about y: the speed of rolling along x.
    """

    across: Floats
    along: Floats
    turning: Floats

    @property
    def slip(self) -> Floats:
        """Velocity of the contact point along x."""
        return self.along - self.turning


def friction_impulse(before: Motion, friction: Floats, restitution: Floats) -> Floats:
    """Return μ (1 + e) v_n: the largest tangential impulse per mass that friction can give, in m/s."""
    return np.asarray(friction * (1.0 + restitution) * before.across)


def slides(before: Motion, friction: Floats, restitution: Floats) -> NDArray[np.bool_]:
    """Tell which spheres slide all through: |slip| ≥ 7/2 μ (1 + e) v_n."""
    return np.asarray(np.abs(before.slip) >= 3.5 * friction_impulse(before, friction, restitution))


def after_sliding(before: Motion, friction: Floats, restitution: Floats) -> Motion:
    """Return the motion after an impact with sliding all through.

    Examples
    --------
    Test 4 of Chung and Ooi (2011) at 60°: restitution of the tangential speed, spin, and angle of the rebound at the
    contact point.

    >>> angle, mu, e, r = np.radians(60.0), 0.092, 0.98, 2.5e-3
    >>> before = Motion(3.9 * np.cos(angle), 3.9 * np.sin(angle), 0.0)
    >>> after = after_sliding(before, mu, e)
    >>> print(f"{after.along / before.along:.4f}  {after.turning / r:.1f}  "
    ...       f"{np.degrees(np.arctan(after.slip / -after.across)):.2f}")
    0.8948  355.2  48.16
    """
    lost = np.sign(before.slip) * friction_impulse(before, friction, restitution)
    return Motion(-restitution * before.across, before.along - lost, before.turning + 2.5 * lost)

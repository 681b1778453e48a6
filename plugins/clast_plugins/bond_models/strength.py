"""Breaking at a normal or a shear stress of the outermost fibre: what brittle bonds have in common."""

from __future__ import annotations

from typing import Annotated, Literal, Protocol

from pydantic import Field

from clast.config.quantities import Number, Stress
from clast.parts.params import Params

MODES = ("tension", "shear")


class BrittleBond(Params):
    """Parameters of an elastic bond that breaks at a stress."""

    young_modulus: Annotated[Stress, Field(gt=0, examples=["564.26 MPa"], description="Young's modulus E of the bond")]
    poisson_ratio: Annotated[Number, Field(gt=-1, lt=0.5, examples=[0.2], description="Poisson's ratio of the bond")]
    normal_strength: Annotated[
        Stress, Field(gt=0, examples=["4.05 MPa"], description="Strength against tension and bending, sigma_br")
    ]
    shear_strength: Annotated[
        Stress | None, Field(gt=0, description="Strength against shear and torsion, tau_br; none: unlimited")
    ] = None
    normal_term: Annotated[
        Literal["tension", "absolute"],
        Field(description="whether compression relieves the outer fibre (tension) or loads it (absolute)"),
    ] = "tension"

    @property
    def per_shear_strength(self) -> float:
        """1/τ_br in 1/Pa; 0 where there is no limit."""
        return 0.0 if self.shear_strength is None else 1.0 / self.shear_strength

    @property
    def compression_sign(self) -> float:
        """What the normal stress of a pressed bond counts as: −1 relieves the outer fibre, +1 loads it."""
        return -1.0 if self.normal_term == "tension" else 1.0


class Strengths(Protocol):
    """Numbers of a law that breaks at a stress."""

    @property
    def A(self) -> float:
        """Section in m²."""

    @property
    def W(self) -> float:
        """Section modulus I/R in m³."""

    @property
    def W_t(self) -> float:
        """Section modulus J/R in m³."""

    @property
    def per_normal_strength(self) -> float:
        """1/σ_br in 1/Pa."""

    @property
    def per_shear_strength(self) -> float:
        """1/τ_br in 1/Pa."""

    @property
    def compression_sign(self) -> float:
        """See :attr:`BrittleBond.compression_sign`."""


def shares(normal: float, shear: float, torsion: float, bending: float, c: Strengths) -> tuple[float, float]:
    """Return normal and shear stress of the outermost fibre, each as a share of its strength.

    Source: Rotter, Dosta, Düster (2023), Eqs. 7–8.

    Parameters
    ----------
    normal, shear : float
        Force along the bond, tension positive, and size of that across it, in N.
    torsion, bending : float
        Moment about the bond, and size of that across it, in N m.
    """
    sign = 1.0 if normal > 0.0 else c.compression_sign
    sigma = sign * abs(normal) / c.A + bending / c.W
    tau = shear / c.A + abs(torsion) / c.W_t
    return sigma * c.per_normal_strength, tau * c.per_shear_strength

"""What a user writes for a bond that yields and breaks at a strain: what Models 2 and 3 have in common."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from clast.config.quantities import Number, Stress
from clast.parts.params import Params


class YieldingBond(Params):
    """Parameters of a bond that yields at a stress and breaks at a strain."""

    young_modulus: Annotated[Stress, Field(gt=0, examples=["564.26 MPa"], description="Young's modulus E of the bond")]
    poisson_ratio: Annotated[Number, Field(gt=-1, lt=0.5, examples=[0.2], description="Poisson's ratio of the bond")]
    yield_stress: Annotated[
        Stress, Field(gt=0, examples=["2 MPa"], description="Stress sigma_y that normal and shear stress can reach")
    ]
    breakage_strain: Annotated[
        Number, Field(gt=0, examples=[0.0075], description="Strain at which the bond breaks, epsilon_max")
    ]
    compressive_break: Annotated[
        Number, Field(ge=0, description="K: also breaks at a strain below -K epsilon_max; 0: never")
    ] = 0.0
    moment_limit: Annotated[
        Literal["none", "outer_fibre", "full_section"],
        Field(
            description="bending and torsion: elastic without limit (none), or limited by the moments at which "
            "the outermost fibre or the full section is at sigma_y"
        ),
    ] = "none"
    breakage_strain_at: Annotated[
        Literal["axis", "outer_fibre"],
        Field(description="where the strains that break the bond are taken; outer_fibre adds bending and torsion"),
    ] = "axis"
    breakage_shear_strain: Annotated[
        Number | None, Field(gt=0, description="Shear strain at which the bond breaks, gamma_max; none: never")
    ] = None

    @property
    def watches_fibre(self) -> bool:
        """Whether the law needs more than what normal and shear stress do along the axis."""
        return (
            self.moment_limit != "none" or self.breakage_strain_at != "axis" or self.breakage_shear_strain is not None
        )

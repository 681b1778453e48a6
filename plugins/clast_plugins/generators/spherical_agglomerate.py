"""Spherical agglomerate: a ball of randomly packed equal spheres."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Annotated

from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import Length
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.plugins.registry import Registry
from clast.scene.packing_report import porosity, sphere_volume
from clast_plugins.generators.packing.agglomerate import (
    AgglomerateParams,
    Body,
    make_agglomerate,
    millimetres,
    number_of_primaries,
    predict_agglomerate,
)
from clast_plugins.generators.packing.macro_pores import refuse_senseless


class SphericalAgglomerate(AgglomerateParams):
    """Equal spheres packed at random, each wholly inside a sphere.

    Equation: N = ⌊(1 − p)·(D/d)³⌋ primaries.

    Symbols: D diameter of the agglomerate in m; d diameter of a primary in m; p porosity, the share of the
    agglomerate's sphere that the primaries leave free.

    Spheres line up along the surface, so a few large ones do not fill a ball as densely as many small ones:
    in 2.16 mm, primaries of 0.25 mm reach porosity 0.43, of 0.40 mm 0.47 and of 0.50 mm 0.48. Below that an
    overlap stays, which ``accept_overlap`` takes.

    Source: Rotter, Dosta and Düster (2023), doi:10.1007/s40571-023-00610-0, Section 4.1. Its grain, 361
    primaries of 0.25 mm in 2.16 mm, has porosity 0.44:

    >>> number_of_primaries(SphericalAgglomerate(
    ...     material="glass", diameter="2.16 mm", primary_diameter="0.25 mm", porosity=0.44))
    361
    """

    diameter: Annotated[Length, Field(gt=0, examples=["1.2 mm"], description="Diameter of the agglomerate")]

    @property
    def whole(self) -> float:
        """Diameter of the agglomerate in m."""
        return self.diameter

    @model_validator(mode="after")
    def _fits(self) -> SphericalAgglomerate:
        if self.primary > self.diameter:
            raise ValueError(
                f"a primary of {millimetres(self.primary)} does not fit into an agglomerate of "
                f"{millimetres(self.diameter)}"
            )
        number_of_primaries(self)
        refuse_senseless(self.macro_pores, self.diameter, self.primary)
        return self


def predict(params: SphericalAgglomerate, site: Site, gaps: Gaps | None) -> Prediction:
    """Return how many primaries there will be, and about how many bonds."""
    return predict_agglomerate(params, _body(params), gaps)


def generate(params: SphericalAgglomerate, site: Site) -> Packing:
    """Pack the primaries.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set; or there is no room for the pores, or they
        cut the grain into pieces.
    """
    packing, reached = make_agglomerate(params, _body(params))
    free = porosity(packing.radius, sphere_volume(params.diameter))
    asked = {} if params.porosity is None else {"porosity_asked": params.porosity}
    return replace(packing, report={"primaries": len(packing.radius), **asked, "porosity_reached": free, **reached})


def _body(params: SphericalAgglomerate) -> Body:
    return Body(params.diameter, math.inf, f"a sphere of {millimetres(params.diameter)}")


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the spherical agglomerate."""
    registry.generator(
        "spherical_agglomerate",
        Generator(
            summary="a ball of randomly packed equal spheres",
            Params=SphericalAgglomerate,
            generate=generate,
            predict=predict,
        ),
    )

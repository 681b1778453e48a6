"""Spherical agglomerate: a ball of randomly packed spheres."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import Length
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.plugins.registry import Registry
from clast_plugins.generators.packing.agglomerate import AgglomerateParams, make_agglomerate, predict_agglomerate
from clast_plugins.generators.packing.fill import Body
from clast_plugins.generators.packing.macro_pores import refuse_senseless
from clast_plugins.generators.packing.room import CutBall
from clast_plugins.generators.packing.spheres import millimetres, number_of_primaries, primary_of


class SphericalAgglomerate(AgglomerateParams):
    """Spheres packed at random, equal or of scattered sizes, each wholly inside a sphere.

    Equation: N = ⌊(1 − p)·(D/d)³⌋ primaries of diameters d_i with Σ d_i³ = N d³.

    Symbols: D diameter of the agglomerate in m; d diameter of a primary in m, of the one of mean volume where they
    differ; p porosity, the share of the agglomerate's sphere that the primaries leave free. ``primary_deviation`` s
    makes the d_i evenly spaced quantiles of a normal or lognormal distribution of that deviation, cut at three
    deviations: with any seed the same sizes, in other places, and the mass of N equal primaries.

    Spheres line up along the surface, so a few large ones do not fill a ball as densely as many small ones:
    in 2.16 mm, primaries of 0.25 mm reach porosity 0.43, of 0.40 mm 0.47 and of 0.50 mm 0.48. Below that an
    overlap stays, which ``accept_overlap`` takes.

    Source: Rotter, Dosta and Düster (2023), doi:10.1007/s40571-023-00610-0, Section 4.1. Its grain, 361
    primaries of 0.25 mm in 2.16 mm, has porosity 0.44:

    >>> grain = SphericalAgglomerate(
    ...     material="glass", diameter="2.16 mm", primary_diameter="0.25 mm", porosity=0.44)
    >>> number_of_primaries(grain, grain.diameter)
    361
    """

    diameter: Annotated[Length, Field(gt=0, examples=["1.2 mm"], description="Diameter of the agglomerate")]

    @model_validator(mode="after")
    def _fits(self) -> SphericalAgglomerate:
        primary = primary_of(self, self.diameter)
        if primary > self.diameter:
            raise ValueError(
                f"a primary of {millimetres(primary)} does not fit into an agglomerate of {millimetres(self.diameter)}"
            )
        number_of_primaries(self, self.diameter)
        refuse_senseless(self.macro_pores, self.diameter, primary)
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
    return make_agglomerate(params, _body(params))


def _body(params: SphericalAgglomerate) -> Body:
    return Body(CutBall(0.5 * params.diameter), params.diameter, f"a sphere of {millimetres(params.diameter)}")


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the spherical agglomerate."""
    registry.generator(
        "spherical_agglomerate",
        Generator(
            summary="a ball of randomly packed spheres",
            Params=SphericalAgglomerate,
            generate=generate,
            predict=predict,
        ),
    )

"""Flattened agglomerate: spheres packed at random into a sphere between two plates."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import Length
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.plugins.registry import Registry
from clast.scene.packing_report import cut_sphere_volume, porosity
from clast_plugins.generators.packing.agglomerate import AgglomerateParams, make_agglomerate, predict_agglomerate
from clast_plugins.generators.packing.fill import Body
from clast_plugins.generators.packing.macro_pores import refuse_senseless
from clast_plugins.generators.packing.room import CutBall
from clast_plugins.generators.packing.spheres import millimetres, number_of_primaries, primary_of


class FlattenedAgglomerate(AgglomerateParams):
    """Spheres packed at random, equal or of scattered sizes, each wholly inside a sphere cut by two plates across z.

    Equation: N = ⌊(1 − p)·(D/d)³⌋ primaries of diameters d_i with Σ d_i³ = N d³, counted from the *uncut* sphere.

    Symbols: D diameter of the uncut sphere in m; h distance of the plates in m, at ± h/2 from the centre; d
    diameter of a primary in m, of the one of mean volume where they differ (see ``spherical_agglomerate``); p
    porosity, the share of the uncut sphere that N primaries leave free. Between the plates it is a little less,
    and reported too.

    Source: Rotter, Dosta and Düster (2023), doi:10.1007/s40571-023-00610-0, Section 4.1 and Fig. 18. The
    paper does not say which volume its porosity refers to; counted from the uncut sphere, its optimised
    grain has 428 primaries and crushes as reported:

    >>> grain = FlattenedAgglomerate(material="glass", volume_diameter="2.3 mm", height="2.16 mm",
    ...     primary_diameter="0.25 mm", porosity=0.45)
    >>> number_of_primaries(grain, grain.volume_diameter)
    428
    """

    volume_diameter: Annotated[
        Length, Field(gt=0, examples=["1.2 mm"], description="Diameter of the sphere before it is flattened")
    ]
    height: Annotated[Length, Field(gt=0, examples=["0.9 mm"], description="Distance of the two plates, along z")]

    @model_validator(mode="after")
    def _fits(self) -> FlattenedAgglomerate:
        if self.height > self.volume_diameter:
            raise ValueError(
                f"height {millimetres(self.height)} is more than volume_diameter "
                f"{millimetres(self.volume_diameter)}: nothing would be flattened; "
                "exchange them, or use 'spherical_agglomerate'"
            )
        primary = primary_of(self, self.volume_diameter)
        if primary > self.height:
            raise ValueError(
                f"a primary of {millimetres(primary)} does not fit between plates {millimetres(self.height)} apart"
            )
        number_of_primaries(self, self.volume_diameter)
        refuse_senseless(self.macro_pores, self.height, primary)
        return self


def predict(params: FlattenedAgglomerate, site: Site, gaps: Gaps | None) -> Prediction:
    """Return how many primaries there will be, and about how many bonds."""
    return predict_agglomerate(params, _body(params), gaps)


def generate(params: FlattenedAgglomerate, site: Site) -> Packing:
    """Pack the primaries.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set; or there is no room for the pores, or they
        cut the grain into pieces.
    """
    packing = make_agglomerate(params, _body(params))
    return replace(packing, report={**packing.report, **_shape(params, packing)})


def _body(params: FlattenedAgglomerate) -> Body:
    words = f"a sphere of {millimetres(params.volume_diameter)} cut to a height of {millimetres(params.height)}"
    room = CutBall(0.5 * params.volume_diameter, 0.5 * params.height)
    return Body(room, params.volume_diameter, words)


def _shape(params: FlattenedAgglomerate, packing: Packing) -> dict[str, float]:
    x = packing.position - np.asarray(params.centre)
    outer = np.sqrt(x[:, 0] ** 2 + x[:, 1] ** 2) + packing.radius
    cut = cut_sphere_volume(params.volume_diameter, params.height)
    return {
        "porosity_between_plates": porosity(packing.radius, cut),
        "height_m": float(np.max(x[:, 2] + packing.radius) - np.min(x[:, 2] - packing.radius)),
        "width_m": 2.0 * float(np.max(outer)),
    }


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the flattened agglomerate."""
    registry.generator(
        "flattened_agglomerate",
        Generator(
            summary="randomly packed spheres in a sphere flattened between two plates",
            Params=FlattenedAgglomerate,
            generate=generate,
            predict=predict,
        ),
    )

"""Ellipsoidal agglomerate: an ellipsoid of randomly packed spheres."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import Point
from clast.parts.generator import Gaps, Generator, Packing, Prediction, Site
from clast.plugins.registry import Registry
from clast_plugins.generators.packing.agglomerate import AgglomerateParams, make_agglomerate, predict_agglomerate
from clast_plugins.generators.packing.ellipsoid import Ellipsoid
from clast_plugins.generators.packing.fill import Body, body_of
from clast_plugins.generators.packing.macro_pores import refuse_senseless
from clast_plugins.generators.packing.spheres import millimetres, number_of_primaries, primary_of

FLATTEST = 10.0
"""Largest ratio of two semi-axes."""


class EllipsoidalAgglomerate(AgglomerateParams):
    r"""Spheres packed at random, equal or of scattered sizes, each wholly inside an ellipsoid.

    Equation
    --------
    N = ⌊(1 − p) 8 a b c/d³⌋;  Σ d_i³ = N d³

    Symbols
    -------
    a, b, c : ``semi_axes`` in m, along x, y and z; p : ``porosity``, the share of the ellipsoid that is free
    d_i : diameters of the primaries in m; d : that of the one of mean volume in m

    Limits
    ------
    The axes of the ellipsoid are those of the scene, and their ratio is at most 10. Where its surface is more curved
    than a primary, no primary reaches into the tip: a sharp tip is blunt, and what lies before it is denser.

    Source
    ------
    D. Eberly (2013), Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid, Geometric Tools.
    """

    semi_axes: Annotated[
        Point, Field(examples=[["0.8 mm", "0.6 mm", "0.5 mm"]], description="Semi-axes along x, y and z")
    ]

    @model_validator(mode="after")
    def _fits(self) -> EllipsoidalAgglomerate:
        least, most = min(self.semi_axes), max(self.semi_axes)
        if least <= 0.0:
            raise ValueError("every one of 'semi_axes' must be above 0")
        if most > FLATTEST * least:
            raise ValueError(f"'semi_axes' from {millimetres(least)} to {millimetres(most)}: at most 1 to {FLATTEST:g}")
        whole = body(self).whole
        number_of_primaries(self, whole)
        primary = primary_of(self, whole)
        if primary > 2.0 * least:
            raise ValueError(f"a primary of {millimetres(primary)} does not fit into {millimetres(2.0 * least)}")
        refuse_senseless(self.macro_pores, 2.0 * least, primary)
        return self


def body(params: EllipsoidalAgglomerate) -> Body:
    """Return what is filled."""
    words = f"an ellipsoid with semi-axes {', '.join(map(millimetres, params.semi_axes))}"
    return body_of(Ellipsoid(*params.semi_axes), words)


def predict(params: EllipsoidalAgglomerate, site: Site, gaps: Gaps | None) -> Prediction:
    """Return how many primaries there will be, and about how many bonds."""
    return predict_agglomerate(params, body(params), gaps)


def generate(params: EllipsoidalAgglomerate, site: Site) -> Packing:
    """Pack the primaries.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set; or the largest primary has no room.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set; or there is no room for the pores, or they
        cut the grain into pieces.
    """
    return make_agglomerate(params, body(params))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the ellipsoidal agglomerate."""
    registry.generator(
        "ellipsoidal_agglomerate",
        Generator(
            summary="an ellipsoid of randomly packed spheres",
            Params=EllipsoidalAgglomerate,
            generate=generate,
            predict=predict,
        ),
    )

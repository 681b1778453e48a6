"""What all agglomerates share: their common parameters, and a packing from a body."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from clast.parts.generator import Estimate, Gaps, Packing, Prediction
from clast.scene.packing_report import porosity, sphere_volume
from clast_plugins.generators.packing.fill import Body, Filled, Told, fill, near_in_number, plan, reached
from clast_plugins.generators.packing.macro_pores import MacroPores, carve, make_voids, report_of
from clast_plugins.generators.packing.near_pairs import gaps_between, near_pairs, scattered
from clast_plugins.generators.packing.pore_estimates import Bulk, pairs_left, primaries_inside
from clast_plugins.generators.packing.room import Floats
from clast_plugins.generators.packing.spheres import Spheres, SpheresParams


class AgglomerateParams(SpheresParams):
    """Parameters of every agglomerate."""

    macro_pores: Annotated[
        MacroPores | None,
        Field(description="Voids carved out of the packing; porosity and primaries are those before"),
    ] = None


def predict_agglomerate(params: AgglomerateParams, body: Body, gaps: Gaps | None) -> Prediction:
    """Return what packing the primaries into a body will make, with the bonds between near ones.

    Raises
    ------
    ConfigError
        No random packing is so dense, or its pores make no sense.
    PackingError
        There is no room for its pores.
    """
    whole = predict_spheres(params, body, gaps)
    if params.macro_pores is None:
        return whole
    d = mean_diameter(plan(params, body))
    room = body.room.per(d)
    packed = Bulk(whole.particles, room.volume, room.surface)
    pores = make_voids(params.macro_pores, body.room).diameter / d
    inside = primaries_inside(packed, pores)
    left = whole.particles - round(inside.value)
    bonds = whole.bonds
    if gaps is not None and bonds is not None:
        bonds = pairs_left(packed, bonds, pores, gaps_between(gaps, d, params.primary_deviation))
    return replace(whole, particles=left, bonds=bonds, particles_band=inside.band * inside.value / left)


def predict_spheres(params: SpheresParams, body: Body, gaps: Gaps | None) -> Prediction:
    """Return what packing spheres into a body will make, with the bonds between near ones.

    Raises
    ------
    ConfigError
        No random packing is so dense, or the largest sphere has no room.
    """
    spheres = plan(params, body)
    d = mean_diameter(spheres)
    bonds: Estimate | None = Estimate(0.0)
    if gaps is not None:
        room, wanted = body.room.per(d), gaps_between(gaps, d, params.primary_deviation)
        bonds = scattered(near_pairs(len(spheres.shares), room.volume, room.surface, wanted), params.primary_deviation)
    return Prediction(len(spheres.shares), 0.5 * spheres.smallest, params.material, bonds)


def mean_diameter(spheres: Spheres) -> float:
    """Return the mean diameter in m."""
    return spheres.primary * float(spheres.shares.mean())


def make_agglomerate(params: AgglomerateParams, body: Body) -> Packing:
    """Pack the primaries into a body, as one grain.

    Raises
    ------
    ConfigError
        No random packing is so dense, and ``accept_overlap`` is not set; or the largest sphere has no room.
    PackingError
        Larger overlaps stay than allowed, and ``accept_overlap`` is not set; or there is no room for the pores, or they
        cut the grain into pieces.
    """
    filled = fill(params, body)
    position, radius, pores = _with_pores(params, body, filled)
    order = near_in_number(position)
    return packing_of(params, body, filled, position[order], radius[order], grain=0, also=pores)


def packing_of(
    params: SpheresParams, body: Body, filled: Filled, position: Floats, radius: Floats, grain: int, also: Told
) -> Packing:
    """Return spheres about the origin as a packing about its centre, with what was reached.

    Parameters
    ----------
    position, radius : (n, 3), (n,) float64
        Those of ``filled`` that are left, in m.
    grain : int
        Of all of them; -1 for loose spheres.
    also : mapping
        What else is told.
    """
    count, position = len(position), np.asarray(params.centre) + position
    asked = {} if params.porosity is None else {"porosity_asked": params.porosity}
    free = porosity(radius, sphere_volume(body.whole))
    return Packing(
        position=position,
        radius=radius,
        material=[params.material] * count,
        velocity=np.zeros((count, 3)),
        spin=np.zeros((count, 3)),
        prescribed=np.zeros(count, np.bool_),
        grain=np.full(count, grain, np.int64),
        relieved=filled.relieved,
        report={
            "primaries": count,
            **asked,
            "porosity_reached": free,
            **also,
            **reached(params, filled, position, radius, body.box),
        },
    )


def _with_pores(params: AgglomerateParams, body: Body, filled: Filled) -> tuple[Floats, Floats, Told]:
    """Return centres and radii of the primaries that pores leave, and what is told of the pores."""
    if params.macro_pores is None:
        return filled.position, filled.radius, {}
    voids = make_voids(params.macro_pores, body.room)
    carved = carve(voids, filled.position, filled.radius)
    told: Told = {**report_of(voids, carved, body.room.volume)}
    return filled.position[carved.kept], filled.radius[carved.kept], told

"""End when nothing is accelerated any more."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.parts.params import Params
from clast.parts.stop import UNBALANCE, Curves, Stop
from clast.plugins.registry import Registry


class AtRest(Params):
    r"""Ends a run when forces balance: the mean force that accelerates a particle is small beside those that hold it.

    Equation
    --------
    mean |m a| < limit · mean |f|,  at some samples in a row

    Symbols
    -------
    m a : mass times acceleration of each particle that forces can move, in N
    f : force in each bond and contact, in N

    Limits
    ------
    At the turning point of a swing velocities are 0 and forces are not, so forces tell rest and velocities do not; but
    in the middle of a swing forces balance for a moment: hence several samples in a row. Scenes in which nothing holds
    anything never rest. The curves get the column ``unbalanced_force_ratio``.

    Source
    ------
    P. A. Cundall, O. D. L. Strack (1979), Géotechnique 29, 47–65, doi:10.1680/geot.1979.29.1.47: unbalanced force.
    """

    limit: Annotated[Number, Field(gt=0, lt=1, description="Ratio below which forces balance")] = 1e-3
    samples: Annotated[int, Field(ge=1, description="At how many samples in a row")] = 5


def reached(params: AtRest, curves: Curves) -> str | None:
    """Tell that the scene rests."""
    latest = curves[UNBALANCE][-params.samples :]
    if len(latest) < params.samples or not latest.max() < params.limit:
        return None
    return f"at rest: unbalanced forces are {latest.max():.2g} of those that hold, at {params.samples} samples in a row"


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop(
        "at_rest",
        Stop(summary="ends when forces balance", Params=AtRest, reached=reached, columns=(UNBALANCE,)),
    )

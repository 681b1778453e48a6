"""End when bonds have broken."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.parts.params import Params
from clast.parts.stop import Curves, Stop
from clast.plugins.registry import Registry


class BondsBroken(Params):
    r"""Ends a run when a share of the bonds has broken; by default all of them.

    Equation
    --------
    broken/(broken + intact) ≥ ``share``

    Limits
    ------
    Bonds that left the domain with their particles count as neither. Scenes without bonds never end by it.
    """

    share: Annotated[Number, Field(gt=0, le=1, description="Share of the bonds that has to break")] = 1.0


def reached(params: BondsBroken, curves: Curves) -> str | None:
    """Tell that so many bonds are broken."""
    broken, intact = float(curves["bonds_broken"][-1]), float(curves["bonds_intact"][-1])
    if broken == 0.0 or broken < params.share * (broken + intact):
        return None
    return f"{broken:.0f} of {broken + intact:.0f} bonds are broken"


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop(
        "bonds_broken",
        Stop(summary="ends when a share of the bonds is broken", Params=BondsBroken, reached=reached),
    )

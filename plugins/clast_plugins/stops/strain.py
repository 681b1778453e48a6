"""End at a strain, however the plates get there."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.parts.params import Params
from clast.parts.stop import Curves, Stop
from clast.plugins.registry import Registry


class Strain(Params):
    r"""Ends a compression when its strain is reached, by plates too that answer to forces.

    Equation
    --------
    ε ≥ ``strain``,  ε the approach of the plates over ``compression.height``

    Limits
    ------
    It looks at samples, so the run ends up to one sample later. Where velocities are known beforehand
    ``time.end.strain`` ends at the very step.
    """

    strain: Annotated[Number, Field(gt=0, examples=["10 %"], description="Strain at which the run ends")]


def reached(params: Strain, curves: Curves) -> str | None:
    """Tell that the strain is reached."""
    strain = float(curves["strain"][-1])
    return f"the strain reached {strain:.4g}" if strain >= params.strain else None


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop(
        "strain", Stop(summary="ends when a strain is reached", Params=Strain, reached=reached, of_compression=True)
    )

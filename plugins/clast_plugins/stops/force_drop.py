"""End when the force has passed its peak and fallen."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress
from clast.parts.params import Params
from clast.parts.stop import Curves, Stop
from clast.plugins.registry import Registry


class ForceDrop(Params):
    r"""Ends a compression when its stress has fallen from the peak by a share.

    Equation
    --------
    σ ≤ (1 − share) max σ,  once max σ ≥ σ_least

    Symbols
    -------
    σ : stress on the upper plate at a sample, in Pa, and max σ the largest up to then; σ_least : ``least``

    Limits
    ------
    It looks at samples: what happens between two is not seen. Noise before the peak can look like one; ``least`` keeps
    it out. A grain that is loaded once more after a drop may reach a higher peak, which this run then does not see.
    """

    share: Annotated[Number, Field(gt=0, lt=1, description="By which share the stress has to fall")] = 0.5
    least: Annotated[Stress, Field(ge=0, description="Peak below which no fall counts")] = 0.0


def reached(params: ForceDrop, curves: Curves) -> str | None:
    """Tell that the stress has fallen."""
    stress = curves["stress_Pa"]
    peak = float(stress.max())
    if peak <= 0.0 or peak < params.least or stress[-1] > (1.0 - params.share) * peak:
        return None
    return f"the stress fell to {stress[-1]:.4g} Pa, {stress[-1] / peak:.0%} of its peak, {peak:.4g} Pa"


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop(
        "force_drop",
        Stop(
            summary="ends when the stress has fallen from its peak by a share",
            Params=ForceDrop,
            reached=reached,
            of_compression=True,
        ),
    )

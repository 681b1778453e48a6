"""Starter: the run ends when a stress is reached."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Stress
from clast.parts.params import Params
from clast.parts.stop import Curves, Stop
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """Ends a compression when its stress reaches a value.

    Equation
    --------
    σ ≥ ``stress``
    """

    stress: Annotated[Stress, Field(gt=0, examples=["2 MPa"], description="Stress at which the run ends")]


def reached(params: Starter, curves: Curves) -> str | None:
    """Say that the stress is reached; None to go on. Curves hold all samples up to now, by column of curves.csv."""
    stress = float(curves["stress_Pa"][-1])
    return f"the stress reached {stress:.4g} Pa" if stress >= params.stress else None


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop("starter", Stop("ends when a stress is reached", Starter, reached, of_compression=True))

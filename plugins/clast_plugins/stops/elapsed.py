"""End when some time has passed."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Time
from clast.parts.params import Params
from clast.parts.stop import Curves, Stop
from clast.plugins.registry import Registry


class Elapsed(Params):
    r"""Holds when a simulated time has passed since the stage of a motion began: to hold a load, or to wait.

    Equation
    --------
    t − t_0 ≥ ``time``

    Symbols
    -------
    t, t_0 : time of a sample, and of that at which the stage began, in s

    Limits
    ------
    It looks at samples, so a stage lasts up to one sample longer. Among conditions that end the run it counts from the
    start, as ``time.end.time`` does to the very step.
    """

    time: Annotated[Time, Field(gt=0, examples=["5 ms"], description="How long")]


def reached(params: Elapsed, curves: Curves) -> str | None:
    """Tell that the time has passed."""
    passed = float(curves["time_s"][-1] - curves["time_s"][0])
    return f"{passed:.4g} s have passed" if passed >= params.time else None


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop("elapsed", Stop(summary="holds when some time has passed", Params=Elapsed, reached=reached))

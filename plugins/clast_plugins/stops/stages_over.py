"""End when a wall has gone through all stages of its motion."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.parts.params import Params
from clast.parts.stop import Curves, Stop
from clast.plugins.registry import Registry


class StagesOver(Params):
    r"""Ends a run when the last stage of a wall's motion is over, such as when a load is taken back to zero.

    Limits
    ------
    The last motion of the wall needs an ``until``: without it the stages are never over, and the scene is refused. The
    run ends at the sample after the one at which that condition held: there the wall stands still. ``stage_NAME`` in
    the curves is the number of the stage, from 1 on, and 0 once all are over.
    """

    wall: Annotated[str, Field(examples=["upper"], description="Name of the wall")]


def reads(params: StagesOver) -> tuple[str]:
    """Return the column of the wall's stages."""
    return (f"stage_{params.wall}",)


def waits_for(params: StagesOver) -> tuple[str]:
    """Return the wall."""
    return (params.wall,)


def reached(params: StagesOver, curves: Curves) -> str | None:
    """Tell that the stages are over."""
    stage = curves[reads(params)[0]]
    # the first sample is taken in the first stage
    return f"all stages of {params.wall} are over" if len(stage) > 1 and stage[-1] == 0.0 else None


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop(
        "stages_over",
        Stop(
            summary="ends when a wall's stages are over",
            Params=StagesOver,
            reached=reached,
            reads=reads,
            waits_for=waits_for,
        ),
    )

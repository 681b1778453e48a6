"""Stages: motions of a wall that follow each other, each until a condition holds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import AfterValidator, Discriminator, Field, Tag

from clast.config.choice import Chosen, PartOf
from clast.config.part_beside import Joined, PartBeside
from clast.config.problems import problem, refuse
from clast.maths.vec3 import Vec
from clast.parts.params import Params


class StageSettings(Params):
    """What every motion has beside its own keys."""

    until: Annotated[
        Annotated[Chosen, PartOf("stop")] | None,
        Field(description="Condition on which the motion is over: the next begins, or the wall stands still"),
    ] = None


@dataclass(frozen=True)
class Stage(Joined):
    """A motion, and the condition on which it is over; None where it never is."""

    motion: Chosen
    until: Chosen | None

    def plain(self) -> dict[str, Any]:
        """Give the stage as the scene file would have it."""
        return {**self.motion.plain(), **({"until": self.until.plain()} if self.until is not None else {})}


STAGE = PartBeside("motion", StageSettings, Stage)


def _all_but_the_last_end(stages: tuple[Stage, ...]) -> tuple[Stage, ...]:
    for k, stage in enumerate(stages[:-1]):
        if stage.until is None:
            text = (
                f"motion {k} ({stage.motion.name}) is never over, so those behind it never begin; give it a condition "
            )
            raise refuse([problem((k,), f"{text}'until'")])
    return stages


def pivot(stages: tuple[Stage, ...]) -> Vec | None:
    """Return the point in m about which a wall turns in some stage, as it stands at the start; None without any."""
    turning = (stage.motion for stage in stages if stage.motion.part.pivot is not None)
    return next((motion.part.pivot(motion.params) for motion in turning), None)


def _turn_about_one_point(stages: tuple[Stage, ...]) -> tuple[Stage, ...]:
    first = pivot(stages)
    for k, stage in enumerate(stages):
        turned = pivot((stage,))
        if turned is not None and turned != first:
            text = (
                f"motion {k} ({stage.motion.name}) turns about {list(turned)} m, and one before it about "
                f"{list(first or ())} m; give all the same point: a wall turns about one"
            )
            raise refuse([problem((k,), text)])
    return stages


def _go_on_as_they_are(stages: tuple[Stage, ...]) -> tuple[Stage, ...]:
    """Refuse velocities at the start of motions that answer, behind the first: such a wall goes on as it moves."""
    for k, stage in enumerate(stages[1:], 1):
        part = stage.motion.part
        course = part.course(stage.motion.params)
        begins = (*(part.start(course) if part.start else ()), *(part.start_spin(course) if part.start_spin else ()))
        if any(begins):
            text = f"motion {k} ({stage.motion.name}) goes on from what the wall does; leave its velocity and spin out"
            raise refuse([problem((k,), text)])
    return stages


Stages = Annotated[
    Annotated[
        tuple[Annotated[Stage, STAGE], ...],
        Field(min_length=1),
        AfterValidator(_all_but_the_last_end),
        AfterValidator(_turn_about_one_point),
        AfterValidator(_go_on_as_they_are),
        Tag("<list>"),
    ]
    | Annotated[Stage, STAGE, Tag("<one>")],
    Discriminator(lambda given: "<list>" if isinstance(given, list | tuple) else "<one>"),
]
"""One motion, or a list of them."""

"""Stages: motions of a wall that follow each other, each until a condition holds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import AfterValidator, Discriminator, Field, Tag

from clast.config.choice import Chosen, PartOf
from clast.config.part_beside import Joined, PartBeside
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
            raise ValueError(
                f"motion {k} ({stage.motion.name}) is never over, so those behind it never begin; give it a condition "
                "'until'"
            )
    return stages


Stages = Annotated[
    Annotated[
        tuple[Annotated[Stage, STAGE], ...], Field(min_length=1), AfterValidator(_all_but_the_last_end), Tag("<list>")
    ]
    | Annotated[Stage, STAGE, Tag("<one>")],
    Discriminator(lambda given: "<list>" if isinstance(given, list | tuple) else "<one>"),
]
"""One motion, or a list of them."""

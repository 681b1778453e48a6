"""What looks at a simulation while it runs, and why one ended early."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from clast.simulation import Simulation


class Ended(NamedTuple):
    """Why a run ended before its time: the condition's name, and a sentence with its numbers."""

    by: str
    reason: str


class Observer(Protocol):
    """Looks at a simulation now and then, and changes nothing."""

    def next_step(self, step: int) -> int | None:
        """Return the next step after ``step`` to look at, None for never again."""

    def observe(self, simulation: Simulation) -> None:
        """Look at the simulation, at the end of a step that was asked for."""

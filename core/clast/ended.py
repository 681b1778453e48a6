"""Why a run ended before its time."""

from __future__ import annotations

from typing import NamedTuple


class Ended(NamedTuple):
    """The name of the condition that ended a run, and a sentence with its numbers."""

    by: str
    reason: str

"""Stop: a condition under which a run ends before its time is up, or a stage of a wall's motion is over."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.errors import PluginError
from clast.parts.params import Params

Curves = Mapping[str, NDArray[np.float64]]
"""Columns of ``curves.csv`` up to now, (s,) each, the sample just taken last."""

UNBALANCE = "unbalanced_force_ratio"
"""Column of the curves that is there only where a condition asks for it; see :mod:`clast.results.unbalance`."""

ON_DEMAND = (UNBALANCE,)
"""All such columns."""


def nothing(params: Any) -> tuple[str, ...]:
    """Return no name, whatever the parameters."""
    return ()


@dataclass(frozen=True)
class Stop:
    """The part a plugin registers with ``registry.stop(name, Stop(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes in the list ``stop``, or under ``until`` of a motion.
    reached : (params, curves) -> str or None
        Asked after every sample; for a stage of a motion with the curves from its beginning on. A sentence that says
        what was reached, with its numbers; None to go on. Must depend on nothing else, so that a run ends at the same
        sample wherever and however often it is run.
    columns : tuple of str, optional
        Columns that it reads and that are kept only for it, of ``ON_DEMAND``.
    of_compression : bool, optional
        Whether it looks at strain or stress, which only scenes with a compression have; others are refused.
    reads : (params) -> sequence of str, optional
        Columns that it reads and that depend on its parameters; scenes without them are refused.
    waits_for : (params) -> sequence of str, optional
        Walls all of whose stages must be over before it can hold; scenes in which they never are are refused.

    Raises
    ------
    PluginError
        If it asks for a column that there is not.
    """

    summary: str
    Params: type[Params]
    reached: Callable[[Any, Curves], str | None]
    columns: tuple[str, ...] = ()
    of_compression: bool = False
    reads: Callable[[Any], Sequence[str]] = nothing
    waits_for: Callable[[Any], Sequence[str]] = nothing

    def __post_init__(self) -> None:
        for name in self.columns:
            if name not in ON_DEMAND:
                raise PluginError(f"stop {self.summary!r} asks for {name!r}; on demand there is {', '.join(ON_DEMAND)}")

"""What holds for every condition that ends a run: a quiet run goes on, and an answer is a sentence, always the same."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from clast.parts.stop import ON_DEMAND, Stop
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import numbers

COLUMNS = ("strain", "displacement_m", "stress_Pa", "force_upper_N", "force_lower_N", "bonds_broken", "bonds_intact")
"""Columns of the curves that every compression has."""

Curves = dict[str, NDArray[np.float64]]


def claims(stop: Stop, params: Any) -> list[Claim]:
    """Return what a condition with parameters must keep to."""
    own = tuple(name for name in stop.reads(params) if name not in COLUMNS)
    drawn = st.lists(
        st.tuples(*[numbers(0.0, 1e7)] * (len(COLUMNS) + len(ON_DEMAND) + len(own))), min_size=1, max_size=8
    )
    return [
        claim("a run in which nothing has happened goes on", lambda: _goes_on(stop, params, own)),
        claim(
            "it answers with a sentence, or with None", lambda rows: _answers(stop, params, curves(rows, own)), drawn
        ),
        claim(
            "the same curves give the same answer, and are left as they are",
            lambda rows: _pure(stop, params, curves(rows, own)),
            drawn,
        ),
    ]


def curves(rows: list[tuple[float, ...]], own: tuple[str, ...] = ()) -> Curves:
    """Return the curves of a compression with one row a sample, every column that can be asked for, and some more."""
    names = (*COLUMNS, *ON_DEMAND, *own)
    return {"time_s": np.arange(float(len(rows)))} | dict(zip(names, np.array(rows).T.copy(), strict=True))


def _goes_on(stop: Stop, params: Any, own: tuple[str, ...]) -> None:
    quiet = curves([(0.0,) * (len(COLUMNS) - 1) + (4.0,) + (1.0,) * len(ON_DEMAND) + (0.0,) * len(own)], own)
    told = stop.reached(params, quiet)
    must(told is None, f"it ends a run at its first sample: {told!r}")


def _answers(stop: Stop, params: Any, given: Curves) -> None:
    told = stop.reached(params, given)
    sound = told is None or (isinstance(told, str) and bool(told))
    must(sound, lambda: f"it answers {told!r}, where None or a sentence is needed")


def _pure(stop: Stop, params: Any, given: Curves) -> None:
    before = {name: values.copy() for name, values in given.items()}
    first, second = stop.reached(params, given), stop.reached(params, given)
    must(first == second, lambda: f"it answers {first!r}, and then {second!r}")
    kept = before.keys() == given.keys() and all(np.array_equal(given[name], before[name]) for name in before)
    must(kept, "it changes the curves")

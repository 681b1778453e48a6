"""Selection: which settings of an axis a statement is about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import isclose

from clast.config.document import Problem
from clast.config.quantities import read_quantity
from clast.config.units import describe_dimension
from clast.studies.axis import Axis, Setting
from clast.studies.expectation_config import Expectation, Range


def meets(setting: Setting, wanted: Range | float | str) -> bool:
    """Tell whether a setting is the one that is wanted, by its name or its number, or lies in a range."""
    if not isinstance(wanted, Range):
        return setting.label == str(wanted) or _is(setting.number, wanted)
    if setting.number is None:
        return False
    value = setting.number
    bounds = {name: read_quantity(each)[0] for name, each in wanted.model_dump(exclude_none=True).items()}
    tests = {
        "at_least": lambda bound: value >= bound or _near(value, bound),
        "at_most": lambda bound: value <= bound or _near(value, bound),
        "above": lambda bound: value > bound and not _near(value, bound),
        "below": lambda bound: value < bound and not _near(value, bound),
    }
    return all(tests[name](bound) for name, bound in bounds.items())


def _is(number: float | None, wanted: float | str) -> bool:
    try:
        return number is not None and _near(number, read_quantity(wanted)[0])
    except ValueError:  # a name that this setting does not have
        return False


def _near(a: float, b: float) -> bool:
    return isclose(a, b, rel_tol=1e-9, abs_tol=1e-15)


def problems(expectations: Iterable[Expectation], axes: Iterable[Axis]) -> Iterator[Problem]:
    """Return what is wrong with the selections of statements: no value is meant, or a number of another dimension."""
    known = {axis.name: axis for axis in axes}
    for k, expectation in enumerate(expectations):
        for key in ("where", "than"):
            for name, wanted in getattr(expectation, key).items():
                told = _complaint(known[name], wanted)
                if told is not None:
                    yield Problem(("expect", k, key, name), told)


def _complaint(axis: Axis, wanted: Range | float | str) -> str | None:
    given = list(wanted.model_dump(exclude_none=True).values()) if isinstance(wanted, Range) else [wanted]
    for each in given:
        try:
            dimension = read_quantity(each)[1]
        except ValueError as error:
            if isinstance(wanted, Range):
                return str(error)
            continue
        if None not in (dimension, axis.dimension) and dimension != axis.dimension:
            assert axis.dimension is not None
            return f"{each!r} is no value of this axis, which is {describe_dimension(axis.dimension)}"
    if axis.settings and not any(meets(setting, wanted) for setting in axis.settings):
        return f"no value of this axis is meant; they are {', '.join(setting.label for setting in axis.settings)}"
    return None

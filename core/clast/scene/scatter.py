"""Scatter: bonds whose parameters are random multiples of those written, for any bond model.

A model is asked once, with arrays in the place of the parameters that scatter. Where it cannot take them (it branches
on a parameter, say), or answers otherwise than for single bonds, it is asked bond by bond: slower, and always right.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from clast.config.choice import plain_fields
from clast.config.problems import explain
from clast.config.scatter import Scatter
from clast.config.scene import SceneConfig
from clast.engine.records import columns, from_columns
from clast.maths.counter_random import uniform
from clast.maths.distributions import lognormal, weibull
from clast.parts.bond_model import BondGeometry, Dashpots, Stiffness
from clast.parts.params import Params

Floats = NDArray[np.float64]
Factors = tuple[Floats, ...]
"""For each entry of ``bonds.scatter`` one factor a bond, (m,)."""
FIRST_COMPONENT = 1 << 31
"""Of the random numbers drawn here; those that bond models draw are counted from 0."""
SAME = 1e-12
"""Share by which an answer for all bonds may differ from that for one: powers of arrays round otherwise."""


def scatter_entries(config: SceneConfig) -> tuple[Scatter, ...]:
    """Return what a scene says of scatter, nothing where it says nothing."""
    return () if config.bonds is None else config.bonds.scatter or ()


def draw_factors(entries: Sequence[Scatter], count: int) -> Factors:
    """Return the factors of ``count`` bonds; those of a bond depend on nothing but its number, entry and seed."""
    numbers: Any = np.arange(count)  # integer arithmetic is the same for one and for many
    found = []
    for k, entry in enumerate(entries):
        u = np.asarray(uniform(entry.seed, numbers, FIRST_COMPONENT + k, 0), np.float64).reshape(count)
        if entry.distribution == "weibull":
            assert entry.modulus is not None
            found.append(weibull(u, entry.modulus))
        else:
            assert entry.deviation is not None
            found.append(lognormal(u, entry.deviation))
    return tuple(found)


def multiplied(params: Params, entries: Sequence[Scatter], factors: Sequence[Any]) -> Params:
    """Return parameters times their factors, numbers or arrays; bounds are not looked at."""
    values = {
        name: getattr(params, name) * factor
        for entry, factor in zip(entries, factors, strict=True)
        for name in entry.parameters
    }
    return params.model_copy(update=values)


def refuse_beyond_bounds(config: SceneConfig, factors: Factors) -> None:
    """Refuse bonds whose parameters the model would not take if a user wrote them.

    Raises
    ------
    ConfigError
        With the bond that is farthest out.
    """
    for k, (entry, factor) in enumerate(zip(scatter_entries(config), factors, strict=True)):
        for bond in {int(np.argmin(factor)), int(np.argmax(factor))} if len(factor) else ():
            _refuse_bond(config, k, entry, bond, float(factor[bond]))


def _refuse_bond(config: SceneConfig, k: int, entry: Scatter, bond: int, factor: float) -> None:
    assert config.bonds is not None
    model = config.bonds.model
    written = plain_fields(model.params)
    changed = {name: written[name] * factor for name in entry.parameters}
    try:
        type(model.params).model_validate(written | changed, context={"registry": config.registry})
    except ValidationError as error:
        wrong = explain(error, type(model.params))[0]
        names = [str(name) for name in wrong.get("loc", ())] or list(entry.parameters)
        raise config.problem(
            ("bonds", "scatter", k),
            f"the factor {factor:.4g} of bond {bond} makes {' and '.join(names)} a value that the model does not "
            f"take: {wrong['type']}; let it scatter less, or not at all",
        ) from None


class Form(NamedTuple):
    """How the answers of a function lie in a table, a row a bond, and how a table becomes an answer."""

    rows: Callable[[Any, int], Floats]
    record: Callable[[Floats], Any]


def form_of_columns(record: Callable[..., Any]) -> Form:
    """Return the form of a record of plain arrays, one entry a bond."""
    return Form(
        lambda answer, count: np.column_stack([np.broadcast_to(each, count) for each in answer]),
        lambda table: record(*table.T),
    )


STIFFNESS, DASHPOTS = form_of_columns(Stiffness), form_of_columns(Dashpots)


def form_of_constants(record: type) -> Form:
    """Return the form of a bond model's constants."""
    return Form(columns, lambda table: from_columns(record, table))


def of_each_bond(
    function: Callable[[Any, BondGeometry], Any],
    form: Form,
    params: Params,
    entries: Sequence[Scatter],
    factors: Factors,
    geometry: BondGeometry,
) -> Any:
    """Return a function of parameters and geometry for all bonds, each with its own factors."""
    count = len(geometry.L0)
    if not entries or not count:
        return function(params, geometry)

    def one(bond: int) -> Floats:
        own = multiplied(params, entries, [float(factor[bond]) for factor in factors])
        return form.rows(function(own, bond_of(geometry, bond)), 1)

    together, table = _at_once(function, form, multiplied(params, entries, factors), geometry)
    if table is not None and all(_same(table[bond], one(bond)[0]) for bond in {0, count // 3, count - 1}):
        return together
    return form.record(np.concatenate([one(bond) for bond in range(count)]))


def bond_of(geometry: BondGeometry, bond: int) -> BondGeometry:
    """Return the geometry of one bond."""
    return BondGeometry(*(each[bond : bond + 1] if np.ndim(each) else each for each in geometry))


def _at_once(
    function: Callable[[Any, BondGeometry], Any], form: Form, params: Params, geometry: BondGeometry
) -> tuple[Any, Floats | None]:
    """Return the answer for arrays of parameters and its table; no table where the function cannot take arrays."""
    try:
        answer = function(params, geometry)
        return answer, form.rows(answer, len(geometry.L0))
    except (TypeError, ValueError):  # what numpy raises where an array stands in the place of a number
        return None, None


def _same(a: Floats, b: Floats) -> bool:
    return bool(np.allclose(a, b, rtol=SAME, atol=0.0, equal_nan=True))

"""Rehearsal: every law is called once in plain Python, so that its mistakes show before compiling, in its own words."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.records import build, columns, fields, is_record, leaves, members, width
from clast.errors import PluginError
from clast.maths.rotation import IDENTITY
from clast.maths.vec3 import ZERO
from clast.parts.bond_kinematics import BondMotion, EndLoads
from clast.parts.bond_model import BondLoad, RandomKey, Strain
from clast.parts.contact_law import NO_DRAG, ContactLoad, ContactLosses, MaterialPair, Touch
from clast.parts.rolling_resistance import Pressing, RollingLoad, RollingLosses
from clast.scene.plan import bond_constants, material_pairs
from clast.scene.scene import Scene

STRETCH = 1e-6
Caller = Callable[..., Any]
NUMBERS = (int, float, np.floating, np.integer, np.bool_)


class Rehearsal:
    """Calls functions of laws in plain Python.

    Attributes
    ----------
    heard : dict
        What each function gave.
    """

    def __init__(self) -> None:
        self.heard: dict[Callable[..., Any], Any] = {}

    def call(self, function: Callable[..., Any], result: type | None, *arguments: Any) -> Any:
        """Return what a function gives.

        Raises
        ------
        PluginError
            It raises, or returns something else than a ``result`` of finite numbers.
        """
        try:
            value = function(*arguments)
        except Exception as error:  # whatever a law raises is told in its own words
            frame = traceback.extract_tb(error.__traceback__)[-1]
            where = f"{frame.filename}:{frame.lineno}" if frame.name != "call" else _where(function)
            raise PluginError(f"{where}: {function.__name__} raised {type(error).__name__}: {error}") from error
        _expect(function, value, result)
        self.heard[function] = value
        return value


def try_laws(scene: Scene, plan: Blueprint) -> Mapping[Callable[..., Any], Any]:
    """Call the laws of a scene once each, on its first bond and first pair of materials; return what each gave.

    Raises
    ------
    PluginError
        With file, line and function of what raised or returned something else than promised.
    """
    rehearsal = Rehearsal()
    if plan.bonds is not None:
        _try_bond(scene, plan, rehearsal.call)
    if plan.contacts is not None:
        _try_contact(scene, plan, rehearsal.call)
    return rehearsal.heard


def _try_bond(scene: Scene, plan: Blueprint, call: Caller) -> None:
    assert plan.bonds is not None
    model, kinematics = plan.bonds.model, plan.bonds.kinematics
    d, L0 = scene.bond_vectors[:1], scene.length[:1]
    constants = _first(model.Constants, bond_constants(scene))
    reference = _first(kinematics.Reference, kinematics.reference(d, L0))
    start = _first(kinematics.State, kinematics.start(d, L0)) if kinematics.start else _zeros(kinematics.State)
    x = tuple(float(c) for c in d[0] * (1.0 + STRETCH))
    motion = BondMotion(x, IDENTITY, IDENTITY, ZERO, ZERO, ZERO)  # type: ignore[arg-type]
    strain, frame, _ = call(kinematics.measure, tuple, motion, reference, start, 0.0)
    _expect(kinematics.measure, strain, Strain)
    state = _zeros(model.State)
    if model.flow is not None:
        state = call(model.flow, model.State, strain, constants, state)
    load = call(model.load, BondLoad, strain, constants, state)
    call(kinematics.end_loads, EndLoads, load, frame)
    call(model.failure, float, strain, load, constants, state)
    call(model.mode, int, strain, load, constants, state)
    call(model.energy, float, strain, constants, state)
    if model.overload is not None and model.on_event is not None:
        call(model.overload, float, strain, constants, state)
        call(model.on_event, model.State, strain, constants, state, RandomKey(1, 0))


def _try_contact(scene: Scene, plan: Blueprint, call: Caller) -> None:
    assert plan.contacts is not None
    assert scene.config.contacts is not None
    law, params = plan.contacts.law, scene.config.contacts.law.params
    r = float(scene.radius[0])
    m = 1.0 / float(scene.mass[0])
    touch = Touch(STRETCH * r, (0.0, 0.0, 1.0), (0.0, 0.0, -STRETCH), ZERO, ZERO, 0.5 * r, r, r, m, m / r**2)
    for _, _, pair in material_pairs(scene)[:1]:
        constants = call(law.constants, law.Constants, params, pair)
        history = _zeros(law.History)
        load, after = call(law.load, tuple, touch, constants, history, 1e-6, plan.contacts.choices)
        _expect(law.load, load, ContactLoad)
        if plan.ledger and law.losses is not None:
            rest = (touch, constants, history, load, after, 1e-6, plan.contacts.choices, NO_DRAG)
            call(law.losses, ContactLosses, *rest)
        call(law.energy, float, touch, constants, history, plan.contacts.choices)
        if law.reach is not None:
            call(law.reach, float, constants, touch.radius)
        if plan.contacts.rolling is not None:
            _try_rolling(scene, plan, touch, pair, load.limit, call)


def _try_rolling(scene: Scene, plan: Blueprint, touch: Touch, pair: MaterialPair, limit: float, call: Caller) -> None:
    assert plan.contacts is not None
    assert scene.config.contacts is not None
    rolling, choices = plan.contacts.rolling, plan.contacts.rolling_choices
    assert rolling is not None
    constants = call(rolling.constants, rolling.Constants, scene.config.contacts.rolling.params, pair)
    history, pressing = _zeros(rolling.History), Pressing(limit, 1.0, 1.0)
    load, after = call(rolling.load, tuple, touch, constants, history, pressing, 1e-6, choices)
    _expect(rolling.load, load, RollingLoad)
    if plan.ledger:
        rest = (touch, constants, history, load, after, pressing, 1e-6, choices, ZERO)
        call(rolling.losses, RollingLosses, *rest)
    if rolling.energy is not None:
        call(rolling.energy, float, constants, history, touch.radius, 1.0)


def _zeros(record: type | None) -> Any:
    if record is None:
        return None
    return build(record, [0.0] * width(record))


def _first(record: type | None, values: Any) -> Any:
    """Return the record of the first bond."""
    if record is None or not isinstance(values, record):
        raise PluginError(f"{_name(record)} was expected from 'constants', 'reference' or 'start', given {values!r}")
    return build(record, (float(x) for x in columns(values, _longest(values))[0]))


def _longest(values: Any) -> int:
    return max(
        len(np.atleast_1d(v)) if f.size == 1 else len(np.atleast_2d(v))
        for f, v in zip(fields(type(values)), leaves(values), strict=True)
    )


def _expect(function: Callable[..., Any], value: Any, result: type | None) -> None:
    good = isinstance(value, NUMBERS) if result in (int, float) else result is None or isinstance(value, result)
    if not good:
        raise PluginError(f"{_where(function)}: {function.__name__} must return {_name(result)}, given {value!r}")
    wrong = _misshapen(value, type(value)) if is_record(type(value)) else ""
    if wrong:
        raise PluginError(f"{_where(function)}: {function.__name__}: {wrong}")
    if not all(np.isfinite(number) for number in _numbers(value)):
        raise PluginError(f"{_where(function)}: {function.__name__} must return finite numbers, given {value!r}")


def _misshapen(value: Any, record: type) -> str:
    """Return what of a record is not as large as it is declared; empty where all is right."""
    for (name, member), inner in zip(members(record).items(), value, strict=True):
        if not isinstance(member, int):
            wrong = _misshapen(inner, member) if isinstance(inner, member) else f"'{name}' must be a {member.__name__}"
        elif member == 1:
            wrong = "" if isinstance(inner, NUMBERS) else f"'{name}' must be a number, given {inner!r}"
        else:
            good = isinstance(inner, tuple) and len(inner) == member
            wrong = "" if good else f"'{name}' must be a tuple of {member} numbers, given {inner!r}"
        if wrong:
            return wrong
    return ""


def _numbers(value: Any) -> Iterator[float]:
    """Yield the numbers of a value, those of tuples in it too."""
    if isinstance(value, tuple):
        for inner in value:
            yield from _numbers(inner)
    elif isinstance(value, int | float | np.floating | np.integer):
        yield float(value)


def _name(record: type | None) -> str:
    return "None" if record is None else record.__name__


def _where(function: Callable[..., Any]) -> str:
    code = getattr(function, "__code__", None)
    return f"{code.co_filename}:{code.co_firstlineno}" if code is not None else repr(function)

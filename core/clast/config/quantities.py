"""Quantities: numbers with units, as a user writes them, turned into SI floats.

A bare number is SI. A text is a number and a unit: ``0.25 mm``, ``564.26 MPa``, ``190 kg/m3``, ``5 %``.
Prefixes are multiplied in decimal, so ``50 um/s`` is exactly the float ``5e-05``.

>>> to_si("50 um/s", "m/s")
5e-05
>>> to_si("3 MPa", "m")
Traceback (most recent call last):
    ...
ValueError: '3 MPa' is a stress; a length is needed, such as '0.25 mm', or a plain number in m
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from decimal import Decimal, localcontext
from numbers import Real
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from clast.config.units import Dimension, describe_dimension, examples, unit_factor

_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.ASCII)
_STARTS_WITH_NUMBER = r"^\s*[+-]?(\d|\.\d)"


def to_si(given: object, unit: str) -> float:
    """Turn what a user wrote into a float in SI.

    Parameters
    ----------
    given : number or str
        A number is taken as SI; a text is a number followed by a unit.
    unit : str
        The SI unit needed, for instance ``"Pa"``; ``"1"`` for a plain number.

    Raises
    ------
    ValueError
        Not a number, not finite, an unknown unit, or a unit of another dimension.

    Examples
    --------
    >>> to_si("564.26 MPa", "Pa"), to_si("5 %", "1"), to_si(2, "m")
    (564260000.0, 0.05, 2.0)
    """
    value = _text_to_si(given, unit) if isinstance(given, str) else _number(given, unit)
    if not math.isfinite(value):
        raise ValueError(f"{given!r} is not a finite number; {_needed(unit)}")
    return value


def _number(given: object, unit: str) -> float:
    if isinstance(given, bool) or not isinstance(given, Real):
        raise ValueError(f"{given!r} is not a number; {_needed(unit)}")
    try:
        return float(given)
    except OverflowError:
        return math.inf


def _text_to_si(given: str, unit: str) -> float:
    match = _QUANTITY.fullmatch(given)
    if match is None:
        raise ValueError(f"{given!r} does not begin with a number; {_needed(unit)}")
    number, symbol = match.groups()
    if not symbol:
        return float(number)
    try:
        factor, dimension = unit_factor(symbol)
    except ValueError as error:
        raise ValueError(f"{given!r}: {error}; {_needed(unit)}") from None
    if dimension != unit_factor(unit)[1]:
        raise ValueError(f"{given!r} is {describe_dimension(dimension)}; {_needed(unit)}")
    with localcontext(prec=60):
        return float(Decimal(number) * factor)


def read_quantity(given: object) -> tuple[float, Dimension | None]:
    """Turn what a user wrote into a float in SI and its dimension; None for a bare number, which may be anything.

    Raises
    ------
    ValueError
        Not a number, not finite, or an unknown unit.

    Examples
    --------
    >>> read_quantity("0.25 mm"), read_quantity(3)
    ((0.00025, (1, 0, 0, 0)), (3.0, None))
    """
    match = _QUANTITY.fullmatch(given) if isinstance(given, str) else None
    if match is None or not match[2]:
        return to_si(given, "1"), None
    return to_si(given, match[2]), unit_factor(match[2])[1]


def written_unit(given: object) -> str:
    """Return the unit that a user wrote behind a number; empty where there is none.

    >>> written_unit("0.25 mm"), written_unit(3), written_unit("soft")
    ('mm', '', '')
    """
    match = _QUANTITY.fullmatch(given) if isinstance(given, str) else None
    return match[2] if match else ""


def _needed(unit: str) -> str:
    if unit == "1":
        return "a plain number is needed, such as 0.05 or '5 %'"
    dimension = describe_dimension(unit_factor(unit)[1])
    example = examples(unit)
    such_as = f", such as {example!r}," if example else ""
    return f"{dimension} is needed{such_as} or a plain number in {unit}"


@dataclass(frozen=True)
class Unit:
    """Marks a float field as a quantity: ``Annotated[float, Unit("Pa")]``.

    The field accepts a number (SI) or a text with a unit of the same dimension; bounds of a ``Field`` beside
    it are checked on the SI value. The unit is also written into the JSON Schema as ``x-unit``.

    >>> from pydantic import TypeAdapter
    >>> TypeAdapter(Annotated[float, Unit("m")]).validate_python("0.25 mm")
    0.00025
    """

    symbol: str

    def __post_init__(self) -> None:
        unit_factor(self.symbol)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Parse before pydantic's own float check."""

        def parse(given: Any) -> float:
            return to_si(given, self.symbol)

        return core_schema.no_info_before_validator_function(parse, handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Tell editors that a number or a text is welcome, and in which unit."""
        described = dict(handler(schema))
        described["type"] = ["number", "string"]
        described["pattern"] = _STARTS_WITH_NUMBER
        described["x-unit"] = self.symbol
        return described


Length = Annotated[float, Unit("m")]
Area = Annotated[float, Unit("m2")]
Time = Annotated[float, Unit("s")]
Stress = Annotated[float, Unit("Pa")]
Density = Annotated[float, Unit("kg/m3")]
Velocity = Annotated[float, Unit("m/s")]
AngularVelocity = Annotated[float, Unit("rad/s")]
Acceleration = Annotated[float, Unit("m/s2")]
Force = Annotated[float, Unit("N")]
Moment = Annotated[float, Unit("N m")]
MomentOfInertia = Annotated[float, Unit("kg m2")]
Mass = Annotated[float, Unit("kg")]
Angle = Annotated[float, Unit("rad")]
Frequency = Annotated[float, Unit("Hz")]
StrainRate = Annotated[float, Unit("1/s")]
Number = Annotated[float, Unit("1")]


def _three_parts(given: Any) -> Any:
    parts = given.tolist() if hasattr(given, "tolist") else given
    if not isinstance(parts, list | tuple):
        raise ValueError(f"{given!r} is not a vector; write it as [x, y, z]")
    if len(parts) != 3:
        raise ValueError(f"a vector has three components, [x, y, z]; {len(parts)} given")
    return tuple(parts)


def _not_zero(given: tuple[float, float, float]) -> tuple[float, float, float]:
    if given == (0.0, 0.0, 0.0):
        raise ValueError("[0, 0, 0] has no direction; at least one component must differ from zero")
    if not 1e-100 < math.hypot(*given) < 1e100:
        raise ValueError(f"the length of {list(given)} is beyond what can be computed with; only the direction counts")
    return given


_Three = BeforeValidator(_three_parts)

Point = Annotated[tuple[Length, Length, Length], _Three]
Direction = Annotated[tuple[Number, Number, Number], AfterValidator(_not_zero), _Three]
VelocityVector = Annotated[tuple[Velocity, Velocity, Velocity], _Three]
SpinVector = Annotated[tuple[AngularVelocity, AngularVelocity, AngularVelocity], _Three]
ForceVector = Annotated[tuple[Force, Force, Force], _Three]
PrincipalMoments = Annotated[tuple[MomentOfInertia, MomentOfInertia, MomentOfInertia], _Three]
MomentVector = Annotated[tuple[Moment, Moment, Moment], _Three]
StrainRates = Annotated[tuple[StrainRate, StrainRate, StrainRate], _Three]
AccelerationVector = Annotated[tuple[Acceleration, Acceleration, Acceleration], _Three]

"""Units: what a symbol such as ``kg/m3`` is worth in SI, and which dimension it has.

Angles count as a dimension of their own, so that ``3 deg`` cannot be taken for a plain number.

>>> factor, dimension = unit_factor("km/h")
>>> float(factor * 36), describe_dimension(dimension)
(10.0, 'a velocity')
"""

from __future__ import annotations

import re
from decimal import Decimal, localcontext
from functools import lru_cache

Dimension = tuple[int, int, int, int]
"""Powers of length, mass, time and angle."""

_PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")
_PREFIXES = {
    "p": Decimal("1e-12"),
    "n": Decimal("1e-9"),
    "u": Decimal("1e-6"),
    "m": Decimal("1e-3"),
    "c": Decimal("1e-2"),
    "d": Decimal("1e-1"),
    "k": Decimal("1e3"),
    "M": Decimal("1e6"),
    "G": Decimal("1e9"),
    "T": Decimal("1e12"),
}
_PREFIXED: dict[str, tuple[Decimal, Dimension]] = {
    "m": (Decimal(1), (1, 0, 0, 0)),
    "g": (Decimal("1e-3"), (0, 1, 0, 0)),
    "s": (Decimal(1), (0, 0, 1, 0)),
    "N": (Decimal(1), (1, 1, -2, 0)),
    "Pa": (Decimal(1), (-1, 1, -2, 0)),
    "J": (Decimal(1), (2, 1, -2, 0)),
    "W": (Decimal(1), (2, 1, -3, 0)),
    "Hz": (Decimal(1), (0, 0, -1, 0)),
    "rad": (Decimal(1), (0, 0, 0, 1)),
}
_UNPREFIXED: dict[str, tuple[Decimal, Dimension]] = {
    "1": (Decimal(1), (0, 0, 0, 0)),
    "%": (Decimal("0.01"), (0, 0, 0, 0)),
    "min": (Decimal(60), (0, 0, 1, 0)),
    "h": (Decimal(3600), (0, 0, 1, 0)),
    "t": (Decimal(1000), (0, 1, 0, 0)),
    "bar": (Decimal(100_000), (-1, 1, -2, 0)),
    "deg": (_PI / 180, (0, 0, 0, 1)),
    "rev": (_PI * 2, (0, 0, 0, 1)),
    "rpm": (_PI / 30, (0, 0, -1, 1)),
}
_NAMES: dict[Dimension, tuple[str, str]] = {
    (0, 0, 0, 0): ("a plain number", "5 %"),
    (1, 0, 0, 0): ("a length", "0.25 mm"),
    (2, 0, 0, 0): ("an area", "1 mm2"),
    (3, 0, 0, 0): ("a volume", "1 mm3"),
    (0, 1, 0, 0): ("a mass", "3 mg"),
    (0, 0, 1, 0): ("a time", "5 us"),
    (0, 0, 0, 1): ("an angle", "30 deg"),
    (1, 0, -1, 0): ("a velocity", "10 mm/s"),
    (0, 0, -1, 1): ("an angular velocity", "30 rpm"),
    (1, 0, -2, 0): ("an acceleration", "9.81 m/s2"),
    (-3, 1, 0, 0): ("a density", "190 kg/m3"),
    (-1, 1, -2, 0): ("a stress", "5.6 MPa"),
    (1, 1, -2, 0): ("a force", "2 N"),
    (2, 1, -2, 0): ("an energy or moment", "5 N mm"),
    (2, 1, 0, 0): ("a moment of inertia", "4 g mm2"),
    (0, 1, -2, 0): ("a stiffness", "5 N/mm"),
    (0, 0, -1, 0): ("a rate", "5 1/s"),
    (-1, 1, -1, 0): ("a viscosity", "1 mPa s"),
}
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_FACTOR = re.compile(r"(1|%|[A-Za-z]+)(?:(?:\^|\*\*)?([+-]?\d))?", re.ASCII)


@lru_cache(maxsize=256)
def unit_factor(symbol: str) -> tuple[Decimal, Dimension]:
    """Worth in SI and dimension of a unit such as ``"MPa"``, ``"kg/m3"``, ``"N*m"`` or ``"m/s^2"``.

    Raises
    ------
    ValueError
        A part of the unit is not known.

    Examples
    --------
    >>> unit_factor("mm2")
    (Decimal('0.000001'), (2, 0, 0, 0))
    """
    total, dimension = Decimal(1), (0, 0, 0, 0)
    sign = 1
    with localcontext(prec=60):
        for piece in re.split(r"(/|(?<!\*)\*(?!\*)| +)", _plain(symbol)):
            if piece == "/":
                sign = -1
            elif piece == "*" or piece.isspace():
                continue
            else:
                worth, powers, power = _factor(piece, symbol)
                total *= worth ** (sign * power)
                dimension = tuple(a + sign * power * b for a, b in zip(dimension, powers, strict=True))  # type: ignore[assignment]
    return total, dimension


def describe_dimension(dimension: Dimension) -> str:
    """Plain words for a dimension: ``"a stress"``."""
    if dimension in _NAMES:
        return _NAMES[dimension][0]
    powers = zip(("m", "kg", "s", "rad"), dimension, strict=True)
    return "a quantity of the unit " + " ".join(f"{name}^{power}" for name, power in powers if power)


def si_unit(dimension: Dimension) -> str:
    """Return the unit in SI of a dimension, as it can be read again; empty for plain numbers.

    >>> si_unit((-1, 1, -2, 0)), unit_factor(si_unit((-1, 1, -2, 0)))
    ('m-1 kg1 s-2', (Decimal('1'), (-1, 1, -2, 0)))
    """
    return " ".join(f"{name}{power}" for name, power in zip(("m", "kg", "s", "rad"), dimension, strict=True) if power)


def examples(unit: str) -> str:
    """One example of how to write a quantity of this unit's dimension; empty where none is known."""
    return _NAMES.get(unit_factor(unit)[1], ("", ""))[1]


def _plain(symbol: str) -> str:
    text = symbol.strip().replace("µ", "u").replace("μ", "u").replace("°", "deg").replace("·", "*")
    return re.sub(r"\s*([/*])\s*", r"\1", text.translate(_SUPERSCRIPTS))


def _factor(piece: str, symbol: str) -> tuple[Decimal, Dimension, int]:
    match = _FACTOR.fullmatch(piece)
    found = _lookup(match[1]) if match else None
    if match is None or found is None:
        raise ValueError(f"{piece or symbol!r} is not a known unit")
    return found[0], found[1], int(match[2] or 1)


def _lookup(name: str) -> tuple[Decimal, Dimension] | None:
    if name in _UNPREFIXED:
        return _UNPREFIXED[name]
    if name in _PREFIXED:
        return _PREFIXED[name]
    if name[:1] in _PREFIXES and name[1:] in _PREFIXED:
        worth, dimension = _PREFIXED[name[1:]]
        return _PREFIXES[name[0]] * worth, dimension
    return None

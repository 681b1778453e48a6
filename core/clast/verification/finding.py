"""What a case finds: a number beside the one it should be."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import inf, isnan


@dataclass(frozen=True)
class Finding:
    """One number that a case computes, beside the one it should be.

    Attributes
    ----------
    quantity : str
        What the number is, with its unit.
    expected, got : float
    bound : float
        Largest error that is accepted.
    absolute : bool
        Whether the error is the difference itself; else it is the share of ``expected``, which is then not 0.

    Examples
    --------
    >>> found = Finding("peak force, N", expected=200.0, got=201.0, bound=0.01)
    >>> found.error, found.passed
    (0.005, True)
    >>> Finding("speed, m/s", 0.0, float("nan"), 1e-3, absolute=True).passed
    False
    """

    quantity: str
    expected: float
    got: float
    bound: float
    absolute: bool = False

    def __post_init__(self) -> None:
        if self.expected == 0.0 and not self.absolute:
            raise ValueError(f"{self.quantity}: an error as a share of 0 says nothing; make it absolute")

    @property
    def error(self) -> float:
        """Distance from the expected number: as a share of it, or as it is."""
        distance = abs(self.got - self.expected)
        return float(distance if self.absolute else distance / abs(self.expected))

    @property
    def passed(self) -> bool:
        """Whether the error is within its bound; what is not a number never is."""
        return bool(self.error <= self.bound)

    @property
    def severity(self) -> float:
        """Error as a share of its bound; infinite for what is not a number, or should be exact and is not."""
        if isnan(self.error):
            return inf
        if self.bound == 0.0:
            return 0.0 if self.error == 0.0 else inf
        return self.error / self.bound


def worst(findings: Iterable[Finding], what: str = "") -> Finding:
    """Return the finding that is nearest to its bound, or farthest beyond it.

    Parameters
    ----------
    findings : iterable of Finding
        At least one.
    what : str
        Set in front of its quantity.

    Examples
    --------
    >>> worst([Finding("a", 1.0, 1.0, 0.1), Finding("b", 1.0, 1.01, 0.1)], "of two: ").quantity
    'of two: b'
    """
    found = max(findings, key=lambda each: each.severity)
    return replace(found, quantity=what + found.quantity)

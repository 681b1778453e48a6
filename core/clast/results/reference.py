"""Reference: measured points that a run is compared with."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from clast.errors import RefusedError


@dataclass(frozen=True)
class Reference:
    """A measured crushing point to compare with, as given under ``reference`` in the config.

    Attributes
    ----------
    label : str
        Where the point comes from.
    strain, stress : float
        The point; stress in Pa.
    strain_deviation, stress_deviation : float
        Its scatter, one standard deviation; 0 where not given.
    """

    label: str
    strain: float
    stress: float
    strain_deviation: float = 0.0
    stress_deviation: float = 0.0


def read_references(path: Path, config: dict[str, Any]) -> list[Reference]:
    """Return the measured points in a resolved config.

    Raises
    ------
    RunError
        If an entry is not what it should be.
    """
    try:
        return [_reference(entry) for entry in config.get("reference") or []]
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise RefusedError(f"{path}: reference: cannot be read ({error!r})") from error


def _reference(entry: dict[str, Any]) -> Reference:
    # float() because YAML loads numbers such as 4e6 as text
    return Reference(
        label=str(entry.get("label", "reference")),
        strain=float(entry["strain"]),
        stress=float(entry["stress"]),
        strain_deviation=float(entry.get("strain_deviation") or 0.0),
        stress_deviation=float(entry.get("stress_deviation") or 0.0),
    )

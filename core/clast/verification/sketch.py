"""A sketch: what one panel of a family's picture shows, told without drawing it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Line:
    """One line or one row of dots of a sketch: (n,) numbers each."""

    label: str
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    dots: bool = False


@dataclass(frozen=True)
class Sketch:
    """One panel of a family's picture.

    Attributes
    ----------
    title, x_label, y_label : str
    lines : tuple of Line
        Closed forms as lines, computed numbers as dots.
    logarithmic : bool
        Whether both axes are.
    round : bool
        Whether both axes have one scale, so that circles are round.
    """

    title: str
    x_label: str
    y_label: str
    lines: tuple[Line, ...]
    logarithmic: bool = False
    round: bool = False

"""How near each bond is to breaking, as one signed number and one colour, the same in every product."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.results.run import Frame

# Brewer's diverging blue to red (colorbrewer2.org, RdBu) with a grey middle that is seen on white.
_ANCHORS = (
    "#08306b", "#2166ac", "#4393c3", "#92c5de", "#c4ccd1", "#f4a582", "#d6604d", "#b2182b", "#67001f",
)  # fmt: skip
_LEVELS = 256


def signed_load(frame: Frame) -> NDArray[np.float32]:
    """Return the failure index of each bond, negative under compression, NaN when broken.

    Equation: ``load = sign(axial stress) * failure index``.

    Returns
    -------
    (m,) float32 in [-1, 1]
    """
    side = np.where(frame.bond_stress < 0.0, np.float32(-1.0), np.float32(1.0))
    return np.where(frame.bond_intact, side * frame.bond_failure, np.float32(np.nan))


def load_colours() -> NDArray[np.uint8]:
    """Return the colour table from load -1 (compression, blue) over 0 (grey) to 1 (tension, red).

    Returns
    -------
    (256, 3) uint8

    Examples
    --------
    >>> load_colours()[0].tolist(), load_colours()[-1].tolist()
    ([8, 48, 107], [103, 0, 31])
    """
    anchors = np.array([[int(text[k : k + 2], 16) for k in (1, 3, 5)] for text in _ANCHORS], dtype=np.float64)
    at = np.linspace(0.0, len(anchors) - 1.0, _LEVELS)
    channels = [np.interp(at, np.arange(len(anchors)), anchors[:, k]) for k in range(3)]
    return np.round(np.stack(channels, axis=1)).astype(np.uint8)


def colour_of(load: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Look up the colour of each load; loads outside [-1, 1] take the colour of the nearest end.

    Returns
    -------
    (k, 3) uint8
    """
    level = np.clip((load + 1.0) * (0.5 * _LEVELS), 0, _LEVELS - 1)
    colours: NDArray[np.uint8] = load_colours()[level.astype(np.intp)]
    return colours


def drawn_bonds(load: NDArray[np.float32], finite_where: NDArray[np.float32], budget: int) -> NDArray[np.intp]:
    """Choose the bonds to draw: all intact ones, or within the budget half by load and half as a sample.

    Parameters
    ----------
    load : (m,) float32
        Signed load, NaN for broken bonds.
    finite_where : (m,) float32
        Any number per bond that is NaN when one of its ends has left the domain.
    budget : int
        Most bonds to return.

    Returns
    -------
    (k,) intp
        Numbers of the bonds, ascending, k <= budget.
    """
    intact = np.flatnonzero(np.isfinite(load) & np.isfinite(finite_where))
    if len(intact) <= budget:
        return intact
    order = np.argsort(-np.abs(load[intact]), kind="stable")
    top, rest = order[: budget - budget // 2], np.sort(order[budget - budget // 2 :])
    sample = rest[np.linspace(0, len(rest) - 1, budget // 2).astype(np.intp)]
    chosen: NDArray[np.intp] = intact[np.sort(np.concatenate([top, sample]))]
    return chosen

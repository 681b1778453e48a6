"""How near each bond is to breaking, as one signed number and one colour, the same in every product."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.results.frame import Frame
from clast_viz.colours import looked_up, table

# Brewer's diverging blue to red (colorbrewer2.org, RdBu) with a grey middle that is seen on white.
LOAD = (
    "#08306b", "#2166ac", "#4393c3", "#92c5de", "#c4ccd1", "#f4a582", "#d6604d", "#b2182b", "#67001f",
)  # fmt: skip


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
    return table(LOAD)


def colour_of(load: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Look up the colour of each load; loads outside [-1, 1] take the colour of the nearest end.

    Returns
    -------
    (k, 3) uint8
    """
    return looked_up(load_colours(), 0.5 * (load + np.float32(1.0)))


def drawn_bonds(load: NDArray[np.float32], finite_where: NDArray[np.float32], budget: int | None) -> NDArray[np.intp]:
    """Choose the bonds to draw: all intact ones, or within the budget half by load and half as a sample.

    Parameters
    ----------
    load : (m,) float32
        Signed load, NaN for broken bonds.
    finite_where : (m,) float32
        Any number per bond that is NaN when one of its ends has left the domain.
    budget : int or None
        Most bonds to return, None for all.

    Returns
    -------
    (k,) intp
        Numbers of the bonds, ascending, k <= budget.
    """
    intact = np.flatnonzero(np.isfinite(load) & np.isfinite(finite_where))
    if budget is None or len(intact) <= budget:
        return intact
    order = np.argsort(-np.abs(load[intact]), kind="stable")
    top, rest = order[: budget - budget // 2], np.sort(order[budget - budget // 2 :])
    sample = rest[np.linspace(0, len(rest) - 1, budget // 2).astype(np.intp)]
    chosen: NDArray[np.intp] = intact[np.sort(np.concatenate([top, sample]))]
    return chosen

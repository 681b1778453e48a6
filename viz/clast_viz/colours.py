"""Colour tables, the same in every product."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

LEVELS = 256

# Brewer's schemes (colorbrewer2.org): OrRd from a grey that is seen on white, and PuBu
DAMAGE = ("#cdd3d9", "#fdd49e", "#fdbb84", "#fc8d59", "#e34a33", "#b30000", "#7f0000")
FORCE = ("#c6cfe4", "#a6bddb", "#74a9cf", "#3690c0", "#0570b0", "#045a8d", "#023858")


def table(anchors: Sequence[str]) -> NDArray[np.uint8]:
    """Return (256, 3) colours from the first of equally spaced anchors to the last.

    >>> table(("#000000", "#ff8000"))[[0, -1]].tolist()
    [[0, 0, 0], [255, 128, 0]]
    """
    known = np.array([[int(text[k : k + 2], 16) for k in (1, 3, 5)] for text in anchors], dtype=np.float64)
    at = np.linspace(0.0, len(known) - 1.0, LEVELS)
    channels = [np.interp(at, np.arange(len(known)), known[:, k]) for k in range(3)]
    return np.round(np.stack(channels, axis=1)).astype(np.uint8)


def looked_up(colours: NDArray[np.uint8], share: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Return the (k, 3) colours of shares of the way through a table; those outside [0, 1] take that of the end."""
    level = np.clip(share * LEVELS, 0, LEVELS - 1)
    found: NDArray[np.uint8] = colours[level.astype(np.intp)]
    return found


def colour_map(anchors: Sequence[str], name: str) -> object:
    """Return a table as matplotlib has them."""
    from matplotlib.colors import ListedColormap

    return ListedColormap(table(anchors) / 255.0, name=name)

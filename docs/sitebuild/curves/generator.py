"""Generators: the particles they make, seen from the side."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from clast.parts.generator import Generator, Site
from clast.parts.params import Params

DENSITY = 2500.0


def draw(generator: Generator, params: Params, figure: Figure) -> str:
    """Draw the particles from behind to the front, the nearer the darker."""
    made = generator.generate(params, Site(Path(), defaultdict(lambda: DENSITY)))
    order = np.argsort(-made.position[:, 1])
    position, radius = 1e3 * made.position[order], 1e3 * made.radius[order]
    circles = [Circle((x, z), r) for (x, _, z), r in zip(position, radius, strict=True)]
    axes = figure.subplots()
    shown = PatchCollection(circles, cmap="Blues", edgecolor="black", linewidth=0.3)
    shown.set_array(np.linspace(0.1, 0.7, len(circles)))
    shown.set_clim(0.0, 1.0)
    axes.add_collection(shown)
    axes.set(aspect="equal", xlabel="x [mm]", ylabel="z [mm]")
    axes.autoscale_view()
    return f"What it makes, seen along y: {len(radius)} particles."

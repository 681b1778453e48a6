"""Walls: the mesh that pictures of runs draw."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from clast.parts.params import Params
from clast.parts.wall import Wall

SIZE = 0.02


def draw(wall: Wall, params: Params, figure: Figure) -> str:
    """Draw the triangles; infinite walls are cut off."""
    points, triangles = wall.mesh(params, SIZE)
    axes = figure.add_subplot(projection="3d")
    faces = Poly3DCollection(1e3 * points[triangles], facecolor="lightsteelblue", edgecolor="slategrey", alpha=0.6)
    faces.set_linewidth(0.4)
    axes.add_collection3d(faces)
    centre, reach = points.mean(axis=0), max(float(np.ptp(points, axis=0).max()), 1e-6)
    for axis, middle in zip("xyz", centre, strict=True):
        axes.set(**{f"{axis}lim": 1e3 * (middle + 0.5 * reach * np.array([-1, 1])), f"{axis}label": f"{axis} [mm]"})
    axes.set_box_aspect((1, 1, 1))
    return f"The wall as pictures draw it; what is infinite is cut off at {1e3 * SIZE:g} mm."

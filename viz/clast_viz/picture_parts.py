"""What all pictures are made of: particles as shaded balls, walls, texts and a scale of colours."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.maths.box import Box

MOST_SPHERES = 10_000  # above, each particle is a shaded point: glyphs would take minutes without a GPU
BALL_COLOUR = "#ccd3db"
PLATE_COLOUR = "#708090"
EDGE_COLOUR = "#48545f"
TEXT_COLOUR = "#2b3138"


def add_balls(plotter: Any, position: NDArray[np.float64], radius: NDArray[np.float64], **look: Any) -> Any:
    """Draw balls at (n, 3) places, with radii (n,) in m, and return their actor, None of no balls.

    What else is given goes to pyvista, ``scalars`` as an array (n,).
    """
    import pyvista as pv

    if not len(position):
        return None
    cloud = pv.PolyData(position)
    cloud["radius"] = radius
    if "scalars" in look:
        cloud["shown"], look["scalars"] = look["scalars"], "shown"
    if len(position) > MOST_SPHERES:
        points = plotter.add_mesh(
            cloud, style="points_gaussian", render_points_as_spheres=True, emissive=False, ambient=0.25, **look
        )
        points.mapper.SetScaleArray("radius")
        points.mapper.SetScaleFactor(1.0)
        return points
    detail = int(np.clip(320 / np.sqrt(len(position)), 10, 90))
    ball = pv.Sphere(radius=1.0, theta_resolution=detail, phi_resolution=detail)
    spheres = cloud.glyph(geom=ball, scale="radius", orient=False)
    return plotter.add_mesh(spheres, smooth_shading=True, ambient=0.2, specular=0.2, **look)


def add_wall(plotter: Any, wall: Any, opacity: float = 0.22) -> None:
    """Draw a wall that one looks through, with its edges."""
    plotter.add_mesh(wall, color=PLATE_COLOUR, opacity=opacity, lighting=False)
    edges = wall.extract_feature_edges(boundary_edges=True, feature_edges=True, manifold_edges=False)
    plotter.add_mesh(edges, color=EDGE_COLOUR, line_width=2.0)


def add_box(plotter: Any, box: Box) -> None:
    """Draw the edges of a box that repeats itself."""
    import pyvista as pv

    if box.repeats:
        edges = pv.Box(np.column_stack([box.lower, box.upper]).ravel())
        plotter.add_mesh(edges, style="wireframe", color=EDGE_COLOUR, line_width=2.0)


def add_scale(plotter: Any, mapper: Any, height: int, text: str, tall: float = 1.0, **look: Any) -> None:
    """Draw the scale of a mapper's colours, with what it means below.

    ``tall`` is how much of its view it takes against one that fills the picture; what else is given goes to pyvista.
    """
    width = look.setdefault("width", 0.36)
    plotter.add_scalar_bar(
        title="",
        mapper=mapper,
        color=TEXT_COLOUR,
        fmt="%.1f",
        label_font_size=height // 50,
        height=0.055 * tall,
        position_x=0.5 - 0.5 * width,
        position_y=0.065 * tall,
        **look,
    )
    below = add_text(plotter, height, text, (0.5, 0.03 * tall), size=1.0 / 100.0)
    below.GetTextProperty().SetJustificationToCentered()


def add_text(plotter: Any, height: int, text: str, where: tuple[float, float], size: float = 1.0 / 90.0) -> Any:
    """Write a line of text; ``where`` and ``size`` as shares of the picture."""
    return plotter.add_text(
        text, position=where, viewport=True, font_size=int(height * size), font="arial", color=TEXT_COLOUR
    )

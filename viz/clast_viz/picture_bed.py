"""Picture of a bed of grains: cut open, each grain coloured by its damage, at the start and at the end."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.frame import Frame
from clast.results.run import Run
from clast_viz.colours import DAMAGE, colour_map
from clast_viz.damage import GrainDamage
from clast_viz.picture_parts import add_balls, add_scale, add_text, add_wall

MARGIN, WALL_MARGIN = 0.03, np.array([0.1, 0.1, 0.0])
"""How far the picture reaches beyond the particles, and walls beyond that, as a share of the size."""
SLOPE = 0.3
"""How much one looks down on the bed."""
VIEW_ANGLE = 20.0
SCALE = 0.16
"""Share of the picture's height below the views, for the scale of colours."""
Box = tuple[NDArray[np.float64], NDArray[np.float64]]


def draw_bed(run: Run, size: tuple[int, int]) -> Any:
    """Draw the first frame and the last one, without the half in front of the middle; return the pyvista plotter.

    They stand side by side or one above the other, whichever shows them larger.

    Parameters
    ----------
    run : Run
    size : (int, int)
        Width and height of the picture in pixels.
    """
    damage, first = GrainDamage(run), run.frame(0)
    box = _box(run, first)
    rows, columns = _views(box, size)
    aspect, balls = _aspect(rows, columns, size), None
    plotter = _plotter(rows, columns, size)
    for k, frame in enumerate((first, run.frame(-1))):
        plotter.subplot(k // columns, k % columns)
        balls = _draw_half(plotter, run, frame, damage.of(frame), box)
        _aim(plotter, box, aspect)
        add_text(plotter, size[1], _caption(run, frame), (0.03, 1.0 - 0.06 * rows))
    plotter.subplot(rows, 0)
    if balls is not None:
        meaning = "share of a grain's bonds that are broken"
        add_scale(plotter, balls.mapper, size[1], meaning, tall=1.0 / SCALE, n_labels=6)
    return plotter


def _views(box: Box, size: tuple[int, int]) -> tuple[int, int]:
    """Return rows and columns of the two views."""
    return min(((1, 2), (2, 1)), key=lambda views: _height(box, _aspect(views[0], views[1], size)) * views[0])


def _aspect(rows: int, columns: int, size: tuple[int, int]) -> float:
    """Return how many times as wide as tall a view is."""
    return rows * size[0] / (columns * size[1] * (1.0 - SCALE))


def _plotter(rows: int, columns: int, size: tuple[int, int]) -> Any:
    """Return a plotter with the views, and a strip below for the scale."""
    import pyvista as pv

    return pv.Plotter(
        off_screen=True,
        window_size=list(size),
        shape=(rows + 1, columns),
        row_weights=[*[(1.0 - SCALE) / rows] * rows, SCALE],
        groups=[(rows, slice(None))],
        border=False,
    )


def _draw_half(plotter: Any, run: Run, frame: Frame, damage: NDArray[np.float32], box: Box) -> Any:
    """Draw what lies behind the middle, and return the actor of the particles."""
    import pyvista as pv

    middle = 0.5 * (box[0][1] + box[1][1])
    shown = np.isfinite(frame.position).all(axis=1) & (np.nan_to_num(frame.position[:, 1]) > middle)
    balls = add_balls(
        plotter,
        frame.position[shown].astype(np.float64),
        run.radius[shown],
        scalars=damage[shown],
        clim=(0.0, 1.0),
        cmap=colour_map(DAMAGE, "damage"),
        show_scalar_bar=False,
    )
    low, high = _box(run, frame)
    beyond = WALL_MARGIN * (high - low)
    bounds = np.stack([low - beyond, high + beyond], axis=1)
    bounds[1, 0] = middle
    for wall in run.walls.values():
        whole = pv.PolyData.from_regular_faces(wall.placed(frame), wall.triangles)
        part = whole.clip_box(bounds.ravel(), invert=False).extract_surface(algorithm="dataset_surface")
        if part.n_points:
            add_wall(plotter, part, opacity=0.15)
    return balls


def _box(run: Run, frame: Frame) -> Box:
    """Return the corners of the box that holds nearly all particles; what flew off does not count."""
    points = frame.position[np.isfinite(frame.position).all(axis=1)].astype(np.float64)
    if not len(points):
        return np.zeros(3), np.ones(3)
    low, high = np.quantile(points, 0.002, axis=0), np.quantile(points, 0.998, axis=0)
    margin = MARGIN * (high - low) + 2.5 * float(run.radius.max())
    return low - margin, high + margin


def _caption(run: Run, frame: Frame) -> str:
    where = f"strain {100.0 * frame.strain:.1f} %" if "strain" in run.curves else f"time {frame.time:.4g} s"
    return f"{where}: {100.0 * float((~frame.bond_intact).mean()):.1f} % of the bonds broken"


def _height(box: Box, aspect: float) -> float:
    """Return the height in m that a view as many times as wide as tall must show, with room for texts."""
    x, y, z = box[1] - box[0]
    return float(1.15 * max(z + 0.5 * SLOPE * y, x / aspect))


def _aim(plotter: Any, box: Box, aspect: float) -> None:
    centre, height = 0.5 * (box[0] + box[1]), _height(box, aspect)
    centre[1] += 0.25 * (box[1][1] - box[0][1])
    from_there = np.array([0.0, -1.0, SLOPE]) / np.hypot(1.0, SLOPE)
    plotter.enable_anti_aliasing("ssaa")
    plotter.camera.focal_point = centre
    distance = 0.5 * height / np.tan(np.radians(0.5 * VIEW_ANGLE))
    plotter.camera.position = np.array(plotter.camera.focal_point) + distance * from_there
    plotter.camera.up = (0.0, 0.0, 1.0)
    plotter.camera.view_angle = VIEW_ANGLE
    plotter.reset_camera_clipping_range()

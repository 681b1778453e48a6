"""Picture of a grain between its plates: bonds coloured by their failure index."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.frame import Frame
from clast.results.run import Run
from clast_viz.colours import colour_map
from clast_viz.loads import LOAD, drawn_bonds, signed_load
from clast_viz.picture_parts import BALL_COLOUR, add_balls, add_box, add_scale, add_text, add_wall

MOST_BONDS = 20_000  # above, the most loaded ones and a sample of the rest
BALL_SIZE = 0.42  # of the radius where there are bonds, so that they are seen


def draw_grain(plotter: Any, run: Run, frame: Frame, height: int, *, bonds: bool) -> None:
    """Draw a frame: with its bonds and small particles, or particles only.

    Parameters
    ----------
    plotter : pyvista.Plotter
    run : Run
    frame : Frame
    height : int
        Of the picture in pixels.
    bonds : bool
    """
    import pyvista as pv

    bonds = bonds and len(run.bond_ends) > 0
    present = np.isfinite(frame.position).all(axis=1)
    size = BALL_SIZE if bonds else 1.0
    add_balls(plotter, frame.position[present].astype(np.float64), size * run.radius[present], color=BALL_COLOUR)
    if bonds:
        _add_bonds(plotter, run, frame, height)
    for wall in run.walls.values():
        placed = wall.placed(frame)
        add_wall(plotter, pv.PolyData.from_regular_faces(placed, wall.triangles))
    add_box(plotter, frame.box)
    add_text(plotter, height, _caption(run, frame), (0.025, 0.945))
    _aim(plotter, run, frame, room_below=0.13 if bonds else 0.03)


def _add_bonds(plotter: Any, run: Run, frame: Frame, height: int) -> None:
    load = signed_load(frame)
    ends = frame.lines(run.bond_ends).astype(np.float64)
    shown = drawn_bonds(load, ends.sum(axis=(1, 2)), MOST_BONDS)
    if not len(shown):
        return
    tubes = _tubes(ends[shown], run.bond_diameter[shown] * (0.04 + 0.2 * np.abs(load[shown])), load[shown])
    drawn = plotter.add_mesh(
        tubes,
        scalars="load",
        clim=(-1.0, 1.0),
        cmap=colour_map(LOAD, "load"),
        smooth_shading=True,
        show_scalar_bar=False,
    )
    meaning = "failure index of the bonds: below 0 compression, above 0 tension, 1 breaks"
    add_scale(plotter, drawn.mapper, height, meaning, n_labels=5)


def _tubes(ends: NDArray[np.float64], radius: NDArray[np.float64], load: NDArray[np.float32]) -> Any:
    import pyvista as pv

    count = len(ends)
    cells = np.column_stack([np.full(count, 2), np.arange(0, 2 * count, 2), np.arange(1, 2 * count, 2)])
    lines = pv.PolyData(ends.reshape(-1, 3), lines=cells.ravel())
    lines["load"] = np.repeat(load, 2)
    lines["radius"] = np.repeat(radius, 2)
    lines.set_active_scalars("radius")
    return lines.tube(scalars="radius", absolute=True, n_sides=8)


def _caption(run: Run, frame: Frame) -> str:
    broken = int((~frame.bond_intact).sum())
    where = f"strain {100.0 * frame.strain:.1f} %" if "strain" in run.curves else f"time {frame.time:.4g} s"
    bonds = f", {broken} of {len(frame.bond_intact)} bonds broken" if len(frame.bond_intact) else ""
    return f"{run.name}: {where}{bonds}"


def _aim(plotter: Any, run: Run, frame: Frame, *, room_below: float) -> None:
    """Look slightly from above, at particles and walls that turn; what flew off must not shrink a grain to a dot."""
    points = frame.position[np.isfinite(frame.position).all(axis=1)].astype(np.float64)
    if not len(points):
        return
    low, high = np.quantile(points, 0.01, axis=0), np.quantile(points, 0.99, axis=0)
    for wall in (each for each in run.walls.values() if each.pivot is not None):
        placed = wall.placed(frame)
        low, high = np.minimum(low, placed.min(axis=0)), np.maximum(high, placed.max(axis=0))
    centre = 0.5 * (low + high)
    size = float(np.linalg.norm(high - low)) + 2.0 * float(run.radius.max())
    plotter.enable_anti_aliasing("ssaa")
    plotter.camera.focal_point = centre - np.array([0.0, 0.0, room_below * size])
    plotter.camera.position = centre + size * np.array([0.82, -1.95, 0.5])
    plotter.camera.up = (0.0, 0.0, 1.0)
    plotter.camera.view_angle = 30.0
    plotter.reset_camera_clipping_range()

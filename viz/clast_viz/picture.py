"""Picture: the grain between its plates at the peak stress, bonds coloured by their failure index."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.run import Frame, Run
from clast_viz.curves import peak_frame
from clast_viz.loads import drawn_bonds, load_colours, signed_load
from clast_viz.renderer import NO_RENDERER, RendererProbe, quiet_vtk

FILE = "picture.png"

MOST_SPHERES = 10_000  # above, each particle is a shaded point: glyphs would take minutes without a GPU
MOST_BONDS = 20_000  # above, the most loaded ones and a sample of the rest
BALL_SIZE = 0.42  # of the radius where there are bonds, so that they are seen
BALL_COLOUR = "#ccd3db"
PLATE_COLOUR = "#708090"
TEXT_COLOUR = "#2b3138"


class PictureParams(Params):
    """What the user can choose about the picture."""

    width: Annotated[int, Field(ge=100, le=8000, description="Width in pixels")] = 1600
    height: Annotated[int, Field(ge=100, le=8000, description="Height in pixels")] = 1200
    bonds: Annotated[bool, Field(description="Draw the bonds and shrink the particles")] = True


def write_picture(run: Run, params: PictureParams, path: Path) -> Written:
    """Write ``picture.png`` of the frame before the peak stress, or of the last one without a curve."""
    if run.n_frames == 0:
        return Written(None, "the run has recorded no frame")
    probe = RendererProbe()
    import pyvista.plotting  # noqa: F401  a second of loading while the probe runs

    if not probe.can_render():
        return Written(None, NO_RENDERER)
    with quiet_vtk():
        _draw(run, run.frame(peak_frame(run)), params, path)
    return Written(path)


def _draw(run: Run, frame: Frame, params: PictureParams, path: Path) -> None:
    import pyvista as pv

    plotter = pv.Plotter(off_screen=True, window_size=[params.width, params.height])
    plotter.set_background("white")
    bonds = params.bonds and len(run.bond_ends) > 0
    _add_particles(plotter, run, frame, BALL_SIZE if bonds else 1.0)
    if bonds:
        _add_bonds(plotter, run, frame, params.height)
    for wall in run.walls.values():
        _add_plate(plotter, wall.points + frame.wall_displacement[wall.index], wall.triangles)
    _add_caption(plotter, run, frame, params.height)
    _aim(plotter, run, frame, room_below=0.13 if bonds else 0.03)
    plotter.screenshot(path)
    plotter.close()


def _add_particles(plotter: Any, run: Run, frame: Frame, size: float) -> None:
    import pyvista as pv

    present = np.isfinite(frame.position).all(axis=1)
    cloud = pv.PolyData(frame.position[present].astype(np.float64))
    cloud["radius"] = size * run.radius[present]
    if len(cloud.points) > MOST_SPHERES:
        points = plotter.add_mesh(
            cloud, style="points_gaussian", render_points_as_spheres=True, emissive=False, color=BALL_COLOUR
        )
        points.mapper.SetScaleArray("radius")
        points.mapper.SetScaleFactor(1.0)
        return
    detail = int(np.clip(320 / np.sqrt(len(cloud.points)), 10, 90))
    ball = pv.Sphere(radius=1.0, theta_resolution=detail, phi_resolution=detail)
    spheres = cloud.glyph(geom=ball, scale="radius", orient=False)
    plotter.add_mesh(spheres, color=BALL_COLOUR, smooth_shading=True, ambient=0.2, specular=0.2)


def _add_bonds(plotter: Any, run: Run, frame: Frame, height: int) -> None:
    load = signed_load(frame)
    ends = frame.position[run.bond_ends].astype(np.float64)
    shown = drawn_bonds(load, ends.sum(axis=(1, 2)), MOST_BONDS)
    if not len(shown):
        return
    tubes = _tubes(ends[shown], run.bond_diameter[shown] * (0.04 + 0.2 * np.abs(load[shown])), load[shown])
    plotter.add_mesh(
        tubes,
        scalars="load",
        clim=(-1.0, 1.0),
        cmap=_colour_map(),
        smooth_shading=True,
        show_scalar_bar=False,
    )
    _add_scale(plotter, height)


def _add_scale(plotter: Any, height: int) -> None:
    plotter.add_scalar_bar(
        title="",
        color=TEXT_COLOUR,
        n_labels=5,
        fmt="%.1f",
        label_font_size=height // 50,
        width=0.36,
        height=0.055,
        position_x=0.32,
        position_y=0.065,
    )
    text = plotter.add_text(
        "failure index of the bonds: below 0 compression, above 0 tension, 1 breaks",
        position=(0.5, 0.03),
        viewport=True,
        font_size=height // 100,
        font="arial",
        color=TEXT_COLOUR,
    )
    text.GetTextProperty().SetJustificationToCentered()


def _tubes(ends: NDArray[np.float64], radius: NDArray[np.float64], load: NDArray[np.float32]) -> Any:
    import pyvista as pv

    count = len(ends)
    cells = np.column_stack([np.full(count, 2), np.arange(0, 2 * count, 2), np.arange(1, 2 * count, 2)])
    lines = pv.PolyData(ends.reshape(-1, 3), lines=cells.ravel())
    lines["load"] = np.repeat(load, 2)
    lines["radius"] = np.repeat(radius, 2)
    lines.set_active_scalars("radius")
    return lines.tube(scalars="radius", absolute=True, n_sides=8)


def _add_plate(plotter: Any, points: NDArray[np.float64], triangles: NDArray[np.int64]) -> None:
    import pyvista as pv

    plate = pv.PolyData.from_regular_faces(points, triangles)
    plotter.add_mesh(plate, color=PLATE_COLOUR, opacity=0.22, lighting=False)
    edges = plate.extract_feature_edges(boundary_edges=True, feature_edges=True, manifold_edges=False)
    plotter.add_mesh(edges, color="#48545f", line_width=2.0)


def _colour_map() -> Any:
    from matplotlib.colors import ListedColormap

    return ListedColormap(load_colours() / 255.0, name="load")


def _add_caption(plotter: Any, run: Run, frame: Frame, height: int) -> None:
    plotter.add_text(
        _caption(run, frame),
        position=(0.025, 0.945),
        viewport=True,
        font_size=height // 90,
        font="arial",
        color=TEXT_COLOUR,
    )


def _caption(run: Run, frame: Frame) -> str:
    broken = int((~frame.bond_intact).sum())
    where = f"strain {100.0 * frame.strain:.1f} %" if "strain" in run.curves else f"time {frame.time:.4g} s"
    bonds = f", {broken} of {len(frame.bond_intact)} bonds broken" if len(frame.bond_intact) else ""
    return f"{run.name}: {where}{bonds}"


def _aim(plotter: Any, run: Run, frame: Frame, *, room_below: float) -> None:
    """Look slightly from above; fragments that flew off must not shrink the grain to a dot."""
    points = frame.position[np.isfinite(frame.position).all(axis=1)].astype(np.float64)
    if not len(points):
        return
    low, high = np.quantile(points, 0.01, axis=0), np.quantile(points, 0.99, axis=0)
    centre = 0.5 * (low + high)
    size = float(np.linalg.norm(high - low)) + 2.0 * float(run.radius.max())
    plotter.enable_anti_aliasing("ssaa")
    plotter.camera.focal_point = centre - np.array([0.0, 0.0, room_below * size])
    plotter.camera.position = centre + size * np.array([0.82, -1.95, 0.5])
    plotter.camera.up = (0.0, 0.0, 1.0)
    plotter.camera.view_angle = 30.0
    plotter.reset_camera_clipping_range()

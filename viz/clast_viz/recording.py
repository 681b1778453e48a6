"""Recording: the whole run as one rerun file to play, scrub and turn."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.run import Frame, Run
from clast_viz.loads import colour_of, drawn_bonds, signed_load
from clast_viz.recording_layout import layout, magnification
from clast_viz.recording_plot import Plot, log_plot, log_plot_until
from clast_viz.recording_series import Events, log_curves, log_peak
from clast_viz.recording_time import Timelines

FILE = "recording.rrd"

GRAIN_COLOURS = ((176, 184, 194), (214, 190, 150), (158, 188, 176), (190, 168, 190), (170, 178, 214))
WALL_COLOUR = (112, 128, 144, 70)
WALL_EDGE_COLOUR = (72, 84, 98)
CRACK_COLOUR = (255, 140, 0)


class RecordingParams(Params):
    """What the user can choose about the recording."""

    bond_budget: Annotated[
        int,
        Field(ge=0, description="Most bonds drawn per frame: the most loaded ones and a sample of the rest"),
    ] = 50_000


class Cracks(NamedTuple):
    """Cracks that opened since the frame before."""

    position: NDArray[np.float64]
    diameter: NDArray[np.float64]


def write_recording(run: Run, params: RecordingParams, path: Path) -> Written:
    """Write ``recording.rrd``: particles, bonds coloured by load, cracks, walls, curves, events."""
    os.environ.setdefault("RUST_LOG", "off")  # what rerun logs about its file, its exceptions or the file's end tell
    import rerun as rr

    if run.n_frames == 0:
        return Written(None, "the run has recorded no frame")
    timelines = Timelines.of(run)
    plot = Plot.of(run)
    # a fixed id and no clock make the recordings of two equal runs equal
    stream = rr.RecordingStream(
        "clast", recording_id=f"{run.name} in {run.folder.resolve().name}", send_properties=False
    )
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    stream.set_sinks(rr.FileSink(path), default_blueprint=layout(run, timelines, plot))
    _log_static(stream, run)
    log_curves(stream, run, timelines)
    log_plot(stream, run, plot)
    events = Events(run, timelines)
    for k in range(run.n_frames):
        frame = run.frame(k)
        timelines.set(stream, k)
        _log_frame(stream, run, frame, _new_cracks(run, timelines, k), params.bond_budget)
        events.log_frame(stream, k, frame)
        log_plot_until(stream, run, plot, frame.time)
    log_peak(stream, run, timelines)
    stream.flush()
    stream.disconnect()
    return Written(path)


def _log_static(stream: Any, run: Run) -> None:
    import rerun as rr

    stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    stream.log("scene", rr.Transform3D(scale=magnification(run)), static=True)
    palette = np.array(GRAIN_COLOURS, dtype=np.uint8)
    colours = palette[run.material.astype(np.intp) % len(palette)]
    stream.log(
        "scene/particles",
        rr.Points3D.from_fields(radii=run.radius.astype(np.float32), colors=colours),
        static=True,
    )
    for name, wall in run.walls.items():
        mesh = rr.Mesh3D(vertex_positions=wall.points, triangle_indices=wall.triangles, albedo_factor=WALL_COLOUR)
        stream.log(f"scene/walls/{name}", mesh, static=True)
        edges = wall.points[_outline(wall.triangles)]
        stream.log(f"scene/walls/{name}/outline", rr.LineStrips3D(edges, colors=WALL_EDGE_COLOUR), static=True)


def _log_frame(stream: Any, run: Run, frame: Frame, cracks: Cracks, budget: int) -> None:
    import rerun as rr

    stream.log("scene/particles", rr.Points3D.from_fields(positions=frame.position))
    for name, wall in run.walls.items():
        stream.log(f"scene/walls/{name}", rr.Transform3D(translation=frame.wall_displacement[wall.index]))
    if len(run.bond_ends) == 0:
        return
    load = signed_load(frame)
    shown = drawn_bonds(load, frame.position[run.bond_ends].sum(axis=(1, 2)), budget)
    bonds = rr.LineStrips3D.from_fields(
        strips=_strips(frame.position[run.bond_ends[shown]]),
        colors=colour_of(load[shown]),
        radii=run.bond_diameter[shown] * (0.04 + 0.16 * np.abs(load[shown])),
    )
    stream.log("scene/bonds", bonds)
    points = rr.Points3D(cracks.position, radii=0.5 * cracks.diameter, colors=CRACK_COLOUR)
    stream.log("scene/cracks", points)


def _new_cracks(run: Run, timelines: Timelines, k: int) -> Cracks:
    chosen = timelines.since_previous(run.cracks["time"], k)
    return Cracks(run.cracks["position"][chosen], run.bond_diameter[run.cracks["bond"][chosen]])


def _strips(ends: NDArray[np.float32]) -> Any:
    """Build the strips as the exact Arrow type: a hundred times faster than handing over an array."""
    import pyarrow as pa
    import rerun as rr

    kind = rr.components.LineStrip3DBatch._ARROW_DATATYPE
    values = pa.array(np.ascontiguousarray(ends, dtype=np.float32).ravel())
    points = pa.FixedSizeListArray.from_arrays(values, type=kind.value_type)
    return pa.ListArray.from_arrays(np.arange(0, 2 * len(ends) + 1, 2, dtype=np.int32), points, type=kind)


def _outline(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the (e, 2) edges that belong to one triangle only, or all edges of a closed surface."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    border: NDArray[np.int64] = unique[count == 1]
    return border if len(border) else unique

"""Recording: the whole run as one rerun file to play, scrub and turn."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.run import Run
from clast_viz.budget import Budget, FrameBudget, chosen_frames, within
from clast_viz.recording_layout import layout
from clast_viz.recording_plot import Plot, log_plot, log_plot_until
from clast_viz.recording_scene import BONDS_BYTES, CHAIN_BYTES, PARTICLE_BYTES, SceneLog
from clast_viz.recording_series import Events, log_curves, log_peak
from clast_viz.recording_time import Timelines

FILE = "recording.rrd"
ROOM = 400e6
"""Bytes that frames may take together with ``frames: auto``: the viewer holds all of them in memory."""


class RecordingParams(Params):
    """What the user can choose about the recording; everything is in it with ``all`` three times."""

    bonds: Annotated[
        Budget,
        Field(description="Most bonds drawn per frame, the most loaded ones and a sample of the rest; or 'all'"),
    ] = 50_000
    contacts: Annotated[
        Budget, Field(description="Most links of force chains drawn per frame, the strongest ones; or 'all'")
    ] = 20_000
    frames: Annotated[
        FrameBudget,
        Field(description="Most frames, evenly spread; 'all'; or 'auto' for as many as fit in about 400 MB"),
    ] = "auto"


def write_recording(run: Run, params: RecordingParams, path: Path) -> Written:
    """Write ``recording.rrd``: particles, bonds coloured by load, force chains, cracks, walls, curves, events."""
    os.environ.setdefault("RUST_LOG", "off")  # what rerun logs about its file, its exceptions or the file's end tell
    import rerun as rr

    if run.n_frames == 0:
        return Written(None, "the run has recorded no frame")
    chosen = chosen_frames(run, params.frames, frame_bytes(run, params), ROOM)
    timelines = Timelines.of(run, chosen)
    plot = Plot.of(run)
    # a fixed id and no clock make the recordings of two equal runs equal
    stream = rr.RecordingStream(
        "clast", recording_id=f"{run.name} in {run.folder.resolve().name}", send_properties=False
    )
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    stream.set_sinks(rr.FileSink(path), default_blueprint=layout(run, timelines, plot))
    log_curves(stream, run, timelines)
    log_plot(stream, run, plot)
    _log_frames(stream, run, params, timelines, plot)
    log_peak(stream, run, timelines)
    stream.flush()
    stream.disconnect()
    return Written(path)


def _log_frames(stream: Any, run: Run, params: RecordingParams, timelines: Timelines, plot: Plot | None) -> None:
    scene, events = SceneLog(stream, run, timelines, params.bonds, params.contacts), Events(run, timelines)
    for k, number in enumerate(timelines.frames):
        frame = run.frame(number)
        timelines.set(stream, k)
        scene.log_frame(k, frame)
        events.log_frame(stream, k, frame)
        log_plot_until(stream, run, plot, frame.time)


def frame_bytes(run: Run, params: RecordingParams) -> float:
    """Return about how many bytes one frame takes in the file."""
    bonds, found = within(params.bonds, len(run.bond_ends)), run.contacts(-1)
    chains = within(params.contacts, len(found.i)) if found is not None else 0
    return PARTICLE_BYTES * len(run.radius) + BONDS_BYTES * bonds + CHAIN_BYTES * chains

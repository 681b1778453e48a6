"""The recording holds the numbers of the run, on both timelines, and only as many bonds as asked for."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from clast.results.run import Run, open_run
from clast_viz.loads import colour_of, drawn_bonds, signed_load
from clast_viz.recording import RecordingParams, write_recording
from clast_viz.recording_plot import Plot
from tests.viz.synthetic_run import FRAMES, LEAVES_AT, small_grain, write_run

rerun = pytest.importorskip("rerun")


@pytest.fixture(autouse=True)
def _strict() -> Iterator[None]:
    rerun.set_strict_mode(True)
    yield
    rerun.set_strict_mode(False)


@pytest.fixture(scope="module")
def recorded(grain_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "recording.rrd"
    with open_run(grain_folder) as run:
        assert write_recording(run, RecordingParams(), path).path == path
    return path


def column(path: Path, entity: str, component: str, *, index: str = "time") -> tuple[NDArray[np.int64], list[Any]]:
    """Return the index in ns (0 when static) and the values of a component, in order of the index."""
    from rerun.chunk import RrdReader

    rows: list[tuple[int, Any]] = []
    for chunk in RrdReader(str(path)).stream():
        batch = chunk.to_record_batch()
        if chunk.entity_path != entity or component not in batch.schema.names:
            continue
        at = [0] * chunk.num_rows if chunk.is_static else batch[index].cast("int64").to_pylist()
        rows += zip(at, batch[component].to_pylist(), strict=True)
    rows.sort(key=lambda row: row[0])
    return np.array([row[0] for row in rows]), [row[1] for row in rows]


def test_positions_are_those_of_the_frames_on_both_timelines(recorded: Path, grain: Run) -> None:
    for index, factor in (("time", 1e9), ("strain", 100e9)):
        at, positions = column(recorded, "/scene/particles", "Points3D:positions", index=index)
        np.testing.assert_allclose(at, grain.frame_values(index) * factor, atol=1.0)
        for k in range(FRAMES):
            np.testing.assert_array_equal(np.array(positions[k], np.float32), grain.frame(k).position)


def test_radii_are_sent_once(recorded: Path, grain: Run) -> None:
    _, radii = column(recorded, "/scene/particles", "Points3D:radii")
    assert len(radii) == 1
    np.testing.assert_array_equal(np.array(radii[0], np.float32), grain.radius.astype(np.float32))


def test_bonds_are_the_intact_ones_between_present_particles_in_the_colour_of_their_load(
    recorded: Path, grain: Run
) -> None:
    _, strips = column(recorded, "/scene/bonds", "LineStrips3D:strips")
    _, colours = column(recorded, "/scene/bonds", "LineStrips3D:colors")
    for k in (0, 5, LEAVES_AT, FRAMES - 1):
        frame = grain.frame(k)
        present = np.isfinite(frame.position[grain.bond_ends]).all(axis=(1, 2))
        shown = frame.bond_intact & present
        np.testing.assert_array_equal(np.array(strips[k], np.float32), frame.position[grain.bond_ends[shown]])
        rgb = colour_of(signed_load(frame)[shown]).astype(np.uint32)
        packed = rgb[:, 0] << 24 | rgb[:, 1] << 16 | rgb[:, 2] << 8 | 255
        np.testing.assert_array_equal(np.array(colours[k], np.uint32), packed)
    assert len(strips[0]) == len(grain.bond_ends) > len(strips[-1])


def test_each_crack_is_shown_once_in_the_frame_after_it(recorded: Path, grain: Run) -> None:
    _, cracks = column(recorded, "/scene/cracks", "Points3D:positions")
    assert [len(points) for points in cracks[:6]] == [0, 0, 0, 0, 7, 7]
    shown = np.concatenate([np.array(points, np.float32).reshape(-1, 3) for points in cracks])
    np.testing.assert_array_equal(shown, grain.cracks["position"].astype(np.float32))


def test_plates_move_as_in_the_frames(recorded: Path, grain: Run) -> None:
    _, moved = column(recorded, "/scene/walls/upper", "Transform3D:translation")
    expected = [grain.frame(k).wall_displacement[0] for k in range(FRAMES)]
    np.testing.assert_allclose(np.array(moved)[:, 0], expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("entity", "name", "scale"),
    [("stress", "stress_Pa", 1e-6), ("strain", "strain", 100.0), ("bonds_broken", "bonds_broken", 1.0)],
)
def test_curves_are_those_of_the_run(recorded: Path, grain: Run, entity: str, name: str, scale: float) -> None:
    at, values = column(recorded, f"/curves/{entity}", "Scalars:scalars")
    np.testing.assert_allclose(at, grain.curves["time_s"] * 1e9, atol=1.0)
    np.testing.assert_array_equal(np.array(values)[:, 0], grain.curves[name] * scale)


def test_drawn_curve_grows_to_the_whole_curve(recorded: Path, grain: Run) -> None:
    _, drawn = column(recorded, "/stress_strain/curve", "LineStrips2D:strips")
    plot = Plot.of(grain)
    assert plot is not None
    assert [len(strips[0]) for strips in drawn] == [1 + 10 * k for k in range(FRAMES)]
    whole = plot.place(grain.curves["strain"], grain.curves["stress_Pa"])
    np.testing.assert_array_equal(np.array(drawn[-1][0], np.float32), whole)
    _, points = column(recorded, "/stress_strain/reference/0/point", "Points2D:positions")
    np.testing.assert_array_equal(np.array(points[0], np.float32), plot.place([0.1649], 4.05e6))


def test_events_are_counted_per_frame(recorded: Path) -> None:
    _, texts = column(recorded, "/events", "TextLog:text")
    lines = [text[0] for text in texts]
    assert lines[0] == "7 bonds broke (total 7): 3 tension, 2 shear, 2 strain"
    assert "peak stress 4.19 MPa at 18.0% strain" in lines
    assert "1 particle left the domain (80 remain)" in lines
    assert lines[-1].startswith("6 bonds broke (total 54)")


def test_layout_is_in_the_file(recorded: Path) -> None:
    from rerun.chunk import RrdReader

    assert len(RrdReader(str(recorded)).blueprints()) == 1


def test_same_run_gives_the_same_recording(recorded: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.rrd"
    with open_run(write_run(tmp_path / "other", small_grain())) as run:
        write_recording(run, RecordingParams(), again)
    compare = [sys.executable, "-m", "rerun_cli", "rrd", "compare", "--unordered", str(recorded), str(again)]
    result = subprocess.run(compare, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr


def test_scene_without_bonds_and_curve_is_recorded(spheres: Run, tmp_path: Path) -> None:
    path = tmp_path / "recording.rrd"
    assert write_recording(spheres, RecordingParams(), path).path == path
    at, positions = column(path, "/scene/particles", "Points3D:positions")
    assert len(at) == spheres.n_frames
    np.testing.assert_array_equal(np.array(positions[-1], np.float32), spheres.frame(-1).position)
    assert column(path, "/stress_strain/curve", "LineStrips2D:strips")[1] == []


def test_budget_keeps_the_most_loaded_bonds_and_a_sample() -> None:
    load = np.linspace(-1.0, 1.0, 1000, dtype=np.float32)
    load[::7] = np.nan
    shown = drawn_bonds(load, np.zeros(1000, np.float32), 100)
    assert len(np.unique(shown)) == 100
    assert np.isfinite(load[shown]).all()
    order = np.argsort(-np.nan_to_num(np.abs(load)), kind="stable")
    assert set(order[:50]) <= set(shown)
    assert np.abs(load[shown]).min() < 0.1


@pytest.mark.parametrize("budget", [0, 1, 2, 3])
def test_budget_is_kept_when_tiny(budget: int) -> None:
    assert len(drawn_bonds(np.ones(5, np.float32), np.zeros(5, np.float32), budget)) == budget


def test_run_without_frames_says_so(tmp_path: Path) -> None:
    scene = small_grain()
    empty = scene._replace(frames={name: values[:0] for name, values in scene.frames.items()})
    with open_run(write_run(tmp_path / "run", empty)) as run:
        written = write_recording(run, RecordingParams(), tmp_path / "recording.rrd")
    assert written.path is None
    assert "no frame" in written.skipped
    assert not (tmp_path / "recording.rrd").exists()

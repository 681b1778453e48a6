"""A run folder is read back as it was written; whatever is wrong with it is said in one sentence."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from clast.errors import RunError
from clast.results.reference import Reference
from clast.results.run import open_run
from tests.viz.synthetic_run import FRAMES, LEAVES_AT, small_grain, two_spheres, write_run


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_run(tmp_path / "grain", small_grain())


def test_scene_is_read_as_written(folder: Path) -> None:
    scene = small_grain()
    with open_run(folder) as run:
        assert (run.name, run.folder, run.complete, run.n_frames) == ("synthetic", folder, True, FRAMES)
        assert run.materials == ["glass"]
        assert run.crack_modes == ["tension", "shear", "strain"]
        assert run.summary == {"steps": 11000}
        np.testing.assert_array_equal(run.radius, scene.radius)
        np.testing.assert_array_equal(run.bond_ends, scene.ends)
        np.testing.assert_array_equal(run.bond_diameter, scene.bond_diameter)
        np.testing.assert_array_equal(run.bond_length, scene.bond_length)
        for name, values in scene.curves.items():
            np.testing.assert_array_equal(run.curves[name], values)
        for name, values in scene.cracks.items():
            np.testing.assert_array_equal(run.cracks[name], values)


def test_walls_come_in_the_order_of_their_displacements(folder: Path) -> None:
    with open_run(folder) as run:
        assert list(run.walls) == ["upper", "lower"]
        moved = run.frame(-1).wall_displacement[run.walls["upper"].index]
        assert moved[2] == pytest.approx(-0.25 * 2.16e-3)


@pytest.mark.parametrize("k", [0, 5, FRAMES - 1])
def test_frame_is_read_as_written(folder: Path, k: int) -> None:
    written = small_grain().frames
    with open_run(folder) as run:
        frame = run.frame(k)
    assert (frame.time, frame.step, frame.strain) == tuple(written[name][k] for name in ("time", "step", "strain"))
    for name in ("position", "velocity", "bond_intact", "bond_stress", "bond_failure", "wall_displacement"):
        np.testing.assert_array_equal(getattr(frame, name), written[name][k])
    assert frame.bond_intact.dtype == bool
    assert frame.orientation is None
    assert bool(np.isnan(frame.position[0]).all()) == (k >= LEAVES_AT)


def test_frames_count_from_the_end_and_no_further(folder: Path) -> None:
    with open_run(folder) as run:
        assert run.frame(-1).time == run.frame(FRAMES - 1).time
        for k in (FRAMES, -FRAMES - 1):
            with pytest.raises(IndexError):
                run.frame(k)


def test_reference_points_come_from_the_config(folder: Path) -> None:
    with open_run(folder) as run:
        assert run.reference == [Reference("experiment, 94 grains", 0.1649, 4.05e6, 0.0412, 1.45e6)]


def test_scene_without_bonds_and_walls_opens(tmp_path: Path) -> None:
    with open_run(write_run(tmp_path, two_spheres(), reference=False)) as run:
        assert (run.walls, run.reference, len(run.bond_ends)) == ({}, [], 0)
        assert run.frame(0).wall_displacement.shape == (0, 3)


def test_unfinished_run_opens_with_what_all_columns_have(folder: Path) -> None:
    (folder / "summary.json").unlink()
    with h5py.File(folder / "results.h5", "a") as file:
        file.attrs["complete"] = False
        file["frames/bond_stress"].resize(FRAMES - 1, axis=0)
        file["curves/stress_Pa"].resize(7, axis=0)
    with open_run(folder) as run:
        assert (run.complete, run.n_frames, run.summary) == (False, FRAMES - 1, {})
        assert {len(values) for values in run.curves.values()} == {7}
        assert run.frame(-1).bond_stress.shape == (len(run.bond_ends),)


def test_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"nowhere: not there; give the run folder"):
        open_run(tmp_path / "nowhere")


def test_file_in_place_of_a_folder_is_refused(folder: Path) -> None:
    with pytest.raises(RunError, match="a file, not a folder; give the run folder"):
        open_run(folder / "results.h5")


def test_folder_without_results_is_no_run_folder(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"not a run folder, it holds no results\.h5"):
        open_run(tmp_path)


@pytest.mark.parametrize("keep", [0, 100, 20_000])
def test_file_cut_short_is_unreadable(folder: Path, keep: int) -> None:
    path = folder / "results.h5"
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(RunError, match=r"cannot be read .* damaged or cut short"):
        open_run(folder)


def test_file_of_another_program_is_refused(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "results.h5", "w") as file:
        file["x"] = 1
    with pytest.raises(RunError, match="not written by Clast"):
        open_run(tmp_path)


@pytest.mark.parametrize("begin", range(600, 12_000, 600))
def test_whatever_is_overwritten_a_file_is_read_or_refused_in_one_sentence(folder: Path, begin: int) -> None:
    path = folder / "results.h5"
    torn = bytearray(path.read_bytes())
    torn[begin : begin + 600] = bytes(600)
    path.write_bytes(torn)
    told = ""
    try:
        with open_run(folder) as run:
            for k in range(run.n_frames):
                run.frame(k)
    except RunError as error:
        told = str(error)
    assert re.fullmatch(rf"({path}: cannot be read \(.*\); the file is damaged or cut short, .*)?", told)


@pytest.mark.parametrize("name", ["curves", "bonds/ends"])
def test_missing_part_is_named(folder: Path, name: str) -> None:
    with h5py.File(folder / "results.h5", "a") as file:
        del file[name]
    with pytest.raises(RunError, match=name.split("/")[-1]):
        open_run(folder)


def test_other_schema_is_named(folder: Path) -> None:
    with h5py.File(folder / "results.h5", "a") as file:
        file.attrs["schema"] = 7
    with pytest.raises(RunError, match="written in schema 7"):
        open_run(folder)


def test_damaged_summary_is_named(folder: Path) -> None:
    (folder / "summary.json").write_text("{", encoding="utf-8")
    with pytest.raises(RunError, match=r"summary\.json: cannot be read"):
        open_run(folder)


def test_damaged_config_is_named_in_one_line(folder: Path) -> None:
    (folder / "config.yaml").write_text("{", encoding="utf-8")
    with pytest.raises(RunError, match=r"config\.yaml: cannot be read \(ParserError: .*\)$"):
        open_run(folder)


def test_damaged_reference_is_named(folder: Path) -> None:
    (folder / "config.yaml").write_text("reference: [{label: x}]", encoding="utf-8")
    with pytest.raises(RunError, match=r"config\.yaml: reference"):
        open_run(folder)


def test_run_being_written_by_another_process_says_so(folder: Path) -> None:
    hold = "import h5py, sys; f = h5py.File(sys.argv[1], 'a'); print('open', flush=True); sys.stdin.read()"
    writer = subprocess.Popen(
        [sys.executable, "-c", hold, str(folder / "results.h5")],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    with writer:
        assert writer.stdout is not None
        writer.stdout.readline()
        with pytest.raises(RunError, match="a running simulation is writing it"):
            open_run(folder)
        writer.communicate()

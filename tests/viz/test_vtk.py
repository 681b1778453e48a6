"""The VTKHDF file, read by VTK itself, holds the numbers of the run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from clast.results.run import Run, open_run
from clast_viz.vtk import VtkParams, write_vtk
from tests.viz.synthetic_run import FRAMES, LEAVES_AT


@pytest.fixture(scope="module")
def written(grain_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("vtk") / "particles.vtkhdf"
    with open_run(grain_folder) as run:
        assert write_vtk(run, VtkParams(), path).path == path
    return path


def reader(path: Path) -> Any:
    from vtkmodules.vtkIOHDF import vtkHDFReader

    opened = vtkHDFReader()
    opened.SetFileName(str(path))
    opened.UpdateInformation()
    return opened


def read_step(opened: Any, k: int) -> Any:
    import pyvista as pv

    opened.SetStep(k)
    opened.Update()
    return pv.wrap(opened.GetOutput())


def test_every_step_equals_its_frame(written: Path, grain: Run) -> None:
    opened = reader(written)
    assert opened.GetNumberOfSteps() == FRAMES
    for k in (*range(FRAMES), 0):
        frame = grain.frame(k)
        data = read_step(opened, k)
        assert opened.GetTimeValue() == frame.time
        present = np.arange(k >= LEAVES_AT, len(grain.radius))
        np.testing.assert_array_equal(data.point_data["id"], present)
        np.testing.assert_array_equal(data.points, frame.position[present])
        np.testing.assert_array_equal(data.point_data["velocity"], frame.velocity[present])
        np.testing.assert_array_equal(data.point_data["radius"], grain.radius[present].astype(np.float32))


def test_bonds_are_lines_between_the_right_particles_with_their_stress(written: Path, grain: Run) -> None:
    opened = reader(written)
    for k in (0, LEAVES_AT - 1, LEAVES_AT, FRAMES - 1):
        frame = grain.frame(k)
        data = read_step(opened, k)
        shown = frame.bond_intact & np.isfinite(frame.position[grain.bond_ends]).all(axis=(1, 2))
        ends = data.point_data["id"][data.lines.reshape(-1, 3)[:, 1:]]
        np.testing.assert_array_equal(ends, grain.bond_ends[shown])
        assert data.n_verts == data.n_points
        np.testing.assert_array_equal(data.cell_data["stress"][data.n_verts :], frame.bond_stress[shown])
        np.testing.assert_array_equal(data.cell_data["failure"][data.n_verts :], frame.bond_failure[shown])
        assert not data.cell_data["stress"][: data.n_verts].any()


def test_scene_without_bonds_is_points_only(spheres: Run, tmp_path: Path) -> None:
    path = tmp_path / "particles.vtkhdf"
    write_vtk(spheres, VtkParams(), path)
    data = read_step(reader(path), 4)
    assert (data.n_points, data.n_lines) == (2, 0)
    np.testing.assert_array_equal(data.points, spheres.frame(4).position)


def test_frames_are_spread_over_the_run_with_the_first_and_the_last(grain: Run, tmp_path: Path) -> None:
    path = tmp_path / "particles.vtkhdf"
    write_vtk(grain, VtkParams(frames=5), path)
    opened = reader(path)
    assert opened.GetNumberOfSteps() == 5
    np.testing.assert_array_equal(read_step(opened, 4).points, grain.frame(-1).position[1:])


def test_equal_runs_give_equal_files(written: Path, grain: Run, tmp_path: Path) -> None:
    again = tmp_path / "again.vtkhdf"
    write_vtk(grain, VtkParams(), again)
    assert again.read_bytes() == written.read_bytes()

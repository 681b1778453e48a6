"""Exported files, read back, hold the numbers of the run; what cannot be exported is told in one message."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from clast import export_run, open_run
from clast.cli import main
from clast.errors import ConfigError, RunError
from clast.plugins.discovery import discover
from clast.results.run import Run
from clast_viz.vtk import VtkParams, write_vtk
from tests.viz.synthetic_run import FRAMES, LEAVES_AT, MODES, small_grain, two_spheres, write_run

FORMATS = [
    part.export.format
    for part in (discover().get("writer", name).part for name in discover().names("writer"))
    if part.export is not None
]

SHOUT = """
from clast import hookimpl
from clast.parts.params import Params
from clast.parts.writer import Export, Writer, Written

CLAST_API = 1


class Shout(Params):
    loud: bool = False


def write(run, params, path):
    path.write_text(f"{run.n_frames} {params.loud}")
    if run.n_frames == 1:
        raise ValueError("hoarse")
    return Written(path)


@hookimpl
def clast_register(registry):
    registry.writer("shout", Writer("shouts", Shout, "shout.txt", write, export=Export("shout", {"loud": True})))
"""


def table(path: Path) -> dict[str, np.ndarray]:
    """Return the columns of a CSV file, of numbers where they are."""
    with path.open(newline="") as file:
        head, *rows = csv.reader(file)
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    return {
        name: values if name == "mode" else values.astype(float) for name, values in zip(head, columns, strict=True)
    }


def vectors(columns: dict[str, np.ndarray], name: str, unit: str) -> np.ndarray:
    return np.column_stack([columns[f"{name}_{axis}_{unit}"] for axis in "xyz"]).astype(np.float32)


@pytest.mark.parametrize("to", FORMATS)
@pytest.mark.parametrize("complete", [True, False])
def test_a_finished_or_stopped_run_is_exported_into_its_folder(to: str, complete: bool, tmp_path: Path) -> None:
    folder = write_run(tmp_path / "run", small_grain(), complete=complete)
    path = export_run(folder, to)
    assert path.parent == folder / "export"
    assert path.is_dir() if to in ("csv", "lammps") else path.stat().st_size > 1000
    assert not list(path.parent.glob(".*"))


def test_the_vtk_file_is_that_of_the_writer_without_budgets_and_shows_the_frames_asked_for(
    grain: Run, grain_folder: Path, tmp_path: Path
) -> None:
    write_vtk(grain.only([0, 5, FRAMES - 1]), VtkParams(bonds="all", frames="all"), tmp_path / "expected.vtkhdf")
    path = export_run(grain_folder, "vtkhdf", tmp_path / "some.vtkhdf", frames="0,5,-1")
    assert path.read_bytes() == (tmp_path / "expected.vtkhdf").read_bytes()


def test_a_run_of_chosen_frames_numbers_them_anew_and_knows_their_numbers(three: Run) -> None:
    few = three.only([2, 7])
    assert (few.n_frames, few.frame_numbers.tolist()) == (2, [2, 7])
    assert few.frame(-1).time == three.frame(7).time
    assert few.frame_values("step").tolist() == [2000.0, 7000.0]
    np.testing.assert_array_equal(few.contacts(1).force, three.contacts(7).force)
    assert few.only([1]).frame_numbers.tolist() == [7]
    assert three.n_frames == FRAMES


def test_tables_hold_particles_and_bonds_to_the_bit(grain: Run, grain_folder: Path, tmp_path: Path) -> None:
    folder = export_run(grain_folder, "csv", tmp_path / "tables", frames=f"{LEAVES_AT}")
    frame, present = grain.frame(LEAVES_AT), np.arange(1, len(grain.radius))
    particles = table(folder / f"particles_{LEAVES_AT:04d}.csv")
    np.testing.assert_array_equal(particles["id"], present)
    np.testing.assert_array_equal(vectors(particles, "position", "m"), frame.position[present])
    np.testing.assert_array_equal(vectors(particles, "velocity", "m_per_s"), frame.velocity[present])
    np.testing.assert_array_equal(particles["radius_m"], grain.radius[present])
    bonds = table(folder / f"bonds_{LEAVES_AT:04d}.csv")
    np.testing.assert_array_equal(np.column_stack([bonds["i"], bonds["j"]]), grain.bond_ends)
    np.testing.assert_array_equal(bonds["length_m"], grain.bond_length)
    np.testing.assert_array_equal(bonds["intact"], frame.bond_intact)
    np.testing.assert_array_equal(bonds["stress_Pa"].astype(np.float32), frame.bond_stress)


def test_tables_hold_curves_cracks_and_the_times_of_the_frames(grain: Run, grain_folder: Path, tmp_path: Path) -> None:
    folder = export_run(grain_folder, "csv", tmp_path / "tables", frames="::4")
    np.testing.assert_array_equal(table(folder / "curves.csv")["stress_Pa"], grain.curves["stress_Pa"])
    cracks = table(folder / "cracks.csv")
    np.testing.assert_array_equal(cracks["bond"], grain.cracks["bond"])
    assert cracks["mode"].tolist() == [MODES[mode] for mode in grain.cracks["mode"]]
    frames = table(folder / "frames.csv")
    assert frames["frame"].tolist() == [0, 4, 8]
    np.testing.assert_array_equal(frames["time_s"], grain.frame_values("time")[::4])


def test_tables_hold_what_touches(three: Run, three_folder: Path, tmp_path: Path) -> None:
    folder = export_run(three_folder, "csv", tmp_path / "tables", frames="last")
    contacts, found = table(folder / f"contacts_{FRAMES - 1:04d}.csv"), three.contacts(-1)
    np.testing.assert_array_equal(contacts["j"], found.j)
    np.testing.assert_array_equal(vectors(contacts, "force", "N"), found.force)
    np.testing.assert_array_equal(contacts["normal_force_N"].astype(np.float32), found.normal_force)


def test_a_scene_without_bonds_and_contacts_has_no_tables_of_them(tmp_path: Path) -> None:
    folder = export_run(write_run(tmp_path / "run", two_spheres()), "csv", tmp_path / "tables", frames="last")
    names = {path.name for path in folder.iterdir()}
    assert names == {"curves.csv", "cracks.csv", "frames.csv", "particles_0004.csv"}


def test_the_lammps_dump_holds_every_frame(grain: Run, grain_folder: Path, tmp_path: Path) -> None:
    path = export_run(grain_folder, "lammps", tmp_path / "out") / "particles.dump"
    head, *snapshots = path.read_text().split("ITEM: TIME\n")
    assert head == "ITEM: UNITS\nsi\n"
    assert len(snapshots) == FRAMES
    for k in (0, LEAVES_AT, FRAMES - 1):
        lines, frame = snapshots[k].splitlines(), grain.frame(k)
        assert (float(lines[0]), int(lines[2])) == (frame.time, frame.step)
        names, rows = lines[9].split()[2:], np.loadtxt(lines[10:], ndmin=2)
        columns = dict(zip(names, rows.T, strict=True))
        here = np.isfinite(frame.position).all(axis=1)
        assert int(lines[4]) == len(rows) == here.sum()
        np.testing.assert_array_equal(columns["id"], np.flatnonzero(here) + 1)
        x = np.column_stack([columns[axis] for axis in "xyz"])
        np.testing.assert_array_equal(x.astype(np.float32), frame.position[here])
        np.testing.assert_array_equal(columns["vz"].astype(np.float32), frame.velocity[here, 2])
        low, high = np.array([line.split() for line in lines[6:9]], float).T
        assert (x - columns["radius"][:, None] > low).all()
        assert (x + columns["radius"][:, None] < high).all()


def test_the_lammps_data_file_holds_the_bonds_of_the_last_frame(grain: Run, grain_folder: Path, tmp_path: Path) -> None:
    text = (export_run(grain_folder, "lammps", tmp_path / "out", frames="0:10") / "bonds.data").read_text()
    head, rest = text.split("\nAtoms # bpm/sphere\n\n")
    atoms, bonds = (np.array([row.split() for row in part.splitlines()], float) for part in rest.split("\nBonds\n\n"))
    frame = grain.frame(9)
    here = np.isfinite(frame.position).all(axis=1)
    held = frame.bond_intact & here[grain.bond_ends].all(axis=1)
    np.testing.assert_array_equal(bonds[:, 2:], grain.bond_ends[held] + 1.0)
    np.testing.assert_array_equal(atoms[:, 5:].astype(np.float32), frame.position[here])
    np.testing.assert_array_equal(atoms[:, 3], 2.0 * grain.radius[here])
    assert set(atoms[:, 4]) == {2500.0}
    assert f"{here.sum()} atoms\n{held.sum()} bonds\n1 atom types\n1 bond types\n" in head


def test_a_plugin_may_offer_a_format_of_its_own(grain_folder: Path, tmp_path: Path) -> None:
    (tmp_path / "shout.py").write_text(SHOUT)
    path = export_run(grain_folder, "shout", tmp_path / "out" / "a.txt", files=[tmp_path / "shout.py"])
    assert path.read_text() == f"{FRAMES} True"
    with pytest.raises(ValueError, match="hoarse"):
        export_run(grain_folder, "shout", tmp_path / "b" / "b.txt", frames="last", files=[tmp_path / "shout.py"])
    assert list((tmp_path / "b").iterdir()) == []


def told(*arguments: str | Path) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["export", *map(str, arguments)])
    return result.exit_code, result.stderr


def test_mistakes_are_told_in_one_message(grain_folder: Path, tmp_path: Path) -> None:
    assert told(grain_folder, "--to", "vtkhd") == (2, "--to vtkhd: there is no such format; did you mean 'vtkhdf'?\n")
    out = ("--to", "csv", "-o", tmp_path / "new")
    count = f"the run has {FRAMES} frames, 0 to {FRAMES - 1}"
    assert told(grain_folder, *out, "--frames", "99") == (2, f"--frames 99: {count}\n")
    assert told(grain_folder, *out, "--frames", "7:3") == (2, f"--frames 7:3: names no frame; {count}\n")
    allowed = "give 'all', 'last', numbers such as 0,5,-1, or a range such as 0:100:10"
    assert told(grain_folder, *out, "--frames", "first") == (2, f"--frames first: {allowed}\n")
    assert told(tmp_path, *out)[0] == 2
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_holds_something_is_left_alone(grain_folder: Path, tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("years of work")
    with pytest.raises(ConfigError, match="holds files already"):
        export_run(grain_folder, "csv", tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


def test_a_file_in_the_place_of_a_folder_is_left_alone(grain_folder: Path, tmp_path: Path) -> None:
    thesis = tmp_path / "thesis.txt"
    thesis.write_text("years of work")
    with pytest.raises(ConfigError, match=r"thesis\.txt: is a file, and a folder is needed; name another with -o"):
        export_run(grain_folder, "csv", thesis)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]
    assert thesis.read_text() == "years of work"


def test_a_run_without_frames_says_so_and_still_has_its_curves(tmp_path: Path) -> None:
    scene = small_grain()
    folder = write_run(tmp_path / "run", scene._replace(frames={}))
    with pytest.raises(RunError, match="keeps no frames"):
        export_run(folder, "lammps")
    with open_run(folder) as run:
        np.testing.assert_array_equal(table(export_run(folder, "csv") / "curves.csv")["strain"], run.curves["strain"])

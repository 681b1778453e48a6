"""What is found in the run of a bed agrees with its geometry, its crack table and its summary."""

from __future__ import annotations

import csv
import shutil
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest
import yaml

from clast.errors import RunError
from clast.granular.analysis import Granular, analyse, frame_at
from clast.granular.bed import bed_of
from clast.granular.coordination import touching_bodies
from clast.granular.cut_spheres import sphere_volumes
from clast.granular.tables import tables, write_tables
from clast.results.run import Run, open_run
from tests.viz.synthetic_run import small_grain, two_spheres, write_run


@pytest.fixture
def bed_run(bed_folder: Path) -> Iterator[Run]:
    with open_run(bed_folder) as run:
        yield run


@pytest.fixture(scope="module")
def found(bed_folder: Path) -> Granular:
    with open_run(bed_folder) as run:
        return analyse(run)


def changed(folder: Path, into: Path, **values: object) -> Path:
    """Return a copy of a run with datasets of its results replaced; ``None`` takes one out."""
    shutil.copytree(folder, into)
    with h5py.File(into / "results.h5", "r+") as file:
        for name, value in values.items():
            place = name.replace("__", "/")
            if value is None:
                del file[place]
            else:
                file[place][...] = value
    return into


def test_the_bed_is_the_tube_and_the_plates_of_the_scene(found: Granular) -> None:
    assert found.bed.tube == pytest.approx(1.1e-3)
    assert found.bed.axis == pytest.approx([0.0, 0.0, 1.0])
    assert found.history["high_m"][-1] == pytest.approx(0.6 * 3.52e-3, rel=1e-6)
    assert found.grains.count == 12
    assert sorted(set(found.grains.primaries.tolist())) == [28, 30]
    assert found.grains.mass == pytest.approx(570.0 * sphere_volumes(np.full(12, 0.125e-3)) * found.grains.primaries)


def test_what_is_left_agrees_with_the_summary(found: Granular, bed_run: Run) -> None:
    last, told = found.moments[-1], bed_run.summary
    assert last.pieces.count == told["fragments"] > 30
    assert last.pieces.primaries.max() == told["largest_fragment_particles"]
    assert last.damage.broken.sum() == told["bonds_broken"]
    assert {name: int(found.history[f"grains_{name}"][-1]) for name in ("intact", "damaged", "crushed")} == {
        name: told["grains"][name] for name in ("intact", "damaged", "crushed")
    }
    assert found.history["damage"][-1] == pytest.approx(told["grains"]["mean_damage"])
    assert told["grains"]["crushed"] > 0


def test_breakage_goes_one_way(found: Granular) -> None:
    for name in ("fragments", "hardin", "einav", "damage"):
        values = found.history[name]
        assert values[0] == (12 if name == "fragments" else 0.0)
        assert (np.diff(values) >= -1e-12).all()
        assert values[-1] > values[0]
    assert (np.diff(found.history["d50_m"]) <= 1e-12).all()


def test_porosity_is_what_primaries_leave_of_the_tube(found: Granular) -> None:
    room = np.pi * 1.1e-3**2 * (found.history["high_m"] - found.history["low_m"])
    assert found.history["porosity"] == pytest.approx(1.0 - found.grains.volume.sum() / room)
    assert found.history["porosity_between"][0] == pytest.approx(1.0 - found.grains.envelope.sum() / room[0])


def test_slabs_and_shells_fill_as_much_as_the_whole_bed(found: Granular) -> None:
    for moment in found.moments:
        row = int(np.flatnonzero(found.history["frame"] == moment.frame)[0])
        assert moment.radius is not None
        shells = np.diff(moment.radius.edges**2)
        for name, column in (("solid", "porosity"), ("envelope", "porosity_between")):
            whole = pytest.approx(1.0 - found.history[column][row], rel=1e-9)
            assert np.mean(getattr(moment.height, name)) == whole
            assert np.average(getattr(moment.radius, name), weights=shells) == whole


def test_the_grain_means_of_a_profile_give_back_the_mean_coordination(found: Granular) -> None:
    moment = found.moments[-1]
    assert moment.coordination.sum() % 2 == 0
    assert np.nanmin(moment.height.coordination) >= moment.coordination.min()
    assert np.nanmax(moment.height.coordination) <= moment.coordination.max()
    assert 3.0 < moment.coordination.mean() < 6.0


def test_every_crack_is_in_every_map_once(found: Granular, bed_run: Run) -> None:
    cracks, count = found.cracks, len(bed_run.cracks["bond"])
    assert cracks.over == "strain"
    assert count > 300
    for counts in (cracks.by_height, cracks.by_radius, cracks.by_mode):
        assert counts.sum() == count
        assert counts.sum(axis=0) == pytest.approx(cracks.total)
    assert cracks.by_mode.sum(axis=1).tolist() == np.bincount(bed_run.cracks["mode"], minlength=3).tolist()
    assert (cracks.rate * np.diff(cracks.edges)).sum() == pytest.approx(count)
    early = bed_run.cracks["time"] < np.interp(0.3, bed_run.curves["strain"], bed_run.curves["time_s"])
    assert cracks.total[cracks.edges[1:] < 0.3 + 1e-9].sum() == early.sum()


def test_a_crack_is_in_the_slab_and_the_ring_of_its_place(tmp_path: Path, bed_folder: Path) -> None:
    with h5py.File(bed_folder / "results.h5") as file:
        place = np.tile([0.0, 0.9e-3, 1.0e-3], (len(file["cracks/bond"]), 1))
    with open_run(changed(bed_folder, tmp_path / "run", cracks__position=place)) as run:
        cracks = analyse(run, [0]).cracks
    (slab,), (ring,) = (np.flatnonzero(counts.sum(axis=1)) for counts in (cracks.by_height, cracks.by_radius))
    assert cracks.height_edges[slab] <= 1.0e-3 <= cracks.height_edges[slab + 1] + 3e-5  # the bed begins above the plate
    assert cracks.radius_edges[ring] <= 0.9e-3 <= cracks.radius_edges[ring + 1]
    assert np.diff(cracks.radius_edges**2) == pytest.approx(1.1e-3**2 / len(cracks.by_radius))


def test_frames_are_chosen_by_number_or_strain(bed_run: Run) -> None:
    at = frame_at(bed_run, 0.2)
    strain = bed_run.frame_values("strain")
    assert strain[at - 1] < 0.2 <= strain[at] + 1e-9
    assert [moment.frame for moment in analyse(bed_run, [-1, at]).moments] == [at, bed_run.n_frames - 1]
    with pytest.raises(IndexError, match="frame 99 of a run with"):
        analyse(bed_run, [99])
    with pytest.raises(ValueError, match=r"no frame reaches a strain of 0\.9; the last one is at 0\.4"):
        frame_at(bed_run, 0.9)


def test_tables_hold_what_was_found_and_no_mass_is_lost(found: Granular, bed_run: Run, tmp_path: Path) -> None:
    folder = write_tables(found, bed_run.crack_modes, tmp_path / "tables")
    written = dict(tables(found, bed_run.crack_modes))
    assert {path.stem for path in folder.iterdir()} == set(written)
    with (folder / "history.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["d50_m"]) for row in rows] == found.history["d50_m"].tolist()
    assert written["fragments"]["mass_kg"].sum() == pytest.approx(found.grains.mass.sum())
    grading = written["grading"]
    for moment in found.moments:
        here = grading["frame"] == moment.frame
        assert grading["mass_share"][here].sum() == pytest.approx(1.0)
        assert grading["fragments"][here].sum() == moment.pieces.count
    for name in ("cracks", "cracks_height", "cracks_radius"):
        assert written[name]["cracks"].sum() == len(bed_run.cracks["bond"])


def test_a_run_without_a_tube_and_a_compression_has_no_porosity_but_all_else(tmp_path: Path) -> None:
    folder = write_run(tmp_path / "run", small_grain())
    (folder / "config.yaml").write_text("materials: {glass: {density: 2500.0}}")
    with open_run(folder) as run:
        found = analyse(run)
    assert found.bed.tube is None
    assert found.bed.plates is None
    assert np.isnan(found.history["porosity"]).all()
    assert found.moments[-1].radius is None
    assert found.moments[-1].pieces.mass.sum() == pytest.approx(80 * 2500.0 * sphere_volumes(np.array([0.18e-3]))[0])
    assert found.cracks.by_height.sum() == len(run.cracks["bond"])


def test_between_the_walls_named_as_side_porosity_refers_to_the_section(bed_folder: Path, tmp_path: Path) -> None:
    folder = changed(bed_folder, tmp_path / "run", walls__tube__points=None)
    with h5py.File(folder / "results.h5", "r+") as file:
        del file["walls/tube"]
    config = yaml.safe_load((folder / "config.yaml").read_text())
    config["compression"] = {"upper": "piston", "lower": "floor", "side": ["a", "b", "c", "d"], "area": 4.84e-6}
    (folder / "config.yaml").write_text(yaml.safe_dump(config))
    with open_run(folder) as run:
        found = analyse(run)
    assert found.bed.tube is None
    assert found.moments[-1].radius is None
    room = 4.84e-6 * (found.history["high_m"] - found.history["low_m"])
    assert found.history["porosity"] == pytest.approx(1.0 - found.grains.volume.sum() / room)
    assert np.mean(found.moments[-1].height.solid) == pytest.approx(1.0 - found.history["porosity"][-1], rel=1e-9)


def test_a_rod_amid_the_grains_is_no_tube(bed_folder: Path, tmp_path: Path) -> None:
    with h5py.File(bed_folder / "results.h5") as file:
        points = file["walls/tube/points"][:] * [0.2, 0.2, 1.0]
    with open_run(changed(bed_folder, tmp_path / "run", walls__tube__points=points)) as run:
        assert bed_of(run).tube is None


def test_what_a_run_lacks_is_told(bed_folder: Path, tmp_path: Path) -> None:
    bare = changed(bed_folder, tmp_path / "bare", frames=None)
    with open_run(bare) as run, pytest.raises(RunError, match=r"bare: keeps no frames"):
        analyse(run)
    with (
        open_run(changed(bed_folder, tmp_path / "empty", frames__position=np.nan)) as run,
        pytest.raises(RunError, match="frame 0: all grains have left the domain"),
    ):
        analyse(run)
    silent = changed(bed_folder, tmp_path / "silent")
    (silent / "config.yaml").unlink()
    with open_run(silent) as run, pytest.raises(RunError, match=r"config\.yaml: does not tell the densities of glass"):
        analyse(run)
    loose = write_run(tmp_path / "loose", two_spheres())
    with h5py.File(loose / "results.h5", "r+") as file:
        file["particles/grain"][...] = -1
    with open_run(loose) as run, pytest.raises(RunError, match="has no grains"):
        analyse(run)


def test_touching_is_within_a_share_of_the_primary_diameter() -> None:
    row = np.array([[0.0, 0.0, 0.0], [2.03, 0.0, 0.0], [4.03, 0.0, 0.0], [np.nan, 0.0, 0.0]])
    grain = np.array([0, 1, -1, 2])
    assert touching_bodies(row, np.ones(4), grain, 0.01).tolist() == []
    assert touching_bodies(row, np.ones(4), grain, 0.02).tolist() == [[0, 1]]

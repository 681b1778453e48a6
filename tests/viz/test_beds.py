"""Scenes of several grains: damage, force chains and budgets, in every product."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from clast.results.run import Run, open_run
from clast_viz.budget import chosen_frames
from clast_viz.chains import force_chains, pieces
from clast_viz.colours import DAMAGE, looked_up, table
from clast_viz.damage import GrainDamage, shows_damage
from clast_viz.picture import PictureParams, write_picture
from clast_viz.recording import RecordingParams, write_recording
from clast_viz.renderer import RendererProbe
from clast_viz.vtk import CONTACTS_FILE, VtkParams, write_vtk
from tests.viz.synthetic_run import FRAMES
from tests.viz.test_figures import pixels
from tests.viz.test_recording import column
from tests.viz.test_vtk import read_step, reader


def packed(rgb: np.ndarray) -> np.ndarray:
    """Return colours as a recording holds them."""
    wide = rgb.astype(np.uint32)
    return wide[:, 0] << 24 | wide[:, 1] << 16 | wide[:, 2] << 8 | 255


def test_damage_is_the_share_of_a_grains_bonds_that_are_broken(three: Run, grain: Run, spheres: Run) -> None:
    assert shows_damage(three)
    assert not shows_damage(grain)
    assert not shows_damage(spheres)
    frame = three.frame(-1)
    damage = GrainDamage(three).of(frame)
    for number in range(3):
        of_grain = three.grain[three.bond_ends[:, 0]] == number
        share = (~frame.bond_intact[of_grain]).mean()
        np.testing.assert_allclose(damage[three.grain == number], share, rtol=1e-6)
        assert 0.0 < share < 1.0
    assert not GrainDamage(three).of(three.frame(0)).any()


def test_links_are_the_sums_of_contacts_by_the_pieces_that_touch(three: Run) -> None:
    frame, found = three.frame(-1), three.contacts(-1)
    assert found is not None
    piece = pieces(three, frame)
    sums: dict[tuple[int, int], np.ndarray] = {}
    for i, j, force in zip(found.i, found.j, found.force, strict=True):
        a, b = int(piece[i]), int(piece[j]) if j >= 0 else int(j)
        side = 1.0 if a < b else -1.0
        sums[min(a, b), max(a, b)] = sums.get((min(a, b), max(a, b)), np.zeros(3)) + side * force
    sizes = sorted((float(np.linalg.norm(force)) for force in sums.values()), reverse=True)
    assert len(found.i) > len(sizes) > 3
    np.testing.assert_allclose(force_chains(frame, found, piece, None).force, sizes, rtol=1e-5)


def test_contacts_of_two_whole_grains_make_one_link_between_their_centres(three: Run) -> None:
    frame, found = three.frame(2), three.contacts(2)
    assert found is not None
    between, wall = found.j >= 0, found.j < 0
    assert set(zip(three.grain[found.i[between]], three.grain[found.j[between]], strict=True)) == {(0, 1)}
    chains = force_chains(frame, found, pieces(three, frame), None)
    pushed = [np.linalg.norm(found.force[which].sum(axis=0)) for which in (between, wall)]
    assert pushed[0] > pushed[1]
    np.testing.assert_allclose(chains.force, pushed, rtol=1e-5)
    centres = [frame.position[three.grain == number].mean(axis=0) for number in (0, 1)]
    np.testing.assert_allclose(chains.ends[0], centres, atol=1e-9)
    plate = [found.position[wall][0], frame.position[three.grain == three.grain[40]].mean(axis=0)]
    np.testing.assert_allclose(chains.ends[1], plate, atol=1e-9)
    strongest = force_chains(frame, found, pieces(three, frame), 1)
    np.testing.assert_array_equal(strongest.ends, chains.ends[:1])


def test_contacts_inside_a_piece_make_no_link(three: Run) -> None:
    found = three.contacts(5)
    assert found is not None
    chains = force_chains(three.frame(5), found, np.zeros(len(three.radius), np.int64), None)
    assert len(chains.force) == 1  # the plate


def test_frames_are_chosen_evenly_within_the_room(three: Run) -> None:
    assert chosen_frames(three, "all", 1e9, 1.0) == list(range(FRAMES))
    assert chosen_frames(three, "auto", 1.0, 1e9) == list(range(FRAMES))
    assert chosen_frames(three, "auto", 1.0, 4.0) == [0, 4, 7, 11]
    assert chosen_frames(three, "auto", 1e9, 1.0) == [0, 11]
    assert chosen_frames(three, 3, 1e9, 1.0) == [0, 6, 11]
    assert chosen_frames(three, 1, 1.0, 1.0) == [11]


@pytest.fixture(scope="module")
def recorded(three_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "recording.rrd"
    with open_run(three_folder) as run:
        write_recording(run, RecordingParams(), path)
    return path


def test_recorded_particles_take_the_colour_of_their_grains_damage_when_it_changes(recorded: Path, three: Run) -> None:
    at, colours = column(recorded, "/scene/particles", "Points3D:colors")
    damage = GrainDamage(three)
    shares = [damage.of(three.frame(k)) for k in range(FRAMES)]
    changes = [0, *[k for k in range(1, FRAMES) if not np.array_equal(shares[k], shares[k - 1])]]
    assert 1 < len(changes) < FRAMES
    np.testing.assert_allclose(at, 1e9 * three.frame_values("time")[changes], atol=1.0)
    for k, got in zip(changes, colours, strict=True):
        np.testing.assert_array_equal(np.array(got, np.uint32), packed(looked_up(table(DAMAGE), shares[k])))


def test_recorded_force_chains_are_the_links_of_each_frame(recorded: Path, three: Run) -> None:
    _, strips = column(recorded, "/scene/force_chains", "LineStrips3D:strips")
    _, radii = column(recorded, "/scene/force_chains", "LineStrips3D:radii")
    for k in range(FRAMES):
        found, frame = three.contacts(k), three.frame(k)
        assert found is not None
        chains = force_chains(frame, found, pieces(three, frame), None)
        np.testing.assert_array_equal(np.array(strips[k], np.float32).reshape(-1, 2, 3), chains.ends)
        assert (np.diff(radii[k]) <= 0.0).all()
    assert len(strips[-1]) > len(strips[1]) > 0


def test_a_recording_keeps_to_its_budgets_and_loses_no_crack(three: Run, tmp_path: Path) -> None:
    path = tmp_path / "small.rrd"
    write_recording(three, RecordingParams(bonds=20, contacts=2, frames=4), path)
    chosen = [0, 4, 7, 11]
    at, positions = column(path, "/scene/particles", "Points3D:positions")
    np.testing.assert_allclose(at, 1e9 * three.frame_values("time")[chosen], atol=1.0)
    for k, got in zip(chosen, positions, strict=True):
        np.testing.assert_array_equal(np.array(got, np.float32), three.frame(k).position)
    assert [len(each) for each in column(path, "/scene/bonds", "LineStrips3D:strips")[1]] == [20] * 4
    assert {len(each) for each in column(path, "/scene/force_chains", "LineStrips3D:strips")[1]} == {1, 2}
    cracks = column(path, "/scene/cracks", "Points3D:positions")[1]
    assert sum(len(points) for points in cracks) == len(three.cracks["time"])


def test_vtk_tells_damage_and_fragments_and_has_the_contacts_beside(three: Run, tmp_path: Path) -> None:
    path = tmp_path / "particles.vtkhdf"
    write_vtk(three, VtkParams(), path)
    particles, contacts = reader(path), reader(tmp_path / CONTACTS_FILE)
    for k in (0, 3, FRAMES - 1):
        frame, found = three.frame(k), three.contacts(k)
        assert found is not None
        present = np.isfinite(frame.position[:, 0])
        data: Any = read_step(particles, k)
        np.testing.assert_array_equal(data.point_data["damage"], GrainDamage(three).of(frame)[present])
        np.testing.assert_array_equal(data.point_data["fragment"], pieces(three, frame)[present])
        np.testing.assert_array_equal(data.point_data["grain"], three.grain[present])
        touching: Any = read_step(contacts, k)
        np.testing.assert_array_equal(touching.points, found.position)
        for name in ("i", "j", "force", "normal_force", "tangential_force"):
            np.testing.assert_array_equal(touching.point_data[name], getattr(found, name))


def test_vtk_keeps_to_its_budget_of_bonds_and_shows_all_on_request(three: Run, tmp_path: Path) -> None:
    shown = {}
    for bonds in (10, "all"):
        path = tmp_path / f"{bonds}.vtkhdf"
        write_vtk(three, VtkParams(bonds=bonds), path)
        shown[bonds] = read_step(reader(path), 0).n_lines
    assert shown == {10: 10, "all": len(three.bond_ends)}


def test_run_without_contacts_has_no_file_of_them(grain: Run, tmp_path: Path) -> None:
    write_vtk(grain, VtkParams(), tmp_path / "particles.vtkhdf")
    assert not (tmp_path / CONTACTS_FILE).exists()


@pytest.mark.parametrize("size", [(480, 360), (300, 600)])
def test_picture_shows_the_bed_whole_at_the_start_and_damaged_at_the_end(
    three: Run, tmp_path: Path, size: tuple[int, int]
) -> None:
    if not RendererProbe().can_render():
        pytest.skip("no OpenGL renderer on this machine")
    path = tmp_path / "picture.png"
    width, height = size
    write_picture(three, PictureParams(width=width, height=height), path)
    image = pixels(path)[: int(0.83 * height)]
    warm = image[..., 0] - image[..., 2] > 0.15
    assert warm.sum() > 300
    halves = [half.sum() for half in (np.array_split(warm, 2, axis=1 if width > height else 0))]
    assert halves[0] == 0
    assert halves[1] == warm.sum()

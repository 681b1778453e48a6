"""The contact network: it adds up to the forces that move particles and walls, and looking at it changes nothing."""

from __future__ import annotations

import signal
from pathlib import Path

import numpy as np
import pytest

from clast.config.scene import load
from clast.engine.kernels.layout import F
from clast.results.contacts import Contacts
from clast.results.found_contacts import find_contacts
from clast.results.run import open_run
from clast.session import run_scene
from clast.simulation import Simulation
from tests.core.test_resume import arrays, assert_same_bytes, run, start_and_stop
from tests.scenes import bed, write

SPHERES = """
name: loose
materials:
  glass: {{density: 2500 kg/m3, young_modulus: 10 MPa, poisson_ratio: 0.25}}
  steel: {{density: 7850 kg/m3, young_modulus: 210 GPa, poisson_ratio: 0.3}}
particles:
  type: explicit
  material: glass
  particles:
{particles}
contacts:
  law: hertz_mindlin
  pairs: {{default: {{restitution: 0.5, sliding_friction: 0.3, rolling_friction: 0.1}}}}
walls:
  floor: {{type: plane, material: steel, point: [0, 0, -1 mm], normal: [0, 0, 1]}}
  tube: {{type: cylinder, material: steel, point: [0, 0, 0], axis: [0, 0, 1], radius: 3.8 mm}}
integrator: velocity_verlet
time: {{step: 2e-6 s, end: {{steps: 400}}}}
output: {{writers: []}}
"""


def loose_spheres(folder: Path) -> Simulation:
    """Return 27 spheres of three sizes that collide in a tube."""
    draw = np.random.default_rng(1)
    rows = []
    for x, y, z in np.stack(np.meshgrid(*[[-2.0, 0.0, 2.0]] * 3), axis=-1).reshape(-1, 3):
        u, v, w = draw.uniform(-0.5, 0.5, 3)
        radius = draw.choice([0.9, 0.95, 0.999])
        rows.append(f"    - {{position: [{x} mm, {y} mm, {z + 2} mm], radius: {radius} mm, velocity: [{u}, {v}, {w}]}}")
    return Simulation(load(write(folder, SPHERES.format(particles="\n".join(rows)))), threads=1)


def force_on_each(contacts: Contacts, count: int) -> np.ndarray:
    """Add up the forces of contacts on each particle; what acts on one acts back on the other."""
    total = np.zeros((count, 3))
    np.add.at(total, contacts.i, -contacts.force.astype(np.float64))
    held = contacts.j >= 0
    np.add.at(total, contacts.j[held], contacts.force[held].astype(np.float64))
    return total


def test_forces_of_contacts_are_what_moves_particles_and_walls(tmp_path: Path) -> None:
    simulation = loose_spheres(tmp_path)
    seen = 0
    for step in (50, 150, 300, 400):
        simulation.advance_to(step)
        found = find_contacts(simulation)
        load = simulation.world.particles.load[:, F : F + 3]
        scale = 1e-6 * np.abs(load).max()
        np.testing.assert_allclose(force_on_each(found, len(load)), load, rtol=1e-6, atol=scale)
        for w, force in enumerate(simulation.world.walls.force):
            np.testing.assert_allclose(found.force[found.wall == w].sum(axis=0), force, rtol=1e-5, atol=scale)
        seen += len(found.i)
    assert seen > 20


def test_normal_and_tangential_parts_make_up_the_force_at_the_contact_point(tmp_path: Path) -> None:
    simulation = loose_spheres(tmp_path)
    simulation.advance_to(300)
    found = find_contacts(simulation)
    assert (found.j >= 0).sum() > 3
    assert (found.j < 0).sum() > 3
    assert found.tangential_force.max() > 0.1 * found.normal_force.max()
    parts = np.hypot(found.normal_force, found.tangential_force)
    np.testing.assert_allclose(parts, np.linalg.norm(found.force, axis=1), rtol=1e-5)
    pose = simulation.world.particles.pose
    arm = found.position - pose[found.i, :3]
    reach = np.linalg.norm(arm, axis=1)
    assert (reach < pose[found.i, 3]).all()
    assert (reach > 0.98 * pose[found.i, 3]).all()
    along = (found.force * arm).sum(axis=1) / reach
    np.testing.assert_allclose(along, found.normal_force, rtol=1e-3, atol=1e-4 * found.normal_force.max())


def test_asking_twice_gives_the_same_and_leaves_everything_as_it_was(tmp_path: Path) -> None:
    one, other = loose_spheres(tmp_path), loose_spheres(tmp_path)
    for step in range(20, 401, 20):
        one.advance_to(step)
        for a, b in zip(find_contacts(one), find_contacts(one), strict=True):
            np.testing.assert_array_equal(a, b)
    other.advance_to(400)
    for a, b in zip(one.world.particles, other.world.particles, strict=True):
        np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(one.world.pairs.history, other.world.pairs.history)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run a bed of six grains that keeps what touches between them."""
    folder = tmp_path_factory.mktemp("bed")
    return run_scene(load(write(folder, bed())), folder / "run").folder


def test_a_run_with_contacts_is_to_the_bit_one_without(recorded: Path, tmp_path: Path) -> None:
    without = run_scene(load(write(tmp_path, bed(contacts="false"))), tmp_path / "run").folder
    assert not [name for name in arrays(without / "results.h5") if "contacts" in name]
    for name in ("results.h5", "checkpoint.h5"):
        a, b = arrays(recorded / name), arrays(without / name)
        assert {key for key in a if "contacts" not in key} == b.keys()
        assert [key for key in b if a[key] != b[key]] == []
    assert (recorded / "curves.csv").read_bytes() == (without / "curves.csv").read_bytes()


def test_contacts_of_frames_are_those_between_grains_and_at_walls(recorded: Path) -> None:
    with open_run(recorded) as run:
        counts = []
        for k in range(run.n_frames):
            found, frame = run.contacts(k), run.frame(k)
            assert found is not None
            counts.append(len(found.i))
            held = found.j >= 0
            assert (run.grain[found.i[held]] != run.grain[found.j[held]]).all()
            apart = np.linalg.norm(frame.position[found.i[held]] - frame.position[found.j[held]], axis=1)
            assert (apart < run.radius[found.i[held]] + run.radius[found.j[held]]).all()
            on_plate = found.wall == 0
            height = run.walls["upper"].points[0, 2] + frame.wall_displacement[0, 2]
            np.testing.assert_allclose(found.position[on_plate, 2], height, rtol=1e-5)
        assert counts[0] == 0
        assert counts[-1] > 20
        last = run.contacts(-1)
        assert last is not None
        # wall forces belong to the last force evaluation, half a step before the frame
        pushed = last.force[last.wall == 0, 2].sum()
        np.testing.assert_allclose(pushed, run.curves["force_upper_z_N"][-1], rtol=0.02)
        with pytest.raises(IndexError, match="frame 99"):
            run.contacts(99)


def test_contacts_inside_grains_come_on_request_and_survive_a_killed_run(tmp_path: Path) -> None:
    scene = write(tmp_path, bed(contacts="all"))
    assert run(scene, tmp_path / "whole").returncode == 0
    assert start_and_stop(scene, tmp_path / "killed", signal.SIGKILL) == -9
    resumed = run(scene, tmp_path / "killed", "--resume")
    assert resumed.returncode == 0, resumed.stderr
    assert_same_bytes(tmp_path / "whole", tmp_path / "killed")
    with open_run(tmp_path / "killed") as opened:
        found = opened.contacts(-1)
        assert found is not None
        held = found.j >= 0
        assert (opened.grain[found.i[held]] == opened.grain[found.j[held]]).sum() > 20

"""Periodic boxes: nothing is lost at their faces, nothing is drawn across them, and what cannot repeat is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from clast import export_run, load, open_run, run_scene
from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.engine.kernels.layout import X
from clast.errors import ConfigError, RunError
from clast.results import checkpoint
from clast.scene.compression import Gauge
from clast.scene.start import check_start
from clast.simulation import Simulation

SIDE = 10e-3
GLASS = {"glass": {"density": 2500, "young_modulus": "50 MPa", "poisson_ratio": 0.2}}
DOMAIN = {"lower": [0, 0, 0], "upper": [SIDE] * 3, "periodic": ["x", "y", "z"]}
MODEL = {
    "type": "elastic",
    "young_modulus": "50 MPa",
    "poisson_ratio": 0.2,
    "normal_strength": "1 GPa",
    "shear_strength": "1 GPa",
}


def scene(particles: list[dict[str, Any]] | dict[str, Any], **sections: Any) -> SceneConfig:
    """Return a scene of spheres of glass, or of what a generator makes, in a box that is periodic in all directions."""
    if isinstance(particles, list):
        particles = {"type": "explicit", "material": "glass", "particles": particles}
    return from_mapping(
        {
            "materials": GLASS,
            "particles": particles,
            "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 1.0}}},
            "boundaries": {"domain": DOMAIN},
            "time": {"step": "5 us", "end": {"time": "60 ms"}},
            "output": {"samples": 10, "frames": 10, "ledger": True, "writers": []},
        }
        | sections
    )


def gas() -> list[dict[str, Any]]:
    """Return 27 spheres that fly about."""
    draw = np.random.default_rng(3)
    places = (np.stack(np.meshgrid(*[range(3)] * 3, indexing="ij"), axis=-1).reshape(-1, 3) + 0.5) * SIDE / 3
    return [
        {"position": place.tolist(), "radius": 0.9e-3, "velocity": draw.uniform(-0.3, 0.3, 3).tolist()}
        for place in places
    ]


@pytest.fixture(scope="module")
def gas_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a run of the gas."""
    return run_scene(scene(gas()), tmp_path_factory.mktemp("periodic") / "gas").folder


def test_a_gas_keeps_momentum_and_energy(gas_run):
    with open_run(gas_run) as run:
        momentum = [run.frame(k).velocity.astype(float).sum(axis=0) for k in range(run.n_frames)]
        speed = np.abs(run.frame(0).velocity).sum()
        np.testing.assert_allclose(momentum, momentum[:1] * len(momentum), atol=1e-6 * speed)
        assert not np.allclose(run.frame(0).velocity, run.frame(-1).velocity, atol=0.1)
        assert abs(run.curves["energy_error_J"]).max() < 1e-3 * run.curves["energy_kinetic_J"][0]


def test_frames_tell_where_particles_are_and_how_far_they_went(gas_run):
    simulation = Simulation(scene(gas()))
    simulation.advance_to(simulation.last_step)
    with open_run(gas_run) as run:
        last = run.frame(-1)
    assert (last.position >= 0.0).all()
    assert (last.position <= np.float32(SIDE)).all()
    assert np.abs(last.image).max() >= 1
    went = simulation.world.particles.pose[:, X : X + 3]
    np.testing.assert_allclose(last.unwrapped, went, atol=1e-6 * SIDE)
    assert last.box.periodic.all()


def test_lammps_reads_where_the_box_is_and_how_often_each_particle_left_it(gas_run, tmp_path):
    folder = export_run(gas_run, "lammps", tmp_path / "lammps", frames="last")
    lines = (folder / "particles.dump").read_text().splitlines()
    assert "ITEM: BOX BOUNDS pp pp pp" in lines
    assert lines[lines.index("ITEM: BOX BOUNDS pp pp pp") + 1] == "0 0.01"
    rows = np.array([line.split() for line in lines[-27:]], float)
    with open_run(gas_run) as run:
        np.testing.assert_allclose(rows[:, 3:6] + SIDE * rows[:, -3:], run.frame(-1).unwrapped, atol=1e-6 * SIDE)


@pytest.fixture(scope="module")
def ring_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a run of twelve bonded spheres in a row without ends."""
    given = load("configs/verification/periodic_ring.yaml").changed(
        {"time.end.steps": 10, "output": {"frames": 2, "samples": 2, "writers": []}}
    )
    return run_scene(given, tmp_path_factory.mktemp("periodic") / "ring").folder


def test_no_bond_is_drawn_across_the_box(ring_run, tmp_path):
    with open_run(ring_run) as run:
        lines = run.frame(-1).lines(run.bond_ends)
    np.testing.assert_allclose(np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1), 1e-3, rtol=1e-4)
    with h5py.File(export_run(ring_run, "vtkhdf", tmp_path / "ring.vtkhdf", frames="last")) as file:
        assert len(file["VTKHDF/Lines/Connectivity"]) == 2 * 11


PAIR = [{"position": [1e-3, 5e-3, 5e-3], "radius": 1e-3}, {"position": [9e-3, 5e-3, 5e-3], "radius": 1e-3}]

PRESSED = {"domain": DOMAIN | {"strain_rate": [-2.0, 0, 1.0]}}
"""A box that becomes shorter along x, where lists must reach farther than they are made, and longer along z."""


def test_a_gas_that_is_compressed_takes_up_the_work_of_the_box():
    simulation = Simulation(scene(gas(), boundaries=PRESSED))
    simulation.advance_to(simulation.last_step)
    ledger = simulation.ledger()
    np.testing.assert_allclose(simulation.box.span, SIDE * np.exp([-2.0 * 0.06, 0.0, 0.06]), rtol=1e-4)
    assert ledger.box > 0.02 * ledger.start
    assert abs(ledger.closure) < 1e-3


def test_it_does_not_matter_when_neighbours_were_searched():
    often, seldom = (
        Simulation(scene(gas(), boundaries=PRESSED, neighbours={"skin": skin})) for skin in ("4 um", "auto")
    )
    for each in (often, seldom):
        each.advance_to(4000)
    assert often.lists.made > 10 * seldom.lists.made
    assert often.world.particles.pose.tobytes() == seldom.world.particles.pose.tobytes()


def test_a_resumed_run_goes_on_to_the_bit(tmp_path):
    whole, stopped, resumed = (Simulation(scene(gas(), boundaries=PRESSED)) for _ in range(3))
    stopped.advance_to(4000)
    checkpoint.save(tmp_path, stopped, {})
    checkpoint.load(tmp_path, resumed)
    for each in (whole, resumed):
        each.advance_to(whole.last_step)
    assert whole.world.particles.pose.tobytes() == resumed.world.particles.pose.tobytes()


def test_it_does_not_matter_where_the_faces_lie():
    moved = {"lower": [3e-3] * 3, "upper": [13e-3] * 3}
    middle = gas()
    for each in middle:  # the box is stretched about its middle: keep places and velocities against it
        each["position"] = [x + 3e-3 for x in each["position"]]
    here, there = (
        Simulation(scene(particles, boundaries={"domain": PRESSED["domain"] | changes}))
        for particles, changes in ((gas(), {}), (middle, moved))
    )
    for each in (here, there):
        each.advance_to(400)
    np.testing.assert_allclose(
        here.world.particles.twist, there.world.particles.twist, atol=1e-9 * np.abs(here.world.particles.twist).max()
    )


def test_a_box_that_shrinks_too_far_ends_the_run():
    domain = DOMAIN | {"upper": [4.7e-3, SIDE, SIDE], "strain_rate": [-20.0, 0, 0]}
    pair = [PAIR[0] | {"position": [1.2e-3, 5e-3, 5e-3]}, PAIR[0] | {"position": [3.5e-3, 5e-3, 5e-3]}]
    simulation = Simulation(scene(pair, boundaries={"domain": domain}))
    with pytest.raises(RunError, match="a side of the periodic box has become so short"):
        simulation.advance_to(simulation.last_step)


@pytest.mark.parametrize(
    ("section", "words"),
    [
        (
            {"damping": {"type": "local", "factor": 0.7}},
            "damping: it brakes velocities, which differ from image to image",
        ),
        (
            {
                "walls": {
                    "floor": {"type": "plane", "material": "glass", "point": [0, 0, 0], "normal": [0, 0, 1]},
                },
                "boundaries": {"domain": DOMAIN | {"periodic": ["x", "y"], "strain_rate": [1.0, 0, 0]}},
            },
            "walls.floor: walls are not stretched with the domain",
        ),
    ],
)
def test_what_does_not_go_with_a_box_that_is_stretched_is_refused(section, words):
    assert words in refusal(scene(PAIR, **({"boundaries": PRESSED} | section)))


def test_only_periodic_directions_can_be_stretched():
    with pytest.raises(ConfigError, match=r"strain_rate stretches the box along z, where it is not periodic"):
        scene(PAIR, boundaries={"domain": PRESSED["domain"] | {"periodic": ["x", "y"]}})


def refusal(given: SceneConfig) -> str:
    """Return why a scene is refused."""
    with pytest.raises(ConfigError) as refused:
        check_start(build_scene(given))
    return str(refused.value)


def test_a_side_too_short_for_its_particles_is_refused():
    domain = DOMAIN | {"lower": [0, 0, 3e-3], "upper": [SIDE, SIDE, 7.3e-3]}
    text = refusal(scene(PAIR, boundaries={"domain": domain}))
    assert "boundaries.domain" in text
    assert "a side of 0.0043 m along z is too short" in text
    assert "0.0044 m are the least" in text


def test_a_bond_that_could_go_either_way_is_refused():
    domain = DOMAIN | {"upper": [5e-3, SIDE, SIDE]}
    pair = [PAIR[0], PAIR[0] | {"position": [3.2e-3, 5e-3, 5e-3]}]
    bonds = {"between": {"max_gap": "0.3 mm"}, "model": MODEL}
    text = refusal(scene(pair, boundaries={"domain": domain}, bonds=bonds))
    assert "bond 0 of particles 0 and 1 spans 44% of a side of 0.005 m" in text
    assert "0.0055 m are the least" in text


@pytest.mark.parametrize(
    ("wall", "axis"),
    [
        ({"type": "plane", "point": [0, 0, 0], "normal": [1, 0, 0]}, "x"),
        ({"type": "sphere", "centre": [5e-3] * 3, "radius": 20e-3}, "x"),
        ({"type": "cylinder", "point": [5e-3, 5e-3, 0], "axis": [0, 0, 1], "radius": 20e-3}, "x"),
    ],
)
def test_a_wall_that_does_not_repeat_is_refused(wall, axis):
    text = refusal(scene(PAIR, walls={"odd": wall | {"material": "glass"}}))
    assert "walls.odd" in text
    assert f"the domain is periodic along {axis}" in text


def test_walls_along_the_periodic_directions_are_taken():
    domain = DOMAIN | {"periodic": ["x", "y"], "lower": [0, 0, -1e-3]}
    floor = {"type": "plane", "material": "glass", "point": [0, 0, 0], "normal": [0, 0, 1]}
    check_start(build_scene(scene(PAIR, boundaries={"domain": domain}, walls={"floor": floor})))


@pytest.mark.parametrize(
    ("force", "boundaries"),
    [
        ({"type": "rotating_frame", "spin": [0, 0, 10.0]}, {"domain": DOMAIN}),
        ({"type": "viscous_drag", "viscosity": "1e-3 Pa s"}, PRESSED),
    ],
)
def test_a_body_force_that_differs_from_image_to_image_is_refused(force, boundaries):
    text = refusal(scene(PAIR, boundaries=boundaries, body_forces=[force]))
    assert f"body_forces.0: '{force['type']}' is not the same in every image" in text


def test_a_drag_is_the_same_in_every_image_of_a_box_that_stays():
    check_start(build_scene(scene(PAIR, body_forces=[{"type": "viscous_drag", "viscosity": "1e-3 Pa s"}])))


def test_particles_may_begin_outside_and_overlap_across_a_face():
    apart = [PAIR[0] | {"position": [-29.2e-3, 5e-3, 5e-3]}, PAIR[1]]
    assert "overlaps particle 0 by 0.0002 m" in refusal(scene(apart))


@pytest.mark.parametrize(("order", "cells", "neighbours"), [("sc", 4, 6), ("fcc", 3, 12), ("hcp", 3, 12)])
def test_a_lattice_goes_on_across_the_faces(order, cells, neighbours):
    edge = {"sc": [1.0] * 3, "fcc": [2**0.5] * 3, "hcp": [1.0, 3**0.5, (8 / 3) ** 0.5]}[order]
    counts = [cells if e > 1.2 else 4 for e in edge]
    sides = [round(n * e * 1e-3, 9) for n, e in zip(counts, edge, strict=True)]
    domain = {"lower": [0.5e-3] * 3, "upper": [0.5e-3 + side for side in sides], "periodic": ["x", "y", "z"]}
    lattice = {"type": "lattice", "material": "glass", "lattice": order, "primary_diameter": "1 mm", "box": sides}
    bonds = {"between": {"max_gap": "0.1 mm"}, "model": MODEL}
    made = build_scene(scene(lattice, boundaries={"domain": domain}, bonds=bonds))
    assert (np.bincount(made.ends.ravel()) == neighbours).all()
    check_start(made)


def test_a_lattice_that_does_not_fit_its_periodic_box_is_told_the_right_size():
    lattice = {"type": "lattice", "material": "glass", "lattice": "sc", "primary_diameter": "0.9 mm", "box": [SIDE] * 3}
    text = refusal(scene(lattice))
    assert "particles.box.0" in text
    assert "make domain and box 0.0099 m long" in text


def test_a_stretched_box_ends_at_the_strain_of_the_side_that_is_strained_most():
    def last_step(strain: float, **changes: Any) -> int:
        time = {"step": "5 us", "end": {"strain": strain}}
        return Gauge(scene(PAIR, time=time, boundaries={"domain": PRESSED["domain"] | changes})).last_step(5e-6)

    assert last_step(0.12) == 12_000
    assert last_step(0.12, strain_measure="engineering") == 12_000
    assert last_step(1.5) == 150_000
    with pytest.raises(ConfigError, match=r"time.end.strain: a side that is pressed to the engineering strain 1.5 has"):
        last_step(1.5, strain_measure="engineering")
    with pytest.raises(ConfigError, match=r"time.end.strain: the box is not stretched, as all of boundaries.domain.s"):
        last_step(0.12, strain_rate=[0, 0, 0])
    with pytest.raises(ConfigError, match=r"a strain needs the section 'compression', .* or a periodic box that 'bou"):
        last_step(0.12, strain_rate=None)

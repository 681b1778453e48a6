"""Which particles can touch which walls: none that does is ever left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.scenes import write

from clast import load
from clast.building import build_scene
from clast.engine.wall_frames import WallFrames, at_start
from clast.scene.near_walls import near_walls
from clast.scene.plan import wall_shapes
from clast.scene.scene import Scene

WALLS = """
materials: {glass: {density: 1000, young_modulus: 1e8, poisson_ratio: 0.2}}
particles:
  type: from_file
  material: glass
  particles: p.csv
contacts: {law: hertz_mindlin, start_overlap: 1e9, pairs: {default: {restitution: 1}}}
walls:
  floor: {type: plane, material: glass, point: [0, 0, -0.03], normal: [0, 0.1, 1]}
  plate: {type: disc, material: glass, point: [0.01, 0, 0.02], normal: [0, 0, -1], radius: 0.02}
  tube: {type: cylinder, material: glass, point: [0, 0, 0], axis: [0, 0, 1], radius: 0.04}
time: {end: {steps: 1}}
"""


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    folder = tmp_path_factory.mktemp("walls")
    x = np.random.RandomState(1).uniform(-0.05, 0.05, (400, 3))
    r = np.random.RandomState(2).uniform(2e-4, 1e-3, 400)
    rows = (f"{k},{a},{b},{c},{s}" for k, ((a, b, c), s) in enumerate(zip(x.tolist(), r.tolist(), strict=True)))
    Path(folder, "p.csv").write_text("id,x,y,z,radius\n" + "\n".join(rows) + "\n")
    return build_scene(load(write(folder, WALLS)))


@settings(max_examples=20)
@given(st.tuples(*3 * [st.floats(-0.02, 0.02)]))
def test_every_particle_that_touches_a_wall_is_near_it(scene: Scene, moved: tuple[float, float, float]) -> None:
    displacement = np.array([moved, (0.0, 0.0, 0.0), moved])
    near = {
        tuple(row) for row in near_walls(scene, scene.position, WallFrames(displacement, np.zeros((3, 3)))).tolist()
    }
    for w, (nearest, shape) in enumerate(wall_shapes(scene)):
        for k, x in enumerate((scene.position - displacement[w]).tolist()):
            if nearest(shape, tuple(x)).distance < scene.radius[k]:
                assert (w, k) in near


def test_most_particles_are_not_asked_about(scene: Scene) -> None:
    assert len(near_walls(scene, scene.position, at_start(3))) < 0.5 * 3 * 400

"""Walls of triangles: where they are touched, what is refused, and that contacts go on after a resume."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.config.scene import load
from clast.engine.wall_feet import Feet, feet
from clast.errors import ConfigError, RunError
from clast.forecast import forecast
from clast.maths.vec3 import Vec
from clast.plugins.discovery import discover
from clast.results import checkpoint
from clast.verification.bench import Bench
from clast_plugins.walls.block import Block
from clast_plugins.walls.mesh import Mesh
from tests.scenes import CRUSH, stl_text, write

WALL = discover().get("wall", "mesh").part
BLOCK = discover().get("wall", "block").part
BOX = Block(lower=(-1.0, -2.0, -3.0), upper=(1.0, 2.0, 3.0))
places = st.tuples(*[st.floats(-6.0, 6.0)] * 3)


def box() -> Mesh:
    points, triangles = BLOCK.mesh(BOX, 1.0)
    return Mesh(triangles=points[triangles].tolist())


def touched(params: Mesh, x: Vec, reach: float) -> Feet:
    return feet(WALL, params, np.array([x]), np.array([reach]))


@settings(max_examples=60, deadline=None)
@given(places)
def test_a_box_is_touched_once_from_outside_where_a_block_is_and_from_inside_on_every_face(x: Vec) -> None:
    near = BLOCK.nearest(BLOCK.shape(BOX), x)
    if near.distance > 1e-6:
        found = touched(box(), x, near.distance + 1.0)  # no face of the other side is as near
        assert found.distance == pytest.approx([near.distance], rel=1e-9)
        assert found.normal[0] == pytest.approx(near.normal, abs=1e-9)
    elif near.distance < -0.02:  # a centre that is all but on a face is no sphere that touches another
        gaps = sorted(abs(c - side * h) for c, h in zip(x, (1.0, 2.0, 3.0), strict=True) for side in (-1, 1))
        assert sorted(touched(box(), x, 20.0).distance) == pytest.approx(gaps, rel=1e-9)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.floats(0.05, 0.95), st.floats(0.05, 0.95)), min_size=1, max_size=6), st.data())
def test_a_flat_face_is_touched_once_however_it_is_cut(corners: list[tuple[float, float]], data: st.DataObject) -> None:
    """Cut a square at random, tilt it, and ask above its inside, its cuts and its corners."""
    from scipy.spatial import Delaunay

    points = np.unique(np.round([(0, 0), (1, 0), (0, 1), (1, 1), *corners], 3), axis=0)
    cells = Delaunay(points).simplices
    turned = np.linalg.qr(np.array([[1.0, 2.0, 0.5], [-1.0, 0.3, 2.0], [0.2, 1.0, -3.0]]))[0]
    lifted = np.column_stack([points, np.zeros(len(points))]) @ turned
    params = Mesh(triangles=lifted[cells].astype(np.float32).astype(float).tolist())
    a, b = data.draw(st.tuples(st.sampled_from(range(len(points))), st.sampled_from(range(len(points)))))
    share = data.draw(st.sampled_from([0.0, 0.5, 0.31]))
    above = 0.1 * turned[2] + (1.0 - share) * lifted[a] + share * lifted[b]
    found = touched(params, tuple(above.tolist()), 0.11)
    assert found.distance == pytest.approx([0.1], rel=1e-5)
    assert abs(found.normal[0] @ turned[2]) == pytest.approx(1.0, abs=1e-5)


def test_of_more_places_than_there_are_contacts_the_deepest_count() -> None:
    few = box().model_copy(update={"contacts": 2})
    assert touched(few, (0.5, 0.1, 0.0), 20.0).distance == pytest.approx([0.5, 1.5])


def test_a_file_as_text_and_as_binary_is_the_same_surface(tmp_path: Path) -> None:
    triangles = np.array([[[0, 0, 0], [10, 0, 0], [0, 20, 0]], [[10, 0, 0], [10, 20, 5], [0, 20, 0]]], np.float32)
    rows = np.zeros(2, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]))
    rows["corners"] = triangles
    (tmp_path / "binary.stl").write_bytes(b" " * 80 + np.uint32(2).tobytes() + rows.tobytes())
    (tmp_path / "text.stl").write_text(stl_text(triangles.tolist()))
    found = [Mesh(file=tmp_path / name, unit="1 mm", origin=(0, 0, 1)) for name in ("binary.stl", "text.stl")]
    points, cells = WALL.mesh(found[0], 1.0)
    assert points[cells] == pytest.approx(1e-3 * triangles + [0, 0, 1])
    assert WALL.shape(found[0]).triangles.tolist() == WALL.shape(found[1]).triangles.tolist()


BARE = stl_text([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [1, 1, 1], [2, 2, 2]]])


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (None, "wall.stl: cannot be read: No such file or directory; check the path"),
        ("", "wall.stl: is no STL file, neither text nor binary; export it again"),
        ("name: not a surface\n" * 30, "cut off, or no STL file; export it again"),
        (BARE.replace("vertex 1 1 1", "vertex 1,0 1 1"), "wall.stl:12: 'vertex 1,0 1 1' is no corner"),
        (BARE[: BARE.index("vertex 2 2 2")], "wall.stl: tells of 2 triangles and holds 5 corners: cut off"),
        (BARE.replace("vertex 2 2 2", "vertex 2e39 2 2"), "triangle 1 has a corner that is no place"),
        (stl_text([[[0, 0, 0], [1, 1, 1], [2, 2, 2]]] * 2), "wall.stl: holds no triangle that has an area; export"),
    ],
)
def test_a_file_that_is_no_surface_is_refused_where_the_scene_names_it(
    tmp_path: Path, content: str | None, told: str, capfd: pytest.CaptureFixture[str]
) -> None:
    if content is not None:
        (tmp_path / "wall.stl").write_text(content)
    crush = write(tmp_path, CRUSH)
    with pytest.raises(ConfigError, match=told) as error:
        load(crush, ["walls.lower={type: mesh, material: steel, file: wall.stl, unit: 1 mm}"])
    assert "walls.lower" in str(error.value)
    assert capfd.readouterr().err == ""


def test_triangles_of_a_file_without_an_area_are_left_out_with_one_sentence(tmp_path: Path) -> None:
    whole = [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0], [0, 1, 0]]]
    point, line = [[5, 5, 5]] * 3, [[0, 0, 0], [1, 1, 1], [2, 2, 2]]
    (tmp_path / "whole.stl").write_text(stl_text(whole))
    (tmp_path / "wall.stl").write_text(stl_text([point, whole[0], line, whole[1]]))
    made, same = (Mesh(file=tmp_path / name, unit="1 mm") for name in ("wall.stl", "whole.stl"))
    assert all(np.array_equal(*each) for each in zip(WALL.shape(made), WALL.shape(same), strict=True))
    assert WALL.concerns(same) == ()
    wall = "walls.lower={type: mesh, material: steel, file: wall.stl, unit: 1 mm, origin: [0, 0, -5 mm]}"
    scene = load(write(tmp_path, CRUSH), [wall])
    told = "walls.lower: 2 of 4 triangles of the file have no area and are left out"
    assert [each for each in forecast(scene).concerns if told in each] == [f"--set {wall}: {told}"]
    with pytest.raises(ValueError, match=r"triangle 0, counted from 0, has no area; leave out what has none"):
        Mesh(triangles=[line, *whole])


@pytest.mark.parametrize(
    ("given_params", "told"),
    [
        ({}, "exactly one of file and triangles is needed; given neither"),
        ({"file": "a.stl"}, "a file needs a unit, such as '1 mm'"),
        ({"triangles": [], "unit": 1.0}, "a unit is that of a file"),
        ({"triangles": []}, "holds no triangle"),
    ],
)
def test_what_does_not_go_together_is_refused(given_params: dict[str, object], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        Mesh.model_validate(given_params)


def test_contacts_on_triangles_go_on_from_a_checkpoint_to_the_same_bytes(tmp_path: Path) -> None:
    bench = Bench("mesh")
    whole, half, resumed = (bench.start(threads=1) for _ in range(3))
    whole.advance_to(12_000)
    half.advance_to(7_000)
    assert half.world.wall_pairs.touching.sum() > 20
    checkpoint.save(tmp_path, half, {})
    checkpoint.load(tmp_path, resumed)
    resumed.advance_to(12_000)
    for (name, one), (_, other) in zip(checkpoint.state_arrays(whole), checkpoint.state_arrays(resumed), strict=True):
        assert one.tobytes() == other.tobytes(), name
    assert abs(whole.ledger().closure) < 1e-3


def test_a_particle_in_more_places_than_it_may_have_contacts_stops_the_run() -> None:
    simulation = Bench("mesh").start({"walls.funnel.contacts": 4}, threads=1)
    told = "touches walls.funnel in more than 4 places, and others would push nothing; raise walls.funnel.contacts"
    with pytest.raises(RunError, match=told):
        simulation.advance_to(12_000)

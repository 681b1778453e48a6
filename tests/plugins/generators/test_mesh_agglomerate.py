"""A closed surface of triangles as a room: its volume, who is inside, margins that are kept; grains that fill it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.scenes import stl_text

from clast.errors import ConfigError
from clast.parts.generator import Site
from clast.plugins.discovery import discover
from clast.scene.packing_report import overlaps
from clast.testing.kit import try_part
from clast_plugins.generators.mesh_agglomerate import MeshAgglomerate, body, generate, predict
from clast_plugins.generators.packing.closed_surface import ClosedSurface, closed
from clast_plugins.generators.packing.vessels import Box
from clast_plugins.walls.block import Block, mesh
from clast_plugins.walls.surface.inside import depths

HERE = Site(Path())
ROCK = Path(__file__).parents[3] / "configs" / "parts" / "generator" / "rock.stl"


def box_of_triangles(x: float, y: float, z: float) -> np.ndarray:
    points, triangles = mesh(Block(lower=(-x, -y, -z), upper=(x, y, z)), 1.0)
    return points[triangles]


def angle_of_triangles() -> np.ndarray:
    """Return the surface of a body like an L: a box of 2 x 2 x 1 less a quarter of it."""
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], float)
    cells = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]])
    low, high = (np.column_stack([outline, np.full(6, height)]) for height in (0.0, 1.0))
    after = np.roll(np.arange(6), -1)
    sides = [np.stack([low, low[after], high[after]], axis=1), np.stack([low, high[after], high], axis=1)]
    return np.concatenate([low[cells[:, ::-1]], high[cells], *sides])


def depth_in_angle(position: np.ndarray) -> np.ndarray:
    """Return the depth of points in the body like an L, below 0 outside: by its outer and its inner faces."""
    x, y, z = position.T
    outer = np.minimum.reduce([x, y, z, 2.0 - x, 2.0 - y, 1.0 - z])
    corner = np.where((x < 1.0) & (y < 1.0), np.hypot(1.0 - x, 1.0 - y), np.maximum(1.0 - x, 1.0 - y))
    return np.minimum(outer, corner)


def grain(**changes: Any) -> MeshAgglomerate:
    asked = {"material": "glass", "file": ROCK, "diameter": 8.0, "primary_diameter": 1.0, "porosity": 0.5}
    return MeshAgglomerate.model_validate(asked | changes)


def test_it_keeps_to_what_holds_for_every_generator() -> None:
    part = discover().get("generator", "mesh_agglomerate")
    assert [each for each in try_part(part) if not each.passed] == []


def test_volume_surface_and_largest_sphere_of_a_box_of_triangles_are_those_of_a_box() -> None:
    room, same = ClosedSurface(box_of_triangles(3.0, 2.0, 1.0)), Box(3.0, 2.0, 1.0)
    assert (room.volume, room.surface) == (pytest.approx(same.volume), pytest.approx(same.surface))
    assert room.inradius == pytest.approx(1.0, rel=1e-3)
    assert room.per(2.0).volume == pytest.approx(same.volume / 8.0)
    x, margin = np.random.default_rng(1).uniform(-4.0, 4.0, (300, 3)), np.random.default_rng(2).uniform(0.0, 0.9, 300)
    np.testing.assert_allclose(room.confine(x, margin), same.confine(x, margin), atol=1e-9)


def test_the_middle_of_a_surface_comes_to_the_origin_whichever_way_it_turns() -> None:
    shifted = angle_of_triangles() + np.array([5.0, -7.0, 1.0])
    for triangles in (shifted, shifted[:, ::-1]):
        about = closed(triangles, "it ")
        assert ClosedSurface(about).volume == pytest.approx(3.0)
        assert about.min(axis=(0, 1)) == pytest.approx([-5.0 / 6.0, -5.0 / 6.0, -0.5])


def test_in_a_body_that_is_not_convex_depths_are_right_and_margins_are_kept() -> None:
    room, dice = ClosedSurface(angle_of_triangles()), np.random.default_rng(3)
    x = dice.uniform(-0.5, 2.5, (1000, 3))
    expected = depth_in_angle(x)
    found = depths(room._surface, x)
    np.testing.assert_allclose(found[expected > 0.0], expected[expected > 0.0], atol=1e-12)
    assert (found[expected < 0.0] < 0.0).all()
    margin = dice.uniform(0.01, 0.45, 1000)
    moved = room.confine(x, margin)
    assert (depth_in_angle(moved) >= margin - 1e-9).all()
    np.testing.assert_array_equal(moved[expected >= margin], x[expected >= margin])


def test_a_centre_without_a_way_to_its_margin_goes_to_the_nearest_place_that_has_it() -> None:
    """Two rooms, and between them a neck that is too narrow: there a centre is sent from side to side."""
    neck = np.array(
        [[0, 0], [2, 0], [2, 0.9], [4, 0.9], [4, 0], [6, 0], [6, 2], [4, 2], [4, 1.1], [2, 1.1], [2, 2], [0, 2]], float
    )
    cells = np.array(
        [
            [0, 1, 2],
            [0, 2, 9],
            [0, 9, 11],
            [9, 10, 11],
            [2, 3, 8],
            [2, 8, 9],
            [3, 4, 5],
            [3, 5, 6],
            [3, 6, 8],
            [6, 7, 8],
        ]
    )
    low, high = (np.column_stack([neck, np.full(12, height)]) for height in (0.0, 2.0))
    after = np.roll(np.arange(12), -1)
    sides = [np.stack([low, low[after], high[after]], axis=1), np.stack([low, high[after], high], axis=1)]
    room = ClosedSurface(closed(np.concatenate([low[cells[:, ::-1]], high[cells], *sides]), "it "))
    moved = room.confine(np.array([[0.4, 0.01, 0.0]]), np.array([0.5]))
    assert depths(room._surface, moved)[0] >= 0.5
    assert 1.4 < moved[0, 0] < 1.9


def test_a_grain_fills_its_surface_as_asked_for() -> None:
    made = generate(grain(primary_deviation=0.2), HERE)
    room = body(grain()).room
    assert isinstance(room, ClosedSurface)
    assert room.volume == pytest.approx(np.pi / 6.0 * 8.0**3)
    assert len(made.radius) == 256
    assert made.report["porosity_reached"] == pytest.approx(0.5, abs=1e-12)
    assert (depths(room._surface, made.position) >= made.radius * (1.0 - 1e-9)).all()
    assert overlaps(made.position, made.radius).largest <= 1e-4 * 2.0 * made.radius.min()


BOX = box_of_triangles(1.0, 1.0, 1.0).tolist()


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"file": None}, "exactly one of file and triangles is needed; given neither"),
        ({"unit": 1.0}, "does not tell lengths: exactly one of diameter and unit is needed; given both"),
        ({"file": None, "triangles": BOX[1:]}, "the surface is not closed: 3 of 18 edges"),
        ({"file": None, "triangles": [*BOX[1:], BOX[0][::-1]]}, "has triangles that do not all turn the same way"),
    ],
)
def test_what_is_no_body_is_refused(changes: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        grain(**changes)


def test_primaries_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ConfigError, match=r"the largest primary, 7000 mm, does not fit into a body of .* mm x"):
        generate(grain(primary_diameter=7.0, primaries=1, porosity=None), HERE)


def test_triangles_without_an_area_are_left_out_unless_the_surface_needs_them(tmp_path: Path) -> None:
    a, b, c = BOX[0]
    flat = [[a, b, a], [a, a, a]]
    amid = np.mean([b, c], axis=0).tolist()
    (tmp_path / "box.stl").write_text(stl_text([*BOX, *flat]))
    params = grain(file=tmp_path / "box.stl")
    assert predict(params, HERE, None).concerns == ("2 of 14 triangles of the file have no area and are left out",)
    assert body(params).room.volume == pytest.approx(np.pi / 6.0 * 8.0**3)
    (tmp_path / "seam.stl").write_text(stl_text([[a, b, amid], [a, amid, c], [b, c, amid], *BOX[1:]]))
    with pytest.raises(ValueError, match=r"1 of 14 triangles of the file has no area and is left out; the surface is"):
        grain(file=tmp_path / "seam.stl")


def test_a_body_may_have_hollows_but_separate_bodies_are_refused() -> None:
    outer, inner = box_of_triangles(3.0, 2.0, 1.0), box_of_triangles(0.5, 0.5, 0.5)
    hollow = ClosedSurface(closed(np.concatenate([inner[:, ::-1], outer]), "it "))
    assert hollow.volume == pytest.approx(48.0 - 1.0)
    assert depths(hollow._surface, np.array([[0.0, 0.0, 0.0], [0.75, 0.0, 0.0]])) == pytest.approx([-0.5, 0.25])
    away = np.array([9.0, 0.0, 0.0])
    for pieces in ([outer, inner], [outer, inner + away], [outer, inner[:, ::-1] + away], [outer, outer + away]):
        for turned in (1, -1):
            with pytest.raises(ConfigError, match="it is that of 2 separate bodies, and a grain is one"):
                closed(np.concatenate(pieces)[:, ::turned], "it ")

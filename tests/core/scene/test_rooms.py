"""Walls held against the room that a generator fills: what stands in it is refused, what is missing is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from clast import load
from clast.building import generated
from clast.config.scene import SceneConfig, from_mapping
from clast.errors import ConfigError
from clast.forecast import forecast
from clast.scene.foretold import foretold
from clast.scene.rooms import open_faces

SCENE = Path(__file__).parents[3] / "configs" / "oedometer_small.yaml"


def small(*changes: str) -> SceneConfig:
    return load(SCENE, changes)


def told(config: SceneConfig) -> list[str]:
    chosen = config.generators[0]
    return open_faces(config, chosen, foretold(config, chosen))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ("walls.piston.point=[0, 0, 6 mm]", "walls.piston: this wall reaches 2.4 mm into the room"),
        ("walls.bottom.point=[0, 0, 1 mm]", "walls.bottom: this wall reaches 1 mm into the room"),
        ("walls.bottom.normal=[0, 0, -1]", "walls.bottom: this wall reaches 8.4 mm into the room"),
        ("walls.tube.radius=6 mm", "walls.tube: this wall reaches 1 mm into the room"),
        ("walls.tube.point=[1 mm, 0, 0]", "walls.tube: this wall reaches 1 mm into the room"),
        ("particles.base=[0, 0, 0.5 mm]", "walls.piston: this wall reaches 0.5 mm into the room"),
    ],
)
def test_a_wall_in_the_room_is_refused_before_anything_is_packed(change: str, sentence: str) -> None:
    config = small(change)
    for refusing in (forecast, lambda config: generated(config, config.generators[0])):
        with pytest.raises(ConfigError) as error:
            refusing(config)
        assert sentence in str(error.value)
        assert "a tube 14 mm wide from (0, 0, " in str(error.value)


@pytest.mark.parametrize("change", ["particles.height=4 mm", "particles.fractions.small.grains=800000"])
def test_more_than_fits_is_refused_by_a_run_as_by_a_check(change: str) -> None:
    config = small(change)
    with pytest.raises(ConfigError, match=r"particles.height: the grains would fill \d+% of the room"):
        generated(config, config.generators[0])


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            ("walls.tube.radius=8 mm", "compression.diameter=16 mm"),
            "no wall stands at its side: the nearest is 1 mm from",
        ),
        (("walls.bottom.type=disc", "walls.bottom.radius=5 mm"), "no wall stands at its bottom: the nearest is "),
        (
            ("walls.bottom.point=[0, 0, -1 mm]", "compression.height=9.4 mm"),
            "no wall stands at its bottom: the nearest is 1 mm from",
        ),
    ],
)
def test_a_face_without_a_wall_is_told_by_a_check(changes: tuple[str, ...], sentence: str) -> None:
    concern, *_ = forecast(small(*changes)).concerns
    assert "oedometer_small.yaml" in concern
    assert "particles: fills a tube 14 mm wide" in concern
    assert sentence in concern


def without(*names: str) -> SceneConfig:
    data: dict[str, Any] = load(SCENE).resolved()
    data["walls"] = {name: wall for name, wall in data["walls"].items() if name not in names}
    del data["compression"]
    data["time"]["end"] = {"steps": 1}
    return from_mapping(data)


@pytest.mark.parametrize(
    ("names", "sentence"),
    [
        (("bottom",), "no wall stands at its bottom: the nearest"),
        (("tube",), "no wall stands at its side: the nearest"),
        (("piston", "bottom", "tube"), "no wall stands at its bottom and its side. Particles will leave there"),
    ],
)
def test_a_fill_without_a_wall_is_told_of(names: tuple[str, ...], sentence: str) -> None:
    (concern,) = told(without(*names))
    assert sentence in concern


def test_walls_that_match_and_open_tops_are_not_talked_about() -> None:
    assert told(small()) == []
    assert told(without("piston")) == []
    domain = {"lower": [-1.0, -1.0, -1.0], "upper": [1.0, 1.0, 1.0]}
    assert told(without("tube").changed({"boundaries.domain": domain})) == []


def box(*left_out: str) -> SceneConfig:
    data: dict[str, Any] = without("tube", "piston").resolved()
    data["particles"] |= {"diameter": None, "width": 12e-3, "depth": 14e-3, "height": None}
    sides = {"left": (-1, 0, 6e-3), "right": (1, 0, 6e-3), "front": (-1, 1, 7e-3), "back": (1, 1, 7e-3)}
    for name, (sign, axis, half) in sides.items():
        point, normal = [0.0] * 3, [0.0] * 3
        point[axis], normal[axis] = sign * half, -float(sign)
        if name not in left_out:
            data["walls"][name] = {"type": "plane", "material": "steel", "point": point, "normal": normal}
    return from_mapping(data)


def test_a_box_has_four_sides() -> None:
    assert told(box()) == []
    (concern,) = told(box("left", "back"))
    assert "a box 12 by 14 mm wide" in concern
    assert "no wall stands at its left side and its back side: the nearest" in concern


def test_a_fill_as_high_as_it_lies_cannot_lie_where_less_than_its_grains_would_fit() -> None:
    """Its grains as spheres fill no more than three quarters of 3.3 mm: a lid there is refused, one above is not."""
    lid = {"type": "plane", "material": "steel", "normal": [0, 0, -1]}
    open_top = without("piston").changed({"particles.height": None})
    foretold(high := open_top.changed({"walls.lid": lid | {"point": [0, 0, 8e-3]}}), high.generators[0])
    with pytest.raises(ConfigError, match=r"walls.lid: this wall reaches"):
        foretold(low := open_top.changed({"walls.lid": lid | {"point": [0, 0, 3e-3]}}), low.generators[0])

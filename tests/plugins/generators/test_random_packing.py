"""Loose spheres: as many as asked for, wholly in their box or tube, and none overlapping another."""

from __future__ import annotations

from math import inf, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.errors import ConfigError, PackingError
from clast.parts.generator import Gaps, Packing, Site
from clast.plugins.discovery import discover
from clast.scene.bonding import bond_neighbours
from clast.scene.packing_report import overlaps
from clast.testing.kit import try_part
from clast_plugins.generators.packing.vessels import Box, Tube
from clast_plugins.generators.random_packing import RandomPacking, generate, predict

HERE = Site(Path())
BOX: dict[str, Any] = {"box": [5.0, 6.0, 7.0]}
TUBE: dict[str, Any] = {"diameter": 6.0, "height": 8.0}
in_each = pytest.mark.parametrize("room", [BOX, TUBE], ids=["box", "tube"])


def params(**given_: Any) -> RandomPacking:
    return RandomPacking.model_validate({"material": "glass", "primary_diameter": 1.0} | given_)


def sticks_out(room: dict[str, Any], made: Packing) -> float:
    """Return how far the farthest sphere sticks out, in m."""
    x, r = made.position, made.radius
    if "box" in room:
        return float((np.abs(x) + r[:, None] - 0.5 * np.array(room["box"])).max())
    side = np.hypot(x[:, 0], x[:, 1]) + r - 0.5 * room["diameter"]
    return float(max(side.max(), (np.abs(x[:, 2]) + r).max() - 0.5 * room["height"]))


def test_it_keeps_to_what_holds_for_every_generator() -> None:
    assert [each for each in try_part(discover().get("generator", "random_packing")) if not each.passed] == []


@in_each
@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 2**32), deviation=st.sampled_from([0.0, 0.1, 0.3]), porosity=st.floats(0.55, 0.9))
def test_spheres_lie_inside_without_overlap(room: dict, seed: int, deviation: float, porosity: float) -> None:
    made = generate(params(**room, porosity=porosity, primary_deviation=deviation, seed=seed), HERE)
    assert sticks_out(room, made) <= 1e-12
    assert overlaps(made.position, made.radius).largest <= 1e-4 * 2.0 * made.radius.min()
    assert (made.grain == -1).all()


@in_each
def test_the_porosity_is_that_of_the_room(room: dict) -> None:
    volume = 210.0 if "box" in room else pi * 9.0 * 8.0
    made = generate(params(**room, porosity=0.6), HERE)
    assert len(made.radius) == int(0.4 * volume / (pi / 6.0))
    free = 1.0 - len(made.radius) * pi / 6.0 / volume
    assert made.report["porosity_reached"] == pytest.approx(free, rel=1e-12) == pytest.approx(0.6, abs=0.003)


def test_the_size_follows_from_number_and_porosity() -> None:
    made = generate(params(**BOX, primary_diameter=None, primaries=50, porosity=0.7, primary_deviation=0.2), HERE)
    assert len(made.radius) == 50
    assert made.report["porosity_reached"] == pytest.approx(0.7, abs=1e-12)


@in_each
def test_places_start_uniform(room: dict) -> None:
    shape = Box(2.5, 3.0, 3.5) if "box" in room else Tube(3.0, 4.0)
    points = shape.random(np.random.Philox(3), 20_000, 0.5)
    free = [2.0, 2.5, 3.0] if "box" in room else [2.5, 2.5, 3.5]
    second = [f**2 / (3.0 if "box" in room or k == 2 else 4.0) for k, f in enumerate(free)]
    np.testing.assert_allclose((points**2).mean(axis=0), second, rtol=0.03)
    assert np.abs(points.mean(axis=0)).max() < 0.06


@in_each
def test_near_ones_are_counted_beforehand_where_the_scene_bonds_them(room: dict) -> None:
    asked = params(**room, porosity=0.6, primary_deviation=0.1)
    made, told = generate(asked, HERE), predict(asked, HERE, Gaps(-inf, 0.5)).bonds
    assert told is not None
    assert told.value == pytest.approx(len(bond_neighbours(made.position, made.radius, 0.5).ends), rel=told.band)
    none = predict(asked, HERE, None).bonds
    assert none is not None
    assert none.value == 0.0


def test_the_centre_only_moves_the_packing() -> None:
    here, there = (generate(params(**TUBE, porosity=0.8, centre=c), HERE) for c in ([0, 0, 0], [1.0, 2.0, 3.0]))
    np.testing.assert_allclose(there.position - [1.0, 2.0, 3.0], here.position, atol=1e-12)


@pytest.mark.parametrize(
    ("given_", "problem"),
    [
        ({}, "either 'box', or 'diameter' and 'height'"),
        ({**BOX, **TUBE}, "either 'box', or 'diameter' and 'height'"),
        ({"diameter": 3.0}, "either 'box', or 'diameter' and 'height'"),
        ({"box": [1.0, 0.0, 1.0]}, "every edge of 'box' must be above 0"),
        ({**BOX, "primary_diameter": 1e-9}, "check the diameters and their units"),
    ],
)
def test_a_room_that_makes_no_sense_is_refused(given_: dict, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        params(**given_, porosity=0.6)


@pytest.mark.parametrize(
    ("given_", "error", "problem"),
    [
        ({**BOX, "porosity": 0.2}, ConfigError, r"denser than any random packing: 320 primaries .* 66%"),
        (
            {"box": [9.0, 9.0, 0.9], "porosity": 0.6},
            ConfigError,
            "the largest primary, 1000 mm, does not fit into a box",
        ),
        ({"box": [2.1, 2.1, 2.1], "porosity": 0.37}, PackingError, "too dense for a random packing: 11 primaries"),
    ],
)
def test_what_has_no_room_is_refused(given_: dict, error: type[Exception], problem: str) -> None:
    with pytest.raises(error, match=problem):
        generate(params(**given_), HERE)
    if error is ConfigError:
        with pytest.raises(error, match=problem):
            predict(params(**given_), HERE, None)

"""An ellipsoid as a room: the nearest point of its surface, margins that are kept, and a grain that fills it."""

from __future__ import annotations

from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.errors import ConfigError
from clast.parts.generator import Gaps, Site
from clast.plugins.discovery import discover
from clast.scene.bonding import bond_neighbours
from clast.scene.packing_report import overlaps
from clast.testing.kit import try_part
from clast_plugins.generators.ellipsoidal_agglomerate import EllipsoidalAgglomerate, generate, predict
from clast_plugins.generators.packing.ellipsoid import Ellipsoid, nearest
from clast_plugins.generators.packing.room import CutBall

HERE = Site(Path())
axes = st.tuples(*[st.floats(1.0, 10.0)] * 3)
seeds = st.integers(0, 2**32)


def grain(**changes: Any) -> EllipsoidalAgglomerate:
    asked = {"material": "glass", "semi_axes": [5.0, 4.0, 3.0], "primary_diameter": 1.0, "porosity": 0.5}
    return EllipsoidalAgglomerate.model_validate(asked | changes)


def margins(room: Ellipsoid, position: np.ndarray) -> np.ndarray:
    """Return the distance from the surface of points inside."""
    assert (((position / np.array(room)) ** 2).sum(axis=1) <= 1.0).all()
    return np.linalg.norm(position - nearest(np.array(room), position), axis=1)


def test_it_keeps_to_what_holds_for_every_generator() -> None:
    part = discover().get("generator", "ellipsoidal_agglomerate")
    assert [each for each in try_part(part) if not each.passed] == []


@settings(max_examples=25, deadline=None)
@given(semi_axes=axes, seed=seeds)
def test_the_nearest_point_is_on_the_surface_below_the_point_along_its_normal(semi_axes: tuple, seed: int) -> None:
    a = np.array(semi_axes)
    x = np.random.default_rng(seed).uniform(-1.5, 1.5, (40, 3)) * a
    x[0] = x[1, 0] = x[2, 1:] = 0.0
    y = nearest(a, x)
    np.testing.assert_allclose(((y / a) ** 2).sum(axis=1), 1.0, rtol=1e-12)
    turned = np.cross(x - y, y / a**2)
    assert np.abs(turned).max() <= 1e-7 * np.abs(x - y).max()
    trial = np.random.default_rng(seed).normal(size=(2000, 3))
    trial *= a / np.linalg.norm(trial, axis=1)[:, None]
    far = np.linalg.norm(x[:, None] - trial, axis=2).min(axis=1)
    assert (np.linalg.norm(x - y, axis=1) <= far + 1e-8 * a.max()).all()


@settings(max_examples=25, deadline=None)
@given(semi_axes=axes, seed=seeds, deepest=st.floats(0.1, 1.0))
def test_confined_centres_keep_their_margin_and_free_ones_stay(semi_axes: tuple, seed: int, deepest: float) -> None:
    room, dice = Ellipsoid(*semi_axes), np.random.default_rng(seed)
    x = dice.uniform(-1.3, 1.3, (60, 3)) * np.array(semi_axes)
    margin = dice.uniform(0.01, deepest, 60) * room.inradius
    moved = room.confine(x, margin)
    assert (margins(room, moved) >= margin * (1.0 - 1e-9) - 1e-12).all()
    inside = ((x / np.array(room)) ** 2).sum(axis=1) <= 1.0
    free = inside & (np.linalg.norm(x - nearest(np.array(room), x), axis=1) >= margin)
    np.testing.assert_array_equal(moved[free], x[free])


def test_with_equal_axes_it_confines_as_a_ball_does() -> None:
    x = np.random.default_rng(1).uniform(-3.0, 3.0, (200, 3))
    margin = np.full(200, 0.5)
    np.testing.assert_allclose(Ellipsoid(2.0, 2.0, 2.0).confine(x, margin), CutBall(2.0).confine(x, margin), atol=1e-9)


def test_random_points_keep_their_margin() -> None:
    room = Ellipsoid(3.0, 2.0, 1.0)
    assert margins(room, room.random(np.random.Philox(1), 500, 0.4)).min() >= 0.4 * (1.0 - 1e-12)


@pytest.mark.parametrize("deviation", [0.0, 0.2])
def test_a_grain_fills_its_ellipsoid_as_asked_for(deviation: float) -> None:
    made = generate(grain(primary_deviation=deviation), HERE)
    assert len(made.radius) == 240
    assert made.report["porosity_reached"] == pytest.approx(0.5, abs=1e-12)
    assert (margins(Ellipsoid(5.0, 4.0, 3.0), made.position) >= made.radius * (1.0 - 1e-9)).all()
    assert overlaps(made.position, made.radius).largest <= 1e-4 * 2.0 * made.radius.min()
    reach = (np.abs(made.position) + made.radius[:, None]).max(axis=0)
    assert (reach > 0.93 * np.array([5.0, 4.0, 3.0])).all()


def test_its_bonds_are_foretold() -> None:
    made, told = generate(grain(), HERE), predict(grain(), HERE, Gaps(-inf, 0.5)).bonds
    assert told is not None
    assert told.value == pytest.approx(len(bond_neighbours(made.position, made.radius, 0.5).ends), rel=told.band)


def test_pores_lie_inside() -> None:
    made = generate(grain(macro_pores={"count": 3, "diameter": 1.6}), HERE)
    assert len(made.radius) < 240


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"semi_axes": [1.0, 0.0, 1.0]}, "must be above 0"),
        ({"semi_axes": [11.0, 1.0, 1.0]}, "at most 1 to 10"),
        ({"semi_axes": [3.0, 2.0, 0.4]}, "does not fit into 800 mm"),
        ({"macro_pores": {"count": 1, "diameter": 6.5}}, "does not fit into a grain of"),
    ],
)
def test_an_ellipsoid_that_makes_no_sense_is_refused(changes: dict, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        grain(**changes)


def test_too_many_primaries_are_refused_before_packing() -> None:
    with pytest.raises(ConfigError, match=r"denser than any random packing: 384 primaries .* an ellipsoid"):
        predict(grain(porosity=0.2), HERE, None)

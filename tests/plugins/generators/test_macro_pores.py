"""Macro-pores: voids in their grain, what they leave, what is told of them beforehand and after."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from clast import load
from clast.building import build_scene
from clast.commands.build_report import report
from clast.config.scene import SceneConfig
from clast.errors import ConfigError, PackingError
from clast.forecast import forecast
from clast.parts.generator import Packing, Site
from clast.scene.packing_report import cut_sphere_volume, porosity, sphere_volume
from clast_plugins.generators import flattened_agglomerate, spherical_agglomerate
from clast_plugins.generators.flattened_agglomerate import FlattenedAgglomerate
from clast_plugins.generators.packing.macro_pores import MacroPores, Voids, carve, make_voids
from clast_plugins.generators.packing.room import CutBall
from clast_plugins.generators.spherical_agglomerate import SphericalAgglomerate

HERE = Site(Path())
CONFIGS = Path(__file__).parents[3] / "configs"
GRAIN = CutBall(1.0, 0.8)
VOLUME = cut_sphere_volume(2.0, 1.6)


def sphere(pores: dict[str, Any] | None, **changes: Any) -> SphericalAgglomerate:
    given: dict[str, Any] = {"material": "glass", "diameter": "1.6 mm", "primary_diameter": "0.2 mm", "porosity": 0.45}
    return SphericalAgglomerate.model_validate(given | changes | ({} if pores is None else {"macro_pores": pores}))


def packed(pores: dict[str, Any] | None, **changes: Any) -> Packing:
    return spherical_agglomerate.generate(sphere(pores, **changes), HERE)


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(1, 8),
    mean=st.floats(0.1, 0.35),
    spread=st.floats(0.01, 0.3),
    wall=st.floats(0.0, 0.05),
)
def test_pores_lie_inside_the_grain_with_walls_between_them(
    seed: int, count: int, mean: float, spread: float, wall: float
) -> None:
    sizes = {"mean": mean, "deviation": spread * mean}
    voids = make_voids(MacroPores(count=count, diameter=sizes, wall=wall, seed=seed), GRAIN)  # type: ignore[arg-type]
    radius = 0.5 * voids.diameter
    assert len(radius) == count
    assert (np.linalg.norm(voids.centre, axis=1) + radius + wall).max() <= 1.0 + 1e-12
    assert (np.abs(voids.centre[:, 2]) + radius + wall).max() <= 0.8 + 1e-12
    way = np.linalg.norm(voids.centre[:, None] - voids.centre, axis=2) + 9.0 * np.eye(count)
    assert (way - radius[:, None] - radius).min() >= wall - 1e-12


def test_diameters_have_the_mean_and_deviation_asked_for() -> None:
    pores = MacroPores(count=400, diameter={"mean": 0.02, "deviation": 0.005}, seed=3)  # type: ignore[arg-type]
    found = make_voids(pores, GRAIN).diameter
    assert found.mean() == pytest.approx(0.02, abs=4 * 0.005 / math.sqrt(400))
    assert found.std() == pytest.approx(0.005, rel=0.2)


def test_places_are_uniform_in_the_grain() -> None:
    pores = [MacroPores(count=1, diameter=0.2, seed=seed) for seed in range(400)]
    centres = [make_voids(each, CutBall(1.0)).centre[0] for each in pores]
    share = (np.linalg.norm(centres, axis=1) / 0.9) ** 3  # uniform from 0 to 1
    assert np.mean(share) == pytest.approx(0.5, abs=4 / math.sqrt(12 * 400))
    assert np.abs(np.mean(centres, axis=0)).max() < 4 * 0.9 * math.sqrt(0.2 / 400)


@settings(max_examples=30, deadline=None)
@given(share=st.floats(0.02, 0.15), seed=st.integers(0, 1000))
def test_as_many_pores_are_made_as_come_nearest_to_the_share(share: float, seed: int) -> None:
    sizes = {"mean": 0.25, "deviation": 0.05}
    voids = make_voids(MacroPores(porosity=share, diameter=sizes, seed=seed), GRAIN)  # type: ignore[arg-type]
    assert abs(voids.volume - share * VOLUME) <= 0.5 * sphere_volume(voids.diameter.max()) * (1 + 1e-9)


def test_the_same_seed_gives_the_same_bytes_and_another_one_another_grain() -> None:
    pores = {"count": 3, "diameter": {"mean": "0.4 mm", "deviation": "0.1 mm"}, "seed": 3}
    first, again, other = packed(pores), packed(pores), packed(pores | {"seed": 4})
    assert first.position.tobytes() == again.position.tobytes()
    assert first.report == again.report
    assert first.position.tobytes() != other.position.tobytes()


def test_exactly_the_primaries_whose_centres_lie_in_a_pore_are_left_out() -> None:
    whole = packed(None)
    grain = packed({"count": 3, "diameter": "0.5 mm", "seed": 3})
    voids = make_voids(MacroPores(count=3, diameter=0.5e-3, seed=3), CutBall(0.8e-3))
    inside = (np.linalg.norm(whole.position[:, None] - voids.centre, axis=2) < 0.25e-3).any(axis=1)
    assert inside.sum() > 10
    np.testing.assert_array_equal(grain.position, whole.position[~inside])


def test_the_report_tells_pores_and_what_they_leave() -> None:
    grain = packed({"porosity": 0.12, "diameter": "0.5 mm"})
    told = grain.report
    assert told["primaries_packed"] == 281
    assert told["primaries"] == len(grain.radius) == 281 - told["primaries_in_macro_pores"] - told["primaries_loose"]
    assert told["macro_pores"] == 4
    assert told["macro_pore_mean_diameter_m"] == pytest.approx(0.5e-3)
    assert told["macro_pore_share"] == pytest.approx(4 * (0.5 / 1.6) ** 3)
    assert told["porosity_asked"] == 0.45
    assert told["porosity_reached"] == pytest.approx(porosity(grain.radius, sphere_volume(1.6e-3)))
    assert float(told["porosity_reached"]) > 0.5


def test_the_centre_moves_pores_with_the_grain() -> None:
    pores = {"count": 2, "diameter": "0.5 mm"}
    here, there = packed(pores), packed(pores, centre=["3 mm", 0, 0])
    np.testing.assert_allclose(there.position - [3e-3, 0, 0], here.position, atol=1e-17)


def test_a_flattened_grain_has_its_pores_between_the_plates() -> None:
    params = FlattenedAgglomerate.model_validate(
        {
            "material": "glass",
            "volume_diameter": "1.8 mm",
            "height": "1.2 mm",
            "primary_diameter": "0.2 mm",
            "porosity": 0.6,
            "macro_pores": {"porosity": 0.1, "diameter": "0.4 mm"},
        }
    )
    told = flattened_agglomerate.generate(params, HERE).report
    share = float(told["macro_pores"]) * sphere_volume(0.4e-3) / cut_sphere_volume(1.8e-3, 1.2e-3)
    assert told["macro_pore_share"] == pytest.approx(share) == pytest.approx(0.1, abs=0.01)


def test_what_hangs_on_nothing_falls_off_and_is_counted() -> None:
    row = np.column_stack([np.arange(60) * 1.2, np.zeros(60), np.zeros(60)])
    carved = carve(Voids(np.array([[2.4, 0.0, 0.0]]), np.array([2.0])), row, np.full(60, 0.5))
    assert np.flatnonzero(~carved.kept).tolist() == [0, 1, 2]
    assert (carved.inside, carved.loose) == (1, 2)


def test_pores_that_cut_a_grain_into_pieces_are_refused() -> None:
    row = np.column_stack([np.arange(60) * 1.2, np.zeros(60), np.zeros(60)])
    with pytest.raises(PackingError, match=r"cut the grain into 2 pieces: 29 of 5\d primaries do not hang") as caught:
        carve(Voids(np.array([[36.0, 0.0, 0.0]]), np.array([2.0])), row, np.full(60, 0.5))
    assert caught.value.at == ("macro_pores",)


@pytest.mark.parametrize(
    ("pores", "sentence"),
    [
        ({"diameter": "0.4 mm"}, "exactly one of 'count' and 'porosity'"),
        ({"count": 1, "porosity": 0.1, "diameter": "0.4 mm"}, "exactly one of 'count' and 'porosity'"),
        ({"count": 0, "diameter": "0.4 mm"}, "greater than or equal to 1"),
        ({"count": 1, "diameter": "0.1 mm"}, "a pore of 0.1 mm is smaller than a primary of 0.2 mm"),
        ({"count": 1, "diameter": "1.5 mm", "wall": "0.1 mm"}, "does not fit into a grain of 1.6 mm"),
        ({"count": 1, "diameter": {"mean": "0.4 mm"}}, "deviation"),
        ({"count": 1, "diameter": "4 N"}, "a length is needed"),
        ({"count": 1, "diameter": "0.4 mm", "number": 3}, "number"),
    ],
)
def test_senseless_pores_are_refused(pores: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValidationError, match=sentence):
        sphere(pores)


@pytest.mark.parametrize(
    ("pores", "error", "sentence"),
    [
        ({"porosity": 0.001, "diameter": "0.5 mm"}, ConfigError, "less than half a pore of 0.5 mm"),
        ({"porosity": 0.9, "diameter": "0.5 mm"}, PackingError, r"no room for 29 pores .* attempts placed \d+"),
        ({"count": 2, "diameter": "1 mm"}, PackingError, "the best of 20 attempts placed 1"),
        ({"count": 40, "diameter": {"mean": "0.3 mm", "deviation": "0.9 mm"}}, PackingError, "no room for 40 pores"),
    ],
)
def test_pores_without_room_are_refused_before_anything_is_packed(
    pores: dict[str, Any], error: type[Exception], sentence: str
) -> None:
    with pytest.raises(error, match=sentence):
        spherical_agglomerate.predict(sphere(pores), HERE, None)


def grain_scene(pores: dict[str, Any], **changes: Any) -> SceneConfig:
    return load(CONFIGS / "crush_grain.yaml").changed({"particles.macro_pores": pores, **changes})


def test_errors_name_the_place_in_the_scene() -> None:
    with pytest.raises(ConfigError, match=r"particles\.macro_pores\.diameter: a pore of 0\.1 mm is smaller"):
        grain_scene({"count": 1, "diameter": "0.1 mm"})
    with pytest.raises(PackingError, match=r"particles\.macro_pores: no room for 3 pores"):
        forecast(grain_scene({"count": 3, "diameter": "1.5 mm"}))


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize(
    "pores",
    [
        {"count": 5, "diameter": {"mean": "0.4 mm", "deviation": "0.1 mm"}},
        {"porosity": 0.1, "diameter": "0.4 mm"},
        {"count": 1, "diameter": "1 mm", "wall": "0.3 mm"},
    ],
)
def test_as_many_primaries_and_bonds_are_left_as_were_told(pores: dict[str, Any], seed: int) -> None:
    scene = grain_scene(pores | {"seed": seed})
    told, built = forecast(scene), build_scene(scene)
    assert 0.0 < told.particles_band < 0.1
    assert len(built.radius) == pytest.approx(told.particles, rel=told.particles_band)
    assert told.bonds is not None
    assert told.bonds.band < 0.25
    assert len(built.ends) == pytest.approx(told.bonds.value, rel=told.bonds.band)
    assert re.search(r"particles +about \d+ \(±\d+%\)", told.text())


def test_check_build_tells_pores_and_pieces() -> None:
    text = report(grain_scene({"count": 5, "diameter": "0.4 mm"}))
    for row in (r"macro_pores +5\n", r"macro_pore_share +0\.0", r"primaries_loose +0\n", r"pieces +1, one a grain"):
        assert re.search(row, text)
    apart = report(grain_scene({"count": 5, "diameter": "0.4 mm"}, **{"bonds.between.max_gap": 0}))
    assert re.search(r"pieces +\d+ in place of 1, the smallest of 1 particles", apart)

"""Designs fill their space, and distributions have the moments that are asked for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.studies.axis import Axis
from clast.studies.axis_config import AxisConfig
from clast.studies.design import points, quantiles
from clast.studies.tasks import tasks
from tests.core.studies.support import study

YIELD, E = "bonds.model.yield_stress", "bonds.model.young_modulus"


def test_a_grid_is_all_combinations_and_together_is_side_by_side(tmp_path: Path) -> None:
    vary = {YIELD: ["1 MPa", "2 MPa"], E: {"from": "100 MPa", "to": "300 MPa", "points": 2}}
    grid = [tuple(setting.number for setting in point) for point in points(study(tmp_path, vary=vary))]
    assert grid == [(1e6, 1e8), (1e6, 3e8), (2e6, 1e8), (2e6, 3e8)]
    together = points(study(tmp_path, vary=vary, design="together"))
    assert [tuple(setting.number for setting in point) for point in together] == [(1e6, 1e8), (2e6, 3e8)]


def test_a_logarithmic_range_grows_by_a_factor() -> None:
    axis = Axis("x", AxisConfig.model_validate({"from": "1 kPa", "to": "1 MPa", "points": 4, "spacing": "log"}))
    assert [setting.number for setting in axis.settings] == pytest.approx([1e3, 1e4, 1e5, 1e6])
    assert axis.settings[0].number == 1e3
    assert axis.settings[-1].number == 1e6


def test_several_keys_follow_one_axis_with_their_factors() -> None:
    keys = {"particles.primary_diameter": 1, "bonds.between.max_gap": 0.5}
    axis = Axis("primary", AxisConfig.model_validate({"keys": keys, "values": ["0.2 mm"]}))
    assert axis.settings[0].changes == {"particles.primary_diameter": 0.2e-3, "bonds.between.max_gap": 0.1e-3}
    assert axis.settings[0].label == "0.2 mm"


@given(
    st.sampled_from(["latin_hypercube", "sobol", "random"]), st.integers(1, 40), st.integers(1, 4), st.integers(0, 9)
)
def test_points_lie_in_the_cube_and_depend_on_the_seed_alone(design: str, count: int, axes: int, seed: int) -> None:
    found = quantiles(design, count, axes, seed)
    assert found.shape == (count, axes)
    assert ((found >= 0.0) & (found < 1.0)).all()
    assert np.array_equal(found, quantiles(design, count, axes, seed))


@given(st.integers(2, 50), st.integers(1, 3))
def test_a_latin_hypercube_has_one_point_in_every_row(count: int, axes: int) -> None:
    found = quantiles("latin_hypercube", count, axes, 3)
    for column in found.T:
        assert sorted((column * count).astype(int)) == list(range(count))


@pytest.mark.parametrize("distribution", ["normal", "lognormal", "weibull"])
def test_distributions_have_their_moments(distribution: str) -> None:
    given = {"distribution": distribution, "mean": "4 MPa", "deviation": "1 MPa"}
    axis = Axis("x", AxisConfig.model_validate(given))
    drawn = np.array([axis.at(share).number for share in (np.arange(4000) + 0.5) / 4000])
    assert drawn.mean() == pytest.approx(4e6, rel=2e-3)
    assert drawn.std() == pytest.approx(1e6, rel=2e-2)


def test_a_distribution_is_cut_off_without_heaping_up() -> None:
    given = {"distribution": "normal", "mean": 1.0, "deviation": 1.0, "at_least": 0.5, "at_most": 1.5}
    axis = Axis("x", AxisConfig.model_validate(given))
    drawn = np.array([axis.at(share).number for share in (np.arange(1000) + 0.5) / 1000])
    assert 0.5 < drawn.min() < 0.51
    assert 1.49 < drawn.max() < 1.5
    assert len(np.unique(drawn)) == 1000


def test_repeats_draw_other_numbers_and_keep_the_grain_where_asked(tmp_path: Path) -> None:
    def seeds(grain: str) -> list[tuple[int, int]]:
        import yaml

        found = tasks(study(tmp_path, vary={YIELD: ["1 MPa", "2 MPa"]}, repeats=2, grain=grain))
        scenes = [yaml.safe_load(task.scene) for task in found]
        return [(scene["particles"]["seed"], scene["bonds"]["model"]["seed"]) for scene in scenes]

    assert seeds("same") == [(3, 1), (3, 2), (3, 1), (3, 2)]
    assert seeds("per_repeat") == [(3, 1), (4, 2), (3, 1), (4, 2)]
    assert seeds("per_run") == [(3, 1), (4, 2), (5, 3), (6, 4)]


def test_names_tell_values_and_runs_that_are_the_same_share_one(tmp_path: Path) -> None:
    first = tasks(study(tmp_path, vary={YIELD: ["1 MPa", "2 MPa"]}))
    more = tasks(study(tmp_path, vary={YIELD: ["0.5 MPa", "2 MPa", "2e6"]}))
    assert first[0].name.startswith("1_MPa-")
    assert more[1].name == first[1].name
    assert more[2].name.split("-")[-1] == more[1].name.split("-")[-1]

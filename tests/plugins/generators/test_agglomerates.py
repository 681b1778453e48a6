"""Agglomerates hold what was asked for, stay inside their body, and say what they reached."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from clast.errors import ConfigError, PackingError
from clast.parts.generator import Gaps, Packing, Site
from clast.plugins.discovery import discover
from clast.scene.bonding import bond_neighbours
from clast.scene.packing_report import overlaps
from clast.testing.kit import try_part
from clast_plugins.generators import flattened_agglomerate, spherical_agglomerate
from clast_plugins.generators.flattened_agglomerate import FlattenedAgglomerate
from clast_plugins.generators.spherical_agglomerate import SphericalAgglomerate

HERE = Site(Path())


def sphere(**changes: Any) -> SphericalAgglomerate:
    given: dict[str, Any] = {
        "material": "glass",
        "diameter": "2.16 mm",
        "primary_diameter": "0.25 mm",
        "porosity": 0.44,
        "seed": 1,
    }
    return SphericalAgglomerate.model_validate(
        {key: value for key, value in (given | changes).items() if value is not None}
    )


def flattened(**changes: Any) -> FlattenedAgglomerate:
    given: dict[str, Any] = {
        "material": "glass",
        "volume_diameter": "2.3 mm",
        "height": "2.16 mm",
        "primary_diameter": "0.25 mm",
        "porosity": 0.45,
    }
    return FlattenedAgglomerate.model_validate(
        {key: value for key, value in (given | changes).items() if value is not None}
    )


def bonds_at_half_a_primary(packing: Packing) -> int:
    return len(bond_neighbours(packing.position, packing.radius, max_gap=float(packing.radius[0])).ends)


@pytest.fixture(scope="module")
def base_grain() -> Packing:
    return spherical_agglomerate.generate(sphere(), HERE)


@pytest.fixture(scope="module")
def optimised_grain() -> Packing:
    return flattened_agglomerate.generate(flattened(), HERE)


@pytest.mark.parametrize(("porosity", "count"), [(0.44, 361), (0.45, 354), (0.60, 257)])
def test_the_number_of_primaries_follows_from_the_porosity(porosity: float, count: int) -> None:
    assert spherical_agglomerate.predict(sphere(porosity=porosity), HERE, None).particles == count


def test_a_count_that_comes_out_even_is_not_lost_to_rounding() -> None:
    params = sphere(diameter="0.3 mm", primary_diameter="0.1 mm", porosity=1 - 9 / 27)
    assert spherical_agglomerate.predict(params, HERE, None).particles == 9


def test_the_flattened_grain_counts_from_the_uncut_sphere() -> None:
    assert flattened_agglomerate.predict(flattened(), HERE, None).particles == 428


def test_the_base_grain_has_as_many_bonds_as_the_paper_says(base_grain: Packing) -> None:
    assert len(base_grain.position) == 361
    assert 2120 <= bonds_at_half_a_primary(base_grain) <= 2180


def test_every_primary_lies_wholly_in_the_sphere_and_overlaps_no_more_than_allowed(
    base_grain: Packing,
) -> None:
    reach = np.linalg.norm(base_grain.position, axis=1) + base_grain.radius
    assert reach.max() <= 1.08e-3 * (1 + 1e-12)
    assert overlaps(base_grain.position, base_grain.radius).largest <= 1e-4 * 0.25e-3


def test_the_report_agrees_with_the_packing(base_grain: Packing) -> None:
    report = base_grain.report
    assert report["primaries"] == 361
    assert report["porosity_asked"] == 0.44
    assert report["porosity_reached"] == pytest.approx(1 - 361 * (0.25 / 2.16) ** 3, rel=1e-12)
    assert report["largest_overlap_m"] == overlaps(base_grain.position, base_grain.radius).largest
    assert report["overlaps_within_tolerance"] == "yes"
    assert report["seed"] == 1


def test_the_flattened_grain_fits_between_its_plates_and_touches_both(optimised_grain: Packing) -> None:
    x, r = optimised_grain.position, optimised_grain.radius
    top, bottom = x[:, 2] + r, x[:, 2] - r
    assert top.max() == pytest.approx(1.08e-3, rel=1e-12)
    assert bottom.min() == pytest.approx(-1.08e-3, rel=1e-12)
    assert (np.linalg.norm(x, axis=1) + r).max() <= 1.15e-3 * (1 + 1e-12)
    assert 3 <= np.count_nonzero(top > 1.08e-3 - 0.25e-6) <= 9


def test_the_flattened_grain_has_about_as_many_bonds_as_the_reference(optimised_grain: Packing) -> None:
    assert 2500 <= bonds_at_half_a_primary(optimised_grain) <= 2600
    assert optimised_grain.report["height_m"] == pytest.approx(2.16e-3)
    assert 2.16e-3 < float(optimised_grain.report["width_m"]) <= 2.3e-3 * (1 + 1e-12)
    between = float(optimised_grain.report["porosity_between_plates"])
    assert between < float(optimised_grain.report["porosity_reached"])


def test_the_centre_only_moves_the_packing() -> None:
    small: dict[str, Any] = {"diameter": "0.8 mm", "primary_diameter": "0.2 mm", "porosity": 0.6}
    here = spherical_agglomerate.generate(sphere(**small), HERE)
    there = spherical_agglomerate.generate(sphere(**small, centre=["1 mm", 0, "-2 mm"]), HERE)
    np.testing.assert_allclose(there.position - [1e-3, 0, -2e-3], here.position, atol=1e-18)


def test_too_dense_a_packing_is_an_error_that_says_what_was_reached_and_what_to_do() -> None:
    dense = sphere(diameter="0.75 mm", primary_diameter="0.25 mm", porosity=0.4)
    with pytest.raises(PackingError, match=r"16 primaries.*porosity 0\.4.*overlap of \d+.*accept_overlap"):
        spherical_agglomerate.generate(dense, HERE)


@pytest.mark.parametrize(("size", "count"), [(2.0, 6), (4.0, 43), (7.0, 227)])
def test_what_is_refused_as_denser_than_random_could_not_be_packed(size: float, count: int) -> None:
    params = {"diameter": size, "primary_diameter": 1.0, "porosity": None, "primaries": count}
    with pytest.raises(ConfigError, match="denser than any random packing"):
        spherical_agglomerate.generate(sphere(**params), HERE)
    forced = spherical_agglomerate.generate(sphere(**params, accept_overlap=True), HERE)
    assert float(forced.report["largest_overlap_per_diameter"]) > 0.01


def test_accepted_overlaps_stay_and_are_reported() -> None:
    dense = sphere(diameter="0.75 mm", primary_diameter="0.25 mm", porosity=0.3, accept_overlap=True)
    packing = spherical_agglomerate.generate(dense, HERE)
    assert packing.report["overlaps_within_tolerance"] == "no, accepted; contacts start stress-free"
    assert float(packing.report["largest_overlap_m"]) > 1e-5


def test_a_wider_tolerance_accepts_the_overlap_it_names() -> None:
    packing = spherical_agglomerate.generate(sphere(max_overlap="1 um"), HERE)
    assert 0 < float(packing.report["largest_overlap_m"]) <= 1e-6


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"porosity": None}, "exactly two of primary_diameter, porosity and primaries"),
        ({"primaries": 100}, "exactly two of primary_diameter, porosity and primaries"),
        ({"porosity": 1.2}, "less than 1"),
        ({"primary_diameter": "3 mm"}, "does not fit into"),
        ({"primary_diameter": "0.25 um"}, "check the diameters and their units"),
        ({"diameter": "-2 mm"}, "greater than 0"),
        ({"primary_diameter": "2 mm", "porosity": 0.9}, "makes 0 primaries"),
    ],
)
def test_senseless_measures_of_a_sphere_are_refused(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValidationError, match=sentence):
        sphere(**changes)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"height": "2.4 mm"}, "nothing would be flattened"),
        ({"height": "0.2 mm"}, "does not fit between"),
        ({"porosity": None}, "exactly two"),
    ],
)
def test_senseless_measures_of_a_flattened_sphere_are_refused(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValidationError, match=sentence):
        flattened(**changes)


def test_a_packing_has_one_entry_per_primary_in_every_array(base_grain: Packing) -> None:
    assert base_grain.velocity.shape == base_grain.spin.shape == base_grain.position.shape == (361, 3)
    assert base_grain.material == ["glass"] * 361
    assert not base_grain.prescribed.any()
    assert base_grain.bonds is None
    assert math.isclose(base_grain.radius.max(), 0.125e-3)


SPREAD = {"diameter": "1.2 mm", "primary_diameter": "0.2 mm", "porosity": 0.5, "primary_deviation": 0.2}


@pytest.mark.parametrize("distribution", ["normal", "lognormal"])
def test_scattered_primaries_have_the_volume_of_equal_ones_and_the_deviation_asked_for(distribution: str) -> None:
    scattered = spherical_agglomerate.generate(sphere(**SPREAD, primary_distribution=distribution), HERE)
    diameter = 2.0 * scattered.radius
    assert len(diameter) == 108
    assert math.fsum(diameter**3) == pytest.approx(108 * 0.2e-3**3, rel=1e-12)
    assert diameter.std() / diameter.mean() == pytest.approx(0.2, rel=0.03)
    assert scattered.report["porosity_reached"] == pytest.approx(0.5, abs=1e-12)
    assert scattered.report["primary_diameter_deviation_m"] == pytest.approx(diameter.std())
    assert (np.linalg.norm(scattered.position, axis=1) + scattered.radius).max() <= 0.6e-3 * (1 + 1e-12)
    assert overlaps(scattered.position, scattered.radius).largest <= 1e-4 * diameter.min()


def test_large_and_small_primaries_lie_everywhere() -> None:
    scattered = spherical_agglomerate.generate(sphere(**SPREAD | {"primary_diameter": "0.1 mm"}), HERE)
    large = scattered.radius > np.median(scattered.radius)
    assert np.abs(scattered.position[large].mean(axis=0)).max() < 0.05e-3


def test_seeds_give_the_same_sizes_in_other_places() -> None:
    one, other = (spherical_agglomerate.generate(sphere(**SPREAD, seed=seed), HERE) for seed in (1, 2))
    np.testing.assert_array_equal(one.radius, other.radius)
    assert np.abs(one.position - other.position).max() > 0.1e-3


@pytest.mark.parametrize("relative", [True, False])
def test_the_bonds_of_scattered_primaries_are_foretold(relative: bool) -> None:
    params = sphere(**SPREAD)
    most = 0.5 if relative else 0.1e-3
    gaps = Gaps(-math.inf, most, relative)
    made = spherical_agglomerate.generate(params, HERE)
    bonds = len(bond_neighbours(made.position, made.radius, most, relative=relative).ends)
    told = spherical_agglomerate.predict(params, HERE, gaps)
    assert told.bonds is not None
    assert told.bonds.band < 0.25
    assert bonds == pytest.approx(told.bonds.value, rel=told.bonds.band)
    assert told.radius == made.radius.min()


def test_a_largest_primary_without_room_is_refused() -> None:
    flat = flattened(height="0.27 mm", primary_deviation=0.3)
    with pytest.raises(ConfigError, match=r"the largest primary, 0\.\d+ mm, does not fit .* up to 0\.27 mm") as caught:
        flattened_agglomerate.predict(flat, HERE, None)
    assert caught.value.at == ("primary_deviation",)


@pytest.mark.parametrize("deviation", [-0.1, 0.4, "0.02 mm"])
def test_a_deviation_is_a_share_that_leaves_every_primary_a_size(deviation: Any) -> None:
    with pytest.raises(ValidationError, match="primary_deviation"):
        sphere(primary_deviation=deviation)


def test_scattered_primaries_can_have_macro_pores() -> None:
    carved = spherical_agglomerate.generate(sphere(**SPREAD, macro_pores={"count": 1, "diameter": "0.4 mm"}), HERE)
    assert int(carved.report["primaries_in_macro_pores"]) > 0
    assert overlaps(carved.position, carved.radius).largest <= 1e-4 * 2 * carved.radius.min()
    assert len(carved.radius) == carved.report["primaries"]


@pytest.mark.parametrize("name", ["spherical_agglomerate", "flattened_agglomerate"])
def test_agglomerates_keep_to_what_holds_for_every_generator(name: str) -> None:
    assert [each for each in try_part(discover().get("generator", name)) if not each.passed] == []

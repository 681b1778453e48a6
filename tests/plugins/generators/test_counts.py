"""How many grains of each fraction."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from clast.errors import ConfigError
from clast_plugins.generators.filling.counts import Share, counts, extremes, nearest
from clast_plugins.generators.sizes import mean_cube, sizes

THREE = (Share("small", 1.0), Share("middle", 2.0), Share("large", 4.0))


def test_counts_that_are_given_stay() -> None:
    given_counts = [each._replace(grains=k) for k, each in enumerate(THREE)]
    assert counts(given_counts, 3, None).grains.tolist() == [0, 1, 2]


def test_shares_are_rounded_so_that_they_add_up() -> None:
    shares = [each._replace(share=1.0 / 3.0) for each in THREE]
    assert counts(shares, 100, None).grains.sum() == 100


@pytest.mark.parametrize("grains", [None, 4, 1396])
def test_shares_of_more_than_all_are_told_as_shares(grains: int | None) -> None:
    shares = [THREE[0]._replace(share=0.7), THREE[1]._replace(share=0.4), THREE[2]]
    with pytest.raises(ConfigError, match="the shares make 110 %; at most 100 % is needed"):
        counts(shares, grains, None)


def test_rounded_shares_are_let_pass() -> None:
    assert counts([each._replace(share=0.333) for each in THREE], 100, None).grains.sum() == 100


def test_without_a_mass_the_prior_decides() -> None:
    shares = [each._replace(prior=p) for each, p in zip(THREE, (0.2, 0.3, 0.5), strict=True)]
    assert counts(shares, 100, None).grains.tolist() == [20, 30, 50]


def test_fractions_without_a_prior_have_what_the_others_leave() -> None:
    shares = [THREE[0]._replace(prior=0.2), *THREE[1:]]
    assert counts(shares, 100, None).grains.tolist() == [20, 40, 40]


def test_one_fraction_that_is_left_takes_all_that_is_left() -> None:
    shares = [THREE[0]._replace(prior=0.0), THREE[1]._replace(grains=3), THREE[2]._replace(share=0.5)]
    assert counts(shares, 10, None).grains.tolist() == [2, 3, 5]


def test_a_mass_that_sizes_can_meet_is_met_as_nearly_as_counts_can() -> None:
    equal = [Share("a", 1.0), Share("b", 1.0)]
    assert counts(equal, 10, 10.5).grains.sum() == 10


def test_one_share_number_and_mass_leave_no_choice() -> None:
    shares = [THREE[0]._replace(share=0.2), *THREE[1:]]
    told = counts(shares, 100, 20 + 50 * 2 + 30 * 4)
    assert told.grains.tolist() == [20, 50, 30]
    assert told.family is None


def test_the_family_is_told_where_number_and_mass_leave_a_choice() -> None:
    told = counts(THREE, 100, 220.0)
    assert told.family is not None
    assert told.family.round(6).tolist() == [[0.0, 60.0], [0.0, 90.0], [10.0, 40.0]]
    low, high = told.family.T
    assert np.all((low <= told.grains) & (told.grains <= high))


@settings(max_examples=30, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(st.floats(0.5, 5.0), min_size=3, max_size=5, unique=True), st.data())
def test_the_nearest_counts_meet_both_sums_and_are_not_negative(masses: list[float], data: st.DataObject) -> None:
    mass = np.array(masses)
    made = np.array(data.draw(st.lists(st.floats(0.0, 50.0), min_size=len(mass), max_size=len(mass))))
    prior = np.array(data.draw(st.lists(st.floats(0.0, 50.0), min_size=len(mass), max_size=len(mass))))
    if made.sum() < 1.0:
        return
    found = nearest(prior, mass, float(made.sum()), float(made @ mass))
    assert np.all(found >= 0.0)
    assert found.sum() == pytest.approx(made.sum(), rel=1e-6, abs=1e-6)
    assert found @ mass == pytest.approx(made @ mass, rel=1e-6, abs=1e-6)
    ends = extremes(mass, float(made.sum()), float(made @ mass))
    assert np.all(ends[:, 0] - 1e-6 <= found)
    assert np.all(found <= ends[:, 1] + 1e-6)


@pytest.mark.parametrize(
    ("shares", "grains", "mass", "sentence"),
    [
        ([each._replace(grains=5) for each in THREE], 16, None, "15 grains together, not 16"),
        ([each._replace(share=0.3) for each in THREE], 100, None, "the shares make 90 %; 100 % is needed"),
        ([THREE[0]._replace(grains=11), *THREE[1:]], 10, None, "11 grains together, not 10"),
        (THREE, None, 10.0, "the number of all is needed"),
        (THREE, 10, 8.0, "weigh 10000 to 40000 g, and 8000 g are left"),
        ([each._replace(grains=0) for each in THREE], None, None, "no fraction has any grains"),
        ([each._replace(prior=0.0) for each in THREE], 10, None, "the 'prior' shares add up to 0"),
        ([each._replace(prior=0.5) for each in THREE], 10, None, "the 'prior' shares add up to 1.5"),
    ],
)
def test_counts_that_do_not_add_up_are_refused(
    shares: list[Share], grains: int | None, mass: float | None, sentence: str
) -> None:
    with pytest.raises(ConfigError, match=sentence):
        counts(shares, grains, mass)


@given(st.integers(2, 300), st.floats(1e-4, 1e-2), st.floats(0.001, 0.2))
def test_sizes_have_the_mean_and_the_deviation_asked_for(count: int, mean: float, share: float) -> None:
    drawn = sizes(count, mean, share * mean)
    assert drawn.mean() == pytest.approx(mean, rel=1e-9)
    assert drawn.std() == pytest.approx(share * mean, rel=0.03 + 1.2 / count)


def test_sizes_stay_within_their_bounds() -> None:
    drawn = sizes(1000, 2.16e-3, 0.15e-3, (2.0e-3, 2.5e-3))
    assert drawn.min() >= 2.0e-3
    assert drawn.max() <= 2.5e-3


def test_the_mean_cube_is_that_of_a_normal_distribution() -> None:
    assert mean_cube(1.0, 0.1) == pytest.approx(1.0 + 3.0 * 0.1**2, rel=1e-3)

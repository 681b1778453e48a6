"""Gradings and breakage measures are those of mixtures that can be worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from clast.granular.breakage import einav, hardin, ultimate_finer, ultimate_mean_log
from clast.granular.grading import Grading, grading

BODIES = st.lists(st.tuples(st.floats(1e-4, 1e-2), st.floats(1e-6, 1.0)), min_size=1, max_size=40)


def mixture(**shares: float) -> Grading:
    """Return a grading by sizes in mm, written as d0p5=0.25."""
    sizes = [1e-3 * float(name[1:].replace("p", ".")) for name in shares]
    return Grading(np.array(sizes), np.array(list(shares.values())))


def test_a_mixture_of_three_sizes_has_the_curve_of_its_masses() -> None:
    size = np.array([2.0, 0.5, 1.0, 0.5, 0.5])
    mass = np.array([5.0, 1.0, 2.0, 1.0, 1.0])
    found = grading(size, mass)
    assert found.size.tolist() == [0.5, 1.0, 2.0]
    assert found.finer == pytest.approx([0.3, 0.5, 1.0])
    assert [found.quantile(share) for share in (0.1, 0.3, 0.31, 0.5, 0.51, 0.9)] == [0.5, 0.5, 1.0, 1.0, 2.0, 2.0]
    assert grading(size, np.ones(5)).finer == pytest.approx([0.6, 0.8, 1.0])


@given(BODIES)
def test_a_grading_holds_all_mass_and_rises(bodies: list[tuple[float, float]]) -> None:
    size, mass = np.array(bodies).T
    found = grading(size, mass)
    assert found.share.sum() == pytest.approx(1.0, rel=1e-12)
    assert (np.diff(found.size) > 0.0).all()
    assert (found.share > 0.0).all()
    for share in (0.1, 0.5, 0.9):
        d = found.quantile(share)
        assert mass[size <= d * (1.0 + 1e-8)].sum() >= share * mass.sum() * (1.0 - 1e-9)
    assert found.quantile(0.1) <= found.quantile(0.5) <= found.quantile(0.9) <= found.size[-1]


def test_hardin_is_what_the_areas_between_two_gradings_give_by_hand() -> None:
    before, after = mixture(d7p4=0.5, d0p74=0.5), mixture(d0p074=0.2, d0p74=0.5, d7p4=0.3)
    # potential before 0.5·2 + 0.5·1 = 1.5; after 0 + 0.5·1 + 0.3·2 = 1.1
    assert hardin(before, after) == pytest.approx(0.4 / 1.5)


def test_hardin_counts_nothing_below_silt() -> None:
    before = mixture(d0p74=1.0)
    assert hardin(before, mixture(d0p01=1.0)) == hardin(before, mixture(d0p07=1.0)) == 1.0
    assert math.isnan(hardin(mixture(d0p05=1.0), mixture(d0p01=1.0)))


def test_einav_is_0_at_the_start_1_at_the_ultimate_grading_and_more_where_all_is_primaries() -> None:
    before = mixture(d2=1.0)
    edges = np.geomspace(0.25e-3, 2e-3, 20_001)
    finer = ultimate_finer(edges, 2e-3, 0.25e-3)
    ultimate = Grading(np.sqrt(edges[1:] * edges[:-1]), np.diff(finer))
    assert einav(before, before, 0.25e-3) == 0.0
    assert einav(before, ultimate, 0.25e-3) == pytest.approx(1.0, rel=1e-6)
    assert einav(before, mixture(d0p25=1.0), 0.25e-3) > 1.0


def test_einav_is_the_ratio_of_two_areas_under_curves() -> None:
    """Hand-made: from 2 mm to half 1 mm, half 2 mm; areas over ln D by small steps."""
    x = np.linspace(math.log(0.25), math.log(2.0), 400_001)
    d = np.exp(x)
    moved = np.trapezoid(np.where(d >= 1.0, 0.5, 0.0), x)
    possible = np.trapezoid((d**0.4 - 0.25**0.4) / (2.0**0.4 - 0.25**0.4), x)
    assert moved == pytest.approx(0.5 * math.log(2.0), rel=1e-4)
    assert einav(mixture(d2=1.0), mixture(d1=0.5, d2=0.5), 0.25e-3) == pytest.approx(moved / possible, rel=1e-4)


def test_grains_that_are_primaries_cannot_break() -> None:
    assert math.isnan(einav(mixture(d1=1.0), mixture(d1=1.0), 1e-3))
    assert ultimate_mean_log(1e-3, 1e-3) == pytest.approx(math.log(1e-3))


@given(BODIES, BODIES)
def test_both_measures_grow_when_all_becomes_finer(
    first: list[tuple[float, float]], second: list[tuple[float, float]]
) -> None:
    before, after = (grading(*np.array(bodies).T) for bodies in (first, second))
    assume(before.mean_log > ultimate_mean_log(before.size[-1], 1e-6))
    finer = Grading(0.9 * after.size, after.share)
    assert hardin(before, finer) > hardin(before, after)
    assert einav(before, finer, 1e-6) > einav(before, after, 1e-6)
    assert hardin(before, before) == einav(before, before, 1e-6) == 0.0

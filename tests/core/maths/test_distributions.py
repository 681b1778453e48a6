"""Factors of mean 1: their moments, their distribution functions, their order."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.maths.distributions import lognormal, weibull, weibull_deviation

EVENLY = (np.arange(1_000_000) + 0.5) / 1_000_000
"""Uniform numbers without chance: what is left of a mean is the quadrature's error."""


@settings(max_examples=25, deadline=None)
@given(modulus=st.floats(1.0, 50.0))
def test_weibull_factors_have_the_mean_1_and_the_deviation_of_their_modulus(modulus: float) -> None:
    found = weibull(EVENLY, modulus)
    assert found.mean() == pytest.approx(1.0, rel=1e-5)
    assert found.std() == pytest.approx(weibull_deviation(modulus), rel=1e-3)


@settings(max_examples=25, deadline=None)
@given(deviation=st.floats(0.01, 1.0))
def test_lognormal_factors_have_the_mean_1_and_the_deviation_asked_for(deviation: float) -> None:
    found = lognormal(EVENLY, deviation)
    assert found.mean() == pytest.approx(1.0, rel=1e-4)
    assert found.std() == pytest.approx(deviation, rel=5e-3)


@settings(max_examples=50, deadline=None)
@given(modulus=st.floats(0.5, 100.0), x=st.floats(0.05, 3.0))
def test_the_share_of_weibull_factors_below_a_number_is_weibull_s(modulus: float, x: float) -> None:
    expected = -math.expm1(-((math.gamma(1.0 + 1.0 / modulus) * x) ** modulus))
    assert np.mean(weibull(EVENLY, modulus) <= x) == pytest.approx(expected, abs=2e-6)


@settings(max_examples=50, deadline=None)
@given(u=st.tuples(st.floats(1e-16, 1.0, exclude_max=True), st.floats(1e-16, 1.0, exclude_max=True)))
@pytest.mark.parametrize(("draw", "width"), [(weibull, 0.5), (weibull, 5.0), (lognormal, 0.2), (lognormal, 10.0)])
def test_factors_are_finite_above_0_and_grow_with_their_random_number(draw: Any, width: float, u: Any) -> None:
    low, high = draw(np.sort(np.array(u)), width)
    assert 0.0 < low <= high < math.inf

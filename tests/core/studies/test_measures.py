"""Measures of curves whose numbers are known."""

from __future__ import annotations

import numpy as np
import pytest

from clast.studies.measures import MEASURES, Curve


def curve(*points: tuple[float, float]) -> Curve:
    """Return a curve through points of strain and stress, finely sampled."""
    strain = np.linspace(0.0, points[-1][0], 2001)
    stress = np.interp(strain, *zip(*points, strict=True))
    return Curve(strain, stress, 2.0 * stress, np.linspace(0.0, 50.0, 2001), 100)


SAW = curve((0.0, 0.0), (0.05, 10.0), (0.052, 4.0), (0.1, 12.0), (0.104, 6.0), (0.2, 6.0))


def test_the_peak_and_what_is_broken_there() -> None:
    assert MEASURES["peak_stress_Pa"](SAW) == pytest.approx(12.0)
    assert MEASURES["peak_force_N"](SAW) == pytest.approx(24.0)
    assert MEASURES["strain_at_peak"](SAW) == pytest.approx(0.1)
    assert MEASURES["peak_inside"](SAW) == 1.0
    assert MEASURES["broken_at_peak"](SAW) == pytest.approx(0.25)
    assert MEASURES["broken_at_end"](SAW) == pytest.approx(0.5)


def test_slopes_are_secants_and_nothing_where_the_curve_ends_before() -> None:
    assert MEASURES["slope_1_4_Pa"](SAW) == pytest.approx(200.0)
    assert MEASURES["slope_5_15_Pa"](SAW) == pytest.approx((6.0 - 10.0) / 0.1)
    assert MEASURES["slope_5_15_Pa"](curve((0.0, 0.0), (0.1, 1.0))) is None
    assert MEASURES["slope_20_80_Pa"](curve((0.0, 0.0), (0.1, 1.0))) == pytest.approx(10.0)


def test_drops_are_counted_and_the_largest_is_a_share_of_the_peak() -> None:
    assert MEASURES["drops"](SAW) == 2.0
    assert MEASURES["largest_drop"](SAW) == pytest.approx(0.5, abs=0.01)
    assert MEASURES["drops"](curve((0.0, 0.0), (0.1, 1.0))) == 0.0
    slow = curve((0.0, 0.0), (0.05, 10.0), (0.15, 0.0))  # a tenth of the peak in one per cent of strain
    assert MEASURES["largest_drop"](slow) == pytest.approx(0.1, abs=0.005)


def test_the_work_is_the_area_below_the_curve() -> None:
    assert MEASURES["work_J_per_m3"](curve((0.0, 0.0), (0.1, 8.0))) == pytest.approx(0.4)


def test_a_curve_without_stress_has_no_drop_and_no_slope() -> None:
    nothing = curve((0.0, 0.0), (0.2, 0.0))
    assert MEASURES["largest_drop"](nothing) is None
    assert MEASURES["slope_20_80_Pa"](nothing) is None

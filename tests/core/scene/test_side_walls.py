"""Planes around a compression: the section that they leave."""

from __future__ import annotations

from math import cos, pi, sin, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.scene.side_walls import inside_planes

AXIS = np.array([0.0, 0.0, 1.0])


def prism(corners: int, reach: float, turn: float = 0.0) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the planes of a regular prism whose faces are at some distance from the point (3, -2, 5)."""
    middle = np.array([3.0, -2.0, 5.0])
    outward = [
        np.array([cos(turn + k * 2 * pi / corners), sin(turn + k * 2 * pi / corners), 0]) for k in range(corners)
    ]
    return [(middle + reach * each, -each) for each in outward]


@given(st.integers(3, 12), st.floats(1e-4, 1e3), st.floats(0.0, 6.0))
def test_a_regular_prism_has_its_section(corners: int, reach: float, turn: float) -> None:
    area, girth = inside_planes(prism(corners, reach, turn), AXIS)
    side = 2.0 * reach * tan(pi / corners)
    assert girth == pytest.approx(corners * side, rel=1e-6)
    assert area == pytest.approx(0.5 * reach * corners * side, rel=1e-6)


def test_a_plane_that_cuts_nothing_off_changes_nothing() -> None:
    far = [(np.array([100.0, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0]))]
    assert inside_planes(prism(4, 1.0) + far, AXIS) == pytest.approx((4.0, 8.0))


def test_planes_that_do_not_close_and_those_that_leave_no_room_are_refused() -> None:
    for left in (prism(4, 1.0)[:3], prism(4, 1.0)[::2], prism(6, 1.0)[:3], prism(4, 1.0)[:1]):
        with pytest.raises(ValueError, match="do not close around"):
            inside_planes(left, AXIS)
    with pytest.raises(ValueError, match="leave no room between them; their normals point to where"):
        inside_planes([(point, -normal) for point, normal in prism(4, 1.0)], AXIS)
    with pytest.raises(ValueError, match="must be parallel to the line between the plates"):
        inside_planes(prism(4, 1.0), np.array([1.0, 0.0, 0.0]))

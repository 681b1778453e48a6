"""A box is touched where its faces are, in as many places as there are faces within reach."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.engine.wall_feet import feet
from clast.plugins.discovery import discover

PART = discover().get("wall", "box").part
LOWER, UPPER = np.array([0.0, -1.0, 2.0]), np.array([1.0, 1.0, 3.5])


def box(*missing: str):
    return PART.Params(lower=LOWER.tolist(), upper=UPPER.tolist(), open=list(missing))


@given(st.tuples(*3 * [st.floats(0.01, 0.99)]), st.floats(0.05, 2.0))
def test_from_inside_it_is_touched_once_on_every_face_within_reach(share, reach):
    x = LOWER + np.array(share) * (UPPER - LOWER)
    gaps = np.concatenate([x - LOWER, UPPER - x])
    found = feet(PART, box(), x[None], np.array([reach]))
    assert np.sort(found.distance) == pytest.approx(np.sort(gaps[gaps < reach]), rel=1e-12)
    for distance, normal in zip(found.distance, found.normal, strict=True):
        axis = int(np.argmax(np.abs(normal)))
        assert abs(normal[axis]) == pytest.approx(1.0)
        assert distance == pytest.approx(min(abs((LOWER if normal[axis] < 0 else UPPER)[axis] - x[axis]), 9.0))


def test_a_face_that_is_open_is_not_touched_but_its_rim_is():
    above = np.array([[0.5, 0.0, 3.5], [0.5, 0.95, 3.6]])
    assert len(feet(PART, box("top"), above[:1], np.array([0.3])).distance) == 0
    found = feet(PART, box("top"), above[1:], np.array([0.3]))
    assert found.distance == pytest.approx([np.hypot(0.05, 0.1)])
    assert PART.slots(box("top", "left")) == 4


def test_a_box_without_a_volume_or_without_faces_is_refused():
    with pytest.raises(ValueError, match="upper must be above lower along y"):
        PART.Params(lower=[0, 1, 0], upper=[1, 1, 1])
    with pytest.raises(ValueError, match="all six faces are open"):
        box("left", "right", "front", "back", "bottom", "top")

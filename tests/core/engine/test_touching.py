"""What a contact has moved counts from touch on, not from the step before it."""

import pytest
from hypothesis import given

from clast.engine.kernels.touching import share_since_touch
from clast.maths.vec3 import dot, scale
from tests.support.strategies import directions, numbers, vectors


def since_touch(moved, n, overlap, held=False):
    return scale(share_since_touch(moved, n, overlap, held), moved)


def test_of_a_displacement_that_closes_a_gap_only_the_part_after_touch_counts():
    """It closes 4, the bodies overlap by 1: three quarters of it came before they met."""
    assert since_touch((8.0, 0.0, -4.0), (0.0, 0.0, 1.0), 1.0) == (2.0, 0.0, -1.0)


@pytest.mark.parametrize("closed", [-1.0, 0.0, 0.5, 1.0])
def test_all_of_it_counts_when_they_touched_before(closed):
    assert since_touch((8.0, 0.0, -closed), (0.0, 0.0, 1.0), 1.0) == (8.0, 0.0, -closed)


@pytest.mark.parametrize("overlap", [-1.0, 1.0])
@pytest.mark.parametrize("closed", [-8.0, -0.5, 0.5, 8.0])
def test_all_of_it_counts_when_a_neck_held_them_together(overlap, closed):
    moved = (8.0, 0.0, -closed)
    assert since_touch(moved, (0.0, 0.0, 1.0), overlap, held=True) == moved


@given(moved=vectors(1.0), n=directions(), overlap=numbers(1e-6, 1.0))
def test_no_contact_closes_more_than_its_overlap(moved, n, overlap):
    after = since_touch(moved, n, overlap)
    assert -dot(after, n) <= overlap * (1.0 + 1e-12)
    assert after == moved or after == pytest.approx(scale(-overlap / dot(moved, n), moved))

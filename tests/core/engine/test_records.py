"""Records of laws in tables: what may be kept, and that nothing changes its place."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from clast.engine.records import columns, construct, destruct, fields, numbers, width
from clast.errors import PluginError
from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec


class Kept(NamedTuple):
    strain: float
    slip: Vec
    turn: Quat
    count: int
    modulus: NDArray[np.float64] | float


class Listed(NamedTuple):
    values: list[float]


class Words(NamedTuple):
    name: str


class Plain:
    strain: float


RECORD = Kept(1.0, (2.0, 3.0, 4.0), (5.0, 6.0, 7.0, 8.0), 9, 10.0)


def test_numbers_take_one_slot_vectors_three_and_quaternions_four():
    assert [field.size for field in fields(Kept)] == [1, 3, 4, 1, 1]
    assert (width(Kept), width(None)) == (10, 0)


def test_taking_a_record_apart_and_building_it_again_gives_it_back():
    texts = destruct(Kept, "record")
    assert len(texts) == width(Kept)
    assert eval(construct(Kept, "Kept", texts), {"Kept": Kept, "record": RECORD}) == RECORD


def test_the_numbers_of_a_record_come_in_the_order_it_is_taken_apart():
    assert numbers(RECORD) == [eval(text, {"record": RECORD}) for text in destruct(Kept, "record")]


def test_columns_repeat_what_all_share_and_keep_what_each_has_of_its_own():
    record = RECORD._replace(strain=np.array([1.0, 2.0]), slip=np.arange(6.0).reshape(2, 3))
    table = columns(record, 2)
    assert table.shape == (2, 10)
    assert table[:, :4].tolist() == [[1.0, 0.0, 1.0, 2.0], [2.0, 3.0, 4.0, 5.0]]
    assert table[:, 4:].tolist() == [[5.0, 6.0, 7.0, 8.0, 9.0, 10.0]] * 2


@pytest.mark.parametrize(
    ("record", "said"),
    [
        (Listed, "Listed.values: .* use float or Vec"),
        (Words, "Words.name: "),
        (Plain, "Plain must be a NamedTuple"),
    ],
)
def test_what_cannot_be_kept_is_refused_by_its_name(record, said):
    with pytest.raises(PluginError, match=said):
        fields(record)

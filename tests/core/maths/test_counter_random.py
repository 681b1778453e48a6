"""Random numbers that depend on what they are for."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import kstest

from clast.maths.counter_random import philox, uniform

WORD = st.integers(0, 2**32 - 1)


class Signed64(int):
    """A number that refuses what does not fit into 64 bits with a sign: compiled, that is undefined."""


def checked(name):
    def operate(self, other):
        value = getattr(int, name)(self, other)
        assert -(2**63) <= value < 2**63, f"{name} needs more than 64 bits"
        return Signed64(value)

    return operate


for operation in ("add", "mul", "lshift", "rshift", "and", "xor", "or"):
    for reflected in ("", "r"):
        setattr(Signed64, f"__{reflected}{operation}__", checked(f"__{reflected}{operation}__"))


@pytest.mark.parametrize(
    ("counter", "key", "words"),
    [
        ((0xFFFFFFFF,) * 4, (0xFFFFFFFF,) * 2, (0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD)),
        (
            (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344),
            (0xA4093822, 0x299F31D0),
            (0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1),
        ),
    ],
)
def test_the_known_answers_of_the_random123_library_come_out(counter, key, words):
    assert philox(*counter, *key) == words


@given(words=st.tuples(*[WORD] * 6))
def test_no_step_overflows_64_bits_with_a_sign(words):
    assert philox(*map(Signed64, words)) == philox(*words)


@given(seed=WORD, owner=st.integers(0, 2**63 - 1), component=WORD, event=WORD)
def test_every_number_lies_strictly_between_0_and_1(seed, owner, component, event):
    assert 0.0 < uniform(seed, owner, component, event) < 1.0


def test_seed_owner_component_and_event_each_change_the_number():
    same = (1, 2, 3, 4)
    others = {uniform(*(x + 1 if k == changed else x for k, x in enumerate(same))) for changed in range(4)}
    assert len(others | {uniform(*same)}) == 5


@pytest.mark.parametrize("place", [0, 1, 3])
def test_numbers_drawn_along_each_index_are_uniform(place):
    index = [5, 6, 0, 7]
    drawn = []
    for k in range(2000):
        index[place] = k
        drawn.append(uniform(*index))
    assert kstest(drawn, "uniform").pvalue > 0.001

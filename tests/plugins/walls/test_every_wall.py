"""Every wall shape keeps to the contract of walls, on both sides where it has two; what a block does beyond it."""

from __future__ import annotations

import pytest

from clast.parts.wall import Wall
from clast.plugins.discovery import discover
from clast.testing.kit import try_part


def part(name: str) -> Wall:
    return discover().get("wall", name).part


def variants() -> list[tuple[str, dict[str, object]]]:
    """Return every wall, on both sides where it has two."""
    found: list[tuple[str, dict[str, object]]] = []
    for name in discover().names("wall"):
        sides = ("inside", "outside") if "side" in part(name).Params.model_fields else (None,)
        found += [(name, {} if side is None else {"side": side}) for side in sides]
    return found


each = pytest.mark.parametrize(("name", "changes"), variants(), ids=lambda value: str(value))


@each
def test_it_keeps_to_what_holds_for_every_wall(name, changes):
    outcomes = try_part(discover().get("wall", name), changes)
    assert [outcome for outcome in outcomes if not outcome.passed] == []


def test_a_block_without_a_volume_is_refused():
    with pytest.raises(ValueError, match="upper must be above lower along y"):
        part("block").Params(lower=[0, 1, 0], upper=[1, 1, 1])


@pytest.mark.parametrize(
    ("x", "normal"),
    [
        ((0.1, 0.5, 0.5), (1.0, 0.0, 0.0)),
        ((0.9, 0.5, 0.5), (-1.0, 0.0, 0.0)),
        ((0.5, 0.1, 0.5), (0.0, 1.0, 0.0)),
        ((0.5, 0.9, 0.5), (0.0, -1.0, 0.0)),
        ((0.5, 0.5, 0.1), (0.0, 0.0, 1.0)),
        ((0.5, 0.5, 0.9), (0.0, 0.0, -1.0)),
    ],
)
def test_what_is_inside_a_block_is_pushed_out_through_the_nearest_face(x, normal):
    block = part("block")
    near = block.nearest(block.shape(block.Params(lower=[0, 0, 0], upper=[1, 1, 1])), x)
    assert near.distance == pytest.approx(-0.1)
    assert near.normal == normal

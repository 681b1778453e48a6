"""Conditions on the curves: whether a scene has what they look at, and whether what they wait for can come."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from clast.config.beside import WallChoice
from clast.config.choice import Chosen
from clast.config.columns import known_columns
from clast.config.document import Problem
from clast.errors import KeyPath
from clast.plugins.nearest import suggestion

Walls = Mapping[str, WallChoice]


def blind_conditions(conditions: Iterable[tuple[KeyPath, Chosen]], walls: Walls, compressed: bool) -> Iterator[Problem]:
    """Yield a problem for each condition that looks at what a scene has not, or waits for what cannot come.

    Parameters
    ----------
    conditions : iterable of key path and Chosen
        The conditions of a scene, and where they stand.
    walls : mapping of str to WallChoice
    compressed : bool
        Whether the scene has a compression.
    """
    known = known_columns(walls, compressed)
    for path, each in conditions:
        if each.part.of_compression and not compressed:
            yield Problem(
                path,
                f"{each.name} looks at strain or stress, and the scene has no compression; add one with its two "
                "plates, or take another condition",
            )
        yield from _blind(walls, path, each, known)
        yield from _in_vain(walls, path, each)


def _blind(walls: Walls, path: KeyPath, condition: Chosen, known: set[str]) -> Iterator[Problem]:
    """Yield the first column that a condition looks at and the curves lack; where it names a wall, by its name."""
    own = f"stage_{path[1]}" if path[0] == "walls" else ""
    if own in condition.part.reads(condition.params):
        yield Problem(
            path, f"{condition.name} waits for the end of the stages that it ends one of; take another condition"
        )
        return
    lacking = [name for name in condition.part.reads(condition.params) if name not in known]
    if not lacking:
        return
    wall = getattr(condition.params, "wall", None)
    if isinstance(wall, str) and wall not in walls:
        yield Problem((*path, "wall"), f"there is no wall {wall!r}; {suggestion(wall, walls)}")
    elif isinstance(wall, str) and lacking[0].startswith("stage_"):
        text = f"the motion of walls.{wall} has no stage that ends; give its stages, each with 'until'"
        yield Problem((*path, "wall"), text)
    else:
        text = f"{condition.name} looks at {lacking[0]!r}, which the curves of this scene lack"
        yield Problem(path, f"{text}; {suggestion(lacking[0], known)}")


def _in_vain(walls: Walls, path: KeyPath, condition: Chosen) -> Iterator[Problem]:
    """Yield a problem for each wall that a condition waits for and whose last stage is never over."""
    for name in condition.part.waits_for(condition.params):
        wall = walls.get(name)
        if wall is None or not wall.staged or wall.stages[-1].until is not None or path[:2] == ("walls", name):
            continue
        last = len(wall.stages) - 1
        yield Problem(
            (*path, "wall"),
            f"{condition.name} can never hold: the last motion of walls.{name}, number {last} "
            f"({wall.stages[last].motion.name}), is never over; give walls.{name}.motion.{last} a condition 'until'",
        )

"""References: names in one section of a scene that must exist in another.

Checked on the data as written, so that these problems are told together with all others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations_with_replacement, product
from typing import Any

from clast.config.document import Problem
from clast.errors import KeyPath
from clast.plugins.nearest import suggestion


def check_references(data: Mapping[str, Any]) -> list[Problem]:
    """Find names of materials, walls and pairs of materials that do not exist, and sections that are missing.

    A part's parameter named ``material`` counts as the name of a material wherever it stands under
    ``particles`` or in a wall.
    """
    return [
        *_materials(data),
        *_compression(data),
        *_strain_at_the_end(data),
        *_pair_names(data),
        *_pairs_needed(data),
    ]


def _section(data: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    found = data.get(name)
    return found if isinstance(found, Mapping) else {}


def _unreadable(data: Mapping[str, Any], name: str) -> bool:
    """Tell whether a section is there but no mapping: that is told by itself, and nothing follows from it."""
    return name in data and not isinstance(data[name], Mapping)


def _materials(data: Mapping[str, Any]) -> Iterator[Problem]:
    if _unreadable(data, "materials"):
        return
    known = _section(data, "materials")
    for path, name in _materials_used(data):
        if name not in known:
            yield Problem(path, f"there is no material {name!r}; {suggestion(name, map(str, known))}")


def _materials_used(data: Mapping[str, Any]) -> Iterator[tuple[KeyPath, str]]:
    yield from _named_material(data.get("particles"), ("particles",))
    for name, wall in _section(data, "walls").items():
        if isinstance(wall, Mapping) and isinstance(wall.get("material"), str):
            yield ("walls", name, "material"), wall["material"]
    between = _section(_section(data, "bonds"), "between")
    listed = between.get("materials")
    for index, name in enumerate(listed if isinstance(listed, list | tuple) else ()):
        if isinstance(name, str):
            yield ("bonds", "between", "materials", index), name


def _named_material(value: Any, path: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    if isinstance(value, Mapping):
        for key, inner in value.items():
            if key == "material" and isinstance(inner, str):
                yield (*path, key), inner
            else:
                yield from _named_material(inner, (*path, key))
    elif isinstance(value, list | tuple):
        for index, inner in enumerate(value):
            yield from _named_material(inner, (*path, index))


def _compression(data: Mapping[str, Any]) -> Iterator[Problem]:
    walls = _section(data, "walls")
    compression = _section(data, "compression")
    side = compression.get("side")
    sides = side if isinstance(side, list | tuple) else (side,)
    for key, name in (
        *((key, compression.get(key)) for key in ("upper", "lower")),
        *(("side", name) for name in sides),
    ):
        if isinstance(name, str) and name not in walls and not _unreadable(data, "walls"):
            yield Problem(("compression", key), f"there is no wall {name!r}; {suggestion(name, walls)}")
    if "upper" in compression and compression["upper"] == compression.get("lower"):
        yield Problem(("compression", "lower"), "upper and lower must be two different walls")
    if any(name is not None and name in (compression.get("upper"), compression.get("lower")) for name in sides):
        yield Problem(("compression", "side"), "the side must be another wall than upper and lower")
    twice = [name for k, name in enumerate(sides) if name is not None and name in sides[:k]]
    if twice:
        yield Problem(("compression", "side"), f"{twice[0]!r} is named twice; name every wall around once")


def _strain_at_the_end(data: Mapping[str, Any]) -> Iterator[Problem]:
    end, domain = _section(_section(data, "time"), "end"), _section(_section(data, "boundaries"), "domain")
    measured = _section(data, "compression") or domain.get("strain_rate") is not None
    if end.get("strain") is not None and not measured and not _unreadable(data, "compression"):
        yield Problem(
            ("time", "end", "strain"),
            "a strain needs the section 'compression', which says how it is measured, or a periodic box that "
            "'boundaries.domain.strain_rate' stretches; give one of them, or another end",
        )


def _pair_names(data: Mapping[str, Any]) -> Iterator[Problem]:
    known = [str(name) for name in _section(data, "materials")]
    names = {frozenset(pair): "-".join(pair) for pair in combinations_with_replacement(known, 2)}
    spelt: dict[str, set[frozenset[str]]] = {}
    for a, b in product(known, known):
        spelt.setdefault(f"{a}-{b}", set()).add(frozenset((a, b)))
    seen: dict[frozenset[str], str] = {}
    for name in _section(_section(data, "contacts"), "pairs"):
        path = ("contacts", "pairs", name)
        if name == "default":
            continue
        if name not in spelt:
            allowed = [*names.values(), "default"]
            yield Problem(path, f"not a pair of materials, 'first-second'; {suggestion(str(name), allowed)}")
            continue
        pair, *others = sorted(spelt[name], key=sorted)
        if others:
            meant = " or ".join(" and ".join(map(repr, sorted(each))) for each in (pair, *others))
            yield Problem(path, f"may mean {meant}; write one of these materials without '-'")
        elif pair in seen:
            yield Problem(path, f"the same pair is given as {seen[pair]!r}; remove one of them")
        else:
            seen[pair] = name


def _pairs_needed(data: Mapping[str, Any]) -> Iterator[Problem]:
    contacts = data.get("contacts")
    if not isinstance(contacts, Mapping) or _unreadable(contacts, "pairs"):
        return
    given = _section(contacts, "pairs")
    if "default" in given:
        return
    grains = sorted({name for _, name in _named_material(data.get("particles"), ())})
    walls = sorted({str(wall.get("material")) for wall in _section(data, "walls").values() if _is_wall(wall)})
    needed = [
        *combinations_with_replacement(grains, 2),
        *((grain, wall) for grain in grains for wall in walls),
    ]
    for first, second in dict.fromkeys(needed):
        if f"{first}-{second}" not in given and f"{second}-{first}" not in given:
            where = ("contacts", "pairs") if "pairs" in contacts else ("contacts",)
            text = f"'{first}-{second}' is needed, or 'default' for all pairs that are not listed"
            yield Problem(where, text)


def _is_wall(wall: Any) -> bool:
    return isinstance(wall, Mapping) and isinstance(wall.get("material"), str)

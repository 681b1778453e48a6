"""The page of a part: what its declaration and its docstring say, and a picture of how it answers."""

from __future__ import annotations

import inspect
import re
from collections.abc import Sequence
from typing import Any, NamedTuple

from clast.config.describe import parameters
from clast.engine.records import fields
from clast.plugins.registered import Registered
from sitebuild import ROOT
from sitebuild.docstring import markdown, plain, sections
from sitebuild.scenes import scenes_with
from sitebuild.snippet import snippet


class Picture(NamedTuple):
    """A picture in the folder of a part's page, with the sentence below it; no file where the sentence says why."""

    file: str
    caption: str


STATES = {"bond_model": "State", "bond_kinematics": "State", "contact_law": "History"}
"""Attribute that holds what a part of a kind remembers."""


def part_page(entry: Registered, picture: Picture | None) -> str:
    """Return the Markdown of a part's page."""
    texts = [
        f"# {entry.name}",
        f"**{entry.kind.replace('_', ' ').capitalize()}**: {plain(entry.part.summary)}.",
        *(markdown(section) for section in sections(entry.part.Params) if section.text),
        *_response(picture),
        "## Parameters",
        _parameters(entry),
        *_memory(entry),
        *_modes(entry),
        "## In a scene",
        snippet(entry),
        *_ready_scene(entry),
        "## File",
        _file(entry),
    ]
    return "\n\n".join(texts) + "\n"


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    r"""Return a Markdown table.

    >>> print(table(["a", "b"], [["1", "x | y"]]))
    | a | b |
    |---|---|
    | 1 | x \| y |
    """
    lines = [head, ["---"] * len(head), *([cell.replace("|", "\\|") for cell in row] for row in rows)]
    return (
        "\n".join("| " + " | ".join(line) + " |" for line in lines).replace("| --- ", "|---").replace("--- |", "---|")
    )


def _response(picture: Picture | None) -> list[str]:
    if picture is None:
        return []
    shown = [f"![Response of the part]({picture.file})"] if picture.file else []
    return ["## Response", *shown, picture.caption]


def _parameters(entry: Registered) -> str:
    listed = parameters(entry.part.Params)
    if not listed:
        return "It has none."
    head = ["parameter", "unit or kind", "default", "bounds", "meaning"]
    rows = [
        [f"`{each.name}`", plain(each.kind), each.default, plain(each.bounds), plain(each.meaning)] for each in listed
    ]
    return table(head, rows)


def _memory(entry: Registered) -> list[str]:
    """Return what a law remembers; one without history says so, other parts have no such section."""
    if entry.kind not in STATES:
        return []
    record = getattr(entry.part, STATES[entry.kind])
    more = " Options may ask for more." if getattr(entry.part, "variant", None) else ""
    if record is None:
        return ["## What it remembers", f"Nothing.{more}"]
    rows = [
        [f"`{each.name}`", {1: "number", 3: "vector"}.get(each.size, f"{each.size} numbers")] for each in fields(record)
    ]
    return ["## What it remembers", plain(inspect.getdoc(record) or "") + more, table(["slot", "kind"], rows)]


def _modes(entry: Registered) -> list[str]:
    modes: tuple[str, ...] = getattr(entry.part, "modes", ())
    more = " Options may add others." if getattr(entry.part, "variant", None) else ""
    return ["## Ways to break", ", ".join(f"`{mode}`" for mode in modes) + "." + more] if modes else []


def _ready_scene(entry: Registered) -> list[str]:
    """Return a link to the scene that shows a part, or to others that use it; writers are chosen for any scene."""
    scenes = [file.relative_to(ROOT).as_posix() for file in scenes_with(entry)]
    if not scenes or entry.kind == "writer":
        return []
    linked = ", ".join(f"[{scene}](../../{scene})" for scene in scenes)
    shows = "A whole scene that shows it" if scenes[0].startswith("configs/parts/") else "Scenes that use it"
    return [f"{shows}: {linked}."]


def _file(entry: Registered) -> str:
    text = f"`{module(entry)}`, from {plain(str(entry.source))}."
    if entry.file is None:
        return text
    code = re.sub("^", "    ", entry.file.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return f'{text}\n\n??? note "{entry.file.name}"\n\n    ````python\n{code}\n    ````'


def module(entry: Registered) -> str:
    """Return the name of the module that declares a part."""
    declared: Any = entry.part.Params
    return str(declared.__module__)

"""``clast plugins check``: try parts on the contract of their kind, and measure what laws cost."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict
from typing import Any

import yaml
from rich.console import Console
from rich.markup import escape

from clast.config.examples import example
from clast.config.yaml_loader import parse_value
from clast.errors import PluginError
from clast.parts.params import Params
from clast.plugins.discovery import discover, parts_of
from clast.plugins.nearest import suggestion
from clast.plugins.registered import Registered
from clast.testing.claim import Outcome, try_claims
from clast.testing.kit import claims_of, remarks_on
from clast.testing.speed import BESIDE, Cost, cost

Changes = Mapping[str, Mapping[str, Any]]


def check(what: str, changes: Sequence[str] = (), speed: bool = True, as_json: bool = False) -> bool:
    """Try parts, print what held and what did not, and tell whether all did.

    Parameters
    ----------
    what : str
        A file, or the name of an installed part, plugin or distribution.
    changes : sequence of str
        ``PART.KEY=VALUE``: what to try a part with, beside its examples.
    speed : bool
        Whether to measure laws in a compiled loop, beside Clast's own.

    Raises
    ------
    PluginError
        Nothing is there of that name, the file cannot be loaded, or a change names no part of it.
    """
    entries = parts_of(what)
    given = _by_part(changes, entries)
    console = Console(highlight=False, soft_wrap=True)
    told = []
    for entry in entries:
        if not as_json:
            console.print(f"[bold]{entry.name}[/] ({entry.kind.replace('_', ' ')}, {entry.source})")
        told.append(_check_part(entry, given.get(entry.name, {}), speed, None if as_json else console))
    if as_json:
        print(json.dumps(told, indent=2, ensure_ascii=False))
    return all(part["passed"] for part in told)


def _check_part(entry: Registered, changes: Mapping[str, Any], speed: bool, console: Console | None) -> dict[str, Any]:
    """Return what became of one part; print it as it comes."""
    try:
        params = example(entry.part.Params, changes)
    except PluginError as error:
        if console:
            console.print(f"  [red]not tried[/]  {escape(str(error))}")
        return {"kind": entry.kind, "name": entry.name, "passed": False, "problem": str(error), "claims": []}
    outcomes: list[Outcome] = []
    for outcome in try_claims(claims_of(entry, params)):
        if console:
            _print(console, outcome, {each.problem for each in outcomes})
        outcomes.append(outcome)
    passed, remarks = all(outcome.passed for outcome in outcomes), remarks_on(entry)
    if console:
        for remark in remarks:
            console.print(f"  [yellow]remark[/]  {escape(remark)}")
    costs = _costs(entry, params, console) if speed and passed and entry.kind in BESIDE else []
    return {
        "kind": entry.kind,
        "name": entry.name,
        "passed": passed,
        "problem": "",
        "claims": [asdict(outcome) for outcome in outcomes],
        "remarks": remarks,
        "costs": [each._asdict() for each in costs],
    }


def _print(console: Console, outcome: Outcome, before: Collection[str]) -> None:
    console.print(f"  [green]passed[/]  {outcome.says}" if outcome.passed else f"  [red]FAILED[/]  {outcome.says}")
    if outcome.problem:
        console.print(f"          {'as above' if outcome.problem in before else escape(outcome.problem)}")


def _costs(entry: Registered, params: Params, console: Console | None) -> list[Cost]:
    """Return what a law costs, and what Clast's own do beside it."""
    registry = discover()
    own = [registry.get(entry.kind, name) for name in BESIDE[entry.kind] if name != entry.name]
    if console:
        console.print("  compiling, to measure what it costs ...")
    costs = [cost(entry, params), *(cost(each, example(each.part.Params)) for each in own)]
    if console:
        vectors = "works on vectors" if costs[0].vectorised else "does [red]not[/] work on vectors: look for branches"
        console.print(f"  speed   the compiled loop {vectors}")
        item = "bond" if entry.kind == "bond_model" else "touching pair"
        for each in costs:
            console.print(f"          {each.name}: {each.law:.1f} ns a {item}; {each.whole:.1f} ns with all its sweep")
    return costs


def _by_part(changes: Sequence[str], entries: Sequence[Registered]) -> Changes:
    """Return the changes by part and key."""
    found: dict[str, dict[str, Any]] = {}
    names = {entry.name for entry in entries}
    for change in changes:
        path, equals, value = change.partition("=")
        part, dot, key = path.strip().partition(".")
        if not (equals and dot and key):
            raise PluginError(f"--set {change}: PART.KEY=VALUE is needed, such as --set {min(names)}.KEY=1")
        if part not in names:
            raise PluginError(f"--set {change}: no part of these is named {part!r}; {suggestion(part, names)}")
        found.setdefault(part, {})[key] = _read(value, change)
    return found


def _read(text: str, change: str) -> Any:
    try:
        return parse_value(text)
    except yaml.YAMLError as error:
        raise PluginError(f"--set {change}: the value is not valid YAML: {error}") from None

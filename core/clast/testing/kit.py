"""The kit: which claims a part of each kind is tried on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from clast.config.describe import parameters
from clast.config.examples import example
from clast.plugins.registered import Registered
from clast.testing.claim import Claim, Outcome, try_claims


def claims_of(entry: Registered, params: Any) -> list[Claim]:
    """Return what a part with parameters must keep to; every kind has a module of its name here."""
    make: Callable[[Any, Any], list[Claim]] = import_module(f"clast.testing.{entry.kind}").claims
    return make(entry.part_for(params), params)


def remarks_on(entry: Registered) -> list[str]:
    """Return what no claim forbids, but is hardly meant so: parameters nobody describes, a state that nothing moves."""
    found, bare = [], [each.name for each in parameters(entry.part.Params) if not each.meaning]
    if bare:
        found.append(
            f"no description of {', '.join(bare)}: with Field(description=...), messages, 'clast plugins show', the "
            "schema for editors and the page of the part say what to give"
        )
    if entry.kind == "bond_model" and entry.part.State is not None and not (entry.part.flow or entry.part.on_event):
        found.append("State stays as it is at the start: neither 'flow' nor 'on_event' is given to the model")
    return found


def try_part(entry: Registered, changes: Mapping[str, Any] | None = None) -> list[Outcome]:
    """Try everything that holds for parts of its kind on one part.

    Parameters
    ----------
    changes : mapping, optional
        Parameters as a user writes them; of others the examples that they state, or their defaults.

    Raises
    ------
    PluginError
        A parameter has neither an example nor a default.
    """
    return list(try_claims(claims_of(entry, example(entry.part.Params, changes))))


def assert_contract(file: str | Path, changes: Mapping[str, Mapping[str, Any]] | None = None) -> None:
    """Try every part of a plugin file, in a test of the plugin.

    Parameters
    ----------
    file : path
        The plugin.
    changes : mapping, optional
        Parameters by the name of their part, where the examples that they state do not do.

    Raises
    ------
    AssertionError
        A claim does not hold; the message holds the smallest case found.
    PluginError
        The file is no plugin.
    """
    from clast.plugins.discovery import parts_of

    problems = [
        f"{entry.name}: {outcome.says}: {outcome.problem}"
        for entry in parts_of(file)
        for outcome in try_part(entry, (changes or {}).get(entry.name))
        if not outcome.passed
    ]
    assert not problems, "\n".join(problems)

"""Pieces of the text of a scene's slots: bindings and functions as source."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from clast.engine.records import members
from clast.engine.sources import address


def bind(name: str, item: Callable[..., Any] | type | None) -> str:
    """Return the line that gives a name to a function or record of a part, or to nothing."""
    if item is None:
        return f"{name} = nothing"
    if isinstance(item, type):
        return f"{name} = import_module({item.__module__!r}).{item.__qualname__}"
    module, qualified = address(item)
    return f"{name} = of_part(import_module({module!r}).{qualified})"


def bind_record(name: str, record: type | None) -> str:
    """Bind a record's type, and the types of the records inside it under the names that ``construct`` gives them."""
    lines = [bind(name, record)]
    for field, member in members(record).items() if record is not None else ():
        if not isinstance(member, int):
            lines.append(bind_record(f"{name}_{field}", member))
    return "\n".join(lines)


def function(name: str, arguments: str, body: str | Sequence[str]) -> str:
    """Return the source of an inlined function."""
    lines = [body] if isinstance(body, str) else list(body) or ["pass"]
    return "\n".join(["", "@inlined", f"def {name}({arguments}):", *(f"    {line}" for line in lines)])


def dispatch(name: str, arguments: str, branches: Sequence[str], otherwise: str, first: Sequence[str] = ()) -> str:
    """Return a function that picks a branch by ``kind``; the last branch needs no test. Some lines may come first."""
    lines = [line for k, text in enumerate(branches[:-1]) for line in (f"if kind == {k}:", f"    return {text}")]
    return function(name, arguments, [*first, *lines, f"return {branches[-1] if branches else otherwise}"])

"""Declaration: what a part must bring to be registered, whatever its kind."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from clast.errors import PluginError
from clast.parts.params import Params

NAME = re.compile(r"[a-z][a-z0-9_]*")
NAME_RULE = "small letters, digits and _ only, a letter first"


def check_declaration(kind: str, name: str, part: Any) -> None:
    """Refuse a part that is badly named or incomplete.

    Raises
    ------
    PluginError
        The name is badly spelt, the part lacks ``summary`` or ``Params``, or what should be a function is none.
    """
    if not NAME.fullmatch(name):
        raise PluginError(f"{name!r} is not a name for a {kind}: {NAME_RULE}")
    declared = getattr(part, "Params", None)
    if not (isinstance(declared, type) and issubclass(declared, Params)):
        raise PluginError(f"{kind} {name!r} needs 'Params', a subclass of clast.parts.params.Params")
    if not isinstance(getattr(part, "summary", None), str):
        raise PluginError(f"{kind} {name!r} needs 'summary', one line of text")
    for field, given in _not_functions(part):
        raise PluginError(f"{kind} {name!r} needs '{field}' to be a function; given {given!r}")


def _not_functions(part: Any) -> Iterator[tuple[str, Any]]:
    """Yield the fields of a part that are declared as functions and hold something else."""
    for field in fields(part) if is_dataclass(part) else ():
        declared, given = str(field.type), getattr(part, field.name)
        if declared.startswith("Callable") and not callable(given) and not (given is None and "None" in declared):
            yield field.name, given

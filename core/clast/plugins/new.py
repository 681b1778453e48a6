"""New parts: a starting file of a kind under a name of one's own."""

from __future__ import annotations

from importlib.resources import files
from keyword import iskeyword
from pathlib import Path

from clast.errors import PluginError
from clast.plugins.declaration import NAME, NAME_RULE
from clast.plugins.discovery import discover

STARTER = "starter"


def starter_text(kind: str, name: str) -> str:
    """Return the text of a plugin with one part of a kind.

    Raises
    ------
    PluginError
        The name is badly spelt.

    Examples
    --------
    >>> print(starter_text("wall", "my_floor").splitlines()[0])
    \"\"\"My floor: a half-space below a level.\"\"\"
    """
    if not NAME.fullmatch(name) or iskeyword(name):
        raise PluginError(f"{name!r} is not a name for a {kind.replace('_', ' ')}: {NAME_RULE}, no word of Python")
    text = files("clast.plugins.starters").joinpath(f"{kind}.py").read_text(encoding="utf-8")
    text = text.replace("Starter:", f"{name.replace('_', ' ').capitalize()}:", 1)
    camel = "".join(word.capitalize() for word in name.split("_"))
    return text.replace(STARTER.capitalize(), camel).replace(STARTER, name)


def write_starter(kind: str, name: str, path: Path) -> Path:
    """Write a plugin with one part of a kind; never over a file.

    Raises
    ------
    PluginError
        The name is badly spelt or taken, or the file is there.
    """
    text = starter_text(kind, name)
    if name in discover().names(kind):
        raise PluginError(f"there is a {kind.replace('_', ' ')} named {name!r} already; take another name")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise PluginError(f"{path}: is there already; give another file with -o, or another name") from None
    except OSError as error:
        raise PluginError(f"{path}: {error.strerror or error}") from None
    return path

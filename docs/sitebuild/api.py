"""Pages of the programming interface: what to document; mkdocstrings reads the docstrings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib import import_module
from importlib.util import find_spec
from pkgutil import iter_modules

import clast

PACKAGES = {
    "parts": ("What a part offers", "clast.parts"),
    "maths": ("Vectors, rotations, random numbers", "clast.maths"),
    "granular": ("Beds of grains", "clast.granular"),
    "testing": ("Checks for your own parts", "clast.testing"),
}
RESULTS = ("clast.session.Outcome", "clast.results.run", "clast.results.contacts")
WRITING = ("clast.plugins.hookspec", "clast.plugins.registry", "clast.config.quantities", "clast.errors")


def api_pages() -> Iterator[tuple[str, str]]:
    """Yield name and Markdown of every page."""
    yield "index", _page("API", "What `import clast` offers.", exported())
    yield "results", _page("Results", "What a run leaves behind, and how to read it.", RESULTS)
    for name, (title, package) in PACKAGES.items():
        if find_spec(package) is not None:
            yield name, _page(title, f"The modules of `{package}`.", modules(package))
    yield "plugins", _page("Plugins", "How parts are registered, declared and refused.", WRITING)


def exported() -> list[str]:
    """Return the full names of what ``clast`` exports: functions and classes, each where it is defined."""
    found = (getattr(clast, name) for name in sorted(clast.__all__))
    return [f"{each.__module__}.{each.__qualname__}" for each in found if hasattr(each, "__qualname__")]


def modules(package: str) -> list[str]:
    """Return the full names of the public modules of a package, the package itself first where it defines names."""
    home = import_module(package)
    inside = sorted(found.name for found in iter_modules(home.__path__) if not found.name.startswith("_"))
    return [*([package] if hasattr(home, "__all__") else []), *(f"{package}.{name}" for name in inside)]


def _page(title: str, sentence: str, names: Sequence[str]) -> str:
    return "\n\n".join([f"# {title}", sentence, *(f"::: {name}" for name in names)]) + "\n"

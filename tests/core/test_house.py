"""The house: imports lead one way, from what is general to what runs it, without a circle."""

from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import clast
import clast_plugins
import clast_viz

ROOTS = {package.__name__: Path(str(package.__file__)).parent for package in (clast, clast_plugins, clast_viz)}


def module_of(root: str, file: Path) -> str:
    parts = file.relative_to(ROOTS[root]).with_suffix("").parts
    return ".".join((root, *(parts[:-1] if parts[-1] == "__init__" else parts)))


MODULES = {module_of(root, file): file for root, folder in ROOTS.items() for file in folder.rglob("*.py")}


def imported(module: str) -> set[str]:
    """Return the modules that one names, wherever in its text: inside functions and for types alone, too."""
    found = set()
    for node in ast.walk(ast.parse(MODULES[module].read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            package = module if MODULES[module].name == "__init__.py" else module.rpartition(".")[0]
            above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            source = ".".join([*above, *([node.module] if node.module else [])])
            found |= {source, *(f"{source}.{alias.name}" for alias in node.names)}
    return found & MODULES.keys() - {module}


def test_no_file_imports_itself_through_others() -> None:
    # a package's face only hands names on, when they are first asked for
    graph = {each: imported(each) for each in MODULES if MODULES[each].name != "__init__.py"}
    try:
        order = tuple(TopologicalSorter(graph).static_order())
    except CycleError as error:
        pytest.fail(f"a circle of imports: {' <- '.join(error.args[1])}")
    assert order.index("clast.maths.vec3") < order.index("clast.simulation") < order.index("clast.cli")


@pytest.mark.parametrize(
    ("room", "above"),
    [
        ("clast.maths", ["clast.parts", "clast.config", "clast.engine", "clast.scene", "clast.results"]),
        ("clast.engine", ["clast.scene", "clast.stability", "clast.simulation", "clast.results", "clast.commands"]),
        ("clast.scene", ["clast.stability", "clast.simulation", "clast.soundness", "clast.results", "clast.commands"]),
        ("clast.stability", ["clast.simulation", "clast.soundness", "clast.results", "clast.commands"]),
        ("clast.soundness", ["clast.simulation", "clast.results", "clast.commands"]),
    ],
)
def test_a_room_takes_nothing_from_those_above_it(room: str, above: list[str]) -> None:
    upwards = {
        f"{each} takes {taken}"
        for each in MODULES
        if each.startswith(f"{room}.")
        for taken in imported(each)
        if any(taken == name or taken.startswith(f"{name}.") for name in above)
    }
    assert upwards == set()

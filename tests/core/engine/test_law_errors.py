"""Whatever a law's author writes: what cannot be compiled, or raises, is told with the law's file and line."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest

from clast.engine.assemble import let_compiled_code_call
from clast.engine.compiler import compiled
from clast.engine.entry import Entry
from clast.engine.law_errors import law_files
from clast.errors import PluginError

HEAD = """\
import numpy as np
from clast.maths.vec3 import dot
TABLE = [1.0, 2.0]
def from_text(x):
    return float(str(x))
def fall(x):
    return fall(x - 1.0) + fall(0.5 * x)
def law(x):
"""
KERNEL = """\
from a_law import law
def kernel(x):
    return law(x)
"""


@pytest.fixture
def law(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Entry]:
    """Return a function that makes an entry point which calls a law with the body given."""

    def entry(body: str) -> Entry:
        (tmp_path / "a_law.py").write_text(HEAD + body)
        (tmp_path / "a_kernel.py").write_text(KERNEL)
        a_law, a_kernel = (imported(tmp_path / f"{name}.py", monkeypatch) for name in ("a_law", "a_kernel"))
        let_compiled_code_call([a_law.law])
        return Entry(compiled(a_kernel.kernel), tmp_path / "lock", law_files([a_law.law]))

    return entry


def imported(file: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """Import a file as a module for the time of one test."""
    spec = spec_from_file_location(file.stem, file)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    monkeypatch.setitem(sys.modules, file.stem, module)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("body", "line", "reason"),
    [
        ("    return float(str(x))\n", 9, "ValueError: could not convert string to float"),
        ("    return from_text(x)\n", 5, "ValueError: could not convert string to float"),
        ("    return fall(x)\n", 7, "compiler re-entrant to the same function signature"),
        ("    return TABLE[0] * x\n", 9, "The use of a reflected list"),
        ("    s = f'{x:.3f}'\n    return len(s) * x\n", 9, "format spec in f-strings not supported"),
        ("    return sum(c * x for c in (1.0, 2.0))\n", 9, "The use of yield in a closure is unsupported"),
        ("    return dot(x, x)\n", 9, "No implementation of function Function(<built-in function getitem>) found for"),
        ("    print(x, end='')\n    return x\n", 9, "print() function implementation does not support keyword"),
        (
            "    y = x\n    try:\n        y = 1.0 / x\n    except ZeroDivisionError:\n        y = 0.0\n    return y\n",
            12,
            "Exception matching is limited",
        ),
        ("    from math import sqrt\n    return sqrt(x)\n", 9, "Use of unsupported opcode (IMPORT_NAME)"),
        ("    return x.length\n", 9, "Unknown attribute 'length' of type float64"),
    ],
)
def test_a_law_that_cannot_be_compiled_is_told_with_its_line(
    law: Callable[[str], Entry], tmp_path: Path, body: str, line: int, reason: str
) -> None:
    with pytest.raises(PluginError) as told:
        law(body)(1.5)
    message = str(told.value)
    assert message.startswith(f"{tmp_path / 'a_law.py'}:{line}: cannot be compiled: ")
    assert reason in message
    assert len(message.splitlines()) == 1


def test_what_a_law_gives_in_plain_python_is_told_beside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a_law.py").write_text(HEAD + "    return float(str(x))\n")
    (tmp_path / "a_kernel.py").write_text(KERNEL)
    a_law, a_kernel = (imported(tmp_path / f"{name}.py", monkeypatch) for name in ("a_law", "a_kernel"))
    let_compiled_code_call([a_law.law])
    laws = law_files([a_law.law], {a_law.law: a_law.law(1.5)})
    with pytest.raises(
        PluginError, match=r"a_law.py:9: cannot be compiled: .* In plain Python 'law' gives 1.5. Laws may"
    ):
        Entry(compiled(a_kernel.kernel), tmp_path / "lock", laws)(1.5)


@pytest.mark.parametrize(
    ("body", "place", "reason"),
    [
        ("    if x > 1.0:\n        raise ValueError('too long')\n    return x\n", ":10", "ValueError: too long"),
        ("    assert x < 1.0, 'too long'\n    return x\n", ":9", "AssertionError: too long"),
        ("    return np.ones(4).reshape(int(x), 3)[0, 0]\n", "", "ValueError: total size of new array"),
    ],
)
def test_a_compiled_law_that_raises_is_told(
    law: Callable[[str], Entry], tmp_path: Path, body: str, place: str, reason: str
) -> None:
    entry = law(body)
    with pytest.raises(PluginError) as told:
        entry(1.5)
    assert f"{tmp_path / 'a_law.py'}{place}: raised {reason}" in str(told.value)


def test_what_the_disk_refuses_is_no_matter_of_the_law(law: Callable[[str], Entry], tmp_path: Path) -> None:
    entry = law("    return x\n")
    entry.function.compile = refuse
    with pytest.raises(OSError, match="full"):
        entry(1.5)


def refuse(_: object) -> None:
    """Stand for a cache on a full disk."""
    raise OSError("full")

"""Sources of a part: what it consists of, and a digest that changes whenever any of it does."""

from __future__ import annotations

import importlib
import math
import sys
from pathlib import Path
from types import FunctionType

import numpy as np
import pytest

from clast import load as load_scene
from clast.engine.sources import address, digest, reachable, source_files
from clast.errors import PluginError

CONFIGS = Path(__file__).parents[3] / "configs"
HELPER = "def f(x):\n    return {stiffness} * x\n"
FACTOR = "FACTOR = {factor}\n\n\ndef g(x):\n    return x\n"
LAW = """\
import numpy as np
from math import sqrt

import digest_factor as factors
from digest_factor import FACTOR
from digest_helper import f


class Record(tuple):
    pass


def inner(x):
    return f(x) + sqrt(x)


def load(x):
    return inner(x) + FACTOR


def energy(x):
    return factors.g(x) + np.abs(x)


def even(x):
    return odd(x - 1) if x else True


def odd(x):
    return even(x - 1) if x else False


def outer(x):
    def within(y):
        return f(y)

    return within(x)
"""
NAMES = ("digest_helper", "digest_factor", "digest_law")


@pytest.fixture
def law(tmp_path, monkeypatch):
    """Return a function that writes a law with its helpers and imports it anew."""
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(sys, "dont_write_bytecode", True)

    def write(stiffness: float = 2.0, factor: float = 1.0, text: str = LAW, helper: str = HELPER):
        sources = (helper.format(stiffness=stiffness), FACTOR.format(factor=factor), text)
        for name, source in zip(NAMES, sources, strict=True):
            (tmp_path / f"{name}.py").write_text(source)
            sys.modules.pop(name, None)
        importlib.invalidate_caches()
        return importlib.import_module("digest_law")

    yield write
    for name in NAMES:
        sys.modules.pop(name, None)


def names(functions) -> list[str]:
    return [function.__name__ for function in reachable(functions)]


def test_a_function_brings_what_it_calls_callees_first_each_once(law):
    module = law()
    assert names([module.load]) == ["f", "inner", "load"]
    assert names([module.load, module.inner, module.load]) == ["f", "inner", "load"]


def test_functions_of_a_module_used_by_its_name_are_found_and_those_of_numpy_are_not(law):
    assert names([law().energy]) == ["g", "energy"]


def test_functions_that_call_each_other_do_not_hang_the_search(law):
    assert sorted(names([law().even])) == ["even", "odd"]


def test_what_a_nested_function_calls_is_found_too(law):
    assert names([law().outer]) == ["f", "outer"]


def test_the_files_of_helpers_belong_to_the_sources(law, tmp_path):
    files = {path.name for path in source_files([law().load])}
    assert files == {"digest_law.py", "digest_helper.py"}


def test_the_files_of_what_is_imported_late_belong_to_the_sources_and_are_not_loaded_for_that(tmp_path, monkeypatch):
    package = tmp_path / "late_package"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "law.py").write_text(
        "def load(x):\n    from late_package.kernel import f\n    from . import table\n    import json\n    f(x)\n"
    )
    for helper in ("kernel", "table"):
        (package / f"{helper}.py").write_text("raise RuntimeError('loaded')\n")
    monkeypatch.syspath_prepend(tmp_path)
    files = source_files([importlib.import_module("late_package.law").load])
    assert {path.name for path in files} == {"__init__.py", "law.py", "kernel.py", "table.py"}


def test_the_sources_of_every_part_are_files_of_plugins_and_of_clast_with_their_kernels():
    names = {}
    for chosen in load_scene(CONFIGS / "crush_grain.yaml").chosen:
        functions = [each for each in vars(chosen.part).values() if isinstance(each, FunctionType)]
        files = source_files(functions)
        assert all(path.is_relative_to(CONFIGS.parent) for path in files)
        names[chosen.name] = {path.name for path in files}
    assert {"linked_cells_kernel.py", "grids_kernel.py"} <= names["auto"]
    assert {"relax.py", "overlap_kernel.py"} <= names["flattened_agglomerate"]


def test_the_digest_is_the_same_for_the_same_sources(law):
    assert digest([law().load]) == digest([law().load])


def test_an_edited_law_has_a_new_digest(law):
    before = digest([law().load])
    assert digest([law(text=LAW.replace("+ FACTOR", "- FACTOR")).load]) != before


def test_an_edited_helper_that_the_law_imports_changes_its_digest(law):
    before = digest([law(stiffness=2.0).load])
    assert digest([law(stiffness=3.0).load]) != before
    assert digest([law(stiffness=2.0).load]) == before


def test_an_imported_number_that_changes_changes_the_digest(law):
    before = digest([law(factor=1.0).load])
    assert digest([law(factor=2.0).load]) != before


def test_a_constant_of_a_module_used_by_its_name_counts_too(law):
    text = LAW.replace("factors.g(x)", "factors.FACTOR * x")
    assert digest([law(factor=1.0, text=text).energy]) != digest([law(factor=2.0, text=text).energy])


def test_an_imported_array_that_changes_changes_the_digest(law):
    """Compiled code keeps the values a global array had when it was compiled."""

    def told(value: str) -> str:
        text = LAW.replace("+ FACTOR", "+ FACTOR[0]")
        return digest([law(factor=f"__import__('numpy').array([{value}])", text=text).load])

    assert told("1.0") == told("1.0")
    assert told("1.0") != told("2.0")


def test_a_helper_that_its_author_compiles_counts_like_a_plain_one(law):
    compiled = "from numba import njit\n\n\n@njit\ndef f(x):\n    return {stiffness} * x\n"
    before = digest([law(stiffness=2.0, helper=compiled).load])
    assert digest([law(stiffness=3.0, helper=compiled).load]) != before


def test_further_texts_belong_to_the_digest(law):
    load = law().load
    assert len({digest([load]), digest([load], "a"), digest([load], "b")}) == 3


def test_a_top_level_function_is_addressed_by_module_and_name(law):
    assert address(law().load) == ("digest_law", "load")


def inside():
    def load(x):
        return x

    return load


@pytest.mark.parametrize("function", [lambda x: x, inside(), math.sqrt, np.abs], ids=["lambda", "nested", "C", "ufunc"])
def test_what_the_loop_cannot_import_is_refused_in_plain_words(function):
    with pytest.raises(PluginError, match=r"not a function at the top level of a file; write it there with 'def'"):
        address(function)


def test_the_refusal_of_a_lambda_names_its_file():
    with pytest.raises(PluginError, match=r"test_sources: .*<lambda>.* is not a function"):
        address(lambda x: x)

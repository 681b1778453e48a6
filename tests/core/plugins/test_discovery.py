"""Finding plugins, and what happens when one is broken."""

import sys
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import pytest

from clast.errors import PluginError
from clast.parts.params import Params
from clast.plugins.discovery import load_entry_points, load_file
from clast.plugins.hookspec import hookimpl
from clast.plugins.registry import Registry


@dataclass(frozen=True)
class FakeEntryPoint:
    name: str
    load: Any
    dist: Any = field(default_factory=lambda: SimpleNamespace(name="other", version="2.0"))
    value: str = "somewhere"


def plugin(*names, api=1):
    @hookimpl
    def clast_register(registry):
        for name in names:
            registry.wall(name, SimpleNamespace(summary="A wall.", Params=Params))

    return SimpleNamespace(clast_register=clast_register, CLAST_API=api)


def point(name, *walls, dist="other", api=1):
    return FakeEntryPoint(name, lambda: plugin(*walls, api=api), SimpleNamespace(name=dist, version="2.0"))


def loaded(*points, choice=None):
    registry = Registry()
    load_entry_points(points, choice, registry)
    return registry


def broken():
    raise ImportError("no such module: fancy")


def test_plugins_are_loaded_with_their_distribution_and_version():
    registry = loaded(point("a", "plane", dist="dist-a"), point("b", "tube", dist="dist-b"))
    assert str(registry.get("wall", "plane").source) == "dist-a 2.0"
    assert registry.names("wall") == ["plane", "tube"]


def test_a_broken_plugin_does_not_stop_the_others_and_is_told_when_a_part_is_missing():
    registry = loaded(FakeEntryPoint("a", broken), point("b", "tube"))
    assert registry.get("wall", "tube")
    with pytest.raises(PluginError) as caught:
        registry.get("wall", "fancy_wall")
    assert "plugin 'a' (other 2.0) could not be loaded: ImportError: no such module: fancy" in str(caught.value)


def test_a_hook_that_raises_is_told_with_the_plugin_s_name_and_line():
    @hookimpl
    def clast_register(registry):
        raise KeyError("x")

    registry = loaded(FakeEntryPoint("a", lambda: SimpleNamespace(clast_register=clast_register, CLAST_API=1)))
    assert str(registry.failures[0]) == "plugin 'a' (other 2.0) could not be loaded: KeyError: 'x'"


def test_two_distributions_with_one_entry_point_name_are_refused():
    with pytest.raises(PluginError, match=r"two distributions bring a plugin named 'a': d1 2.0 and d2 2.0"):
        loaded(point("a", "x", dist="d1"), point("a", "y", dist="d2"))


def test_two_plugins_with_one_part_are_refused_at_once():
    with pytest.raises(PluginError, match="two plugins bring a wall named 'plane'"):
        loaded(point("a", "plane"), point("b", "plane"))


def test_a_list_tells_of_conflicts_as_of_broken_plugins_and_lists_all_others():
    registry = Registry()
    points = [point("a", "plane"), point("b", "plane"), point("c", "x", dist="d1"), point("c", "y", dist="d2")]
    load_entry_points(points, None, registry, conflicts_stop=False)
    assert registry.names("wall") == ["plane", "x"]
    assert [each.source.plugin for each in registry.failures] == ["c", "b"]
    assert "two plugins bring a wall named 'plane'" in str(registry.failures[1])
    assert "two distributions bring a plugin named 'c': d1 2.0 and d2 2.0" in str(registry.failures[0])


@pytest.mark.parametrize(("api", "said"), [(2, "written for CLAST_API 2"), (None, "add 'CLAST_API = 1'")])
def test_a_plugin_for_another_api_is_not_loaded(api, said):
    registry = loaded(point("a", "plane", api=api))
    assert registry.names("wall") == []
    assert said in str(registry.failures[0].error)


def test_a_misspelt_hook_or_none_at_all_is_told():
    @hookimpl
    def clast_registr(registry): ...

    def clast_register(registry): ...

    misspelt = FakeEntryPoint("a", lambda: SimpleNamespace(clast_registr=clast_registr, CLAST_API=1))
    unmarked = FakeEntryPoint("b", lambda: SimpleNamespace(clast_register=clast_register, CLAST_API=1))
    first, second = (failure.error for failure in loaded(misspelt, unmarked).failures)
    assert "clast_registr" in str(first)
    assert "the only hook is 'clast_register'" in str(first)
    assert "marked with '@hookimpl'" in str(second)


def test_the_environment_chooses_plugins_but_keeps_clast_s_own():
    points = [point("own", "plane", dist="clast"), point("a", "x", dist="d1"), point("b", "y", dist="d2")]
    assert loaded(*points).names("wall") == ["plane", "x", "y"]
    assert loaded(*points, choice="none").names("wall") == ["plane"]
    assert loaded(*points, choice="a").names("wall") == ["plane", "x"]
    assert loaded(*points, choice="a, b").names("wall") == ["plane", "x", "y"]
    with pytest.raises(PluginError, match="CLAST_PLUGINS: no plugin named 'c' is installed"):
        loaded(*points, choice="c")


PLUGIN_FILE = """\
from dataclasses import dataclass
from clast import hookimpl
from clast.parts.params import Params

CLAST_API = 1

class Mine(Params):
    number: int = {number}

@dataclass(frozen=True)
class Part:
    summary: str = "Mine."
    Params: type = Mine

@hookimpl
def clast_register(registry):
    registry.wall("mine", Part())
"""


def test_a_file_is_a_plugin_and_its_module_can_be_found_again(tmp_path):
    (tmp_path / "mine.py").write_text(PLUGIN_FILE.format(number=1))
    registry = Registry()
    load_file(tmp_path / "mine.py", registry)
    entry = registry.get("wall", "mine")
    assert entry.file == tmp_path / "mine.py"
    assert sys.modules[entry.part.Params.__module__].CLAST_API == 1


def test_an_edited_file_is_loaded_anew_and_an_unchanged_one_is_not(tmp_path):
    def load():
        registry = Registry()
        load_file(tmp_path / "mine.py", registry)
        return registry.get("wall", "mine").part.Params

    (tmp_path / "mine.py").write_text(PLUGIN_FILE.format(number=1))
    first, again = load(), load()
    (tmp_path / "mine.py").write_text(PLUGIN_FILE.format(number=2))
    edited = load()
    assert first is again
    assert (first().number, edited().number) == (1, 2)


def test_files_of_one_name_in_two_folders_do_not_mix(tmp_path):
    registry = Registry()
    for folder, wall in (("a", "mine"), ("b", "yours")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "law.py").write_text(PLUGIN_FILE.format(number=1).replace('"mine"', f'"{wall}"'))
        load_file(tmp_path / folder / "law.py", registry)
    assert registry.names("wall") == ["mine", "yours"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = 1\nx +\n", r"mine.py:2: SyntaxError"),
        ("import nothing_like_this\n", r"mine.py:1: ModuleNotFoundError"),
        ("x = 1\n", r"does not state its API; add 'CLAST_API = 1'"),
        ("CLAST_API = 1\n", r"registers nothing"),
        (PLUGIN_FILE.format(number=1).replace("Part())", "3)"), r"mine.py:17: wall 'mine' needs 'Params'"),
        ("raise SystemExit('bye')\n", r"mine.py:1: SystemExit: bye"),
    ],
)
def test_a_bad_file_is_told_with_its_line(tmp_path, text, said):
    (tmp_path / "mine.py").write_text(text)
    with pytest.raises(PluginError, match=said):
        load_file(tmp_path / "mine.py", Registry())


def test_a_missing_file_is_told(tmp_path):
    with pytest.raises(PluginError, match="No such file"):
        load_file(tmp_path / "none.py", Registry())

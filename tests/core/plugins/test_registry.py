"""The registry: names, sources, conflicts."""

from types import SimpleNamespace

import pytest

from clast.errors import PluginError
from clast.parts.body_force import BodyForce
from clast.parts.params import Params
from clast.plugins.registered import Source
from clast.plugins.registry import KINDS, Registry


def part(summary="A part."):
    return SimpleNamespace(summary=summary, Params=Params)


def register_good_and_bad(registry):
    registry.wall("plane", part())
    registry.wall("No Name", part())


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_its_method(kind):
    registry = Registry()
    getattr(registry, kind)("mine", part())
    assert registry.names(kind) == ["mine"]
    assert registry.get(kind, "mine").kind == kind


def test_a_part_remembers_where_it_came_from():
    registry = Registry()
    with registry.registering(Source("a", "dist-a", "1.0")):
        registry.wall("plane", part())
    entry = registry.get("wall", "plane")
    assert str(entry.source) == "dist-a 1.0"
    assert entry.file.name == "params.py"


def test_one_name_for_two_parts_of_a_kind_is_an_error_naming_both_and_the_remedies():
    registry = Registry()
    with registry.registering(Source("a", "dist-a", "1.0")):
        registry.wall("plane", part())
    with pytest.raises(PluginError) as caught, registry.registering(Source("b", "dist-b", "2.0")):
        registry.wall("plane", part())
    for text in ("'plane'", "'a' (dist-a 1.0)", "'b' (dist-b 2.0)", "rename", "uninstall", "CLAST_PLUGINS"):
        assert text in str(caught.value)
    registry.motion("plane", part())


def test_a_plugin_that_fails_half_way_leaves_nothing_behind():
    registry = Registry()
    with pytest.raises(PluginError), registry.registering(Source("a", "dist-a")):
        register_good_and_bad(registry)
    assert registry.names("wall") == []


@pytest.mark.parametrize("name", ["Plane", "my-plane", "", "1plane", "my plane"])
def test_a_name_has_one_spelling(name):
    with pytest.raises(PluginError, match="small letters"):
        Registry().wall(name, part())


def test_a_part_without_params_or_summary_is_refused():
    with pytest.raises(PluginError, match="needs 'Params'"):
        Registry().wall("plane", SimpleNamespace(summary="x", Params=dict))
    with pytest.raises(PluginError, match="needs 'summary'"):
        Registry().wall("plane", SimpleNamespace(Params=Params))


def test_what_should_be_a_function_and_a_kind_that_does_not_exist_are_told():
    force = BodyForce(summary="x", Params=Params, Numbers=tuple, numbers=tuple, acceleration=9.81)
    with pytest.raises(PluginError, match=r"body_force 'weight' needs 'acceleration' to be a function; given 9.81"):
        Registry().body_force("weight", force)
    with pytest.raises(AttributeError, match="'bodyforce' is not a kind of part; did you mean 'body_force'"):
        Registry().bodyforce("weight", force)


def test_a_copy_is_independent():
    registry = Registry()
    registry.wall("plane", part())
    registry.copy().wall("tube", part())
    assert registry.names("wall") == ["plane"]


def test_a_missing_part_names_the_nearest_and_says_when_nothing_is_installed():
    registry = Registry()
    with pytest.raises(PluginError, match="no plugin is installed"):
        registry.get("wall", "plane")
    registry.wall("plane", part())
    with pytest.raises(PluginError, match="did you mean 'plane'"):
        registry.get("wall", "plan")

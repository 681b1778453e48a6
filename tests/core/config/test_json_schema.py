"""The JSON Schema says what Clast accepts."""

import json

from fake_parts import Ball, Explicit

from clast.config.describe import parameters, part_text, plugins_text
from clast.config.json_schema import scene_schema


def _references(value):
    if isinstance(value, dict):
        if "$ref" in value:
            yield value["$ref"]
        for inner in value.values():
            yield from _references(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _references(inner)


def test_every_reference_leads_somewhere(registry):
    schema = json.loads(json.dumps(scene_schema(registry)))
    for reference in _references(schema):
        name = reference.removeprefix("#/$defs/").replace("%20", " ")
        assert name in schema["$defs"], reference


def test_parts_are_a_choice_by_type_or_by_bare_name(registry):
    definitions = scene_schema(registry)["$defs"]
    assert definitions["any integrator"]["oneOf"][0] == {"enum": ["leapfrog", "midstep"]}
    elastic = definitions["bond_model elastic"]
    assert elastic["properties"]["type"]["const"] == "elastic"
    assert elastic["required"] == ["type", "young_modulus"]
    assert elastic["additionalProperties"] is False


def test_walls_take_material_and_motion_beside_their_shape(registry):
    plane = scene_schema(registry)["$defs"]["wall plane"]
    assert set(plane["properties"]) == {"type", "material", "motion", "point", "normal"}
    assert plane["required"] == ["type", "material", "point"]


def test_the_neighbour_search_that_is_meant_by_default_needs_no_type(registry):
    definitions = scene_schema(registry)["$defs"]
    assert definitions["any neighbour_search"]["oneOf"][0] == {"enum": ["auto", "linked_cells"]}
    for name, required in (("auto", []), ("linked_cells", ["type"])):
        search = definitions[f"neighbour_search {name}"]
        assert set(search["properties"]) == {"type", "skin"}
        assert search["required"] == required


def test_quantities_have_units_and_standard_bounds(registry):
    density = scene_schema(registry)["$defs"]["Material"]["properties"]["density"]
    assert density["x-unit"] == "kg/m3"
    assert density["exclusiveMinimum"] == 0
    assert "gt" not in density


def test_nothing_internal_is_left(registry):
    assert "x-clast-kind" not in json.dumps(scene_schema(registry))


def test_parameters_are_told_with_unit_default_bounds_and_meaning():
    by_name = {each.name: each for each in parameters(Ball)}
    diameter = by_name["primary_diameter"]
    assert (diameter.kind, diameter.default, diameter.bounds) == ("m", "required", "> 0")
    assert diameter.meaning == "Diameter of a primary"
    assert by_name["seed"].default == "0"
    assert [each.name for each in parameters(Explicit)] == ["grains", "grains.position", "grains.material"]


def test_parts_are_told_with_their_source(registry):
    assert "fake-distribution 1.2" in plugins_text(registry)
    assert "brittle | ductile" in part_text(registry, "elastic")
    assert "bond model" in part_text(registry, "bond_model.elastic")


def test_a_bond_model_says_what_of_it_can_scatter(registry):
    assert "may differ from bond to bond ('bonds.scatter'): young_modulus" in part_text(registry, "elastic")
    assert "bonds.scatter" not in part_text(registry, "explicit")


def test_the_schema_knows_scatter(registry):
    definitions = scene_schema(registry)["$defs"]
    assert definitions["Bonds"]["properties"]["scatter"]["anyOf"][0]["items"] == {"$ref": "#/$defs/Scatter"}
    assert set(definitions["Scatter"]["properties"]) == {"parameters", "distribution", "modulus", "deviation", "seed"}

"""A scene file becomes a validated scene."""

import copy

import pytest
from fake_parts import SCENE, Ball, Elastic
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from clast.config import scene as scene_module
from clast.config.sections import StepRule
from clast.config.yaml_loader import dump_yaml, parse_document
from clast.errors import ConfigError


def _said(load, *replacements, **options):
    with pytest.raises(ConfigError) as caught:
        load(*replacements, **options)
    return str(caught.value)


def test_parts_are_chosen_with_their_parameters_in_si(load):
    scene = load()
    assert scene.generators[0].name == "ball"
    assert scene.generators[0].params == Ball(material="glass", primary_diameter=0.25e-3, seed=1)
    assert scene.bonds.model.params == Elastic(young_modulus=5e6)
    assert scene.walls["upper"].motion.params.velocity == (0.0, 0.0, -0.01)
    assert scene.walls["lower"].motion is None
    assert scene.materials["glass"].young_modulus == 70e9


def test_defaults_are_those_of_the_contract(load):
    scene = load()
    assert scene.name == "scene"
    assert scene.integrator.name == "midstep"
    assert scene.bonds.kinematics.name == "total"
    assert scene.neighbours.search.name == "auto"
    assert scene.neighbours.skin == "auto"
    assert scene.contacts.rolling.name == "constant_torque"
    assert scene.contacts.bonded_pairs is True
    assert (scene.output.samples, scene.output.frames, scene.output.force) == (500, 100, "instantaneous")
    assert scene.output.checkpoint == 600.0
    assert [writer.name for writer in scene.output.writers] == ["figure"]
    assert scene.time.mass_scaling == 1.0


def test_the_time_step_is_a_time_or_a_rule(load):
    assert load().time.step == 5e-7
    assert load(("step: 5e-7", "mass_scaling: 2")).time.step == StepRule(rule="spectral", factor=0.8)
    assert load(("5e-7", "{rule: paper}")).time.step.factor == 0.1
    assert load(("5e-7", "{rule: paper, factor: 0.3}")).time.step.factor == 0.3
    assert "time.step: must be greater than 0" in _said(load, ("5e-7", "0"))
    assert "time.step.rule: 'papper' is not allowed; did you mean 'paper'?" in _said(load, ("5e-7", "{rule: papper}"))


def test_a_bare_name_stands_for_a_part_without_parameters(load):
    assert (
        load(overrides=["integrator=leapfrog"]).integrator == load(overrides=["integrator={type: leapfrog}"]).integrator
    )


def test_the_neighbour_search_is_chosen_by_type_with_the_skin_beside_it(load):
    for written in ("auto", "{type: auto}", "{skin: auto}"):
        assert load(overrides=[f"neighbours={written}"]).neighbours == load().neighbours
    assert load(overrides=["neighbours.skin=1 um"]).neighbours.skin == 1e-6
    assert load(overrides=["neighbours.skin=1 um"]).resolved()["neighbours"] == {"type": "auto", "skin": 1e-6}
    said = _said(load, overrides=["neighbours={search: linked_cells}"])
    assert "neighbours.search: not a known key; known are skin, type" in said
    said = _said(load, overrides=["neighbours={type: cells, skin: 0}"])
    assert "neighbours.type: no neighbour search is named 'cells'; known are auto, linked_cells" in said
    assert "neighbours.skin: must be greater than 0" in said
    assert "neighbours.skin: must be less than 1e+100" in _said(load, overrides=["neighbours.skin=1e300"])
    assert "must be less than 1e+100" in _said(load, overrides=["time.selective_mass_scaling=1e300 s"])


def test_the_checkpoint_interval_may_be_minutes_or_hours(load):
    assert load(overrides=["output.checkpoint=10 min"]).output.checkpoint == 600.0
    assert load(overrides=["output.checkpoint=1 h"]).output.checkpoint == 3600.0


def test_an_unknown_key_is_told_with_place_path_and_nearest_name(load):
    said = _said(load, ("  primary_diameter", "  primary_diametre"))
    assert "scene.yaml:7:3: particles.primary_diametre: not a known key; did you mean 'primary_diameter'?" in said
    assert "scene.yaml:4:1: particles.primary_diameter: this key is missing: Diameter of a primary" in said


def test_an_unknown_key_inside_a_part_s_list_is_told_too(load):
    said = _said(
        load,
        ("type: ball", "type: explicit"),
        ("  material: glass\n", "  grains: [{position: [0, 0, 0], materiel: glass}]\n"),
        ("  primary_diameter: 0.25 mm\n  seed: 1\n", ""),
    )
    assert "scene.yaml:6:34: particles.grains.0.materiel: not a known key; did you mean 'material'?" in said


def test_an_unknown_part_is_told_with_the_nearest_name(load):
    said = _said(load, ("type: elastic", "type: elastik"))
    assert "scene.yaml:11:11: bonds.model.type: no bond model is named 'elastik'; did you mean 'elastic'?" in said


def test_a_wrong_dimension_is_told_in_plain_words(load):
    said = _said(load, ("5 MPa", "5 mm"))
    assert "scene.yaml:11:26: bonds.model.young_modulus: '5 mm' is a length; a stress is needed" in said


def test_a_bound_is_told_with_what_was_given(load):
    assert "materials.glass.density: must be greater than 0; given '-1 kg/m3'" in _said(load, ("2500", "-1"))
    assert "materials.glass.poisson_ratio: must be less than 0.5" in _said(
        load, ("poisson_ratio: 0.2", "poisson_ratio: 0.5")
    )


def test_wall_settings_and_shape_are_checked_together(load):
    said = _said(
        load,
        ("point: [0, 0, 1 mm]", "pint: [0, 0]"),
        ("material: steel, point: [0, 0, -1", "materail: steel, point: [0, 0, -1"),
    )
    assert "walls.upper.pint: not a known key; did you mean 'point'?" in said
    assert "walls.upper.point: this key is missing: A point of the plane" in said
    assert "walls.lower.materail: not a known key; did you mean 'material'?" in said
    assert "walls.lower.material: this key is missing" in said


def test_all_problems_are_told_at_once_in_the_order_of_the_file(load):
    said = _said(
        load,
        ("seed: 1", "seed: -1"),
        ("restitution: 0.5", "restitution: 2"),
        ("upper: upper", "upper: uper"),
        ("material: glass", "material: glas"),
        ("5e-7", "5 mm"),
    )
    lines = said.splitlines()
    assert [int(line.split(":")[1]) for line in lines] == [6, 8, 15, 19, 21]
    assert all(line.startswith("scene.yaml:") for line in lines)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("upper: upper", "upper: uper", "compression.upper: there is no wall 'uper'; did you mean 'upper'?"),
        (
            "lower: lower, h",
            "lower: upper, h",
            "compression.lower: upper and lower must be two different walls",
        ),
        (
            "material: glass",
            "material: glas",
            "particles.material: there is no material 'glas'; did you mean 'glass'?",
        ),
        ("default: {r", "steel: {r", "contacts.pairs.steel: not a pair of materials"),
        ("default: {r", "glass-steel: {r", "contacts.pairs: 'glass-glass' is needed, or 'default'"),
        ("compression:", "#compression:", "time.end.strain: a strain needs the section 'compression'"),
        (
            "strain: 0.25",
            "strain: 0.25, steps: 3",
            "time.end: exactly one of strain, time and steps is needed",
        ),
        ("{strain: 0.25}", "{}", "exactly one of strain, time and steps is needed; given none of them"),
        ("  law: hertz", "  law: 3", "contacts.law: the name of a contact law is needed"),
        ("  law: hertz", "  law: {}", "contacts.law.type: this key is missing"),
        (
            "max_gap: 0.1 mm",
            "max_gap: 0.1 mm, materials: [glas]",
            "bonds.between.materials.0: there is no material",
        ),
        ("max_gap: 0.1 mm", "max_gap: 0.1 mm, min_gap: 1 mm", "bonds.between: min_gap 0.001 m is larger"),
        (
            "time:",
            "boundaries: {domain: {lower: [0,0,0], upper: [1,1,0]}}\ntime:",
            "boundaries.domain.upper: every coordinate",
        ),
        ("time:", "neighbours: {skin: aut}\ntime:", "neighbours.skin: 'aut' does not begin with a number"),
        ("time:", "particle: 1\ntime:", "particle: not a known key; did you mean 'particles'?"),
        ("time:", "name: a/b\ntime:", "name: 'a/b' cannot name the folder of a run"),
    ],
)
def test_what_does_not_fit_together_is_refused(load, old, new, said):
    assert said in _said(load, (old, new))


def test_pairs_are_found_in_either_order_and_not_told_twice(load):
    scene = load(("default: {restitution: 0.5}", "steel-glass: {restitution: 0.7}\n    default: {restitution: 0.5}"))
    assert scene.contacts.pair("glass", "steel").restitution == 0.7
    assert scene.contacts.pair("steel", "glass").restitution == 0.7
    assert scene.contacts.pair("glass", "glass").restitution == 0.5
    said = _said(load, ("default:", "steel-glass: {restitution: 1}\n    glass-steel:"))
    assert "contacts.pairs.glass-steel: the same pair is given as 'steel-glass'" in said


def test_several_generators_are_a_list(load):
    ball = "{type: ball, material: glass, primary_diameter: 1 mm}"
    scene = load(overrides=[f"particles=[{ball}, {ball}]"])
    assert len(scene.generators) == 2
    assert "particles: must have 1 or more entries; given []" in _said(load, overrides=["particles=[]"])


def test_the_resolved_scene_is_plain_and_gives_the_same_scene(load, tmp_path):
    scene = load(("seed: 1", "seed: 1\n  file: data/grain.csv"))
    plain = parse_document(dump_yaml(scene.resolved())).data
    assert plain == scene.resolved()
    assert plain["particles"]["file"] == str(tmp_path / "data/grain.csv")
    again = scene_module.from_mapping(plain)
    assert again.resolved() == scene.resolved()
    assert again.bonds == scene.bonds
    assert again.walls == scene.walls


def test_a_changed_scene_is_validated_and_leaves_the_first_alone(load):
    scene = load()
    changed = scene.changed({"particles.seed": 3, "particles.primary_diameter": "0.2 mm"})
    assert changed.generators[0].params.seed == 3
    assert scene.generators[0].params.seed == 1
    with pytest.raises(ConfigError, match=r"change of 'particles.seed': particles.seed: must be at least 0; given -1"):
        scene.changed({"particles.seed": -1})
    with pytest.raises(ConfigError, match="did you mean 'particles'"):
        scene.changed({"particle.seed": 1})


def test_every_part_a_scene_uses_is_listed_with_its_source(load):
    chosen = {f"{each.kind} {each.name}": each.source.origin for each in load().chosen}
    assert set(chosen) == {
        "generator ball", "bond_kinematics total", "bond_model elastic", "contact_law hertz",
        "rolling_resistance constant_torque", "wall plane", "motion moving",
        "integrator midstep", "neighbour_search auto", "writer figure",
    }  # fmt: skip
    assert set(chosen.values()) == {"fake-distribution"}


def test_a_file_named_in_the_scene_brings_its_parts(load, tmp_path):
    (tmp_path / "mine.py").write_text(
        "from types import SimpleNamespace\n"
        "from clast import hookimpl\nfrom clast.parts.params import Params\n"
        "CLAST_API = 1\n@hookimpl\ndef clast_register(registry):\n"
        "    registry.contact_law('mine', SimpleNamespace(summary='Mine.', Params=Params))\n"
    )
    scene = load(text="plugins: [./mine.py]\n" + SCENE.replace("law: hertz", "law: mine"))
    assert scene.contacts.law.source.plugin == "mine.py"
    assert scene.resolved()["plugins"] == [str(tmp_path / "mine.py")]


def test_a_plugin_file_that_fails_is_told_at_its_place_with_all_other_problems(load, tmp_path):
    (tmp_path / "broken.py").write_text("x = 1\nraise RuntimeError('no')\n")
    said = _said(load, ("seed: 1", "sed: 1"), text="plugins: [broken.py, none.py]\n" + SCENE)
    assert f"scene.yaml:1:11: plugins.0: {tmp_path}/broken.py:2: RuntimeError: no" in said
    assert "scene.yaml:1:22: plugins.1: none.py: No such file" in said
    assert "particles.sed: not a known key" in said


def test_parts_that_a_failing_file_would_have_brought_are_not_missed(load, tmp_path):
    (tmp_path / "broken.py").write_text("x = 1\nraise RuntimeError('no')\n")
    text = "plugins: [broken.py]\n" + SCENE.replace("law: hertz", "law: mine")
    said = _said(load, ("type: elastic", "type: softening"), text=text)
    assert said == f"scene.yaml:1:11: plugins.0: {tmp_path}/broken.py:2: RuntimeError: no"


def test_a_scene_that_is_all_wrong_is_still_one_plain_message(load):
    said = _said(load, text="materials: 3\nparticles: []\nwalls: [1]\ncontacts: x\ntime: {end: 3}\n")
    assert "scene.yaml:1:1: materials: a mapping 'key: value' is needed; given 3" in said
    assert "Traceback" not in said


def _paths(value, above=()):
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*above, key)
        yield from _paths(inner, (*above, key))


_DATA = parse_document(SCENE).data
_JUNK = st.sampled_from([None, True, 0, -1, 1e400, "", "x", "3 mm", "3 MPa", [], [1, 2], {}, {"type": 1}, {"a": {}}])


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(path=st.sampled_from(list(_paths(_DATA))), junk=_JUNK)
def test_whatever_stands_anywhere_gives_a_scene_or_one_plain_message(registry, path, junk):
    data = copy.deepcopy(_DATA)
    parent = data
    for step in path[:-1]:
        parent = parent[step]
    parent[path[-1]] = junk
    said = ""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene_module, "discover", registry.copy)
        try:
            scene_module.from_mapping(data)
        except ConfigError as error:
            said = str(error)
    assert said == "" or all(line.startswith("scene: ") for line in said.splitlines())

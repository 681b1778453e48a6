"""Names that become folders, paths in files and columns are refused where they cannot."""

from __future__ import annotations

import pytest

from clast.errors import ConfigError


def said(load, *replacements, **options) -> str:
    with pytest.raises(ConfigError) as caught:
        load(*replacements, **options)
    return str(caught.value)


@pytest.mark.parametrize("name", ["..", ".", "' '", "a/b", "'a\\b'", '"a\\0b"', '"a\\nb"', "'/tmp'"])
def test_a_scene_is_not_named_like_a_place(load, name):
    told = said(load, overrides=[f"name={name}"])
    assert told.startswith(f"--set name={name}: name: ")
    assert "cannot name the folder of a run; give the scene a 'name' with" in told


def test_a_scenes_name_fits_a_folder(load):
    assert load(overrides=["name=Fig. 9 – Körner (2)"]).name == "Fig. 9 – Körner (2)"
    assert load(overrides=[f"name={'ö' * 100}"]).name == "ö" * 100
    assert "name: the name has 202 bytes; a folder of a run takes 200" in said(load, overrides=[f"name={'ö' * 101}"])


@pytest.mark.parametrize("name", ["a/b", "..", "a.b", '""', '" a"', "a,b", '"a\\0"'])
def test_walls_and_materials_are_named_by_letters_digits_and_lines(load, name):
    wall = f"  {name}: {{type: plane, material: steel, point: [0, 0, 0]}}\n  lower:"
    assert "cannot be a name here; write it with letters, digits, '_', '-' and single spaces" in said(
        load, ("  lower:", wall)
    )
    material = f"  {name}: {{density: 1, young_modulus: 1, poisson_ratio: 0}}\n  steel:"
    told = said(load, ("  steel:", material))
    assert told.startswith("scene.yaml:3:3: materials")
    assert "cannot be a name here" in told


@pytest.mark.parametrize("name", ["Deckel_2", "side wall-3", "Glas-ß", "玻璃"])
def test_other_names_are_taken(load, name):
    wall = f"  {name}: {{type: plane, material: steel, point: [0, 0, 0]}}\n  lower:"
    assert name in load(("  lower:", wall)).walls


def test_a_pair_that_may_mean_two_is_refused(load):
    more = "".join(
        f"  {name}: {{density: 1, young_modulus: 1, poisson_ratio: 0}}\n" for name in ("a", "b-c", "a-b", "c")
    )
    told = said(load, ("  steel:", f"{more}  steel:"), ("    default:", "    a-b-c: {restitution: 1}\n    default:"))
    assert "contacts.pairs.a-b-c: may mean 'a' and 'b-c' or 'a-b' and 'c'; write one of these materials without" in told


def test_more_than_the_results_can_hold_is_refused(load):
    many = "".join(f"  m{k}: {{density: 1, young_modulus: 1, poisson_ratio: 0}}\n" for k in range(255))
    told = said(load, ("  steel:", f"{many}  steel:"))
    assert "materials: must have 256 or fewer entries" in told
    numbers = ", ".join(map(str, range(8001)))
    told = said(load, overrides=[f"output.tracks.particles=[{numbers}]"])
    assert "output.tracks.particles: must have 8000 or fewer entries" in told

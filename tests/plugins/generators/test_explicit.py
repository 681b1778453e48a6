"""Particles and bonds written in the scene."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from clast.parts.generator import Site
from clast_plugins.generators import explicit
from clast_plugins.generators.explicit import Explicit

HERE = Site(Path())


def particle(x: float, **more: Any) -> dict[str, Any]:
    return {"position": [f"{x} mm", 0, 0], "radius": "1 mm", **more}


def scene(*particles: dict[str, Any], bonds: Any = (), **more: Any) -> Explicit:
    return Explicit.model_validate({"particles": list(particles), "material": "glass", "bonds": list(bonds), **more})


def test_particles_are_taken_as_written() -> None:
    packing = explicit.generate(
        scene(
            particle(0, velocity=[0, 0, "10 mm/s"], spin=[1, 2, 3], material="steel"),
            particle(3, prescribed=True, velocity=[1, 0, 0]),
            particle(6, fixed=True),
        ),
        HERE,
    )
    np.testing.assert_array_equal(packing.position, [[0, 0, 0], [3e-3, 0, 0], [6e-3, 0, 0]])
    np.testing.assert_array_equal(packing.velocity, [[0, 0, 0.01], [1, 0, 0], [0, 0, 0]])
    np.testing.assert_array_equal(packing.spin[0], [1, 2, 3])
    assert packing.material == ["steel", "glass", "glass"]
    assert packing.prescribed.tolist() == [False, True, True]
    assert packing.grain.tolist() == [-1, -1, -1]
    assert packing.bonds is None


def test_bonds_name_particles_by_their_places_and_make_grains() -> None:
    bonds = [
        {"between": [2, 0], "diameter": "0.5 mm"},
        {"between": [2, 3], "diameter": 1e-3, "length": "2 mm"},
    ]
    packing = explicit.generate(scene(*(particle(3 * k) for k in range(4)), bonds=bonds), HERE)
    assert packing.bonds is not None
    assert packing.bonds.ends.tolist() == [[2, 0], [2, 3]]
    assert packing.bonds.diameter.tolist() == [0.5e-3, 1e-3]
    assert np.isnan(packing.bonds.length[0])
    assert packing.bonds.length[1] == 2e-3
    assert packing.grain.tolist() == [0, -1, 0, 0]


@pytest.mark.parametrize("moving", [{"velocity": [0, 0, 1]}, {"spin": [0, 0, 1]}])
def test_a_fixed_particle_with_a_velocity_is_a_contradiction(moving: dict[str, Any]) -> None:
    with pytest.raises(ValidationError, match="take 'prescribed: true'"):
        scene(particle(0, fixed=True, **moving))


@pytest.mark.parametrize(
    ("bonds", "told"),
    [
        (
            [{"between": [0, 2], "diameter": 1}],
            r"bonds\.0\.between\n  there is no particle 2; the particles are counted from 0 to 1",
        ),
        ([{"between": [-1, 1], "diameter": 1}], r"bonds\.0\.between\n  there is no particle -1"),
        ([{"between": [0, 1], "diameter": 0}], "greater than 0"),
        ([{"between": [0, 1], "diameter": 1, "length": "-1 mm"}], "greater than 0"),
    ],
)
def test_senseless_bonds_are_refused(bonds: list[dict[str, Any]], told: str) -> None:
    with pytest.raises(ValidationError, match=told):
        scene(particle(0), particle(2), bonds=bonds)


def test_a_bond_of_no_length_is_refused() -> None:
    with pytest.raises(ValidationError, match="one centre, so their bond has no direction"):
        scene(particle(0), particle(0), bonds=[{"between": [0, 1], "diameter": 1}])


def test_a_particle_needs_a_material_and_a_scene_a_particle() -> None:
    with pytest.raises(ValidationError, match=r"particles\.1\n  names no material"):
        scene(particle(0, material="steel"), particle(3), material=None)
    with pytest.raises(ValidationError, match="at least 1"):
        scene()


@pytest.mark.parametrize("wrong", [{"radius": "-1 mm"}, {"radius": "1 s"}, {"position": [0, 0]}, {"colour": "red"}])
def test_a_wrong_particle_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        scene({**particle(0), **wrong})

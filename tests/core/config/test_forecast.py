"""What a run will cost, told without packing."""

from math import pi, sqrt

import pytest

from clast.config.forecast import forecast
from clast.parts.bond_model import Stiffness


def test_counts_memory_steps_and_time_follow_from_the_scene(load):
    told = forecast(load())
    assert (told.particles, told.bonds) == (100, 600)
    assert told.memory == 150e6 + 400 * 700
    assert told.time_step == 5e-7
    assert told.steps == round(0.25 * 2e-3 / 0.01 / 5e-7)
    assert told.seconds == pytest.approx(told.steps * 700 / 10e6)
    assert "estimate" in told.text()


def test_the_paper_s_rule_is_evaluated_for_two_touching_primaries(load, registry):
    part = registry.get("bond_model", "elastic").part
    E, nu = 5e12, 0.2

    def stiffness(params, geometry):
        axial = params.young_modulus * geometry.A / geometry.L0
        return Stiffness(axial, axial / (2 * (1 + nu)), axial, axial)

    object.__setattr__(part, "stiffness", stiffness)
    told = forecast(load(("5 MPa", "5 TPa"), ("step: 5e-7", "step: {rule: paper, factor: 0.1}\n  mass_scaling: 4")))
    R = 0.125e-3
    mass = 4 * 2500 * 4 / 3 * pi * R**3
    assert told.time_step == pytest.approx(0.1 * 2 * sqrt(mass / (E * pi * R**2 / (2 * R))))


def test_what_cannot_be_known_is_said(load):
    told = forecast(
        load(
            ("type: ball", "type: explicit"),
            (
                "  material: glass\n  primary_diameter: 0.25 mm\n  seed: 1\n",
                "  grains: [{position: [0, 0, 0], material: glass}]\n",
            ),
            ("5e-7", "{rule: paper}"),
        )
    )
    assert (told.particles, told.bonds, told.time_step, told.seconds) == (1, None, None, None)
    assert "known after packing" in told.text()
    assert "clast check --build" in told.text()


def test_without_a_bonds_section_there_are_no_bonds(load):
    bonds = "bonds:\n  between: {max_gap: 0.1 mm}\n  model: {type: elastic, young_modulus: 5 MPa}\n"
    assert forecast(load((bonds, ""))).bonds == 0

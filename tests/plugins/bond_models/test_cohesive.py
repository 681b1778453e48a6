"""Cohesive bonds: what breaking takes, however it is done, and what damage leaves of a bond."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast import load
from clast.building import build_scene
from clast.errors import ConfigError
from clast.forecast import forecast
from clast.parts.bond_model import Strain
from tests.support.bonds import GEOMETRY, L0, WRITTEN, E, G, R, bent, follow, law, respond, scaled, strains, stretch
from tests.support.strategies import numbers

SCENE = Path(__file__).parents[3] / "configs" / "parts" / "bond_model" / "cohesive.yaml"
GIVEN = WRITTEN["cohesive"][1]
A = float(GEOMETRY.A)


def flat(strain: Strain) -> np.ndarray:
    return np.array([strain.axial, *strain.shear, strain.twist, *strain.bending])


def onset_and_end(strain: Strain) -> tuple[float, float]:
    """Return the multiples of a strain at which damage begins and at which it is complete."""
    opening = max(strain.axial, 0.0) ** 2 + 0.25 * R**2 * np.dot(strain.bending, strain.bending)
    sliding = np.dot(strain.shear, strain.shear) + 0.5 * R**2 * strain.twist**2
    by_stress = (E / L0 / GIVEN["tensile_strength"]) ** 2 * opening + (G / L0 / GIVEN["shear_strength"]) ** 2 * sliding
    by_energy = E / L0 * opening / GIVEN["fracture_energy"] + G / L0 * sliding / GIVEN["shear_fracture_energy"]
    return 1.0 / sqrt(by_stress), 2.0 * sqrt(by_stress) / by_energy


@settings(max_examples=40, deadline=None)
@given(
    strain=strains().filter(lambda strain: np.abs(flat(strain) / ([L0] * 4 + [1.0] * 4)).max() > 1e-4),
    stops=st.lists(numbers(0.0, 1.0), max_size=20),
)
def test_breaking_takes_the_energy_of_fracture_in_any_proportion_and_any_number_of_steps(
    strain: Strain, stops: list[float]
) -> None:
    """Stress over strain is two straight lines, so that trapezoids between any points on them add up exactly."""
    way = strain._replace(axial=abs(strain.axial))
    onset, end = onset_and_end(way)
    path = [scaled(way, share) for share in sorted({0.0, onset, end, *(stop * end for stop in stops)})]
    told = follow(law("cohesive"), path)
    loads = np.array([flat(Strain(*response.load)) for response in told])
    work = 0.5 * (loads[1:] + loads[:-1]) * np.diff([flat(each) for each in path], axis=0)
    by_opening, by_sliding = work[:, [0, 5, 6, 7]].sum() / A, work[:, 1:5].sum() / A
    spent = by_opening / GIVEN["fracture_energy"] + by_sliding / GIVEN["shear_fracture_energy"]
    assert spent == pytest.approx(1.0, rel=1e-9)
    assert told[-1].index == pytest.approx(1.0, rel=1e-12)


@settings(max_examples=40, deadline=None)
@given(reached=numbers(0.0, 1.0), back=numbers(0.0, 1.0))
def test_pulled_the_stress_is_a_triangle_and_unloading_leads_straight_back(reached: float, back: float) -> None:
    strength = GIVEN["tensile_strength"]
    first, last = strength / E, 2.0 * GIVEN["fracture_energy"] / (strength * L0)
    epsilon = first + reached * (last - first)
    loaded, unloaded = follow(law("cohesive"), [stretch(epsilon), stretch(back * epsilon)])
    assert loaded.load.normal == pytest.approx(strength * A * (1.0 - reached), rel=1e-9, abs=1e-9 * strength * A)
    assert unloaded.load.normal == pytest.approx(back * loaded.load.normal, rel=1e-12)
    assert unloaded.state == loaded.state
    assert loaded.index == pytest.approx(epsilon / last, rel=1e-12)


@settings(max_examples=40, deadline=None)
@given(path=st.lists(strains(), min_size=2, max_size=12))
def test_damage_never_falls_and_pressure_finds_a_whole_bond(path: list[Strain]) -> None:
    bond = law("cohesive")
    told = follow(bond, path)
    damage = [response.state.damage for response in told]
    assert damage == sorted(damage)
    assert 0.0 <= damage[-1] <= 1.0
    pressed = respond(bond, stretch(-0.01), told[-1].state)
    assert pressed.load.normal == pytest.approx(-0.01 * E * A, rel=1e-12)
    assert pressed.state.damage == damage[-1]


def test_bent_alone_a_bond_is_damaged_from_where_its_outermost_fibre_has_twice_the_strength() -> None:
    at, bond = 2.0 * GIVEN["tensile_strength"] / E, law("cohesive")
    damage = [respond(bond, bent(share * at), bond.start).state.damage for share in (1.0 - 1e-9, 1.0 + 1e-9)]
    assert damage[0] == 0.0 < damage[1]


@pytest.mark.parametrize(
    ("key", "sentence"),
    [
        ("fracture_energy", r"bonds\.model: bond \d+, .* m long, holds .* J/m2 at its tensile_strength"),
        ("shear_fracture_energy", r"J/m2 at its shear_strength, but shear_fracture_energy is 1e-06 J/m2"),
    ],
)
def test_bonds_that_would_snap_back_are_refused_before_anything_runs(key: str, sentence: str) -> None:
    with pytest.raises(ConfigError, match=sentence):
        forecast(load(SCENE).changed({f"bonds.model.{key}": "1e-6 J/m2"}))


def test_a_bond_whose_parameters_scatter_into_snapping_back_is_the_one_that_is_named() -> None:
    scatter = {"parameters": ["fracture_energy"], "distribution": "weibull", "modulus": 0.5}
    scene = load(SCENE).changed({"bonds.scatter": [scatter]})
    built = build_scene(scene)
    weakest = int(np.argmin(built.factors[0] / built.length))
    with pytest.raises(ConfigError, match=rf"bonds\.model: bond {weakest}, "):
        forecast(scene)

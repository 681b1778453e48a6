"""Kelvin–Voigt bonds: dashpots that go with the springs, in the limits of the time step as well."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from clast import load
from clast.building import build_scene
from clast.config.examples import example
from clast.config.scene import SceneConfig
from clast.forecast import forecast
from clast.parts.bond_model import Dashpots
from clast.plugins.discovery import discover
from clast.scene.plan import blueprint, bond_stiffness, damping_coefficients
from clast.stability.time_step import limits
from clast.testing.bond_model import claims
from clast.testing.claim import try_claims
from clast_plugins.bond_models import elastic
from tests.scenes import CRUSH, write

MODEL = {"type": "kelvin", "young_modulus": "420 MPa", "poisson_ratio": 0.2, "normal_strength": "2 MPa"}


def grain(folder: Path, tau: float, **changes: object) -> SceneConfig:
    model = MODEL | {"retardation_time": tau}
    return load(write(folder, CRUSH)).changed({"bonds.model": model, "time.step": {"rule": "spectral"}, **changes})


def test_every_spring_has_a_dashpot_of_the_same_time_and_damping_of_the_scene_is_added(tmp_path: Path) -> None:
    alone, damped = (build_scene(grain(tmp_path, 2e-6, **{"bonds.damping": zeta})) for zeta in (0.0, 0.1))
    elastic = build_scene(load(write(tmp_path, CRUSH)).changed({"bonds.damping": 0.1}))
    springs = np.column_stack(bond_stiffness(alone))
    assert blueprint(alone).bonds.damping
    np.testing.assert_allclose(damping_coefficients(alone), 2e-6 * springs, rtol=1e-14)
    np.testing.assert_allclose(damping_coefficients(damped), 2e-6 * springs + damping_coefficients(elastic), rtol=1e-14)


def test_models_without_dashpots_have_none_compiled(tmp_path: Path) -> None:
    assert discover().get("bond_model", "elastic").part.dashpots is None
    assert not blueprint(build_scene(load(write(tmp_path, CRUSH)))).bonds.damping


@pytest.mark.parametrize(("viscosity", "kept"), [(0.0, True), (-1.0, False), (float("nan"), False)])
def test_dashpots_that_push_break_the_contract_of_bond_models(viscosity: float, kept: bool) -> None:
    model = replace(elastic.MODEL, dashpots=lambda params, bond: Dashpots(*[np.array([viscosity])] * 4))
    (claim,) = (each for each in claims(model, example(elastic.Elastic)) if "dashpots" in each.says)
    (outcome,) = try_claims([claim])
    assert outcome.passed == kept


def test_the_step_falls_with_the_time_of_retardation_and_check_foresees_it(tmp_path: Path) -> None:
    """Far above the period, in which springs count no more, dashpots ten times as strong take a step of a tenth."""
    steps = {}
    for tau in (1e-8, 1e-5, 1e-4):
        scene = grain(tmp_path, tau)
        built = build_scene(scene)
        steps[tau] = limits(built, blueprint(built)).spectral
        assert forecast(scene).time_step == pytest.approx(0.8 * steps[tau], rel=0.25)
    assert steps[1e-5] < 0.5 * steps[1e-8]
    assert steps[1e-4] == pytest.approx(0.1 * steps[1e-5], rel=0.02)

"""Bonds whose parameters scatter: which factors they get, for every bond model, and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.scenes import CRUSH, write
from tests.support.bonds import WRITTEN

from clast import load
from clast.building import build_scene
from clast.commands.build_report import report
from clast.config.scatter import Scatter, can_scatter
from clast.engine.records import columns
from clast.errors import ConfigError
from clast.forecast import forecast
from clast.maths.distributions import weibull_deviation
from clast.parts.bond_model import BondGeometry, BondModel, Stiffness
from clast.parts.params import Params
from clast.plugins.discovery import discover
from clast.scene.plan import blueprint, bond_constants, bond_stiffness
from clast.scene.scatter import (
    DASHPOTS,
    STIFFNESS,
    bond_of,
    draw_factors,
    form_of_constants,
    multiplied,
    of_each_bond,
)
from clast.scene.start import check_start
from clast.simulation import Simulation
from clast.stability.time_step import limits

EXAMPLES = Path(__file__).parents[3] / "docs" / "examples"
COUNT = 40
ALONG = np.linspace(0.2e-3, 0.3e-3, COUNT)
SIZES = np.linspace(0.1e-3, 0.12e-3, COUNT)
GEOMETRIES = {
    "one size": BondGeometry(ALONG, 0.1e-3, np.pi * 0.1e-3**2, 0.25 * np.pi * 0.1e-3**4),
    "own sizes": BondGeometry(ALONG, SIZES, np.pi * SIZES**2, 0.25 * np.pi * SIZES**4),
}


def weibull_entry(*parameters: str, modulus: float = 5.0, seed: int = 1) -> Scatter:
    return Scatter(parameters=parameters, distribution="weibull", modulus=modulus, seed=seed)


def one_by_one(function: Any, form: Any, params: Params, entries: Any, factors: Any, geometry: BondGeometry) -> Any:
    rows = []
    for bond in range(COUNT):
        own = multiplied(params, entries, [float(each[bond]) for each in factors])
        own = type(params).model_validate({name: getattr(own, name) for name in type(params).model_fields})
        rows.append(form.rows(function(own, bond_of(geometry, bond)), 1))
    return np.concatenate(rows)


@pytest.mark.parametrize("geometry", GEOMETRIES.values(), ids=GEOMETRIES)
@pytest.mark.parametrize("name", WRITTEN)
def test_every_parameter_of_every_model_scatters_as_if_each_bond_were_computed_alone(
    name: str, geometry: BondGeometry
) -> None:
    part, written = WRITTEN[name]
    entry = discover().get("bond_model", part)
    params = entry.part.Params(**written)
    model: BondModel = entry.part_for(params)
    for parameter in can_scatter(params):
        scatter = [Scatter(parameters=(parameter,), distribution="lognormal", deviation=1e-3)]
        factors = (1.0 - np.abs(draw_factors(scatter, COUNT)[0] - 1.0),)  # some numbers may not grow
        asked = [(model.constants, form_of_constants(model.Constants)), (model.stiffness, STIFFNESS)]
        asked += [(model.dashpots, DASHPOTS)] if model.dashpots else []
        for function, form in asked:
            found = of_each_bond(function, form, params, scatter, factors, geometry)
            expected = one_by_one(function, form, params, scatter, factors, geometry)
            np.testing.assert_allclose(form.rows(found, COUNT), expected, rtol=1e-14)


def test_the_built_in_models_are_asked_once_for_all_bonds() -> None:
    for name, (part, written) in WRITTEN.items():
        entry = discover().get("bond_model", part)
        params = entry.part.Params(**written)
        model = entry.part_for(params)
        calls = 0

        def counted(params: Any, bond: BondGeometry, constants: Any = model.constants) -> Any:
            nonlocal calls
            calls += 1
            return constants(params, bond)

        entries = [weibull_entry(*can_scatter(params))]
        factors = (np.linspace(0.9, 1.0, COUNT),)
        of_each_bond(counted, form_of_constants(model.Constants), params, entries, factors, GEOMETRIES["one size"])
        assert calls == 4, name  # once for all, and three bonds to compare with


class Odd(Params):
    stiffness: float = 2.0
    limit: float = 3.0


class OddConstants(NamedTuple):
    k: float
    way: tuple[float, float, float]
    kind: float


def branching(params: Odd, bond: BondGeometry) -> OddConstants:
    """A law that cannot take arrays."""
    kind = 1.0 if params.limit > 3.0 else 0.0
    return OddConstants(params.stiffness / bond.L0, (params.limit, 0.0, 1.0), kind)


def mixing(params: Odd, bond: BondGeometry) -> OddConstants:
    """A law that takes arrays, and makes of them what it did not mean."""
    return OddConstants(params.stiffness / bond.L0, (params.limit, params.limit, params.limit), 0.0)


@pytest.mark.parametrize("law", [branching, mixing])
def test_a_law_that_cannot_take_arrays_is_asked_bond_by_bond(law: Any) -> None:
    entries = [weibull_entry("limit")]
    factors = draw_factors(entries, COUNT)
    found = of_each_bond(law, form_of_constants(OddConstants), Odd(), entries, factors, GEOMETRIES["one size"])
    limit = 3.0 * factors[0]
    table = columns(found, COUNT)
    np.testing.assert_array_equal(table[:, 0], 2.0 / ALONG)
    np.testing.assert_array_equal(table[:, 1], limit)
    np.testing.assert_array_equal(table[:, 4], (limit > 3.0) if law is branching else 0.0)


def test_the_law_of_the_tutorial_scatters_without_knowing_it(tmp_path: Path) -> None:
    law = {"type": "softening", "young_modulus": "100 MPa", "damage_strain": 0.001, "breakage_strain": 0.004}
    entry = {"parameters": ["damage_strain", "breakage_strain"], "distribution": "lognormal", "deviation": 0.1}
    changes = {"plugins": [str(EXAMPLES / "my_law.py")], "bonds.model": law, "bonds.scatter": [entry]}
    built = build_scene(load(write(tmp_path, CRUSH)).changed(changes))
    c = bond_constants(built)
    assert len(built.factors[0]) > 100
    np.testing.assert_allclose(c.eps_0, 0.001 * built.factors[0], rtol=1e-14)
    np.testing.assert_allclose(c.eps_f / c.eps_0, 4.0, rtol=1e-14)


def test_an_error_of_the_law_itself_is_not_swallowed() -> None:
    def wrong(params: Odd, bond: BondGeometry) -> Stiffness:
        raise ValueError("my own")

    with pytest.raises(ValueError, match="my own"):
        of_each_bond(wrong, STIFFNESS, Odd(), [weibull_entry("limit")], (np.ones(COUNT),), GEOMETRIES["one size"])


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), modulus=st.floats(2.0, 20.0))
def test_the_factors_of_many_bonds_have_mean_and_deviation_of_their_distribution(seed: int, modulus: float) -> None:
    count = 20_000
    (found,) = draw_factors([weibull_entry("a", modulus=modulus, seed=seed)], count)
    deviation = weibull_deviation(modulus)
    assert found.mean() == pytest.approx(1.0, abs=5.0 * deviation / np.sqrt(count))
    assert found.std() == pytest.approx(deviation, rel=0.06)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 50), more=st.integers(0, 50))
def test_the_factor_of_a_bond_depends_on_nothing_but_its_number_entry_and_seed(
    seed: int, count: int, more: int
) -> None:
    entries = [weibull_entry("a", seed=seed), weibull_entry("b", seed=seed)]
    few, many = draw_factors(entries, count), draw_factors(entries, count + more)
    for a, b in zip(few, many, strict=True):
        assert a.tobytes() == b[:count].tobytes()
    assert not np.isin(many[0], many[1]).any()
    assert draw_factors([weibull_entry("c", modulus=5.0, seed=seed)], count)[0].tobytes() == few[0].tobytes()


@pytest.mark.parametrize("bonds", [4, 16, 64])
def test_a_chain_is_as_strong_as_its_weakest_bond_and_so_weibull_s_with_a_smaller_scale(bonds: int) -> None:
    chains, modulus = 5000, 5.0
    (factors,) = draw_factors([weibull_entry("a", modulus=modulus)], chains * bonds)
    strength = np.sort(factors.reshape(chains, bonds).min(axis=1)) * bonds ** (1.0 / modulus)
    (single,) = draw_factors([weibull_entry("a", modulus=modulus, seed=2)], chains)
    from scipy.stats import ks_2samp

    assert ks_2samp(strength, single).pvalue > 0.01
    assert strength.mean() == pytest.approx(1.0, abs=4.0 * weibull_deviation(modulus) / np.sqrt(chains))


def scattered(tmp_path: Path, *entries: dict[str, Any], **more: Any) -> Any:
    return load(write(tmp_path, CRUSH)).changed({"bonds.scatter": list(entries), **more})


WEAK = {"parameters": ["yield_stress", "breakage_strain"], "distribution": "weibull", "modulus": 5}
SOFT = {"parameters": ["young_modulus"], "distribution": "lognormal", "deviation": 0.3, "seed": 4}


def test_parameters_of_one_entry_share_the_factor_of_a_bond(tmp_path: Path) -> None:
    scene = build_scene(scattered(tmp_path, WEAK, SOFT))
    c = bond_constants(scene)
    strength, stiffness = scene.factors
    np.testing.assert_allclose(c.yield_stress, 2e6 * strength, rtol=1e-14)
    np.testing.assert_allclose(1.0 / c.per_tensile_limit, 0.0075 * strength, rtol=1e-14)
    np.testing.assert_allclose(c.E, 420e6 * stiffness, rtol=1e-14)
    assert abs(np.corrcoef(strength, stiffness)[0, 1]) < 4.0 / np.sqrt(len(strength))


def test_stiffer_bonds_count_with_their_own_stiffness_in_every_limit_of_the_time_step(tmp_path: Path) -> None:
    plain, scene = (build_scene(scattered(tmp_path, *entries)) for entries in ((), (SOFT,)))
    np.testing.assert_allclose(bond_stiffness(scene).axial, bond_stiffness(plain).axial * scene.factors[0], rtol=1e-14)
    before, found = limits(plain, blueprint(plain)), limits(scene, blueprint(scene))
    stiffest = scene.factors[0].max() ** -0.5
    assert stiffest * before.network <= found.network < before.network
    assert stiffest * before.bond <= found.bond * (1.0 + 1e-12)
    assert found.local <= found.spectral * (1.0 + 1e-9) < before.spectral
    told = forecast(scene.config.changed({"time.step": {"rule": "spectral"}}))
    assert told.time_step <= 0.8 * found.spectral
    assert any("the stiffest" in note for note in told.notes)


def test_without_scatter_of_the_stiffness_the_forecast_is_what_it_was(tmp_path: Path) -> None:
    plain, weak = (forecast(scattered(tmp_path, *entries)) for entries in ((), (WEAK,)))
    assert (weak.time_step, weak.notes) == (plain.time_step, plain.notes)


def test_the_same_seed_breaks_the_same_bonds_and_another_one_others(tmp_path: Path) -> None:
    def cracks(seed: int) -> bytes:
        simulation = Simulation(scattered(tmp_path, WEAK | {"seed": seed}, SOFT, **{"time.end.strain": 0.15}))
        simulation.advance_to(simulation.last_step)
        assert simulation.bonds_broken > 3
        return bytes(simulation.world.cracks.bond[: simulation.bonds_broken].tobytes())

    first = cracks(1)
    assert cracks(1) == first
    assert cracks(2) != first


def test_the_results_and_the_build_report_tell_the_factors(tmp_path: Path) -> None:
    import h5py

    from clast import run_scene

    scene = scattered(tmp_path, WEAK, SOFT, **{"time.end": {"steps": 2}, "output.samples": 2})
    run_scene(scene, tmp_path / "run")
    built = build_scene(scene)
    with h5py.File(tmp_path / "run" / "results.h5") as file:
        kept = file["bonds/factors"]
        assert kept[...].T.tobytes() == np.array(built.factors).tobytes()
        assert list(kept.attrs["parameters"]) == ["yield_stress, breakage_strain", "young_modulus"]
    text = report(scene)
    assert f"weibull: factors {built.factors[0].mean():.4g} ±" in text
    assert "scatter of young_modulus" in text


@pytest.mark.parametrize(
    ("entry", "sentence"),
    [
        (
            {"parameters": ["yield_stres"]},
            r"scatter\.0\.parameters\.0: .* no parameter 'yield_stres'; did you mean 'yield_stress'\?",
        ),
        ({"parameters": ["fixed_drop"]}, r"parameters\.0: bonds\.model gives no 'fixed_drop'"),
        ({"parameters": ["seed"]}, r"'seed' is no number that can be multiplied; such are young_modulus, "),
        ({"parameters": ["drop_from"]}, r"'drop_from' is no number that can be multiplied"),
        ({"parameters": ["yield_stress", "yield_stress"]}, r"parameters\.1: 'yield_stress' has a factor already"),
        ({"parameters": []}, r"parameters: must have 1 or more entries"),
        ({"parameters": "yield_stress"}, r"parameters: a list is needed"),
        ({"modulus": 0.2}, r"scatter\.0\.modulus: must be at least 0\.5"),
        ({"modulus": "5 MPa"}, r"modulus: .* plain number is needed"),
        ({"modulus": None}, r"scatter\.0: a weibull distribution needs 'modulus'"),
        ({"deviation": 0.2}, r"'deviation' is the measure of lognormal; weibull takes 'modulus'"),
        ({"distribution": "lognormal", "modulus": None}, r"a lognormal distribution needs 'deviation'"),
        ({"distribution": "lognormal", "modulus": None, "deviation": 0}, r"deviation: must be greater than 0"),
        ({"distribution": "weibul"}, r"distribution: 'weibul' is not allowed; did you mean 'weibull'\?"),
        ({"seed": -1}, r"seed: must be at least 0"),
        ({"mean": 1}, r"scatter\.0\.mean: not a known key"),
    ],
)
def test_scatter_that_makes_no_sense_is_refused_at_its_place(tmp_path: Path, entry: Any, sentence: str) -> None:
    given = {key: value for key, value in (WEAK | entry).items() if value is not None}
    with pytest.raises(ConfigError, match=sentence):
        scattered(tmp_path, given)


def test_a_parameter_that_is_0_cannot_scatter(tmp_path: Path) -> None:
    entry = WEAK | {"parameters": ["compressive_break"]}
    with pytest.raises(ConfigError, match=r"'compressive_break' is 0 in bonds\.model"):
        scattered(tmp_path, entry, **{"bonds.model.compressive_break": 0})


def test_a_bond_beyond_the_bounds_of_its_model_is_refused_before_anything_runs(tmp_path: Path) -> None:
    entry = {"parameters": ["poisson_ratio"], "distribution": "lognormal", "deviation": 0.8}
    config = scattered(tmp_path, entry)
    refused = r"bonds\.scatter\.0: the factor .* of bond \d+ makes poisson_ratio .* must be less than 0\.5"
    with pytest.raises(ConfigError, match=refused):
        check_start(build_scene(config))
    with pytest.raises(ConfigError, match=refused):
        forecast(config)

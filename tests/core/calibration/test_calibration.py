"""Calibrations find what is known: the modulus of a sphere between two plates, and what cannot be found."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from click.testing import CliRunner

from clast import Simulation, load, run_scene
from clast.calibration.config import load_calibration
from clast.calibration.identify import identify
from clast.calibration.proposal import misfit, next_point, next_points, optimum
from clast.calibration.record import read_record
from clast.calibration.responses import Goal, Response
from clast.calibration.surrogate import fit
from clast.cli import main
from clast.errors import ConfigError
from clast.studies.axis import Axis
from clast.studies.axis_config import AxisConfig
from clast.studies.design import quantiles
from clast.studies.measures import measure
from tests.scenes import write

SPHERE = """
name: sphere
materials:
  glass: {density: 2500 kg/m3, young_modulus: 420 MPa, poisson_ratio: 0.2}
  plate: {density: 2500 kg/m3, young_modulus: 1 GPa, poisson_ratio: 0.2}
particles: {type: explicit, material: glass, particles: [{position: [0, 0, 0], radius: 1 mm}]}
contacts: {law: hertz_mindlin, pairs: {default: {restitution: 0.2, sliding_friction: 0.3}}}
walls:
  upper:
    {type: plane, material: plate, point: [0, 0, 1 mm], normal: [0, 0, -1],
     motion: {type: constant_velocity, velocity: [0, 0, -0.2 m/s]}}
  lower: {type: plane, material: plate, point: [0, 0, -1 mm], normal: [0, 0, 1]}
compression: {upper: upper, lower: lower, height: 2 mm, diameter: 2 mm}
time: {step: 1e-6 s, end: {strain: 0.05}}
output: {samples: 60, frames: 0, writers: []}
"""
GLASS, PLATE = "materials.glass.young_modulus", "materials.plate.young_modulus"
BOUNDS = {"from": "100 MPa", "to": "1000 MPa"}


def calibration_file(folder: Path, **keys: Any) -> Path:
    """Write the scene and a calibration of it."""
    write(folder, SPHERE, "sphere.yaml")
    given = {"base": "sphere.yaml", "parameters": {GLASS: BOUNDS}, "repeats": 1, "budget": 10, **keys}
    return write(folder, yaml.safe_dump(given, sort_keys=False), "fit.yaml")


def measured(folder: Path, **changes: Any) -> dict[str, float]:
    """Return what the sphere really gives."""
    run_scene(load(write(folder, SPHERE, "sphere.yaml")).changed(changes), folder / "truth")
    return {name: value for name, value in measure(folder / "truth")[0].items() if value is not None}


def calibrate(file: Path, folder: Path) -> Any:
    """Calibrate as a user does."""
    return CliRunner().invoke(main, ["calibrate", str(file), "-o", str(folder), "--workers", "2"])


def test_a_modulus_is_found_from_a_force_and_the_scene_that_is_left_has_it(tmp_path: Path) -> None:
    target = {"peak_force_N": {"value": measured(tmp_path)["peak_force_N"], "within": 0.01}}
    file = calibration_file(tmp_path, targets=target)
    told = calibrate(file, tmp_path / "out")
    assert told.exit_code == 0, told.output
    fitted = load(tmp_path / "out" / "fitted.yaml")
    assert fitted.materials["glass"].young_modulus == pytest.approx(420e6, rel=0.02)
    assert Simulation(fitted).last_step > 0
    page = (tmp_path / "out" / "calibration.md").read_text()
    assert f"| {GLASS} | 1e+08 to 1e+09 | 4.2" in page.replace("4.1", "4.2")
    account = read_record(tmp_path / "out" / "account.json")
    assert (account.name, account.points, account.repeats, account.runs, account.failed) == ("fit", 10, 1, 10, 0)
    assert [row[0] for row in account.parameters.rows] == [GLASS]
    assert account.targets.rows[0][0] == account.sensitivities.rows[0][0] == "peak_force_N"
    assert abs(account.distances[0]) < 1.0
    assert account.left_open == []
    assert (tmp_path / "out" / "fit.png").read_bytes().startswith(b"\x89PNG")
    before = {each: each.stat().st_mtime_ns for each in (tmp_path / "out" / "runs").rglob("summary.json")}
    assert len(before) == 10
    assert calibrate(file, tmp_path / "out").exit_code == 0
    assert before == {each: each.stat().st_mtime_ns for each in (tmp_path / "out" / "runs").rglob("summary.json")}


def test_a_modulus_is_found_from_a_whole_curve(tmp_path: Path) -> None:
    measured(tmp_path)
    with (tmp_path / "truth" / "curves.csv").open(newline="") as file:
        rows = [(row["strain"], row["stress_Pa"]) for row in csv.DictReader(file)]
    write(tmp_path, "strain,stress_Pa\n" + "\n".join(",".join(row) for row in rows[::3]), "measured.csv")
    told = calibrate(calibration_file(tmp_path, targets={"curve": {"file": "measured.csv"}}), tmp_path / "out")
    assert told.exit_code == 0, told.output
    assert load(tmp_path / "out" / "fitted.yaml").materials["glass"].young_modulus == pytest.approx(420e6, rel=0.05)


def test_moduli_that_only_act_together_are_said_to(tmp_path: Path) -> None:
    """Two bodies in contact have one modulus: 1/E* is the sum of both."""
    target = {"peak_force_N": {"value": measured(tmp_path)["peak_force_N"], "within": 0.02}}
    file = calibration_file(tmp_path, parameters={GLASS: BOUNDS, PLATE: BOUNDS}, targets=target, budget=20)
    told = calibrate(file, tmp_path / "out")
    assert f"{GLASS} and {PLATE} cannot be told apart" in told.output
    assert "2 parameters, 1 targets" in (tmp_path / "out" / "calibration.md").read_text()
    left_open = read_record(tmp_path / "out" / "account.json").left_open
    assert [sentence.split(":")[0] for sentence in left_open] == [
        f"{GLASS} and {PLATE} cannot be told apart",
        "2 parameters, 1 targets",
    ]


def test_a_parameter_that_does_nothing_is_said_to(tmp_path: Path) -> None:
    target = {"peak_force_N": {"value": measured(tmp_path)["peak_force_N"], "within": 0.02}}
    friction = {"contacts.pairs.default.sliding_friction": {"from": 0, "to": 1}}
    file = calibration_file(tmp_path, parameters={GLASS: BOUNDS} | friction, targets=target, budget=16)
    told = calibrate(file, tmp_path / "out")
    assert "contacts.pairs.default.sliding_friction is hardly determined" in told.output
    assert "not determined" in told.output


def test_an_optimum_at_the_end_of_a_range_is_said_to_be(tmp_path: Path) -> None:
    target = {"peak_force_N": {"value": measured(tmp_path)["peak_force_N"], "within": 0.02}}
    narrow = {GLASS: {"from": "100 MPa", "to": "300 MPa"}}
    told = calibrate(calibration_file(tmp_path, parameters=narrow, targets=target, budget=6), tmp_path / "out")
    assert f"{GLASS} lies at the end of its range: a wider range may fit better" in told.output


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"targets": {}}, "targets: "),
        ({"targets": {"peak_force_N": {}}}, "a target needs data"),
        ({"targets": {"peak_forse_N": {"value": 1}}}, "did you mean 'peak_force_N'?"),
        ({"targets": {"peak_force_N": {"value": "3 parsec"}}}, "parsec"),
        ({"targets": {"peak_force_N": {"value": 0}}}, "must not be 0"),
        ({"targets": {"peak_force_N": {"value": "2 mm"}}}, "is a length; a force is needed"),
        ({"targets": {"drops": {"value": 1}}, "parameters": {GLASS: {"from": 2, "to": 1}}}, "must be below 'to'"),
        ({"targets": {"peak_force_N": {"scatter": 1}}}, "scatter of peak_force_N cannot be told from 1 runs"),
        ({"targets": {"curve": {"value": 1}}}, "'curve' needs it"),
        ({"targets": {"curve": {"file": "none.csv"}}}, "'none.csv' cannot be read"),
        ({"targets": {"curve": {"file": "sphere.yaml"}}}, "needs columns of numbers"),
        ({"targets": {"drops": {"value": 1}}, "parameters": {GLASS: [1, 2]}}, "a parameter needs bounds"),
        ({"targets": {"drops": {"value": 1}}, "parameters": {"materials.glas.young_modulus": BOUNDS}}, "'glas'"),
        ({"targets": {"drops": {"value": 1}}, "budget": 4, "repeats": 2}, "at least 4 points"),
        ({"targets": {"drops": {"value": 1}}, "budget": 1}, "must be at least 4"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(tmp_path: Path, keys: dict[str, Any], message: str) -> None:
    told = calibrate(calibration_file(tmp_path, **keys), tmp_path / "out")
    assert told.exit_code == 2, told.output
    assert message in told.output
    assert "fit.yaml" in told.output


def test_runs_that_all_fail_end_in_a_sentence(tmp_path: Path) -> None:
    file = calibration_file(tmp_path, targets={"peak_force_N": {"value": 1.0}}, set={"time.step": "1 s"})
    told = calibrate(file, tmp_path / "out")
    assert told.exit_code == 2
    assert "only 0 points have a result for peak_force_N; runs fail: " in told.output


def bowl(points: np.ndarray, noise: float) -> list[list[Response]]:
    """Return two goals that are both met at (0.3, 0.6) only."""
    random = np.random.default_rng(3)
    exact = np.column_stack([points[:, 0] + points[:, 1], points[:, 0] * points[:, 1]])
    return [[Response(float(x + noise * random.normal()), noise) for x in row] for row in exact]


GOALS = [Goal("sum", "a", False, 0.9, 0.02), Goal("product", "b", False, 0.18, 0.02)]


def exact_misfit(point: np.ndarray) -> float:
    return float(misfit((np.array([point[0] + point[1], point[0] * point[1]]) - [0.9, 0.18]) / 0.02))


def test_points_are_proposed_where_the_goals_are_met() -> None:
    points = quantiles("sobol", 10, 2, 1)
    for k in range(8):
        points = np.vstack([points, next_point(fit(points, bowl(points, 0.002), GOALS), points, k)])
    assert exact_misfit(optimum(fit(points, bowl(points, 0.002), GOALS), points, 1)) < 1.0


def test_points_that_are_chosen_together_differ_and_meet_the_goals_too() -> None:
    points = quantiles("sobol", 10, 2, 1)
    for k in range(2):
        surrogate = fit(points, bowl(points, 0.002), GOALS)
        chosen = np.array(next_points(surrogate, points, 4, 10 * k))
        assert len(np.unique(chosen, axis=0)) == 4
        assert (chosen[0] == next_point(surrogate, points, 10 * k)).all()
        points = np.vstack([points, chosen])
    assert exact_misfit(optimum(fit(points, bowl(points, 0.002), GOALS), points, 1)) < 1.0


def test_a_belief_takes_doubt_away_and_changes_no_mean_at_its_point() -> None:
    points = quantiles("sobol", 10, 2, 1)
    surrogate, new = fit(points, bowl(points, 0.02), GOALS), np.array([[0.95, 0.05]])
    mean, deviation = surrogate.predict(new)
    believed, less = surrogate.believing(new[0]).predict(new)
    assert believed == pytest.approx(mean, abs=1e-6)
    assert (less < deviation).all()


def test_how_many_points_are_chosen_together_follows_from_the_file_alone(tmp_path: Path) -> None:
    targets = {"peak_force_N": {"value": 5.0}}
    for keys, count in (
        ({"budget": 96, "repeats": 4}, 3),
        ({"budget": 960, "repeats": 4}, 4),
        ({"budget": 10, "repeats": 1}, 1),
        ({"budget": 10, "repeats": 1, "at_once": 7}, 7),
    ):
        assert load_calibration(calibration_file(tmp_path, targets=targets, **keys)).together == count


def test_a_budget_is_kept_however_many_points_are_chosen_together(tmp_path: Path) -> None:
    file = calibration_file(tmp_path, targets={"peak_force_N": {"value": 5.0}}, budget=8, at_once=50)
    assert calibrate(file, tmp_path / "out").exit_code == 0
    assert len((tmp_path / "out" / "history.csv").read_text().splitlines()) == 1 + 8


def test_the_deviation_of_a_logarithmic_parameter_is_that_at_its_value() -> None:
    axis = Axis("x", AxisConfig.model_validate({"from": "2 MPa", "to": "20 MPa", "spacing": "log"}))
    step = (axis.at(0.5001).number or 0.0) - (axis.at(0.4999).number or 0.0)
    assert axis.slope(0.5) == pytest.approx(step / 2e-4, rel=1e-6)
    assert Axis("x", AxisConfig.model_validate({"from": 1, "to": 5})).slope(0.2) == 4.0


def test_noise_without_repeats_is_read_from_the_points() -> None:
    """Points that scatter about a straight line do not make it wave."""
    random = np.random.default_rng(5)
    points = np.sort(random.random((14, 1)), axis=0)
    values = 20.0 * points[:, 0] + random.normal(size=14)
    told = fit(points, [[Response(float(x), 0.0)] for x in values], [Goal("a", "a", False, 10.0, 1.0)])
    grid = np.linspace(0.0, 1.0, 101)[:, None]
    assert np.abs(told.predict(grid)[0][:, 0] - (20.0 * grid[:, 0] - 10.0)).max() < 3.0
    assert told.slopes(np.array([0.5]))[0, 0] == pytest.approx(20.0, abs=8.0)


def test_the_smallest_budget_is_enough(tmp_path: Path) -> None:
    target = {"peak_force_N": {"value": measured(tmp_path)["peak_force_N"], "within": 0.1}}
    assert calibrate(calibration_file(tmp_path, targets=target, budget=4), tmp_path / "out").exit_code == 0


def test_noise_is_not_taken_for_a_trend() -> None:
    points = np.random.default_rng(1).random((12, 2))
    noisy = fit(points, bowl(points, 0.2), GOALS)
    _, deviation = noisy.predict(points)
    assert (deviation[:, 0] * 0.02 > 0.03).all()


def test_the_information_of_slopes_is_fishers() -> None:
    sure = identify(np.array([[10.0, 0.0], [0.0, 20.0]]), np.ones(2))
    assert sure.deviation == pytest.approx([(100 + 12) ** -0.5, (400 + 12) ** -0.5])
    assert sure.loose == []
    together = identify(np.array([[10.0, 10.0]]), np.ones(1))
    assert together.loose == [[0, 1]]
    nothing = identify(np.array([[10.0, 0.0]]), np.ones(1))
    assert nothing.loose == [[1]]
    assert nothing.deviation[1] == pytest.approx(12**-0.5)


def test_a_calibration_is_the_same_every_time(tmp_path: Path) -> None:
    target = {"peak_force_N": {"value": 5.0}}
    file = calibration_file(tmp_path, targets=target, budget=8)
    for name in ("one", "two"):
        assert calibrate(file, tmp_path / name).exit_code == 0
    for name in ("history.csv", "fitted.yaml", "account.json"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="no such file"):
        load_calibration(tmp_path / "none.yaml")

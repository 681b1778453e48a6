"""Ensembles: samples whose mean, deviation and Weibull modulus are known."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.studies.axis import weibull_modulus
from clast.studies.ensemble import LEAST, draw_weibull, summarise, weibull, write_ensemble
from clast.studies.expectation_config import Expectation
from clast.studies.table import Row, Table
from clast.studies.tasks import Task
from clast.studies.verdict import NOT_REPRODUCED, OPEN, REPRODUCED, judge


def table(forces: list[float]) -> Table:
    """Return runs with some crushing forces."""
    tasks = [Task(f"{k}", "", k, 0, (), "") for k in range(len(forces))]
    return Table([Row(task, "done", "", {"peak_force_N": f}) for task, f in zip(tasks, forces, strict=True)])


def drawn(count: int) -> list[float]:
    """Return forces of a Weibull distribution with mean 15 N and deviation 5 N."""
    modulus = weibull_modulus(1.0 / 3.0)
    sample = np.random.default_rng(4).weibull(modulus, count)
    return list(sample * 15.0 / weibull(sample.tolist()).mean)


@settings(max_examples=10)
@given(st.floats(1.2, 20.0), st.floats(0.1, 1e3))
def test_a_weibull_distribution_is_found_again(modulus: float, scale: float) -> None:
    found = weibull(list(scale * np.random.default_rng(2).weibull(modulus, 4000)))
    assert found.modulus == pytest.approx(modulus, rel=0.05)
    assert found.scale == pytest.approx(scale, rel=0.05)


def test_a_summary_holds_the_truth_within_its_intervals() -> None:
    found = summarise(drawn(200))
    assert found.mean_low < 15.0 < found.mean_high
    assert found.deviation_low < 5.0 < found.deviation_high
    assert found.deviation_high - found.deviation_low < 1.5


def test_an_ensemble_is_written_and_drawn(tmp_path: Path) -> None:
    assert write_ensemble(table(drawn(30)), tmp_path / "ensemble.csv")
    with (tmp_path / "ensemble.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert (row["measure"], row["grains"]) == ("peak_force_N", "30")
    assert float(row["mean"]) == pytest.approx(15.0, rel=0.2)
    assert draw_weibull(table(drawn(30)), tmp_path / "weibull.png")
    assert (tmp_path / "weibull.png").read_bytes().startswith(b"\x89PNG")


def test_too_few_grains_are_no_ensemble(tmp_path: Path) -> None:
    assert not write_ensemble(table(drawn(LEAST - 1)), tmp_path / "ensemble.csv")
    assert not draw_weibull(table(drawn(LEAST - 1)), tmp_path / "weibull.png")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("value", "count", "verdict"), [(5.0, 200, REPRODUCED), (9.0, 200, NOT_REPRODUCED), (9.0, 4, OPEN)]
)
def test_a_scatter_can_be_expected(value: float, count: int, verdict: str) -> None:
    keys = {"says": "s", "check": "equals", "of": "deviation", "measure": "peak_force_N", "value": value}
    (found,) = judge(table(drawn(count)), [Expectation.model_validate(keys)])
    assert found.verdict == verdict

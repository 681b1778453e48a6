"""Plots of a study can be read: labels do not run into each other, and stand in the units of the study file."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from clast.studies.axis import Axis
from clast.studies.axis_config import AxisConfig
from clast.studies.plots import SHOWN, measures_figure
from clast.studies.table import Row, Table
from clast.studies.tasks import Task

APART = 5.0
"""Pixels between two labels: about one digit."""


def table(**axes: Any) -> Table:
    """Return runs at the values of some axes side by side, with every measure that is drawn."""
    made = [Axis(name, AxisConfig.model_validate(given)) for name, given in axes.items()]
    points = zip(*(axis.settings for axis in made), strict=True)
    measures = dict.fromkeys(SHOWN, 0.123456)
    return Table([Row(Task(str(k), "", k, 0, point, ""), "done", "", measures) for k, point in enumerate(points)])


def figure_of(**axes: Any) -> Any:
    found = measures_figure(table(**axes))
    assert found is not None
    found.canvas.draw()
    return found


@pytest.mark.parametrize(
    "values",
    [
        [-0.0045, -0.0025],
        [0.0050, 0.0075],
        ["0.4350", "0.4625"],
        {"from": "2 MPa", "to": "20 MPa", "points": 5, "spacing": "log"},
        {"from": 1e-9, "to": 1e3, "points": 13, "spacing": "log"},
        {"from": 2.0, "to": 200.0, "points": 5, "spacing": "log"},
    ],
)
def test_labels_of_ticks_do_not_run_into_each_other(values: Any) -> None:
    figure = figure_of(x=values)
    for panel in figure.axes:
        boxes = [label.get_window_extent() for label in panel.get_xticklabels() if label.get_text()]
        inside = sorted((box.x0, box.x1) for box in boxes if panel.bbox.x0 - 1 <= (box.x0 + box.x1) / 2)
        assert len(inside) > 1
        assert all(right[0] - left[1] > APART for left, right in pairwise(inside))


def test_an_axis_is_labelled_in_the_unit_of_the_study_file() -> None:
    figure = figure_of(
        primary=["0.15 mm", "500 um"], strength={"from": "2 MPa", "to": "8 MPa", "points": 2}, plain=[1, 2]
    )
    rows = np.array(figure.axes).reshape(3, len(SHOWN))
    assert [panel.get_xlabel() for panel in rows[:, 0]] == ["primary, mm", "strength, MPa", "plain (SI)"]
    drawn = [panel.containers[0].lines[0].get_xdata() for panel in rows[:, 0]]
    assert [x.tolist() for x in drawn] == [pytest.approx(x) for x in ([0.15, 0.5], [2.0, 8.0], [1.0, 2.0])]


def test_values_of_a_range_are_told_in_the_unit_of_its_ends_and_named_as_ever() -> None:
    axis = Axis("x", AxisConfig.model_validate({"from": "2 MPa", "to": "8 MPa", "points": 3}))
    assert [setting.label for setting in axis.settings] == ["2 MPa", "5 MPa", "8 MPa"]
    assert [setting.slug for setting in axis.settings] == ["2e+06", "5e+06", "8e+06"]
    assert axis.settings[0].changes["x"] == "2000000.0 m-1 kg1 s-2"


def test_what_has_no_numbers_is_not_drawn() -> None:
    assert measures_figure(table(x=["soft", "hard"])) is None

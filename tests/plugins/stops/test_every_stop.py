"""Every condition: it can be tried, asks for what there is, and is reached when it says."""

from __future__ import annotations

import numpy as np
import pytest

from clast.config.examples import example
from clast.errors import PluginError
from clast.parts.params import Params
from clast.parts.stop import UNBALANCE, Stop
from clast.plugins.discovery import discover
from clast.testing.kit import try_part


def part(name: str) -> Stop:
    return discover().get("stop", name).part


def curves(**columns: list[float]) -> dict[str, np.ndarray]:
    quiet = {
        "time_s": [0.0, 1.0],
        "strain": [0.0, 0.0],
        "stress_Pa": [0.0, 0.0],
        "bonds_broken": [0.0, 0.0],
        "bonds_intact": [4.0, 4.0],
        UNBALANCE: [1.0, 1.0],
    }
    return {name: np.array(values) for name, values in (quiet | columns).items()}


def asked(name: str, changes: dict[str, object], **columns: list[float]) -> str | None:
    return part(name).reached(example(part(name).Params, changes), curves(**columns))


@pytest.mark.parametrize("name", discover().names("stop"))
def test_it_keeps_to_what_holds_for_every_condition(name):
    outcomes = try_part(discover().get("stop", name))
    assert [outcome for outcome in outcomes if not outcome.passed] == []


def test_a_force_drop_counts_from_the_highest_peak_and_only_from_one_that_is_high_enough():
    changes = {"share": 0.4, "least": 5.0}
    assert asked("force_drop", changes, stress_Pa=[0, 4, 1]) is None
    assert asked("force_drop", changes, stress_Pa=[0, 10, 6.1]) is None
    assert asked("force_drop", changes, stress_Pa=[0, 10, 8, 6]) == "the stress fell to 6 Pa, 60% of its peak, 10 Pa"
    assert asked("force_drop", changes, stress_Pa=[0, -1, -2]) is None


def test_rest_is_a_ratio_that_stays_small():
    changes = {"limit": 0.01, "samples": 3}
    assert asked("at_rest", changes, **{UNBALANCE: [0.0, 0.0]}) is None
    assert asked("at_rest", changes, **{UNBALANCE: [0.0, 0.02, 0.0, 0.0]}) is None
    assert asked("at_rest", changes, **{UNBALANCE: [0.0, float("nan"), 0.0]}) is None
    told = asked("at_rest", changes, **{UNBALANCE: [1.0, 0.009, 0.0, 0.001]})
    assert told == "at rest: unbalanced forces are 0.009 of those that hold, at 3 samples in a row"


def test_strain_and_broken_bonds_are_reached_at_their_number():
    assert asked("strain", {"strain": 0.1}, strain=[0, 0.099]) is None
    assert asked("strain", {"strain": 0.1}, strain=[0, 0.1]) == "the strain reached 0.1"
    assert asked("bonds_broken", {"share": 0.5}, bonds_broken=[0, 1], bonds_intact=[4, 3]) is None
    assert asked("bonds_broken", {"share": 0.5}, bonds_broken=[0, 2], bonds_intact=[4, 2]) == "2 of 4 bonds are broken"
    assert asked("bonds_broken", {}, bonds_broken=[0, 0], bonds_intact=[0, 0]) is None


def test_a_condition_that_asks_for_a_column_that_there_is_not_is_refused():
    with pytest.raises(PluginError, match="asks for 'colour'; on demand there is unbalanced_force_ratio"):
        Stop(summary="odd", Params=Params, reached=lambda params, curves: None, columns=("colour",))


def test_a_force_on_a_wall_is_its_length_or_its_component():
    columns = {"force_upper_x_N": [0.0, 3.0], "force_upper_y_N": [0.0, 0.0], "force_upper_z_N": [0.0, -4.0]}
    assert asked("force", {"above": 5.01}, **columns) is None
    assert asked("force", {"above": 5.0}, **columns) == "the force on upper rose to 5 N"
    assert asked("force", {"above": 3.9, "direction": [0, 0, -2]}, **columns) == "the force on upper rose to 4 N"
    assert asked("force", {"above": None, "below": -3.9, "direction": [0, 0, 1]}, **columns) is not None
    assert asked("force", {"above": None, "below": 4.99}, **columns) is None


def test_a_force_falls_below_a_value_only_once_it_has_been_above():
    def fell(*along: float, **changes: object) -> str | None:
        columns = {f"force_upper_{c}_N": [0.0] * len(along) for c in "xy"} | {"force_upper_z_N": list(along)}
        return asked("force", {"above": None, "below": 1.0, **changes}, **columns)

    assert fell(0.0) is None
    assert fell(0.0, 0.0, 1.0, 0.5) is None
    assert fell(0.0, 1.5) is None
    assert fell(0.0, -1.5, -0.5) == "the force on upper fell to 0.5 N"
    assert fell(2.0, 1.0) == "the force on upper fell to 1 N"
    assert fell(0.0, 0.0, below=0.0) is None
    assert fell(0.0, 2.0, 0.0, below=0.0) == "the force on upper fell to 0 N"
    assert fell(-3.0, -2.0, below=-1.0, direction=[0, 0, 1]) is None


def test_time_counts_from_the_first_sample_and_stages_are_over_at_0():
    assert asked("elapsed", {"time": 2.0}, time_s=[5.0, 6.0]) is None
    assert asked("elapsed", {"time": 2.0}, time_s=[5.0, 7.0]) == "2 s have passed"
    assert asked("stages_over", {}, stage_upper=[1.0, 2.0]) is None
    assert asked("stages_over", {}, stage_upper=[2.0, 0.0]) == "all stages of upper are over"

"""A bond whose ends turn against each other by half a turn breaks: beyond that its strains would come back from the
other side."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from clast import Simulation, load, open_run, run_scene
from tests.scenes import write

TWISTED = """
name: twisted
materials: {glass: {density: 2500, young_modulus: 1e9, poisson_ratio: 0.2}}
particles:
  type: explicit
  material: glass
  particles:
    - {position: [0, 0, 0], radius: 1 mm, fixed: true}
    - {position: [2.1 mm, 0, 0], radius: 1 mm, spin: SPIN, prescribed: true}
  bonds:
    - {between: [0, 1], diameter: 1 mm}
bonds:
  kinematics: total
  model: {type: elastic, young_modulus: 1e9, poisson_ratio: 0.2, normal_strength: 1e15}
time: {step: 1e-5, end: {steps: 1000}}
output: {samples: 4, frames: 2, writers: [], ledger: true, tracks: {bonds: [0]}}
"""


@pytest.mark.parametrize("spin", ["[1000, 0, 0]", "[-1000, 0, 0]", "[0, 1000, 0]"])
def test_it_breaks_at_half_a_turn_and_what_it_held_is_booked(tmp_path: Path, spin: str) -> None:
    scene = load(write(tmp_path, TWISTED.replace("SPIN", spin)))
    simulation = Simulation(scene)
    simulation.advance_to(round(0.99 * np.pi / 1e-2))
    assert simulation.bonds_broken == 0
    run_scene(scene, tmp_path / "run")
    with open_run(tmp_path / "run") as run:
        assert run.cracks["time"] == pytest.approx([np.pi / 1000], rel=0.01)
        assert [run.crack_modes[mode] for mode in run.cracks["mode"]] == ["turned"]
        energy = {name: run.curves[f"energy_{name}_J"][-1] for name in ("driven", "broken", "error")}
    assert energy["broken"] == pytest.approx(energy["driven"], rel=0.02)
    assert abs(energy["error"]) < 0.02 * energy["driven"]


def test_one_that_is_turned_less_and_back_holds(tmp_path: Path) -> None:
    simulation = Simulation(load(write(tmp_path, TWISTED.replace("SPIN", "[1000, 0, 0]"))))
    for turned, way in ((0.98, 1.0), (-0.98, -1.0), (0.98, 1.0)):
        simulation.world.particles.twist[1, 4] = 1000.0 * way
        target = simulation.step + round((0.98 + (0.0 if simulation.step == 0 else 0.98)) * np.pi / 1e-2)
        simulation.advance_to(target)
        q = simulation.world.particles.pose[1, 4:8]
        assert 2.0 * np.arctan2(q[1], q[0]) == pytest.approx(turned * np.pi, abs=0.03)
    assert simulation.bonds_broken == 0


def test_both_ends_may_turn_together_as_often_as_they_like(tmp_path: Path) -> None:
    text = TWISTED.replace("SPIN", "[1000, 0, 0]").replace("fixed: true", "spin: [1000, 0, 0], prescribed: true")
    simulation = Simulation(load(write(tmp_path, text)))
    simulation.advance_to(1000)
    assert simulation.bonds_broken == 0

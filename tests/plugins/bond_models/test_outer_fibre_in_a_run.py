"""The outermost fibre in the compiled loop: which bonds of a run break, when, and how."""

from __future__ import annotations

from pathlib import Path

import pytest

from clast import load, open_run, run_scene
from tests.scenes import CRUSH, write

PAIR = """
name: pair
materials:
  glass: {density: 570 kg/m3, young_modulus: 420 MPa, poisson_ratio: 0.2}
particles:
  type: explicit
  material: glass
  particles:
    - {position: [0, 0, 0], radius: 0.125 mm, fixed: true}
    - {position: [0, 0, 0.25 mm], radius: 0.125 mm, spin: SPIN, prescribed: true}
  bonds:
    - {between: [0, 1], diameter: 0.2 mm}
bonds:
  model: {type: MODEL, young_modulus: 420 MPa, poisson_ratio: 0.2, yield_stress: 2 MPa, breakage_strain: 0.0075,
          moment_limit: outer_fibre, breakage_strain_at: outer_fibre, breakage_shear_strain: 0.03}
time: {step: 1 us, end: {time: 1 ms}}
output: {samples: 10, frames: 0, writers: []}
"""
RATE = 100.0  # rad/s


@pytest.mark.parametrize("model", ["elastic_plastic", "micro_cracking"])
@pytest.mark.parametrize(
    ("spin", "angle", "mode"),
    [
        ("[0, 100, 0]", 0.0075 * 0.25 / 0.1, "strain in bending"),  # ε_max L0/R
        ("[0, 0, 100]", 0.03 * 0.25 / 0.1, "strain in torsion"),  # γ_max L0/R
    ],
)
def test_a_bond_between_a_held_and_a_turning_particle_breaks_in_the_step_that_reaches_its_angle(
    tmp_path: Path, model: str, spin: str, angle: float, mode: str
) -> None:
    run_scene(load(write(tmp_path, PAIR.replace("SPIN", spin).replace("MODEL", model))), tmp_path / "run")
    with open_run(tmp_path / "run") as run:
        assert [run.crack_modes[int(k)] for k in run.cracks["mode"]] == [mode]
        assert run.cracks["time"][0] == pytest.approx(angle / RATE, abs=1.1e-6)


@pytest.mark.parametrize("shear_limit", [None, 0.03])
def test_in_a_grain_bonds_break_by_bending_torsion_or_shear_where_they_are_asked_to(
    tmp_path: Path, shear_limit: float | None
) -> None:
    scene = load(write(tmp_path, CRUSH)).changed({"time.end.strain": 0.08})
    fibre = {"bonds.model.breakage_strain_at": "outer_fibre", "bonds.model.breakage_shear_strain": shear_limit}
    found = []
    for number, each in enumerate((scene, scene.changed(fibre))):
        run_scene(each, tmp_path / str(number))
        with open_run(tmp_path / str(number)) as run:
            found.append({run.crack_modes[int(k)] for k in run.cracks["mode"]})
    assert found[0] <= {"strain in tension", "strain in compression"}
    assert found[1] & {"strain in bending", "strain in shear", "strain in torsion"}

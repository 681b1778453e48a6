"""Energy from nowhere stops a run, whatever drives its scene; a step above the limit is told at the end."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from clast import Simulation, load, run_scene
from clast.config.scene import SceneConfig
from clast.errors import RunError
from clast.plugins.new import write_starter
from clast.results.in_words import summary_rows
from clast.soundness.energy import Balance
from clast.soundness.suspects import foreign_laws
from tests.scenes import CRUSH, write

UNSTABLE = {"time.allow_unstable": True, "output.samples": 500}


def at_share(folder: Path, share: float, changes: dict[str, Any]) -> SceneConfig:
    """Return the small crush with a step that is a share of its true limit at the start."""
    scene = load(write(folder, CRUSH))
    return scene.changed({"time.step": share * Simulation(scene).limits.spectral, **changes})


@pytest.mark.parametrize("share", [1.05, 1.1, 1.2, 1.3])
@pytest.mark.parametrize("ledger", [False, pytest.param(True, marks=pytest.mark.long)])
def test_a_crush_above_the_limit_is_stopped_before_its_plates_have_done_anything(
    tmp_path: Path, share: float, ledger: bool
) -> None:
    scene = at_share(tmp_path, share, {**UNSTABLE, "output.ledger": ledger})
    with pytest.raises(RunError, match="energy came from nowhere"):
        run_scene(scene, tmp_path / "run")


@pytest.mark.parametrize("share", [0.3, 0.8])
def test_a_crush_below_the_limit_is_not(tmp_path: Path, share: float) -> None:
    outcome = run_scene(at_share(tmp_path, share, {"output.samples": 500}), tmp_path / "run")
    assert outcome.summary["bonds_broken"] > 10
    assert outcome.summary["time_step_warning"] is None
    assert "WARNING" not in dict(summary_rows(outcome.summary))


def test_a_step_that_the_scene_outgrows_is_told_at_the_end(tmp_path: Path) -> None:
    outcome = run_scene(at_share(tmp_path, 0.97, UNSTABLE), tmp_path / "run")
    told = json.loads((tmp_path / "run" / "summary.json").read_text())["time_step_warning"]
    assert told.startswith("do not trust these results: the step was up to 1.")
    assert dict(summary_rows(outcome.summary))["WARNING"] == told


def test_energy_is_compared_with_the_look_that_leaves_the_least(tmp_path: Path) -> None:
    simulation = Simulation(load(write(tmp_path, CRUSH)))
    watch, ledger = simulation.soundness.energy, simulation.ledger()._replace(kinetic=0.0, contact_elastic=0.0)
    watch.note(ledger._replace(kinetic=1.0))
    watch.note(ledger._replace(kinetic=0.5))
    watch.note(ledger._replace(kinetic=0.6, walls=0.3))
    assert watch.balance == Balance(0.6, 0.3, 0.3, 0.0)
    gained = ledger._replace(kinetic=100.0, walls=0.3)
    assert "energy came from nowhere" in str(watch.complaint(gained, simulation.world))
    assert watch.complaint(gained._replace(walls=100.0), simulation.world) is None


def test_the_advice_names_laws_that_are_not_clasts_own_only(tmp_path: Path) -> None:
    file = write(tmp_path, CRUSH)
    assert foreign_laws(load(file)) == ""
    law = write_starter("damping", "mine", tmp_path / "mine.py")
    told = foreign_laws(load(file, [f"plugins=[{law}]", "damping={type: mine, rate: 0.5}"]))
    assert told.endswith(f": try damping 'mine' ({law}) with 'clast plugins check'")

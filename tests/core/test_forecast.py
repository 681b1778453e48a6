"""What a run will cost, told without packing: right within what is said, where packing or running can tell."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tracemalloc
from pathlib import Path
from typing import Any

import pytest

from clast import load
from clast.building import build_scene
from clast.config.scene import SceneConfig
from clast.errors import ConfigError
from clast.forecast import forecast, time_concerns
from clast.forecast_memory import COMPILER_BYTES
from clast.forecast_results import frame_bytes, frame_count, size_concerns
from clast.results.run import open_run
from clast.scene.plan import blueprint
from clast.scene.wall_rows import wall_rows
from clast.session import run_scene
from clast.stability.time_step import choose_step, limits, pair_limit
from tests.scenes import COLLISION, CRUSH, write

CONFIGS = Path(__file__).parents[2] / "configs"
GRAIN = "paper/fig09_model1.yaml"
CUT = "crush_grain.yaml"


@pytest.mark.parametrize(
    ("config", "changes"),
    [
        (CUT, {}),
        (GRAIN, {}),
        (GRAIN, {"particles.seed": 7}),
        (GRAIN, {"particles.porosity": 0.6}),
        (GRAIN, {"particles.porosity": 0.75}),
        (GRAIN, {"particles.primary_diameter": "0.18 mm"}),
        (GRAIN, {"particles.primary_diameter": "0.5 mm", "particles.porosity": 0.5, "bonds.between.max_gap": "0.2 mm"}),
        (GRAIN, {"bonds.between.max_gap": "0.0125 mm"}),
        (GRAIN, {"bonds.between.max_gap": "0.07 mm"}),
        (GRAIN, {"bonds.between.max_gap": "0.25 mm"}),
        (GRAIN, {"bonds.between.min_gap": "0.05 mm"}),
        (GRAIN, {"bonds.between.min_gap": "-0.01 mm"}),
        (
            CUT,
            {
                "particles.height": "1 mm",
                "particles.porosity": 0.75,
                "walls.upper.point": [0, 0, 1],
                "walls.lower.point": [0, 0, -1],
            },
        ),
    ],
)
def test_as_many_bonds_are_made_as_were_told(config: str, changes: dict[str, Any]) -> None:
    scene = load(CONFIGS / config).changed(changes)
    told = forecast(scene)
    built = build_scene(scene)
    assert told.particles == len(built.radius)
    assert told.bonds is not None
    assert 0.04 < told.bonds.band < 0.25
    assert len(built.ends) == pytest.approx(told.bonds.value, rel=told.bonds.band)


def test_the_rule_s_time_step_is_that_of_two_touching_primaries() -> None:
    scene = load(CONFIGS / CUT)
    built = build_scene(scene)
    exact = choose_step(built, limits(built, blueprint(built)))
    told = forecast(scene)
    assert told.time_step == pytest.approx(exact, rel=1e-3)
    assert "clast check --build" in told.text()


def test_the_limit_of_a_pair_is_never_below_that_of_the_network() -> None:
    for config in (CUT, GRAIN):
        built = build_scene(load(CONFIGS / config))
        assert limits(built, blueprint(built)).network <= pair_limit(built)


def test_what_is_written_down_is_counted_and_not_estimated(tmp_path: Path) -> None:
    scene = load(write(tmp_path, COLLISION)).changed(
        {
            "bonds.between.max_gap": "2 um",
            "bonds.model": {
                "type": "elastic",
                "young_modulus": "1 MPa",
                "poisson_ratio": 0.2,
                "normal_strength": "1 MPa",
                "shear_strength": "1 MPa",
            },
        }
    )
    told = forecast(scene)
    assert (told.particles, told.bonds) == (2, (1.0, 0.0))
    assert re.search(r"^bonds +1$", told.text(), re.MULTILINE)
    assert told.steps == 4000
    assert told.notes == ()


def test_without_a_bonds_section_there_are_no_bonds() -> None:
    data = {key: value for key, value in load(CONFIGS / GRAIN).document.data.items() if key != "bonds"}
    from clast.config.scene import from_mapping

    assert forecast(from_mapping(data)).bonds == (0.0, 0.0)


def test_materials_that_the_scene_does_not_bond_have_no_bonds() -> None:
    scene = load(CONFIGS / GRAIN)
    for material, bonds in (("glass", forecast(scene).bonds), ("steel", (0.0, 0.0))):
        assert forecast(scene.changed({"bonds.between.materials": [material]})).bonds == bonds


def test_bonds_of_spheres_that_all_but_touch_are_known_only_after_packing() -> None:
    told = forecast(load(CONFIGS / GRAIN).changed({"bonds.between.max_gap": "1 um"}))
    assert told.bonds is None
    assert "known after packing" in told.text()


def test_a_step_above_the_limit_of_two_neighbours_is_refused_before_anything_is_packed() -> None:
    with pytest.raises(ConfigError, match=r"time\.step: 0\.0001 s is above .* two neighbours alone are unstable"):
        forecast(load(CONFIGS / GRAIN).changed({"time.step": "0.1 ms"}))
    assert forecast(load(CONFIGS / GRAIN).changed({"time.step": "0.1 ms", "time.allow_unstable": True})).steps == 540


def test_a_run_of_days_or_of_absurdly_many_steps_is_pointed_out() -> None:
    scene = load(CONFIGS / GRAIN)
    assert forecast(scene).concerns == ()
    (concern,) = forecast(scene.changed({"time.step": "1e-11 s"})).concerns
    assert re.search(r"fig09_model1\.yaml:54:1: time: 5,400,000,000 steps, about \d+ days on one core; take a", concern)
    assert time_concerns(scene, steps=10**6, seconds=3 * 86400.0) != []
    with pytest.raises(ConfigError, match=r"time\.end: 5\.4e\+16 steps of 1e-18 s, more than 1e\+12; end earlier"):
        forecast(scene.changed({"time.step": "1e-18 s"}))


def test_more_memory_than_the_machine_has_is_pointed_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sysconf", {"SC_PAGE_SIZE": 4096, "SC_PHYS_PAGES": 50_000}.get)
    (concern,) = forecast(load(CONFIGS / GRAIN)).concerns
    assert concern.endswith(
        "particles: about 207 MB of memory are needed, this machine has 205 MB; take fewer particles"
    )


def _plate(cells: int) -> list[list[list[float]]]:
    """Return the triangles of a plate of so many squares along each side."""
    corners = [((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)) for x in range(cells) for y in range(cells)]
    return [
        [[1e-4 * c for c in (*at, -100.0)] for at in (a, *more)] for a, b, c, d in corners for more in ((b, c), (c, d))
    ]


def test_the_triangles_of_a_wall_count_in_the_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = load(write(tmp_path, COLLISION))
    meshed = scene.changed({"walls": {"plate": {"type": "mesh", "material": "glass", "triangles": _plate(50)}}})
    told = forecast(meshed).memory - forecast(scene).memory
    built = build_scene(meshed)
    plan = blueprint(built)
    tracemalloc.start()
    wall_rows(built, plan)
    _, rows = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert rows < told < 2.0 * rows  # the surface, its picture and what numbers in lists leave behind come on top
    monkeypatch.setattr("clast.forecast_memory.SHAPE_NUMBER_BYTES", 1e5)
    monkeypatch.setattr(os, "sysconf", {"SC_PAGE_SIZE": 4096, "SC_PHYS_PAGES": 80_000}.get)
    (concern,) = forecast(meshed).concerns
    assert concern.endswith("of memory are needed, this machine has 328 MB; make surfaces coarser")


RUN = """
import sys
from pathlib import Path
from clast.commands import run as run_command
run_command.run(Path(sys.argv[1]), output=Path(sys.argv[2]))
print(Path("/proc/self/status").read_text())
"""
"""Ends with the peak memory of this process alone: what getrusage tells begins with that of the parent."""


def _peak(scene: Path, folder: Path) -> tuple[bool, float]:
    """Run a scene in a process of its own; return whether it compiled, and its peak memory in bytes."""
    command = [sys.executable, "-c", RUN, str(scene), str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    (peak,) = re.findall(r"VmHWM:\s+(\d+) kB", done.stdout)
    return "compiling" in done.stdout, 1024.0 * float(peak)


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="no /proc to read the peak memory from")
@pytest.mark.parametrize("diameter", ["1.2 mm", "5 mm"])
def test_a_run_needs_about_the_memory_that_was_told(tmp_path: Path, diameter: str) -> None:
    text = CRUSH.replace("diameter: 1.2 mm\n  primary", f"diameter: {diameter}\n  primary")
    text = text.replace("primaries: 55", "porosity: 0.5").replace("end: {strain: 0.3}", "end: {steps: 5}")
    scene = write(tmp_path, text.replace("0.6 mm]", "2.5 mm]"))
    told = forecast(load(scene)).memory
    compiled, peak = _peak(scene, tmp_path / "first")
    if compiled:
        assert told < peak < 1.3 * (told + COMPILER_BYTES)
        compiled, peak = _peak(scene, tmp_path / "second")
    assert not compiled
    assert peak == pytest.approx(told, rel=0.25)


def test_a_generator_of_one_s_own_needs_no_prediction(tmp_path: Path) -> None:
    write(
        tmp_path,
        "from clast import hookimpl\n"
        "from clast.parts.generator import Generator\n"
        "from clast_plugins.generators.explicit import Explicit, generate\n"
        "CLAST_API = 1\n"
        "@hookimpl\n"
        "def clast_register(registry):\n"
        "    registry.generator('mine', Generator('the same again', Explicit, generate))\n",
        "mine.py",
    )
    text = "plugins: [mine.py]\n" + COLLISION.replace("type: explicit", "type: mine")
    assert forecast(load(write(tmp_path, text))).particles == 2


def test_a_track_of_a_particle_that_will_not_be_there_is_refused() -> None:
    scene = load(CONFIGS / GRAIN)
    forecast(scene.changed({"output.tracks": {"particles": [360], "bonds": [9999]}}))
    with pytest.raises(
        ConfigError, match=r"output\.tracks\.particles\.0: there is no number 361; the number of particles"
    ):
        forecast(scene.changed({"output.tracks.particles": [361]}))


def test_a_scene_that_cannot_start_is_refused_as_far_as_it_shows(tmp_path: Path) -> None:
    scene: SceneConfig = load(write(tmp_path, COLLISION))
    with pytest.raises(ConfigError, match=r"particles\.particles\.1: particle 1 overlaps particle 0"):
        forecast(scene.changed({"particles.particles.1.position": ["0.5 mm", 0, 0]}))


def test_results_become_as_large_as_was_told(tmp_path: Path) -> None:
    scene = load(write(tmp_path, CRUSH)).changed({"output.frames": 40})
    run_scene(scene, tmp_path / "run")
    told = forecast(scene)
    size = (tmp_path / "run" / "results.h5").stat().st_size
    built = build_scene(scene)
    with open_run(tmp_path / "run") as run:
        assert run.n_frames == pytest.approx(frame_count(scene), abs=1)
    least = 40 * (40 * len(built.radius) + 9 * len(built.ends))
    assert least < frame_count(scene) * frame_bytes(scene, len(built.radius), len(built.ends)) < size
    assert "41 frames" in told.text()


def test_large_results_are_pointed_out_with_the_frames_that_fit(tmp_path: Path) -> None:
    scene = load(write(tmp_path, CRUSH.replace("frames: 12", "frames: 300")))
    line = CRUSH.splitlines().index(next(each for each in CRUSH.splitlines() if each.startswith("output"))) + 1
    assert size_concerns(scene, 280_000, 1_700_000) == [
        f"{tmp_path / 'scene.yaml'}:{line}:23: output.frames: the results need about 9 GB of disk, 30 MB a frame; "
        "132 frames would need 4 GB"
    ]
    assert size_concerns(scene.changed({"output.frames": 100}), 280_000, 1_700_000) == []
    without = scene.changed({"output.frames": 0})
    assert size_concerns(without, 280_000, 1_700_000) == []
    assert "curves only" in forecast(without).text()

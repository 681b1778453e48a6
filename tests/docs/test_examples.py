"""What the documentation shows works as it stands."""

import ast
import re
import runpy
from pathlib import Path

import h5py
import numpy as np
import pytest
import yaml

import clast

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def track(folder, kind, name):
    with h5py.File(folder / "results.h5") as file:
        return file[f"tracks/{kind}/{name}"][:, 0]


def test_the_python_example_runs_and_draws(tmp_path):
    figure = runpy.run_path(str(DOCS / "examples" / "python_api.py"))["main"](tmp_path)
    assert figure.stat().st_size > 1000
    with clast.open_run(tmp_path) as run:
        assert run.complete
        assert run.curves["stress_Pa"].max() > 1e5


def test_the_readme_shows_the_smallest_scene_and_its_python_runs(tmp_path, monkeypatch):
    (shown,) = blocks(ROOT / "README.md", "yaml")
    scene = ROOT / "configs" / "bouncing_sphere.yaml"
    assert shown in scene.read_text(encoding="utf-8")
    (tmp_path / "configs").mkdir()
    (tmp_path / "configs" / scene.name).write_text(shown, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    (code,) = blocks(ROOT / "README.md", "python")
    exec(compile(code, "README.md", "exec"), {})
    assert (tmp_path / "runs" / "softer_sphere" / "results.h5").is_file()


def test_the_page_on_parts_shows_the_example():
    page = DOCS / "write-a-part.md"
    (shown,) = blocks(page, "python")
    example = (DOCS / "examples" / "my_law.py").read_text(encoding="utf-8")
    assert ast.dump(ast.parse(shown)) == ast.dump(ast.parse(example))
    (wanted,) = (yaml.safe_load(text) for text in blocks(page, "yaml"))
    scene = yaml.safe_load((DOCS / "examples" / "my_law.yaml").read_text(encoding="utf-8"))
    assert wanted == {key: scene[key] for key in wanted}
    assert len(page.read_text(encoding="utf-8").splitlines()) <= 120


def test_the_parts_of_the_page_do_what_they_promise(tmp_path):
    """The bond takes its fracture energy from the ball; the wall gives back half of the speed."""
    clast.run_scene(clast.load(DOCS / "examples" / "my_law.yaml"), tmp_path)
    speed = track(tmp_path, "particles", "velocity")[:, 2]
    mass = 2500 * 4 / 3 * np.pi * 1e-3**3
    fracture = np.pi / 4 * 1e-3**2 * 2e-3 * 100e6 * 0.001 * 0.004 / 2  # A L0 E eps_0 eps_f / 2
    assert speed[100] == pytest.approx(np.sqrt(0.3**2 - 2 * fracture / mass), rel=1e-3)
    assert speed[-1] == pytest.approx(-0.5 * speed[100], rel=0.01)
    strain, stress = track(tmp_path, "bonds", "axial_strain"), track(tmp_path, "bonds", "normal_stress")
    softens = (strain > 0.001) & (strain < 0.004)
    assert softens.sum() > 3
    assert stress[softens] == pytest.approx(100e6 * 0.001 * (0.004 - strain[softens]) / 0.003, rel=1e-9)


def test_the_page_on_beds_shows_python_that_runs(bed_folder, monkeypatch, capsys):
    monkeypatch.chdir(bed_folder.parents[1])
    (code,) = blocks(DOCS / "granular.md", "python")
    exec(compile(code, "granular.md", "exec"), {})
    told = capsys.readouterr().out
    assert told.count("% strain: ") == 3
    with clast.open_run(bed_folder) as run:
        assert f"{len(run.cracks['bond'])} cracks in (24, 24)" in told


def test_every_link_between_pages_leads_somewhere():
    pages = [ROOT / "README.md", ROOT / "CHANGELOG.md", *DOCS.rglob("*.md")]
    for page in pages:
        for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
            if not target.startswith("http"):
                assert (page.parent / target).exists(), f"{page}: {target}"

"""A report shows what becomes of a bed of grains, and says nothing of grains where there is only one."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import h5py
import pytest
import yaml
from click.testing import CliRunner

from clast.cli import main
from tests.viz.report.page import Page
from tests.viz.synthetic_run import small_grain, two_spheres, write_run


def page_of(*arguments: Path | str) -> Page:
    result = CliRunner().invoke(main, ["report", *map(str, arguments)])
    assert result.exit_code == 0, result.output
    return Page(Path(result.output.splitlines()[-1]))


@pytest.fixture
def bed(bed_folder: Path, tmp_path: Path) -> Path:
    return shutil.copytree(bed_folder, tmp_path / "bed")


def test_a_bed_has_a_section_with_charts_and_a_table(bed: Path) -> None:
    page = page_of(bed)
    assert "grains" in page.ids
    assert page.rows["grains"] == ["12"]
    summary = page.rows["grains intact, damaged, crushed"][0].split(", ")
    section = page.rows["intact, damaged, crushed at the end"][0].split(", ")
    assert [each.split()[0] for each in section] == summary
    assert page.rows["d50"][0].startswith("0.94 mm → ")
    for told in ("Grading by mass", "Where and when bonds broke", "Solid fraction near the wall", "ultimate, fractal"):
        assert told in page.text
    assert "Force chains at " in page.text
    assert re.search(r"\d+ links with [\d.e-]+ N on average; \d+% of them carry half of all force\. Lines", page.text)
    assert page.foreign == []
    assert len(set(page.ids)) == len(page.ids)


def test_a_page_about_a_bed_is_the_same_each_time(bed: Path) -> None:
    page_of(bed)
    first = (bed / "report.html").read_bytes()
    page_of(bed)
    assert (bed / "report.html").read_bytes() == first


def test_beds_lie_over_each_other_and_a_single_grain_beside_them_is_named(bed: Path, tmp_path: Path) -> None:
    other, single = shutil.copytree(bed, tmp_path / "other"), write_run(tmp_path / "one", small_grain())
    page = page_of(bed, other, single, "-o", str(tmp_path / "page.html"))
    assert page.rows["grains"] == ["12", "12"]
    assert "Where and when bonds broke: other" in page.text
    assert "one: not shown here, as it has one grain or none." in page.text


def test_runs_of_one_grain_or_of_loose_particles_have_no_such_section(tmp_path: Path) -> None:
    for scene in (small_grain(), two_spheres()):
        page = page_of(write_run(tmp_path / f"run{len(scene.radius)}", scene))
        assert "grains" not in page.ids


def test_a_bed_that_is_not_in_a_tube_and_one_that_cannot_be_looked_at_say_so(bed: Path) -> None:
    with h5py.File(bed / "results.h5", "r+") as file:
        del file["walls/tube"]
    page = page_of(bed)
    assert "No porosities and solid fractions, as no walls around the bed are named." in page.text
    assert "Solid fraction near the wall" not in page.text
    config = yaml.safe_load((bed / "config.yaml").read_text())
    (bed / "config.yaml").write_text(yaml.safe_dump({"name": config["name"]}))
    assert "does not tell the densities of glass, steel" in page_of(bed).text


def test_a_bed_without_a_compression_is_drawn_over_time(bed: Path, tmp_path: Path) -> None:
    with h5py.File(bed / "results.h5", "r+") as file:
        for name in ("strain", "stress_Pa"):
            del file[f"curves/{name}"]
        last = 1e3 * file["frames/time"][-1]
    config = yaml.safe_load((bed / "config.yaml").read_text())
    (bed / "config.yaml").write_text(yaml.safe_dump(config | {"compression": None}))
    page = page_of(bed)
    assert f"{last:.3g} ms" in page.text
    assert "bonds per ms" in page.text
    assert "strain [%]" not in page.text


def test_a_bed_of_which_one_frame_was_kept_has_no_course_but_a_grading(bed: Path, tmp_path: Path) -> None:
    with h5py.File(bed / "results.h5", "r+") as file:
        for data in file["frames"].values():
            data.resize(1, axis=0)
    for folders in ([bed], [bed, shutil.copytree(bed, tmp_path / "other")]):
        page = page_of(*folders, "-o", str(tmp_path / "page.html"))
        assert "What becomes of the grains" not in page.text
        assert "Grading by mass" in page.text
        assert page.rows["d50"][-1] == "0.94 mm → 0.94 mm"


def test_a_bed_of_which_contacts_were_not_kept_or_do_not_press_has_no_chains(bed: Path) -> None:
    with h5py.File(bed / "results.h5", "r+") as file:
        file["contacts/normal_force"][...] = 0.0
    assert "Force chains" not in page_of(bed).text
    with h5py.File(bed / "results.h5", "r+") as file:
        del file["frames/contacts_end"]
    assert "Force chains" not in page_of(bed).text


def test_the_tables_are_written_by_a_writer(bed: Path) -> None:
    result = CliRunner().invoke(main, ["write", str(bed), "grains"])
    assert result.exit_code == 0, result.output
    assert result.output.splitlines()[-1].strip() == str(bed / "grains")
    assert (bed / "grains" / "grading.csv").is_file()
    assert "grains/history.csv" in page_of(bed).loaded

"""What a user reads when something is wrong: one message with its place, an exit code, no traceback."""

from __future__ import annotations

import errno
import subprocess
import sys
from pathlib import Path
from typing import Any

import h5py
import pytest
from click.testing import CliRunner, Result

from clast.cli import main
from clast.results import curves
from clast.run_folder import run_folder
from tests.scenes import COLLISION

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
PAIR = """\
materials:
  glass: {density: 2500 kg/m3, young_modulus: 100 MPa, poisson_ratio: 0.25}
  steel: {density: 7850 kg/m3, young_modulus: 210 GPa, poisson_ratio: 0.3}
particles:
  type: explicit
  material: glass
  particles:
    - {position: [-1.1 mm, 0, 0], radius: 1 mm}
    - {position: [1.1 mm, 0, 0], radius: 1 mm}
  bonds:
    - {between: [0, 1], diameter: 1 mm}
bonds:
  model: {type: elastic, young_modulus: 100 MPa, poisson_ratio: 0.2, normal_strength: 1 MPa, shear_strength: 1 MPa}
contacts:
  law: hertz_mindlin
  pairs:
    default: {restitution: 0.5}
walls:
  floor: {type: plane, material: steel, point: [0, 0, -1 mm], normal: [0, 0, 1]}
time:
  step: 1e-7 s
  end: {steps: 10}
output: {writers: []}
"""
FILES = """\
  type: from_file
  particles: grain.csv
  bonds: bonds.csv
  material: glass
"""
EXPLICIT = PAIR[PAIR.index("  type: explicit") : PAIR.index("bonds:\n  model")]
GRAIN = """\
  type: spherical_agglomerate
  material: glass
  diameter: 0.75 mm
  primary_diameter: 0.25 mm
  porosity: 0.3
"""


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work in a folder of its own, so that messages name files as the user does."""
    monkeypatch.chdir(tmp_path)


def clast(*arguments: Any) -> Result:
    return CliRunner().invoke(main, [str(each) for each in arguments])


def scene(*replacements: tuple[str, str]) -> str:
    """Write the scene with some of its text replaced."""
    text = PAIR
    for old, new in replacements:
        assert old in text
        text = text.replace(old, new)
    Path("scene.yaml").write_text(text)
    return "scene.yaml"


def table(name: str, text: str) -> None:
    Path(name).write_text(text)


def said(result: Result, exit_code: int = 2) -> str:
    """Return the one message of a command that failed as it should."""
    assert isinstance(result.exception, SystemExit), result.exception
    assert result.exit_code == exit_code
    assert "Traceback" not in result.output
    return result.stderr.removesuffix("\n")


def test_the_scene_that_all_others_spoil_is_right() -> None:
    result = clast("check", "--build", scene())
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[1.1 mm, 0, 0]", "[0.5 mm, 0, 0]", "scene.yaml:9:7: particles.particles.1: particle 1 overlaps particle 0"),
        (
            "[0, 0, -1 mm]",
            "[0, 0, -0.5 mm]",
            "scene.yaml:19:3: walls.floor: particle 0 reaches 0.0005 m into this wall",
        ),
        (
            "writers: []",
            "tracks: {bonds: [0, 1]}",
            "scene.yaml:23:30: output.tracks.bonds.1: there is no number 1; the number of bonds is 1",
        ),
        ("1e-7 s", "1e-3 s", "scene.yaml:21:3: time.step: 0.001 s is above the stability limit of the bonds"),
        ("pairs:\n    default", "pairs:\n    glass-steel", "scene.yaml:16:3: contacts.pairs: 'glass-glass' is needed"),
        (
            "contacts:\n  law: hertz_mindlin\n  pairs:\n    default: {restitution: 0.5}\n",
            "",
            "scene.yaml:14:1: walls: particles fall through walls without a section 'contacts'",
        ),
    ],
)
def test_a_scene_that_cannot_start_is_told_with_file_line_and_key(old: str, new: str, message: str) -> None:
    for command in (["check", "--build"], ["run"]):
        told = said(clast(*command, scene((old, new))))
        assert told.startswith(message)
        assert len(told.splitlines()) == 1
    assert not Path("runs/scene").exists()


def test_a_value_from_the_command_line_is_told_as_it_was_written() -> None:
    told = said(clast("run", scene(), "--set", "time.step=1 ms"))
    assert told.startswith("--set time.step=1 ms: time.step: 0.001 s is above the stability limit")


def test_a_packing_that_is_too_dense_names_the_porosity() -> None:
    told = said(clast("run", scene((EXPLICIT, GRAIN), ("porosity: 0.3", "porosity: 0.4"))), exit_code=1)
    assert told.startswith("scene.yaml:9:3: particles.porosity: too dense for a random packing: 16 primaries")
    assert "Take a larger 'porosity'" in told


def test_a_packing_that_can_never_be_is_refused_before_it_is_tried() -> None:
    impossible = scene((EXPLICIT, GRAIN))
    for command in (["check"], ["check", "--build"], ["run"]):
        assert said(clast(*command, impossible)) == (
            "scene.yaml:9:3: particles.porosity: denser than any random packing: 18 primaries of 0.25 mm (porosity "
            "0.3) fill 67% of a sphere of 0.75 mm, and at most 66% can be filled. Take a larger 'porosity', or "
            "'accept_overlap: true' to go on with the best packing found"
        )
    assert clast("check", impossible, "--set", "particles.accept_overlap=true").exit_code == 0
    grain = "{type: spherical_agglomerate, material: glass, diameter: 1, primary_diameter: 0.1, primaries: 700}"
    told = said(clast("check", impossible, "--set", f"particles={grain}"))
    assert "particles.primaries: denser than any random packing: 700 primaries" in told


@pytest.mark.parametrize(
    "change",
    ["materials.glass.density=1e308", "materials.glass.density=1e-300", "particles.particles.0.radius=1e200"],
)
def test_a_mass_beyond_all_numbers_is_told_once(change: str) -> None:
    for command in (["check"], ["run"]):
        told = said(clast(*command, scene(), "--set", change))
        assert told.startswith("scene.yaml:8:7: particles.particles.0: particle 0 has a mass of ")
        assert told.endswith("can be computed with; check the units of radius and density, and time.mass_scaling")


@pytest.mark.parametrize("length", ["1e-300", "1e300"])
def test_a_direction_of_absurd_length_is_told(length: str) -> None:
    told = said(clast("check", scene(("normal: [0, 0, 1]", f"normal: [0, 0, {length}]"))))
    assert "walls.floor.normal: the length of" in told


def test_a_particle_outside_the_domain_is_told_before_the_run() -> None:
    domain = "boundaries: {domain: {lower: [-1, -1, -1], upper: [1 mm, 1, 1]}}\ntime:"
    for command in (["check"], ["run"]):
        assert said(clast(*command, scene(("time:", domain)))) == (
            "scene.yaml:9:7: particles.particles.1: particle 1, centred at (0.0011, 0, 0) m, is outside "
            "boundaries.domain at the start; move it, or make the domain larger"
        )


def test_a_function_of_a_plugin_that_raises_is_told_with_its_line() -> None:
    law = (EXAMPLES / "my_law.py").read_text()
    table("my_law.py", law.replace("    return BondConstants(1", "    oops()\n    return BondConstants(1"))
    table("scene.yaml", (EXAMPLES / "my_law.yaml").read_text())
    line = law[: law.index("    return BondConstants(1")].count("\n") + 1
    told = said(clast("run", "scene.yaml"))
    assert told == f"{Path('my_law.py').resolve()}:{line}: raised NameError: name 'oops' is not defined"


def test_a_plugin_that_cannot_be_loaded_is_one_message_with_file_and_line() -> None:
    table("my_law.py", "import clast\n\nnonsense(\n")
    table("scene.yaml", (EXAMPLES / "my_law.yaml").read_text())
    told = said(clast("check", "scene.yaml"))
    assert told.startswith(f"scene.yaml:2:11: plugins.0: {Path('my_law.py').resolve()}:3: SyntaxError")
    assert len(told.splitlines()) == 1


@pytest.mark.parametrize(
    ("particles", "bonds", "message"),
    [
        (None, None, "scene.yaml:6:3: particles.particles: grain.csv: there is no such file"),
        ("id,x,y,z,radius\n", None, "scene.yaml:6:3: particles.particles: grain.csv: holds a header but no rows"),
        ("id,x,y,z,radius\n4,0,0,0,-1\n", None, "grain.csv:2: radius is -1; it must be above 0"),
        ("id,x,y,z,radius\n4,0,0,0,1e-3\n", None, "scene.yaml:7:3: particles.bonds: bonds.csv: there is no such file"),
        ("id,x,y,z,radius\n4,0,0,0,1e-3\n", "i,j,diameter\n4,5,1e-3\n", "bonds.csv:2: j names particle 5"),
        (
            "id,x,y,z,radius,material\n4,0,0,0,1e-3,\n7,0.0022,0,0,1e-3,glas\n",
            "i,j,diameter\n4,7,1e-3\n",
            "grain.csv:3: there is no material 'glas'; did you mean 'glass'?",
        ),
        (
            "id,x,y,z,radius\n4,0,0,0,1e-3\n\n7,0.001,0,0,1e-3\n",
            "i,j,diameter\n4,7,1e-3\n",
            "grain.csv:4: particle 1 overlaps particle 0 (grain.csv:2) by 0.001 m",
        ),
    ],
)
def test_what_is_wrong_with_a_table_is_told_with_its_line(
    particles: str | None, bonds: str | None, message: str
) -> None:
    for name, text in (("grain.csv", particles), ("bonds.csv", bonds)):
        if text is not None:
            table(name, text)
    assert said(clast("run", scene((EXPLICIT, FILES)))).startswith(message)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "law: hertz_mindlin",
            "law: {type: hertz_mindlin, rollin: none}",
            "scene.yaml:15:30: contacts.law.rollin: not a known key; did you mean 'rolling'?",
        ),
        (
            "young_modulus: 100 MPa, poisson_ratio: 0.2, normal",
            "young_modulus: 100 mm, poisson_ratio: 0.2, normal",
            "scene.yaml:13:26: bonds.model.young_modulus: '100 mm' is a length; a stress is needed",
        ),
        ("1e-7 s", "1e-7 sec", "scene.yaml:21:3: time.step: '1e-7 sec': 'sec' is not a known unit; a time is needed"),
        (
            "[-1.1 mm, 0, 0], radius: 1 mm",
            "[-1.1 mm, 0, 0], radius: -1 mm",
            "scene.yaml:8:35: particles.particles.0.radius: must be greater than 0; given",
        ),
        (
            "between: [0, 1]",
            "between: [0, 2]",
            "scene.yaml:11:8: particles.bonds.0.between: there is no particle 2; the particles are counted from 0 to 1",
        ),
        (
            "radius: 1 mm}\n    - {position: [1",
            "radius: 1 mm, fixed: true, velocity: [1, 0, 0]}\n    - {position: [1",
            "scene.yaml:8:7: particles.particles.0: 'fixed: true' means no velocity",
        ),
        (
            "type: elastic",
            "type: elastc",
            "scene.yaml:13:11: bonds.model.type: no bond model is named 'elastc'; did you",
        ),
        (
            "type: plane",
            "type: plain",
            "scene.yaml:19:11: walls.floor.type: no wall is named 'plain'; did you mean 'plane'?",
        ),
        ("materials:", "materials: [", "scene.yaml:3:3: not valid YAML: did not find expected ',' or ']'"),
        (
            "type: explicit\n  material: glass",
            "type: explicit\n  material: glas",
            "scene.yaml:6:3: particles.material: there",
        ),
    ],
)
def test_what_is_wrong_with_a_scene_file_is_one_message_with_its_place(old: str, new: str, message: str) -> None:
    for command in ("check", "run"):
        told = said(clast(command, scene((old, new))))
        assert told.startswith(message)
        assert len(told.splitlines()) == 1


def test_a_scene_file_that_is_missing_or_no_text_is_told() -> None:
    assert said(clast("run", "none.yaml")) == "none.yaml: there is no such file"
    Path("scene.yaml").write_bytes(b"name: a\n\x89HDF\xff")
    assert said(clast("run", "scene.yaml")).startswith("scene.yaml:2: byte 0x89 is not UTF-8 text")
    Path("folder").mkdir()
    assert said(clast("run", "folder")) == "folder: this is a folder; a YAML file is needed"


def test_a_folder_with_anything_but_a_run_is_not_written_into() -> None:
    Path("thesis").mkdir()
    table("thesis/chapter.tex", "words")
    table("thesis/notes.txt", "more words")
    told = said(clast("run", scene(), "-o", "thesis"), exit_code=1)
    assert told == (
        "thesis: is not empty and not the folder of a run, it holds chapter.tex and 1 more; choose another with -o"
    )
    assert said(clast("run", scene(), "-o", "thesis/chapter.tex/run"), exit_code=1).startswith(
        "thesis/chapter.tex/run: cannot be written (Not a directory); choose another folder with -o"
    )
    assert said(clast("run", scene(), "-o", "new", "--resume"), exit_code=1).startswith("new: no run to resume here")


def test_a_run_is_neither_overwritten_nor_gone_on_with_by_another_scene() -> None:
    table("one.yaml", COLLISION)
    Path("run").mkdir()
    Path("run/log").touch()
    assert clast("run", "one.yaml", "-o", "run").exit_code == 0
    assert said(clast("run", "one.yaml", "-o", "run"), exit_code=1) == (
        "run: holds a run already; add --resume to go on with it, or choose another folder with -o"
    )
    told = said(clast("run", "one.yaml", "-o", "run", "--resume", "--set", "time.end.time=5e-4"), exit_code=1)
    assert told.startswith(
        "run/checkpoint.h5: belongs to another scene, so it cannot be resumed (time.end.time: 0.0004"
    )
    for name in ("checkpoint.h5", "checkpoint.previous.h5"):
        Path("run", name).write_bytes(b"torn")
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"), exit_code=1)
    assert told.startswith("run/checkpoint.h5: cannot be read")
    assert len(told.splitlines()) == 1


def spoilt_run(*removed: str) -> None:
    """Make a finished run and take some of its files away."""
    table("one.yaml", COLLISION)
    assert clast("run", "one.yaml", "-o", "run").exit_code == 0
    for name in removed:
        Path("run", name).unlink()


def test_results_that_lost_their_checkpoint_are_not_overwritten() -> None:
    spoilt_run("checkpoint.h5", "checkpoint.previous.h5")
    for options in ([], ["--resume"]):
        assert said(clast("run", "one.yaml", "-o", "run", *options), exit_code=1) == (
            "run: holds results but no checkpoint, so the run in it cannot go on, and is not overwritten either; "
            "choose another folder with -o, or delete this one"
        )


@pytest.mark.parametrize("options", [[], ["--resume"]])
def test_a_run_that_ended_before_its_first_checkpoint_is_begun_anew(options: list[str]) -> None:
    spoilt_run("checkpoint.h5", "checkpoint.previous.h5", "curves.csv", "summary.json")
    with h5py.File("run/results.h5", "r+") as file:
        for data in file["curves"].values():
            data.resize(1, axis=0)
    assert clast("run", "one.yaml", "-o", "run", *options).exit_code == 0
    assert len(Path("run/curves.csv").read_text().splitlines()) == 402


@pytest.mark.parametrize("keep", [0, 3000, 30_000])
def test_a_damaged_results_file_is_one_sentence_in_every_command(keep: int) -> None:
    spoilt_run()
    torn = Path("run/results.h5").read_bytes()[:keep]
    Path("run/results.h5").write_bytes(torn)
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"), exit_code=1)
    assert told.startswith("run/results.h5: is damaged, so the run cannot go on (")
    assert told.endswith("); start it anew in another folder with -o")
    assert said(clast("write", "run"), exit_code=1).startswith("run/results.h5: cannot be read (")
    assert said(clast("view", "run"), exit_code=1).startswith("run: holds no recording.rrd")


def test_results_that_the_checkpoint_has_outgrown_are_told() -> None:
    spoilt_run()
    with h5py.File("run/results.h5", "r+") as file:
        file["curves/time_s"].resize(10, axis=0)
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"), exit_code=1)
    assert "is damaged, so the run cannot go on (ValueError: curves has 10 rows, the checkpoint knows 401)" in told


def test_a_checkpoint_that_lacks_something_is_told() -> None:
    spoilt_run("checkpoint.previous.h5")
    with h5py.File("run/checkpoint.h5", "r+") as file:
        del file["particles/pose"]
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"), exit_code=1)
    assert told.startswith("run/checkpoint.h5: cannot be read (KeyError: 'particles/pose'): the run cannot go on")


def test_a_file_or_a_reader_in_the_way_of_a_run_is_told() -> None:
    spoilt_run()
    assert said(clast("run", "one.yaml", "-o", "one.yaml"), exit_code=1) == (
        "one.yaml: is a file, and the folder of the run is needed; choose another with -o"
    )
    hold = "import h5py, sys; f = h5py.File(sys.argv[1]); print('open', flush=True); sys.stdin.read()"
    command = [sys.executable, "-c", hold, "run/results.h5"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as reader:
        assert reader.stdout is not None
        reader.stdout.readline()
        told = said(clast("run", "one.yaml", "-o", "run", "--resume"), exit_code=1)
        reader.communicate()
    assert told == ("run/results.h5: another program has it open, perhaps one that reads it; close that and try again")


@pytest.mark.parametrize("options", [[], ["--resume"]])
def test_two_runs_do_not_write_into_one_folder(options: list[str]) -> None:
    spoilt_run()
    with run_folder(Path("run"), resume=True):
        told = said(clast("run", "one.yaml", "-o", "run", *options), exit_code=1)
    assert told == ("run: another run is writing into it; wait until it has ended, or choose another folder with -o")


def test_what_the_disk_refuses_is_told_with_the_name_of_the_file(monkeypatch: pytest.MonkeyPatch) -> None:
    table("one.yaml", COLLISION)

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device", "run/curves.csv")

    monkeypatch.setattr(curves, "write", full)
    told = said(clast("run", "one.yaml", "-o", "run"), exit_code=1)
    assert told == "run/curves.csv: No space left on device"

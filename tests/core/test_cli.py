"""The command line: one message, an exit code, and nothing heavy."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from clast.cli import main

HEAVY = ("numba", "h5py", "rerun", "vtk", "vtkmodules", "pyvista", "matplotlib")


def invoke(*arguments):
    return CliRunner().invoke(main, [str(each) for each in arguments])


def test_an_error_is_one_message_and_exit_code_2(tmp_path):
    (tmp_path / "s.yaml").write_text("materials: {}\nmaterials: {}\n")
    result = invoke("check", tmp_path / "s.yaml")
    assert result.exit_code == 2
    assert result.stderr == f"{tmp_path}/s.yaml:2:1: materials: said twice, first in line 1; remove one of them\n"
    assert result.stdout == ""


def test_a_missing_file_is_one_message(tmp_path):
    result = invoke("check", tmp_path / "none.yaml")
    assert (result.exit_code, result.stderr) == (2, f"{tmp_path}/none.yaml: there is no such file\n")


def test_parts_are_listed_and_shown():
    assert "hertz_mindlin" in invoke("plugins").stdout
    assert "yield_stress" in invoke("plugins", "show", "micro_cracking").stdout
    result = invoke("plugins", "show", "micro_craking")
    assert result.exit_code == 2
    assert "did you mean 'micro_cracking'?" in result.stderr


def test_a_plugin_of_the_command_line_is_beside_those_of_the_scene(tmp_path):
    examples = Path(__file__).parents[2] / "docs" / "examples"
    scene = (examples / "my_law.yaml").read_text()
    (tmp_path / "scene.yaml").write_text(scene[: scene.index("plugins:")] + scene[scene.index("materials:") :])
    result = invoke("check", tmp_path / "scene.yaml")
    assert result.exit_code == 2
    assert "no bond model is named 'softening'" in result.stderr
    result = invoke("check", tmp_path / "scene.yaml", "--plugin", examples / "my_law.py")
    assert result.exit_code == 0, result.output


def test_the_schema_is_json():
    schema = json.loads(invoke("schema").stdout)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert "bond_model micro_cracking" in schema["$defs"]


def test_run_offers_its_options():
    told = invoke("run", "--help").stdout
    for option in ("-o", "--set", "--threads", "--resume"):
        assert option in told


@pytest.mark.parametrize(
    "arguments",
    [["--help"], ["schema"], ["plugins"], ["check", "configs/crush_grain.yaml"]],
    ids=lambda a: a[0],
)
def test_nothing_heavy_is_imported(arguments, request):
    program = (
        "import sys\nfrom clast.cli import main\n"
        f"try: main({arguments!r})\nexcept SystemExit: pass\n"
        f"sys.exit(' '.join(name for name in {HEAVY!r} if name in sys.modules) or 0)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        cwd=request.config.rootpath,
        check=False,
    )
    assert done.returncode == 0, done.stderr

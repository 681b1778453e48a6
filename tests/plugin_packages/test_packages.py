"""Third parties' packages: built, installed into a clean environment, listed, checked, run, and removed again."""

from __future__ import annotations

import ast
import csv
import json
import os
import shutil
import site
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest

HERE = Path(__file__).parent
PACKAGES = sorted(HERE.glob("clast-*"))
PUBLIC = {"clast", "clast.config.quantities", "clast.errors", "clast.plugins.registry", "clast.results.run"}
PARTS = {
    "cones": "clast-cones",
    "tiring": "clast-fatigue",
    "honeycomb": "clast-honeycomb",
    "survivors": "clast-honeycomb",
}


class Environment:
    """A virtual environment with the third parties' packages, and all else from the parent's."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        venv.create(folder / "venv", with_pip=False)
        self.python = folder / "venv" / "bin" / "python"
        lib = subprocess.run(
            [self.python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
            capture_output=True, text=True, check=True,
        ).stdout.strip()  # fmt: skip
        parents = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib"), *site.getsitepackages()}
        lines = [f"import site; site.addsitedir({each!r})" for each in sorted(parents)]
        Path(lib, "parent.pth").write_text("\n".join([*lines, ""]))

    def pip(self, *arguments: object) -> None:
        """Run the parent's pip on this environment."""
        command = [sys.executable, "-m", "pip", "--quiet", "--python", self.python, *arguments]
        subprocess.run([str(each) for each in command], check=True, cwd=self.folder)

    def clast(self, *arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
        """Run clast in the environment, in its folder."""
        return subprocess.run(
            [str(self.python), "-m", "clast", *(str(each) for each in arguments)],
            capture_output=True, text=True, check=False, cwd=self.folder, env=os.environ | environment,
        )  # fmt: skip


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> Environment:
    folder = tmp_path_factory.mktemp("third-parties")
    for package in PACKAGES:
        shutil.copytree(package, folder / package.name)
    wheels = folder / "wheels"
    sources = [str(folder / package.name) for package in PACKAGES]
    subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(wheels), *sources], check=True
    )
    made = Environment(folder)
    made.pip("install", "--no-index", "--no-deps", *sorted(wheels.glob("*.whl")))
    shutil.copy(HERE / "scene.yaml", folder / "scene.yaml")
    return made


def test_the_packages_import_nothing_private() -> None:
    for file in HERE.glob("clast-*/src/**/*.py"):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "clast":
                parts = node.module.split(".")[:2] in (["clast", "parts"], ["clast", "maths"], ["clast", "testing"])
                assert parts or node.module in PUBLIC, f"{file}: {node.module}"
                assert not any(name.name.startswith("_") for name in node.names)


def test_packages_of_third_parties_are_listed_checked_run_and_removed(environment: Environment) -> None:
    told = environment.clast("plugins", "--json")
    assert told.returncode == 0, told.stderr
    listed = json.loads(told.stdout)
    sources = {part["name"]: (part["origin"], part["version"]) for part in listed["parts"]}
    assert {name: sources[name][0] for name in PARTS} == PARTS
    assert sources["cones"][1] == "0.3.1"
    assert {each["plugin"]: each["state"] for each in listed["plugins"]} == dict.fromkeys(
        ["clast_plugins", "clast_viz", "clast_cones", "clast_fatigue", "clast_honeycomb"], "ok"
    )

    for package in ("clast-cones", "clast-fatigue", "clast-honeycomb"):
        checked = environment.clast("plugins", "check", package, "--no-speed")
        assert checked.returncode == 0, checked.stdout + checked.stderr

    ran = environment.clast("run", "scene.yaml", "--threads", "1", "-o", "run")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    run = environment.folder / "run"
    survivors = [int(row["bonds"]) for row in csv.DictReader((run / "survivors.csv").open())]
    assert survivors[0] == 69
    assert survivors[-1] < survivors[0]
    parts = json.loads((run / "summary.json").read_text())["parts"]
    assert "clast-fatigue 1.0" in json.dumps(parts)

    blocked = environment.clast("run", "scene.yaml", "-o", "blocked", CLAST_PLUGINS="none")
    assert blocked.returncode == 2
    assert "no generator is named 'honeycomb'" in blocked.stderr
    states = json.loads(environment.clast("plugins", "--json", CLAST_PLUGINS="clast_cones").stdout)["plugins"]
    assert {each["plugin"] for each in states if each["state"] == "blocked"} == {"clast_fatigue", "clast_honeycomb"}

    environment.pip("uninstall", "--yes", *(package.name for package in PACKAGES))
    gone = environment.clast("check", "scene.yaml")
    assert gone.returncode == 2
    assert "no generator is named 'honeycomb'" in gone.stderr
    assert "cones" not in environment.clast("plugins").stdout

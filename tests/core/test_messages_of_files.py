"""What is wrong with a file, a scene or a table, is told with its line, also where the disk is to blame."""

from __future__ import annotations

import errno
from pathlib import Path

import pytest

from clast.results import curves
from tests.core.spoiled import EXPLICIT, FILES, clast, said, scene, table
from tests.scenes import COLLISION

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")


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
            "law: {type: hertz_mindlin, tension_cutof: true}",
            "scene.yaml:15:30: contacts.law.tension_cutof: not a known key; did you mean 'tension_cutoff'?",
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


def test_what_the_disk_refuses_is_told_with_the_name_of_the_file(monkeypatch: pytest.MonkeyPatch) -> None:
    table("one.yaml", COLLISION)

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device", "run/curves.csv")

    monkeypatch.setattr(curves, "write", full)
    told = said(clast("run", "one.yaml", "-o", "run"), exit_code=1)
    assert told == "run/curves.csv: No space left on device"

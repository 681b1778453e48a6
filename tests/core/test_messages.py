"""What a user reads when something is wrong: one message with its place, an exit code, no traceback."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.core.spoiled import EXPLICIT, GRAIN, PAIR, clast, said, scene, table

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
pytestmark = pytest.mark.usefixtures("in_an_empty_folder")


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
        (
            "  bonds:\n    - {between: [0, 1], diameter: 1 mm}\n",
            "",
            "scene.yaml:10:1: bonds: no particles are bonded; add 'between' with a 'max_gap'",
        ),
        (
            PAIR[PAIR.index("bonds:\n  model") : PAIR.index("contacts:")],
            "",
            "scene.yaml:10:3: particles.bonds: the scene has no section 'bonds' with a 'model' for these bonds; add it",
        ),
    ],
)
def test_a_scene_that_cannot_start_is_told_with_file_line_and_key(old: str, new: str, message: str) -> None:
    for command in (["check", "--build"], ["run"]):
        told = said(clast(*command, scene((old, new))))
        assert told.startswith(message)
        assert len(told.splitlines()) == 1
    assert not Path("runs/scene").exists()


@pytest.mark.parametrize(
    ("wall", "message"),
    [
        (
            "{type: mesh, material: glass,\n    file: none.stl,\n    unit: 1 mm}",
            "scene.yaml:20:5: walls.floor.file: {folder}/none.stl: cannot be read",
        ),
        (
            "{type: mesh, material: glass,\n    file: .,\n    unit: 1 mm}",
            "scene.yaml:20:5: walls.floor.file: {folder}: cannot be read: Is a directory",
        ),
        (
            "{type: mesh, material: glass,\n    file: none.stl}",
            "scene.yaml:20:5: walls.floor.file: a file needs a unit, such as '1 mm'",
        ),
        (
            "{type: block, material: glass, lower: [0, 0, 0],\n    upper: [1, 0, 1]}",
            "scene.yaml:20:5: walls.floor.upper: upper must be above lower along y; given 0 m and 0 m",
        ),
        (
            "{type: box, material: glass, lower: [0, 0, 0], upper: [1, 1, 1],\n"
            "    open: [left, right, front, back, bottom, top]}",
            "scene.yaml:20:5: walls.floor.open: all six faces are open",
        ),
        (
            "{type: plane, material: glass, point: [0, 0, -1 mm], normal: [0, 0, 1], motion: {type: table,\n"
            "    direction: [0, 0, 1],\n    displacement: [[1 s, 0], [2 s, 1]]}}",
            "scene.yaml:21:5: walls.floor.motion.displacement: the first row must be at the time 0; given 1 s",
        ),
        (
            "{type: plane, material: glass, point: [0, 0, -1 mm], normal: [0, 0, 1], motion: [\n"
            "    {type: constant_velocity, velocity: [0, 0, 1],\n    until: {type: force, wall: flor, above: 1 N}}]}",
            "scene.yaml:21:26: walls.floor.motion.0.until.wall: there is no wall 'flor'; did you mean 'floor'?",
        ),
    ],
)
def test_what_is_wrong_with_a_wall_is_told_at_the_key_that_is_to_blame(wall: str, message: str) -> None:
    old = PAIR[PAIR.index("  floor: ") : PAIR.index("time:")]
    told = said(clast("check", scene((old, f"  floor: {wall}\n"))))
    assert told.startswith(message.format(folder=Path().resolve()))


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
    bonded = ("--set", "bonds.between={max_gap: 0.1 mm}")
    assert clast("check", impossible, *bonded, "--set", "particles.accept_overlap=true").exit_code == 0
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


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (
            "shear=scale(kept * c.shear, strain.shear)",
            "shear=(1.0, 2.0, float('nan'))",
            "load must return finite numbers",
        ),
        ("return state.largest / c.eps_f", "return (state.largest, c.eps_f)", "failure must return float, given ("),
        ("BondState(max(state.largest,", "BondState(max(state.widest,", "has no attribute 'widest'"),
    ],
)
def test_a_law_that_gives_no_numbers_or_asks_for_what_it_never_declared_is_told(
    old: str, new: str, reason: str
) -> None:
    law = (EXAMPLES / "my_law.py").read_text()
    assert old in law
    table("my_law.py", law.replace(old, new))
    table("scene.yaml", (EXAMPLES / "my_law.yaml").read_text())
    told = said(clast("run", "scene.yaml"))
    assert told.startswith(f"{Path('my_law.py').resolve()}:")
    assert reason in told
    assert len(told.splitlines()) == 1


def test_a_plugin_that_cannot_be_loaded_is_one_message_with_file_and_line() -> None:
    table("my_law.py", "import clast\n\nnonsense(\n")
    table("scene.yaml", (EXAMPLES / "my_law.yaml").read_text())
    told = said(clast("check", "scene.yaml"))
    assert told.startswith(f"scene.yaml:2:11: plugins.0: {Path('my_law.py').resolve()}:3: SyntaxError")
    assert len(told.splitlines()) == 1


@pytest.mark.parametrize("section", ["materials", "walls", "compression", "contacts.pairs"])
def test_a_section_that_is_no_mapping_is_told_once(section: str) -> None:
    told = said(clast("check", scene(), "--set", f"{section}=.nan"))
    assert told == f"--set {section}=.nan: {section}: a mapping 'key: value' is needed; given nan"

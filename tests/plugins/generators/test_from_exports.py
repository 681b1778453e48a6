"""What Clast exported comes back: particles, bonds and grains; what is wrong with such a file is told with its line."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from tests.viz.synthetic_run import small_grain, three_grains, write_run

from clast import export_run, open_run
from clast.errors import ConfigError
from clast.parts.generator import Packing, Site
from clast_plugins.generators import from_file
from clast_plugins.generators.from_file import FromFile

FILES = {"lammps": "bonds.data", "vtkhdf": "particles.vtkhdf"}
each = pytest.mark.parametrize("to", sorted(FILES))
DATA = """a comment, 7 atoms # bpm/sphere
2 atoms
1 bonds
2 atom types # of glass and steel

Atoms # bpm/sphere

7 4 2 2e-3 2500 0 0 0
9 9 1 3e-3 2500 0 0 4e-3 0 0 1

Velocities

7 1 2 3 0 0 0

Bonds

1 1 9 7
"""


def read(folder: Path, file: str, **given: Any) -> Packing:
    return from_file.generate(FromFile(**{"particles": file, "material": "glass", **given}), Site(folder))


def of(folder: Path, text: str, **given: Any) -> Packing:
    (folder / "x.data").write_text(text)
    return read(folder, "x.data", **given)


@each
@pytest.mark.parametrize("scene", [small_grain, three_grains])
def test_the_last_frame_of_a_run_comes_back(to: str, scene: Any, tmp_path: Path) -> None:
    folder = write_run(tmp_path / "run", scene())
    exported = export_run(folder, to)
    made = read(exported if exported.is_dir() else exported.parent, FILES[to])
    with open_run(folder) as run:
        frame = run.frame(-1)
        here = np.flatnonzero(np.isfinite(frame.position).all(axis=1))
        np.testing.assert_allclose(made.position, frame.position[here], rtol=1e-8)
        np.testing.assert_allclose(made.radius, run.radius[here], rtol=1e-7)
        held = run.bond_ends[frame.bond_intact.astype(bool) & np.isin(run.bond_ends, here).all(axis=1)]
        assert made.bonds is not None
        assert {*map(frozenset, here[made.bonds.ends].tolist())} == {*map(frozenset, held.tolist())}
        _, grain = np.unique(run.grain[here], return_inverse=True)
        np.testing.assert_array_equal(made.grain, grain)


def test_types_name_materials_and_molecules_grains(tmp_path: Path) -> None:
    made = of(tmp_path, DATA, material=None, materials=["glass", "steel"])
    assert made.material == ["steel", "glass"]
    assert made.grain.tolist() == [0, 1]
    assert made.radius.tolist() == [1e-3, 1.5e-3]
    assert made.position[1].tolist() == [0.0, 0.0, 4e-3]
    assert made.bonds is not None
    assert made.bonds.ends.tolist() == [[1, 0]]
    assert made.bonds.diameter.tolist() == [2e-3]
    assert made.bonds.origin(0) == f"{tmp_path / 'x.data'}:17"
    assert made.origin(1) == f"{tmp_path / 'x.data'}:9"


def test_loose_atoms_of_the_style_sphere_are_read(tmp_path: Path) -> None:
    made = of(tmp_path, "c\n\nAtoms # sphere\n\n1 1 1.0 2500 0 0 0\n")
    assert made.bonds is None
    assert made.grain.tolist() == [0]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("Atoms # bpm/sphere", "Atoms", r"x\.data:6: no atom style after 'Atoms #'; bpm/sphere or sphere is needed"),
        ("Atoms # bpm/sphere", "Atoms # full", r"x\.data:6: the atom style 'full' after"),
        ("Atoms # bpm/sphere", "Masses", r"holds no atoms; a data file of LAMMPS"),
        ("2e-3 2500", "-2e-3 2500", r"x\.data:8: diameter is -2e-3; it must be above 0"),
        ("2e-3 2500", "2e-3", r"x\.data:8: 7 values for 8 columns \(id molecule type"),
        ("7 4 2", "9 4 2", r"x\.data:9: particle 9 is there already, in line 8"),
        ("7 4 2", "7 4 3", r"holds the material 3, and 2 names are given, for 1 to 2"),
        ("1 1 9 7", "1 1 9 8", r"x\.data:17: the bond names atom 8, which the file does not hold"),
        ("2 atoms", "3 atoms", r"its header tells 3 atoms, and it holds 2; is it cut off\?"),
        ("1 bonds", "2 bonds", r"its header tells 2 bonds, and it holds 1"),
    ],
)
def test_what_is_wrong_with_a_data_file_is_told_with_its_line(old: str, new: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=told):
        of(tmp_path, DATA.replace(old, new, 1), material=None, materials=["glass", "steel"])


def test_numbers_of_materials_need_names(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="tells materials by numbers; give 'material' for all, or 'materials'"):
        of(tmp_path, DATA, material=None)


@pytest.mark.parametrize("file", ["none.data", "none.vtkhdf"])
def test_a_missing_file_is_told(file: str, tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="there is no such file") as caught:
        read(tmp_path, file)
    assert caught.value.at == ("particles",)


def test_what_is_no_vtkhdf_of_points_is_told(tmp_path: Path) -> None:
    (tmp_path / "text.vtkhdf").write_text("no HDF5")
    with h5py.File(tmp_path / "other.vtkhdf", "w") as file:
        file.create_group("VTKHDF")
    for name in ("text.vtkhdf", "other.vtkhdf"):
        with pytest.raises(ConfigError, match=f"{name}: not a VTKHDF file with points over time"):
            read(tmp_path, name)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"particles": "x.data", "bonds": "b.csv"}, r"x\.data holds its bonds itself; leave 'bonds' out"),
        ({"particles": "x.csv", "materials": ["glass"]}, "a CSV file has a column 'material'"),
    ],
)
def test_keys_that_say_nothing_for_a_format_are_refused(given: dict, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        FromFile(**given)

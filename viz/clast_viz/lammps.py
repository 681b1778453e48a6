"""LAMMPS: a dump of all frames and a data file with the bonds of the last one, which OVITO reads too.

Source: https://docs.lammps.org/dump.html and https://docs.lammps.org/read_data.html
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from clast.errors import RunError
from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.frame import Frame
from clast.results.run import Run

FILE = "lammps"
DUMP, DATA = "particles.dump", "bonds.data"
COLUMNS = "id type mol x y z vx vy vz radius"
IMAGES = " ix iy iz"
_ROW = "%d %d %d" + " %.9g" * 6 + " %.17g"


class LammpsParams(Params):
    """Nothing to choose: all frames, in units ``si``; numbers of particles, bonds and types count from 1."""


def write_lammps(run: Run, params: LammpsParams, path: Path) -> Written:
    """Write a folder with ``particles.dump`` of all frames and ``bonds.data`` of the last one."""
    path.mkdir()
    densities = _densities(run)
    with (path / DUMP).open("w", encoding="utf-8") as file:
        file.write("ITEM: UNITS\nsi\n")
        for k in range(run.n_frames):
            _dump(file, run, run.frame(k))
    last = run.frame(-1)
    (path / DATA).write_text("\n".join(_data(run, last, densities)) + "\n", encoding="utf-8")
    return Written(path)


def _dump(file: TextIO, run: Run, frame: Frame) -> None:
    here = _present(frame)
    file.write(f"ITEM: TIME\n{frame.time:.17g}\nITEM: TIMESTEP\n{frame.step}\nITEM: NUMBER OF ATOMS\n{here.sum()}\n")
    file.write(f"ITEM: BOX BOUNDS {' '.join('pp' if repeats else 'ff' for repeats in run.periodic)}\n")
    file.writelines(f"{low:.9g} {high:.9g}\n" for low, high in _box(run, frame))
    file.write(f"ITEM: ATOMS {COLUMNS}{IMAGES if frame.box.repeats else ''}\n")
    who = np.column_stack([np.flatnonzero(here) + 1, run.material[here] + 1, _molecules(run)[here]])
    rows = np.column_stack([who, frame.position[here], frame.velocity[here], run.radius[here]])
    if frame.box.repeats:
        np.savetxt(file, np.column_stack([rows, frame.image[here]]), fmt=_ROW + " %d" * 3)
    else:
        np.savetxt(file, rows, fmt=_ROW)


def _data(run: Run, frame: Frame, density: NDArray[np.float64]) -> Iterator[str]:
    """Yield the lines of a data file for ``atom_style bpm/sphere``."""
    here = _present(frame)
    held = np.flatnonzero(frame.bond_intact & here[run.bond_ends].all(axis=1))
    yield f"{run.name}: {frame.time:.9g} s, step {frame.step}, strain {frame.strain:.9g}; units si"
    yield ""
    yield from (f"{here.sum()} atoms", f"{len(held)} bonds", f"{len(run.materials)} atom types", "1 bond types")
    if len(held):
        degree = int(np.bincount(run.bond_ends[held].ravel()).max())
        yield from (f"{degree} extra bond per atom", f"{4 * degree} extra special per atom")
    yield ""
    yield from (f"{low:.9g} {high:.9g} {a}lo {a}hi" for a, (low, high) in zip("xyz", _box(run, frame), strict=True))
    yield from ("", "Atoms # bpm/sphere", "")
    molecules = _molecules(run)
    for k in np.flatnonzero(here):
        x, y, z = frame.position[k]
        size = f"{2.0 * run.radius[k]:.17g} {density[k]:.17g}"
        image = " {} {} {}".format(*frame.image[k]) if frame.box.repeats else ""
        yield f"{k + 1} {molecules[k]} {run.material[k] + 1} {size} {x:.9g} {y:.9g} {z:.9g}{image}"
    if len(held):
        yield from ("", "Bonds", "")
        yield from (f"{b + 1} 1 {i + 1} {j + 1}" for b, (i, j) in zip(held, run.bond_ends[held], strict=True))


def _present(frame: Frame) -> NDArray[np.bool_]:
    return np.asarray(np.isfinite(frame.position).all(axis=1))


def _molecules(run: Run) -> NDArray[np.int64]:
    """Return the number of the grain of each particle from 1; 0 for those that belong to none."""
    return run.grain.astype(np.int64) + 1


def _box(run: Run, frame: Frame) -> list[tuple[float, float]]:
    """Return bounds around all spheres, those of the box where it repeats itself."""
    here = _present(frame)
    position = frame.position[here].astype(np.float64)
    if not len(position):
        return [(-1.0, 1.0)] * 3
    room = 2.0 * run.radius[here][:, None]
    low = np.where(frame.box.periodic, frame.box.lower, (position - room).min(axis=0))
    high = np.where(frame.box.periodic, frame.box.upper, (position + room).max(axis=0))
    return list(zip(low.tolist(), high.tolist(), strict=True))


def _densities(run: Run) -> NDArray[np.float64]:
    """Return the density of each particle in kg/m³, that of its material before any mass scaling."""
    try:
        of_material = [float(run.config["materials"][name]["density"]) for name in run.materials]
    except KeyError as error:
        raise RunError(f"{run.folder}/config.yaml: {error} is missing, so densities are not known") from None
    return np.array(of_material)[run.material]

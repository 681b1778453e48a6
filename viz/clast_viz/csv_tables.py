"""CSV: particles, bonds and contacts of every frame, the curves and the cracks as tables."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results import curves
from clast.results.frame import Frame
from clast.results.run import Run
from clast_viz.chains import pieces

FILE = "csv"
Columns = Mapping[str, NDArray[Any]]
_FORMATS = {"f4": "%.9g", "f8": "%.17g", "i": "%d", "u": "%d", "U": "%s"}
"""By type, or by kind of type; with so many digits reading gives the same bits again."""


class CsvParams(Params):
    """Nothing to choose: all frames, everything in SI, units in the names of the columns."""


def write_csv(run: Run, params: CsvParams, path: Path) -> Written:
    """Write the folder of tables: ``particles_K.csv``, ``bonds_K.csv``, ``contacts_K.csv`` of frame K, and others."""
    path.mkdir()
    curves.write(path / "curves.csv", run.curves)
    _table(path / "cracks.csv", _cracks(run))
    if run.n_frames:
        _table(path / "frames.csv", _frames(run))
    for k, number in enumerate(run.frame_numbers):
        frame, contacts = run.frame(k), run.contacts(k)
        _table(path / f"particles_{number:04d}.csv", _particles(run, frame))
        if len(run.bond_ends):
            _table(path / f"bonds_{number:04d}.csv", _bonds(run, frame))
        if contacts is not None:
            _table(path / f"contacts_{number:04d}.csv", _with_units(contacts._asdict(), _CONTACT_UNITS))
    return Written(path)


_CONTACT_UNITS = {"position": "m", "force": "N", "normal_force": "N", "tangential_force": "N"}
_CRACK_UNITS = {"time": "s", "position": "m", "normal_stress": "Pa", "shear_stress": "Pa", "energy": "J"}


def _particles(run: Run, frame: Frame) -> Columns:
    """Return the particles that are in the domain; ``id`` counts from 0."""
    here = np.isfinite(frame.position).all(axis=1)
    columns: Columns = {
        "id": np.arange(len(run.radius)),
        "position": frame.position,
        "velocity": frame.velocity,
        "radius": run.radius,
        "grain": run.grain,
        "material": run.material,
        "fragment": pieces(run, frame),
        **({"image": frame.image} if frame.box.repeats else {}),
    }
    return _with_units(
        {name: values[here] for name, values in columns.items()}, {"position": "m", "velocity": "m/s", "radius": "m"}
    )


def _bonds(run: Run, frame: Frame) -> Columns:
    columns: Columns = {
        "id": np.arange(len(run.bond_ends)),
        "i": run.bond_ends[:, 0],
        "j": run.bond_ends[:, 1],
        "diameter": run.bond_diameter,
        "length": run.bond_length,
        "intact": frame.bond_intact.astype(np.uint8),
        "stress": frame.bond_stress,
        "failure": frame.bond_failure,
    }
    return _with_units(columns, {"diameter": "m", "length": "m", "stress": "Pa"})


def _cracks(run: Run) -> Columns:
    """Return the cracks, with the names of their modes."""
    modes = np.array(run.crack_modes, dtype=np.str_)[run.cracks["mode"].astype(np.intp)]
    return _with_units({**run.cracks, "mode": modes}, _CRACK_UNITS)


def _frames(run: Run) -> Columns:
    """Return the moments of the frames."""
    step = run.frame_values("step").astype(np.int64)
    return {
        "frame": run.frame_numbers,
        "time_s": run.frame_values("time"),
        "step": step,
        "strain": run.frame_values("strain"),
    }


def _with_units(columns: Columns, units: Mapping[str, str]) -> dict[str, NDArray[Any]]:
    """Return columns with their units in their names, vectors as three.

    >>> list(_with_units({"id": np.zeros(1), "force": np.zeros((1, 3))}, {"force": "N"}))
    ['id', 'force_x_N', 'force_y_N', 'force_z_N']
    """
    named = {}
    for name, values in columns.items():
        unit = f"_{units[name].replace('/', '_per_')}" if name in units else ""
        if values.ndim == 1:
            named[f"{name}{unit}"] = values
        else:
            named |= {f"{name}_{axis}{unit}": values[:, k] for k, axis in enumerate("xyz")}
    return named


def _table(path: Path, columns: Columns) -> None:
    """Write columns of equal length."""
    formats = [_FORMATS.get(values.dtype.str[1:]) or _FORMATS[values.dtype.kind] for values in columns.values()]
    rows = np.rec.fromarrays([*columns.values()], dtype=[(name, values.dtype) for name, values in columns.items()])
    np.savetxt(path, rows, fmt=formats, delimiter=",", header=",".join(columns), comments="")

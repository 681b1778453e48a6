"""VTK: particles and bonds over time as one VTKHDF file for ParaView."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.room import SPARE, in_memory, room_beyond
from clast.results.run import Frame, Run
from clast_viz.column import Column

FILE = "particles.vtkhdf"

# VTK reads nothing, without a word, from files in the newest HDF5 layout
_LAYOUT = ("earliest", "v110")
_CELL_KINDS = ("Vertices", "Lines", "Polygons", "Strips")


class VtkParams(Params):
    """What the user can choose about the VTK file."""

    every: Annotated[int, Field(ge=1, description="Write every n-th frame; the last one always")] = 1


def write_vtk(run: Run, params: VtkParams, path: Path) -> Written:
    """Write ``particles.vtkhdf``: a temporal PolyData, each particle a vertex, each intact bond a line.

    Point data: ``id``, ``radius`` in m, ``velocity`` in m/s, ``grain``, ``material``. Cell data: ``stress``
    in Pa (tension positive) and ``failure`` (0 unloaded, 1 breaks) of the bonds, 0 on the vertices. Particles
    that have left the domain are absent from then on, so ``id`` says which particle a point is.

    Source: VTKHDF file format 2.2, https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/
    """
    import h5py

    if run.n_frames == 0:
        return Written(None, "the run has recorded no frame")
    path.write_bytes(in_memory(lambda file: file.create_group("VTKHDF"), libver=_LAYOUT))
    with h5py.File(path, "r+", libver=_LAYOUT) as file:
        polydata = TemporalPolyData(file)
        for k in _chosen_frames(run.n_frames, params.every):
            _append_frame(polydata, run, run.frame(k))
        polydata.close()
    return Written(path)


class TemporalPolyData:
    """Grows a VTKHDF PolyData one time step at a time.

    Parameters
    ----------
    file : h5py.File
        A file to write to, with an empty group ``VTKHDF``.
    """

    def __init__(self, file: Any) -> None:
        self._root = file["VTKHDF"]
        with room_beyond(file, SPARE):
            self._root.attrs["Version"] = np.array([2, 2], dtype=np.int64)
            self._root.attrs.create("Type", b"PolyData", dtype="S8")
        self._columns: dict[str, Column] = {}
        self._steps: dict[str, list[Any]] = {}

    def append(
        self,
        time: float,
        points: NDArray[np.float32],
        lines: NDArray[np.int64],
        point_data: dict[str, NDArray[Any]],
        cell_data: dict[str, NDArray[Any]],
    ) -> None:
        """Add a step: every point is a vertex cell, then come the ``lines`` (k, 2)."""
        cells = {"Vertices": np.arange(len(points), dtype=np.int64)[:, None], "Lines": lines.reshape(-1, 2)}
        nothing = np.zeros((0, 1), dtype=np.int64)
        self._step("PartOffsets", len(self._steps.get("Values", [])))
        self._step("Values", time)
        self._step("NumberOfParts", 1)
        self._column("NumberOfPoints").append(np.array([len(points)], dtype=np.int64))
        self._step("PointOffsets", self._column("Points").append(points))
        placed = [self._append_cells(kind, cells.get(kind, nothing)) for kind in _CELL_KINDS]
        self._step("CellOffsets", [cell for cell, _ in placed])
        self._step("ConnectivityIdOffsets", [connectivity for _, connectivity in placed])
        for name, values in point_data.items():
            self._step(f"PointDataOffsets/{name}", self._column(f"PointData/{name}").append_if_new(values))
        for name, values in cell_data.items():
            self._step(f"CellDataOffsets/{name}", self._column(f"CellData/{name}").append(values))

    def close(self) -> None:
        """Write what is still held back and the table of steps; the file is complete after this."""
        for column in self._columns.values():
            column.flush()
        tables = {
            name: np.array(rows, dtype=np.float64 if name == "Values" else np.int64)
            for name, rows in self._steps.items()
        }
        with room_beyond(self._root.file, SPARE + sum(table.nbytes for table in tables.values())):
            steps = self._root.create_group("Steps")
            steps.attrs["NSteps"] = len(self._steps["Values"])
            for name, table in tables.items():
                steps[name] = table

    def _append_cells(self, kind: str, cells: NDArray[np.int64]) -> tuple[int, int]:
        count, size = cells.shape
        steps_before = self._column(f"{kind}/NumberOfCells").append(np.array([count], dtype=np.int64))
        self._column(f"{kind}/NumberOfConnectivityIds").append(np.array([cells.size], dtype=np.int64))
        offsets = np.arange(0, count * size + 1, size, dtype=np.int64)
        # VTK counts cells here, and each step before this one has one offset more than it has cells
        cell = self._column(f"{kind}/Offsets").append(offsets) - steps_before
        return cell, self._column(f"{kind}/Connectivity").append_if_new(cells.ravel())

    def _step(self, name: str, value: Any) -> None:
        self._steps.setdefault(name, []).append(value)

    def _column(self, name: str) -> Column:
        return self._columns.setdefault(name, Column(self._root, name))


def _append_frame(polydata: TemporalPolyData, run: Run, frame: Frame) -> None:
    present = np.asarray(np.isfinite(frame.position).all(axis=1))
    renumbered = np.cumsum(present) - 1
    shown = frame.bond_intact & present[run.bond_ends].all(axis=1)
    lines = renumbered[run.bond_ends[shown]].astype(np.int64)
    on_vertices = np.zeros(int(present.sum()), dtype=np.float32)
    polydata.append(
        frame.time,
        frame.position[present],
        lines,
        point_data={
            "id": np.flatnonzero(present).astype(np.int64),
            "radius": run.radius[present].astype(np.float32),
            "velocity": frame.velocity[present],
            "grain": run.grain[present].astype(np.int64),
            "material": run.material[present],
        },
        cell_data={
            "stress": np.concatenate([on_vertices, frame.bond_stress[shown]]),
            "failure": np.concatenate([on_vertices, frame.bond_failure[shown]]),
        },
    )


def _chosen_frames(n_frames: int, every: int) -> list[int]:
    return sorted({*range(0, n_frames, every), n_frames - 1})

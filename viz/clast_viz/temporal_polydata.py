"""A VTKHDF PolyData that grows in time."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.room import SPARE, room_beyond
from clast_viz.column import Column

# VTK reads nothing, without a word, from files in the newest HDF5 layout
LAYOUT = ("earliest", "v110")
_CELL_KINDS = ("Vertices", "Lines", "Polygons", "Strips")


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

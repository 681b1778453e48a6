"""Store: the growing results file of a run."""

from __future__ import annotations

import shutil
import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from clast.engine.tables import crack_rows
from clast.errors import RunError

if TYPE_CHECKING:
    from clast.simulation import Simulation

FILE = "results.h5"
SPARE = 2**18
"""Bytes left free on the disk, so that the file can always be closed."""
CRACKS = ("time", "bond", "i", "j", "position", "mode", "normal_stress", "shear_stress", "energy")
GROWING = ("curves", "frames", "tracks/particles", "tracks/bonds")


class Store:
    """Appends rows to ``results.h5``; brought to disk with frames, about every second, so a killed run loses little.

    Parameters
    ----------
    folder : Path
        Run folder.
    resume : bool
        Open the file there instead of starting a new one.

    Raises
    ------
    RunError
        If the file cannot be written.
    """

    def __init__(self, folder: Path, resume: bool = False) -> None:
        import h5py

        self.path = folder / FILE
        self.next_flush = 0.0
        self.pending: dict[str, dict[str, list[NDArray[Any]]]] = {}
        try:
            self.file = h5py.File(self.path, "r+" if resume else "w")
        except OSError as error:
            raise RunError(f"{self.path}: cannot be {'opened' if resume else 'written'}: {error}") from error

    def describe(self, simulation: Simulation) -> None:
        """Write what does not change during a run."""
        from clast import __version__

        scene, file = simulation.scene, self.file
        file.attrs.update({"schema": 1, "name": scene.config.name, "clast_version": __version__, "complete": False})
        particles = file.create_group("particles")
        particles["radius"], particles["grain"] = scene.radius, scene.grain
        particles["material"] = scene.material.astype(np.uint8)
        particles["material"].attrs["names"] = list(scene.config.materials)
        bonds = file.create_group("bonds")
        bonds["ends"] = scene.ends.astype(np.uint32)
        bonds["diameter"], bonds["length"] = scene.diameter, scene.length
        extent = np.ptp(scene.position, axis=0).max() + 2.0 * scene.radius.max()
        for k, (name, wall) in enumerate(scene.config.walls.items()):
            group = file.create_group(f"walls/{name}")
            group["points"], group["triangles"] = wall.shape.part.mesh(wall.shape.params, 0.75 * extent)
            group.attrs["index"] = k
        for name in ("particles", "bonds"):
            wanted = getattr(scene.config.output.tracks, name)
            if wanted:
                self._growing(f"tracks/{name}").attrs["numbers"] = list(wanted)

    def append(self, group: str, row: Mapping[str, Any]) -> None:
        """Append one row to every dataset of a group; it reaches the file with the next flush."""
        columns = self.pending.setdefault(group, {})
        for name, value in row.items():
            columns.setdefault(name, []).append(np.array(value))

    def _write_pending(self) -> None:
        self._need_room(
            sum(row.nbytes for columns in self.pending.values() for rows in columns.values() for row in rows)
        )
        for group, columns in self.pending.items():
            table = self._growing(group)
            for name, rows in columns.items():
                self._extend(table, name, np.stack(rows))
        self.pending.clear()

    def _need_room(self, wanted: int) -> None:
        """Refuse to write when the disk is nearly full: HDF5 files do not survive a write that fails half-way.

        Raises
        ------
        RunError
            With what to do.
        """
        free = shutil.disk_usage(self.path.parent).free
        if free < 2 * wanted + SPARE:
            raise RunError(
                f"{self.path}: the disk is full ({free / 1e6:.1f} MB free). Everything up to the last checkpoint is "
                "kept: make room and go on with --resume"
            )

    def _growing(self, group: str) -> Any:
        """Return a group, made when missing; its datasets keep the order in which they were made."""
        if group not in self.file:
            self.file.create_group(group, track_order=True)
        return self.file[group]

    def _extend(self, table: Any, name: str, rows: NDArray[Any]) -> None:
        shape = rows.shape[1:]
        if name not in table:
            chunk = max(1, min(512, 262144 // max(1, rows[0].nbytes)))
            limit = (None, *(size or None for size in shape))
            table.create_dataset(name, (0, *shape), rows.dtype, maxshape=limit, chunks=_chunk(chunk, shape))
        data = table[name]
        data.resize(len(data) + len(rows), axis=0)
        data[-len(rows) :] = rows

    def keep_cracks(self, simulation: Simulation) -> None:
        """Bring the crack table up to date."""
        cracks, scene = simulation.world.cracks, simulation.scene
        rows = crack_rows(cracks)
        count, bond = len(rows), cracks.bond[rows]
        area = 0.25 * np.pi * scene.diameter[bond] ** 2
        columns: tuple[NDArray[Any], ...] = (
            simulation.timeline.times(cracks.step[rows]),
            bond,
            cracks.ends[rows, 0],
            cracks.ends[rows, 1],
            cracks.position[rows],
            cracks.mode[rows].astype(np.uint8),
            cracks.load[rows, 0] / area,
            cracks.load[rows, 1] / area,
            cracks.load[rows, 2],
        )
        try:
            table = self.file.require_group("cracks")
            for name, values in zip(CRACKS, columns, strict=True):
                if name not in table:
                    table.create_dataset(name, (0, *values.shape[1:]), values.dtype, maxshape=(None, *values.shape[1:]))
                known = len(table[name])
                table[name].resize(count, axis=0)
                table[name][known:] = values[known:]
            modes = simulation.plan.bonds.crack_modes if simulation.plan.bonds is not None else ()
            table["mode"].attrs["modes"] = list(modes)
        except OSError as error:
            raise self._full(error) from error

    def keep_up(self, simulation: Simulation) -> None:
        """Bring frames and cracks to disk, unless that was done a moment ago.

        A moment is a second, or a hundred times as long as it took: waiting for the disk is not what a run is for.
        """
        begun = time.monotonic()
        if begun >= self.next_flush:
            self.keep_cracks(simulation)
            self.flush()
            done = time.monotonic()
            self.next_flush = done + max(1.0, 100.0 * (done - begun))

    def lengths(self) -> dict[str, int]:
        """Return how many rows each growing group has."""
        found = {name: self._length(name) for name in (*GROWING, "cracks")}
        return {name: length for name, length in found.items() if length}

    def _length(self, group: str) -> int:
        if group not in self.file:
            return 0
        return min((len(data) for data in self.file[group].values() if hasattr(data, "shape")), default=0)

    def cut(self, lengths: Mapping[str, int]) -> None:
        """Forget rows beyond the given lengths: what a run wrote after its last checkpoint."""
        for group in (*GROWING, "cracks"):
            if group in self.file:
                for data in self.file[group].values():
                    if hasattr(data, "shape"):
                        data.resize(lengths.get(group, 0), axis=0)

    def flush(self) -> None:
        """Bring everything to disk."""
        try:
            self._write_pending()
            self.file.flush()
        except OSError as error:
            raise self._full(error) from error

    def close(self, complete: bool) -> None:
        """Close the file, noting whether the run came to its end."""
        try:
            self._write_pending()
            self.file.attrs["complete"] = complete
            self.file.close()
        except (OSError, RuntimeError) as error:
            raise self._full(error) from error

    def _full(self, error: Exception) -> RunError:
        return RunError(
            f"{self.path}: writing failed ({error}). Is the disk full? The last checkpoint is kept: make room and go "
            "on with --resume"
        )


def _chunk(rows: int, shape: tuple[int, ...]) -> tuple[int, ...]:
    return (rows, *(max(1, n) for n in shape))

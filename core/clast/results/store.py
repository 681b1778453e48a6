"""Store: the growing results file of a run."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from clast.about import VERSION
from clast.engine.tables import crack_rows
from clast.errors import DamagedError, RefusedError, RunError, one_line
from clast.results.checkpoint import how_to_go_on
from clast.results.contacts import GROUP as CONTACTS
from clast.results.room import SPARE, NoRoomError, in_memory, room_beyond
from clast.results.whole_file import whole_file
from clast.scene.scatter import scatter_entries
from clast.scene.scene import spans_at

if TYPE_CHECKING:
    from clast.simulation import Simulation

FILE = "results.h5"
CRACKS = ("time", "bond", "i", "j", "position", "mode", "normal_stress", "shear_stress", "energy")
TRACKS = ("particles", "bonds")
GROWING = ("curves", CONTACTS, "frames", *(f"tracks/{name}" for name in TRACKS), "cracks")
DATASET_METADATA, CHUNK_METADATA = 2**13, 2**8
"""Bytes by which header and index of a dataset may grow with each flush, and with each chunk beside its own."""


def begin(folder: Path, simulation: Simulation) -> None:
    """Write ``results.h5`` with what does not change during a run; it appears whole or not at all.

    Raises
    ------
    RunError
        If the disk refuses.
    """
    path = folder / FILE
    try:
        with whole_file(path) as draft:
            draft.write_bytes(in_memory(lambda file: _describe(file, simulation)))
    except OSError as error:
        raise _refused(path, error) from error


def _describe(file: Any, simulation: Simulation) -> None:

    scene = simulation.scene
    file.attrs.update({"schema": 1, "name": scene.config.name, "clast_version": VERSION, "complete": False})
    file.attrs["periodic"] = scene.box.periodic
    particles = file.create_group("particles")
    particles["radius"], particles["grain"] = scene.radius, scene.grain
    particles["material"] = scene.material.astype(np.uint8)
    particles["material"].attrs["names"] = list(scene.config.materials)
    bonds = file.create_group("bonds")
    bonds["ends"] = scene.ends.astype(np.uint32)
    bonds["diameter"], bonds["length"] = scene.diameter, scene.length
    if scene.factors:
        bonds["factors"] = np.column_stack(scene.factors)
        bonds["factors"].attrs["parameters"] = [", ".join(each.parameters) for each in scatter_entries(scene.config)]
    extent = np.ptp(scene.position, axis=0).max() + 2.0 * scene.radius.max()
    for k, (name, wall) in enumerate(scene.config.walls.items()):
        group = file.create_group(f"walls/{name}")
        group["points"], group["triangles"] = wall.shape.part.mesh(wall.shape.params, 0.75 * extent)
        group.attrs["index"] = k
        if wall.pivot is not None:
            group.attrs["pivot"] = wall.pivot
    for name in TRACKS:
        wanted = getattr(scene.config.output.tracks, name)
        if wanted:
            file.create_group(f"tracks/{name}", track_order=True).attrs["numbers"] = list(wanted)
    mode = _extended(file, "cracks", "mode", np.zeros(0, np.uint8))
    mode.attrs["modes"] = list(simulation.plan.bonds.crack_modes) if simulation.plan.bonds is not None else []


class Store:
    """Appends rows to ``results.h5``; brought to disk with frames, about every second, so a killed run loses little.

    Parameters
    ----------
    folder : Path
        Run folder with the file that :func:`begin` wrote.

    Raises
    ------
    RunError
        If the file cannot be opened.
    """

    def __init__(self, folder: Path) -> None:
        import h5py

        self.path = folder / FILE
        self.next_flush = 0.0
        self.pending: dict[str, dict[str, list[NDArray[Any]]]] = {}
        try:
            self.file = h5py.File(self.path, "r+")
        except BlockingIOError as error:
            raise RefusedError(
                f"{self.path}: another program has it open, perhaps one that reads it; close that and try again"
            ) from error
        except PermissionError as error:
            raise RefusedError(f"{self.path}: no permission to write it") from error
        except (OSError, RuntimeError) as error:
            raise _damaged(self.path, error) from error

    def append(self, group: str, row: Mapping[str, Any]) -> None:
        """Append one row to every dataset of a group; it reaches the file with the next flush."""
        self.extend(group, {name: np.array(value)[None] for name, value in row.items()})

    def curves(self) -> dict[str, NDArray[Any]]:
        """Return all samples that are on disk, by column."""
        return {name: np.asarray(values) for name, values in self.file.get("curves", {}).items()}

    def extend(self, group: str, rows: Mapping[str, NDArray[Any]]) -> None:
        """Append any number of rows to every dataset of a group; they reach the file with the next flush.

        Groups reach it in the order in which they were first given something since the flush before.
        """
        columns = self.pending.setdefault(group, {})
        for name, values in rows.items():
            columns.setdefault(name, []).append(values)

    def keep_cracks(self, simulation: Simulation) -> None:
        """Append the cracks that are not in the table yet."""
        cracks, scene = simulation.world.cracks, simulation.scene
        rows = crack_rows(cracks)[self.known("cracks") :]
        bond = cracks.bond[rows]
        area = 0.25 * np.pi * scene.diameter[bond] ** 2
        time = simulation.timeline.times(cracks.step[rows])
        then = scene.box.grown(spans_at(scene.config, time))
        columns: tuple[NDArray[Any], ...] = (
            time,
            bond,
            cracks.ends[rows, 0],
            cracks.ends[rows, 1],
            then.wrapped(cracks.position[rows]),
            cracks.mode[rows].astype(np.uint8),
            cracks.load[rows, 0] / area,
            cracks.load[rows, 1] / area,
            cracks.load[rows, 2],
        )
        self.extend("cracks", dict(zip(CRACKS, columns, strict=True)))

    def known(self, group: str) -> int:
        """Return how many rows a group has, in the file and on the way to it."""
        waiting = next(iter(self.pending.get(group, {}).values()), [])
        return self._length(group) + sum(len(rows) for rows in waiting)

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
        found = {name: self._length(name) for name in GROWING}
        return {name: length for name, length in found.items() if length}

    def _length(self, group: str) -> int:
        return min((len(data) for data in self._tables(group)), default=0)

    def _tables(self, group: str) -> list[Any]:
        return list(self.file[group].values()) if group in self.file else []

    def cut(self, lengths: Mapping[str, int]) -> None:
        """Forget rows beyond the given lengths: what a run wrote after its last checkpoint.

        Raises
        ------
        RunError
            If the file is damaged, or lacks rows that the checkpoint knows.
        """
        try:
            with room_beyond(self.file, SPARE):
                for group in GROWING:
                    length = lengths.get(group, 0)
                    if self._length(group) < length:
                        raise ValueError(f"{group} has {self._length(group)} rows, the checkpoint knows {length}")
                    for data in self._tables(group):
                        data.resize(length, axis=0)
        except NoRoomError as error:
            raise _refused(self.path, error) from error
        except (KeyError, ValueError, OSError, RuntimeError) as error:
            raise _damaged(self.path, error) from error

    def flush(self) -> None:
        """Bring everything to disk.

        Raises
        ------
        RunError
            If the disk refuses; what it took before stays.
        """
        columns = [
            (group, name, np.concatenate(rows))
            for group, columns in self.pending.items()
            for name, rows in columns.items()
        ]
        self.pending.clear()
        if columns:
            try:
                with room_beyond(self.file, SPARE + sum(self._growth(*column) for column in columns)):
                    for column in columns:
                        _extended(self.file, *column)
            except (OSError, RuntimeError) as error:
                raise _refused(self.path, error) from error

    def _growth(self, group: str, name: str, rows: NDArray[Any]) -> int:
        """Return the most bytes that rows add to the file: chunks are written whole."""
        place = f"{group}/{name}"
        length, chunk = (len(self.file[place]), self.file[place].chunks) if place in self.file else (0, _chunk(rows))
        chunks = -(-(length + len(rows)) // chunk[0]) - -(-length // chunk[0])
        return DATASET_METADATA + chunks * (CHUNK_METADATA + math.prod(chunk) * rows.itemsize)

    def close(self, complete: bool) -> None:
        """Close the file, noting whether the run came to its end.

        Raises
        ------
        RunError
            If the disk refuses what was not flushed; what it took before stays.
        """
        try:
            self.flush()
            self.file.attrs.modify("complete", complete)  # in its place, which needs no room
        except (OSError, RuntimeError) as error:
            raise _refused(self.path, error) from error
        finally:
            self.file.close()


def _extended(file: Any, group: str, name: str, rows: NDArray[Any]) -> Any:
    """Append rows to a dataset, made when missing, and return it."""
    if group not in file:
        file.create_group(group, track_order=True)  # columns keep the order in which they came
    table, shape = file[group], rows.shape[1:]
    if name not in table:
        limit = (None, *(size or None for size in shape))
        table.create_dataset(name, (0, *shape), rows.dtype, maxshape=limit, chunks=_chunk(rows))
    data = table[name]
    data.resize(len(data) + len(rows), axis=0)
    data[len(data) - len(rows) :] = rows
    return data


def _chunk(rows: NDArray[Any]) -> tuple[int, ...]:
    shape = tuple(max(1, size) for size in rows.shape[1:])
    return (max(1, min(512, 2**18 // (math.prod(shape) * rows.itemsize))), *shape)


def _refused(path: Path, error: Exception) -> RunError:
    reason = error.strerror if isinstance(error, OSError) and error.strerror else one_line(error)
    return RunError(f"{path}: cannot be written ({reason}); {how_to_go_on(path.parent)}")


def _damaged(path: Path, error: Exception) -> DamagedError:
    return DamagedError(
        f"{path}: is damaged, so the run cannot go on ({one_line(error)}); start it anew in another folder with -o"
    )

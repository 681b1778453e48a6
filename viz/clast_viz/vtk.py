"""VTK: particles and bonds over time as one VTKHDF file for ParaView, what touches as another."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.contacts import Contacts
from clast.results.frame import Frame
from clast.results.room import in_memory
from clast.results.run import Run
from clast_viz.budget import Budget, FrameBudget, chosen_frames, most, within
from clast_viz.chains import pieces
from clast_viz.damage import GrainDamage
from clast_viz.loads import drawn_bonds, signed_load
from clast_viz.temporal_polydata import LAYOUT, TemporalPolyData

FILE = "particles.vtkhdf"
CONTACTS_FILE = "contacts.vtkhdf"
ROOM = 2e9
"""Bytes, before they are compressed, that frames may take together with ``frames: auto``."""
PARTICLE_BYTES, BOND_BYTES = 68.0, 32.0


class VtkParams(Params):
    """What the user can choose about the VTK files; everything is in them with ``all`` twice."""

    bonds: Annotated[
        Budget,
        Field(description="Most bonds per frame, the most loaded ones and a sample of the rest; or 'all'"),
    ] = 200_000
    frames: Annotated[
        FrameBudget,
        Field(description="Most frames, evenly spread; 'all'; or 'auto' for as many as fit in about 2 GB"),
    ] = "auto"


def write_vtk(run: Run, params: VtkParams, path: Path) -> Written:
    """Write ``particles.vtkhdf``: a temporal PolyData, each particle a vertex, each intact bond a line.

    Point data: ``id``, ``radius`` in m, ``velocity`` in m/s, ``grain``, ``material``, ``fragment`` (which piece, held
    together by bonds), ``damage`` (share of the grain's bonds that are broken). Cell data: ``stress`` in Pa (tension
    positive) and ``failure`` (0 unloaded, 1 breaks) of the bonds, 0 on the vertices. Particles that have left the
    domain are absent from then on, so ``id`` says which particle a point is. Bonds across a periodic face are not
    drawn: their lines would cross the whole box.

    Where the run keeps contacts, ``contacts.vtkhdf`` beside it has a point for each: ``i``, ``j`` (−1 − w for wall w),
    ``force`` on j, ``normal_force`` and ``tangential_force`` in N.

    Source: VTKHDF file format 2.2, https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/
    """
    if run.n_frames == 0:
        return Written(None, "the run has recorded no frame")
    size = PARTICLE_BYTES * len(run.radius) + BOND_BYTES * within(params.bonds, len(run.bond_ends))
    frames = chosen_frames(run, params.frames, size, ROOM)
    damage = GrainDamage(run)
    _write(path, frames, lambda polydata, k: _append_frame(polydata, run, run.frame(k), damage, most(params.bonds)))
    if run.contacts(0) is not None:
        _write(path.with_name(CONTACTS_FILE), frames, lambda polydata, k: _append_contacts(polydata, run, k))
    return Written(path)


def _write(path: Path, frames: Sequence[int], append: Callable[[TemporalPolyData, int], None]) -> None:
    import h5py

    path.write_bytes(in_memory(lambda file: file.create_group("VTKHDF"), libver=LAYOUT))
    with h5py.File(path, "r+", libver=LAYOUT) as file:
        polydata = TemporalPolyData(file)
        for k in frames:
            append(polydata, k)
        polydata.close()


def _append_frame(polydata: TemporalPolyData, run: Run, frame: Frame, damage: GrainDamage, budget: int | None) -> None:
    present = np.asarray(np.isfinite(frame.position).all(axis=1))
    renumbered = np.cumsum(present) - 1
    ends = frame.position[run.bond_ends]
    inside = np.where((frame.lines(run.bond_ends) == ends).all(axis=(1, 2)), signed_load(frame), np.float32(np.nan))
    shown = drawn_bonds(inside, ends.sum(axis=(1, 2)), budget)
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
            "fragment": pieces(run, frame)[present],
            "damage": damage.of(frame)[present],
        },
        cell_data={
            "stress": np.concatenate([on_vertices, frame.bond_stress[shown]]),
            "failure": np.concatenate([on_vertices, frame.bond_failure[shown]]),
        },
    )


def _append_contacts(polydata: TemporalPolyData, run: Run, k: int) -> None:
    found = run.contacts(k)
    assert isinstance(found, Contacts)
    data = found._asdict()
    polydata.append(float(run.frame_values("time")[k]), data.pop("position"), np.zeros((0, 2), np.int64), data, {})

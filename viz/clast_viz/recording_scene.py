"""The scene in a recording: particles, bonds, force chains, cracks and walls, frame by frame."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.frame import Frame
from clast.results.run import Run
from clast_viz.budget import most
from clast_viz.chains import force_chains, pieces, reference_force
from clast_viz.colours import DAMAGE, FORCE, looked_up, table
from clast_viz.damage import GrainDamage, shows_damage
from clast_viz.loads import colour_of, drawn_bonds, signed_load
from clast_viz.recording_layout import grain_colours, magnification
from clast_viz.recording_time import Timelines

WALL_COLOUR = (112, 128, 144, 70)
WALL_EDGE_COLOUR = (72, 84, 98)
CRACK_COLOUR = (255, 140, 0)
PARTICLE_BYTES, BONDS_BYTES, CHAIN_BYTES = 16.0, 36.0, 36.0
"""Bytes in the file for one of each and frame: positions and colours; ends, colours, radii and offsets."""


class SceneLog:
    """Logs the scene.

    Parameters
    ----------
    stream : rerun.RecordingStream
    run : Run
    timelines : Timelines
        With the frames that come.
    bonds, contacts : int or "all"
        Most bonds and links of force chains per frame.
    """

    def __init__(self, stream: Any, run: Run, timelines: Timelines, bonds: int | str, contacts: int | str) -> None:
        self._stream, self._run, self._timelines = stream, run, timelines
        self._bonds, self._contacts = most(bonds), most(contacts)
        self._damage = GrainDamage(run) if shows_damage(run) else None
        self._shown_damage: NDArray[np.float32] | None = None
        self._full_force = reference_force(run, timelines.frames)
        self._log_static()

    def log_frame(self, k: int, frame: Frame) -> None:
        """Log the ``k``-th of the frames that come, in order; the stream is at its time."""
        import rerun as rr

        self._stream.log("scene/particles", rr.Points3D.from_fields(positions=frame.position))
        for name, wall in self._run.walls.items():
            w, x, y, z = wall.orientation(frame)
            turned = {} if wall.pivot is None else {"quaternion": rr.Quaternion(xyzw=(x, y, z, w))}
            moved = rr.Transform3D(translation=wall.shift(frame), **turned)
            self._stream.log(f"scene/walls/{name}", moved)
        if frame.box.repeats:
            middle, half = 0.5 * (frame.box.lower + frame.box.upper), 0.5 * (frame.box.upper - frame.box.lower)
            self._stream.log("scene/box", rr.Boxes3D(centers=[middle], half_sizes=[half], colors=WALL_EDGE_COLOUR))
        self._log_damage(frame)
        self._log_bonds(k, frame)
        self._log_chains(k, frame)

    def _log_static(self) -> None:
        import rerun as rr

        run, stream = self._run, self._stream
        stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        stream.log("scene", rr.Transform3D(scale=magnification(run)), static=True)
        particles = rr.Points3D.from_fields(radii=run.radius.astype(np.float32))
        stream.log("scene/particles", particles, static=True)
        if self._damage is None:  # else they change, and what is static would hide that
            stream.log("scene/particles", rr.Points3D.from_fields(colors=grain_colours(run)), static=True)
        for name, wall in run.walls.items():
            mesh = rr.Mesh3D(vertex_positions=wall.points, triangle_indices=wall.triangles, albedo_factor=WALL_COLOUR)
            stream.log(f"scene/walls/{name}", mesh, static=True)
            edges = wall.points[_outline(wall.triangles)]
            stream.log(f"scene/walls/{name}/outline", rr.LineStrips3D(edges, colors=WALL_EDGE_COLOUR), static=True)

    def _log_damage(self, frame: Frame) -> None:
        """Colour particles by the damage of their grain, where it has changed since the frame before."""
        import rerun as rr

        if self._damage is None:
            return
        damage = self._damage.of(frame)
        if self._shown_damage is None or not np.array_equal(damage, self._shown_damage):
            colours = looked_up(table(DAMAGE), damage)
            self._stream.log("scene/particles", rr.Points3D.from_fields(colors=colours))
            self._shown_damage = damage

    def _log_bonds(self, k: int, frame: Frame) -> None:
        import rerun as rr

        run = self._run
        if len(run.bond_ends) == 0:
            return
        load = signed_load(frame)
        shown = drawn_bonds(load, frame.position[run.bond_ends].sum(axis=(1, 2)), self._bonds)
        bonds = rr.LineStrips3D.from_fields(
            strips=_strips(frame.lines(run.bond_ends[shown])),
            colors=colour_of(load[shown]),
            radii=run.bond_diameter[shown] * (0.04 + 0.16 * np.abs(load[shown])),
        )
        self._stream.log("scene/bonds", bonds)
        new = self._timelines.since_previous(run.cracks["time"], k)
        radii = 0.5 * run.bond_diameter[run.cracks["bond"][new]]
        self._stream.log("scene/cracks", rr.Points3D(run.cracks["position"][new], radii=radii, colors=CRACK_COLOUR))

    def _log_chains(self, k: int, frame: Frame) -> None:
        """Log the links of force chains: as thick as the root of their force, the strongest also darker."""
        import rerun as rr

        found = self._run.contacts(self._timelines.frames[k])
        if found is None:
            return
        chains = force_chains(frame, found, pieces(self._run, frame), self._contacts)
        share = np.minimum(chains.force / np.float32(self._full_force), 1.0)
        links = rr.LineStrips3D.from_fields(
            strips=_strips(chains.ends),
            colors=looked_up(table(FORCE), share),
            radii=self._thickest * np.sqrt(share),
        )
        self._stream.log("scene/force_chains", links)

    @property
    def _thickest(self) -> float:
        """Radius of a link that is drawn in full: a fifth of a grain's, were its particles one ball."""
        per_grain = len(self._run.radius) / max(len(np.unique(self._run.grain)), 1)
        return float(0.2 * np.median(self._run.radius) * np.cbrt(per_grain))


def _strips(ends: NDArray[np.float32]) -> Any:
    """Build the strips as the exact Arrow type: a hundred times faster than handing over an array."""
    import pyarrow as pa
    import rerun as rr

    kind = rr.components.LineStrip3DBatch._ARROW_DATATYPE
    values = pa.array(np.ascontiguousarray(ends, dtype=np.float32).ravel())
    points = pa.FixedSizeListArray.from_arrays(values, type=kind.value_type)
    return pa.ListArray.from_arrays(np.arange(0, 2 * len(ends) + 1, 2, dtype=np.int32), points, type=kind)


def _outline(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the (e, 2) edges that belong to one triangle only, or all edges of a closed surface."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    border: NDArray[np.int64] = unique[count == 1]
    return border if len(border) else unique

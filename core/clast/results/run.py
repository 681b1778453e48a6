"""Run: the reading side of a run folder."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.errors import RunError
from clast.maths.box import Box, open_space
from clast.results.contacts import ENDS, GROUP, Contacts
from clast.results.frame import Frame
from clast.results.reading import (
    CONFIG_FILE,
    RESULTS_FILE,
    check_contents,
    common_length,
    open_results,
    read_json,
    read_yaml,
    strings,
    telling_damage,
)
from clast.results.reference import read_references
from clast.results.wall_mesh import WallMesh


class Run:
    """Results of one run, read from its folder; frames are read from disk one at a time.

    Parameters
    ----------
    folder : Path
        A run folder, finished or not.

    Attributes
    ----------
    folder : Path
        The run folder.
    name : str
        Name of the scene.
    complete : bool
        Whether the run went to its end.
    curves : dict of str to (S,) float64
        The sampled columns, for example ``strain`` and ``stress_Pa``.
    tracks : dict of str to dict of str to (S, k, ...) array
        Full state of the ``particles`` and ``bonds`` under ``output.tracks``, at every sample.
    tracked : dict of str to list of int
        Numbers of those particles and bonds.
    cracks : dict of str to array
        One entry per broken bond: ``time``, ``bond``, ``i``, ``j``, ``position`` (k, 3), ``mode``,
        ``normal_stress``, ``shear_stress`` in Pa and ``energy`` in J.
    crack_modes : list of str
        What the numbers in ``cracks["mode"]`` mean.
    radius : (n,) float64
        Radii of the particles in m.
    grain : (n,) int64
        Number of the grain each particle belongs to.
    material : (n,) uint8
        Index into ``materials`` of each particle.
    materials : list of str
        Names of the materials.
    periodic : (3,) bool
        Directions in which the scene repeats itself.
    bond_ends : (m, 2) uint32
        The two particles of each bond.
    bond_diameter, bond_length : (m,) float64
        Size of each bond in m.
    walls : dict of str to WallMesh
        Drawable walls, in the order of ``Frame.wall_displacement``.
    n_frames : int
        Number of recorded frames.
    frame_numbers : (n_frames,) int64
        The number that each frame has in the file; others than 0, 1, … after :meth:`only`.
    summary, config : dict
        Contents of ``summary.json`` and of the resolved ``config.yaml``; empty where the file is missing.
    reference : list of Reference
        Measured points named in the config.

    Raises
    ------
    RunError
        If the folder holds no results, or they are unreadable, or a simulation is still writing them.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = Path(folder)
        self._file = open_results(self.folder)
        try:
            with telling_damage(self.folder / RESULTS_FILE):
                self._read()
        except RunError:
            self.close()
            raise

    def _read(self) -> None:
        file = self._file
        check_contents(self.folder / RESULTS_FILE, file)
        self.name = str(file.attrs["name"])
        self.complete = bool(file.attrs["complete"])
        self._read_scene(file)
        self.curves: dict[str, NDArray[np.float64]] = common_length(file["curves"])
        self.cracks: dict[str, NDArray[Any]] = common_length(file["cracks"])
        self.tracks = {name: common_length(group) for name, group in file.get("tracks", {}).items()}
        self.tracked = {name: group.attrs["numbers"].tolist() for name, group in file.get("tracks", {}).items()}
        self.crack_modes = strings(file["cracks/mode"].attrs["modes"])
        self._frames = file.get("frames", {})
        self.n_frames = min((len(dataset) for dataset in self._frames.values()), default=0)
        self.frame_numbers = np.arange(self.n_frames)
        self.summary = read_json(self.folder / "summary.json")
        self.config = read_yaml(self.folder / CONFIG_FILE)
        self.reference = read_references(self.folder / CONFIG_FILE, self.config)

    def _read_scene(self, file: Any) -> None:
        self.radius: NDArray[np.float64] = file["particles/radius"][:]
        self.grain: NDArray[np.int64] = file["particles/grain"][:]
        self.material: NDArray[np.uint8] = file["particles/material"][:]
        self.materials = strings(file["particles/material"].attrs["names"])
        self.periodic = np.array(file.attrs.get("periodic", [False] * 3), bool)
        self.bond_ends: NDArray[np.uint32] = file["bonds/ends"][:].reshape(-1, 2)
        self.bond_diameter: NDArray[np.float64] = file["bonds/diameter"][:]
        self.bond_length: NDArray[np.float64] = file["bonds/length"][:]
        walls = {
            name: WallMesh(
                group["points"][:], group["triangles"][:], int(group.attrs["index"]), group.attrs.get("pivot")
            )
            for name, group in file.get("walls", {}).items()
        }
        self.walls = dict(sorted(walls.items(), key=lambda item: item[1].index))

    def only(self, frames: Sequence[int]) -> Run:
        """Return the same run with these of its frames, numbered from 0; both read one open file."""
        twin = copy(self)
        twin.frame_numbers = self.frame_numbers[list(frames)]
        twin.n_frames = len(twin.frame_numbers)
        return twin

    def frame(self, k: int) -> Frame:
        """Read frame ``k``; negative numbers count from the end.

        Raises
        ------
        IndexError
            If there is no such frame.
        RunError
            If the file is damaged there.
        """
        self._refuse_missing(k)
        with telling_damage(self.folder / RESULTS_FILE, f"frame {k}: "):
            return self._read_frame(int(self.frame_numbers[k]))

    def _refuse_missing(self, k: int) -> None:
        if not -self.n_frames <= k < self.n_frames:
            raise IndexError(f"frame {k} of a run with {self.n_frames} frames")

    def _read_frame(self, k: int) -> Frame:
        frames = self._frames
        return Frame(
            time=float(frames["time"][k]),
            step=int(frames["step"][k]),
            strain=float(frames["strain"][k]),
            position=frames["position"][k],
            orientation=frames["orientation"][k] if "orientation" in frames else None,
            velocity=frames["velocity"][k],
            bond_intact=frames["bond_intact"][k].astype(bool),
            bond_stress=frames["bond_stress"][k],
            bond_failure=frames["bond_failure"][k],
            wall_displacement=frames["wall_displacement"][k].reshape(-1, 3),
            wall_orientation=frames["wall_orientation"][k] if "wall_orientation" in frames else None,
            image=frames["image"][k] if "image" in frames else np.zeros((len(self.radius), 3), np.int32),
            box=self._box(k),
        )

    def _box(self, k: int) -> Box:
        """Return the box of the ``k``-th frame in the file."""
        if "box" not in self._frames:
            return open_space()
        lower, upper = self._frames["box"][k]
        return Box(lower, upper, self.periodic)

    def contacts(self, k: int) -> Contacts | None:
        """Read what touches in frame ``k``; None where the frames keep no contacts, see ``output.contacts``.

        Raises
        ------
        IndexError
            If there is no such frame.
        RunError
            If the file is damaged there.
        """
        self._refuse_missing(k)
        if ENDS not in self._frames:
            return None
        with telling_damage(self.folder / RESULTS_FILE, f"contacts of frame {k}: "):
            return self._read_contacts(int(self.frame_numbers[k]))

    def _read_contacts(self, k: int) -> Contacts:
        ends = self._frames[ENDS]
        begin, end = int(ends[k - 1]) if k else 0, int(ends[k])
        return Contacts(*(self._file[GROUP][name][begin:end] for name in Contacts._fields))

    def frame_values(self, name: str) -> NDArray[np.float64]:
        """Read one number per frame for all frames: ``time``, ``step`` or ``strain``.

        Returns
        -------
        (F,) float64
        """
        with telling_damage(self.folder / RESULTS_FILE, f"{name} of the frames: "):
            return np.asarray(self._frames[name][:][self.frame_numbers], dtype=np.float64)

    def close(self) -> None:
        """Close the file; frames cannot be read any more, everything else can."""
        self._file.close()

    def __enter__(self) -> Run:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def open_run(folder: str | Path) -> Run:
    """Open a run folder for reading, for example ``with open_run("runs/crush_grain") as run: ...``.

    Raises
    ------
    RunError
        If the folder holds no results, or they are unreadable, or a simulation is still writing them.
    """
    return Run(Path(folder))

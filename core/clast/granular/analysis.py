"""Analysis: all that granular mechanics asks of a bed of breakable grains, from one run folder."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.errors import RunError
from clast.granular.bed import Bed, bed_of
from clast.granular.breakage import einav, hardin
from clast.granular.coordination import TOLERANCE, coordination_numbers, touching_bodies
from clast.granular.crack_maps import CrackMaps, crack_maps
from clast.granular.damage import CRUSHED, DAMAGED, INTACT, Damage, damage
from clast.granular.grading import Grading, grading
from clast.granular.grains import Grains, grains_of, sums
from clast.granular.pieces import Pieces, pieces_in
from clast.granular.profiles import Profile, over_height, over_radius, packed
from clast.results.frame import Frame
from clast.results.run import Run

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
BINS = 24
"""Slabs, shells and steps of strain."""
MOST_FRAMES = 60
"""That a history looks at; each is read whole."""
SHOWN = 5
"""Frames that are looked at closely where none are named."""


@dataclass(frozen=True, eq=False)
class Moment:
    """A bed in one frame. ``g`` grains.

    Attributes
    ----------
    frame : int
    time, strain : float
        Of the frame; time in s.
    pieces : Pieces
        The fragments.
    grading : Grading
        Of their envelope diameters, by mass.
    damage : Damage
        Of each grain.
    coordination : (g,) int64
        Number of other grains that each grain touches.
    height : Profile
        Over the height of the bed.
    radius : Profile or None
        Over the distance from the axis; None where the walls around are no tube.
    """

    frame: int
    time: float
    strain: float
    pieces: Pieces
    grading: Grading
    damage: Damage
    coordination: Ints
    height: Profile
    radius: Profile | None


@dataclass(frozen=True, eq=False)
class Granular:
    """Granular mechanics of a run.

    Attributes
    ----------
    grains : Grains
        The grains as packed.
    bed : Bed
        Axis, plates, tube and section.
    history : dict of str to (F,) float64
        One value a frame: ``frame``, ``time_s``, ``strain``, ``fragments``, ``d10_m``, ``d50_m``, ``d90_m``,
        ``hardin``, ``einav``, ``grains_intact``, ``grains_damaged``, ``grains_crushed``, ``damage`` (mean over the
        grains), ``porosity`` (total), ``porosity_between`` (between fragments with their pores), ``low_m`` and
        ``high_m`` (heights between which the bed lies).
    moments : list of Moment
        The frames looked at closely, in their order.
    cracks : CrackMaps
        When and where bonds broke.
    smallest : float
        Diameter of the smallest primary in m: no fragment can be smaller.
    """

    grains: Grains
    bed: Bed
    history: dict[str, Floats]
    moments: list[Moment]
    cracks: CrackMaps
    smallest: float


@dataclass(frozen=True, eq=False)
class _Look:
    """What is known of a frame at a glance."""

    frame: Frame
    pieces: Pieces
    grading: Grading
    damage: Damage
    extent: tuple[float, float]


class _Eye:
    """Looks at frames of one run."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.grains = grains_of(run)
        self.bed = bed_of(run)
        self.broken = np.zeros(len(run.bond_ends), bool)
        self.broken[run.cracks["bond"]] = True
        self.smallest = 2.0 * float(run.radius[run.grain >= 0].min())

    def look(self, k: int) -> _Look:
        """Look at frame ``k``."""
        run, frame = self.run, self.run.frame(k)
        found = pieces_in(run, self.grains, frame)
        if not found.count:
            raise RunError(f"{run.folder}: frame {k}: all grains have left the domain, so there is nothing to look at")
        lost = self.broken & ~frame.bond_intact
        return _Look(
            frame=frame,
            pieces=found,
            grading=grading(found.envelope_diameter, found.mass),
            damage=damage(run.grain, self.grains.primary_mass, found.of_primary, run.bond_ends, lost),
            extent=self.bed.extent(frame, run.radius),
        )

    def row(self, k: int, seen: _Look, before: Grading) -> dict[str, float]:
        """Return the row of the history."""
        hurt, found = seen.damage, seen.pieces
        loose = np.isfinite(seen.frame.position[:, 0]) & (found.of_primary < 0)
        solid = float(found.volume.sum() + self.grains.primary_volume[loose].sum())
        pores = float((found.envelope - found.volume).sum())
        room = self.bed.room(*seen.extent)
        return {
            "frame": k,
            "time_s": seen.frame.time,
            "strain": seen.frame.strain,
            "fragments": found.count,
            **{f"d{share}_m": seen.grading.quantile(share / 100.0) for share in (10, 50, 90)},
            "hardin": hardin(before, seen.grading),
            "einav": einav(before, seen.grading, self.smallest),
            "grains_intact": hurt.number(INTACT),
            "grains_damaged": hurt.number(DAMAGED),
            "grains_crushed": hurt.number(CRUSHED),
            "damage": float(hurt.damage.mean()),
            "porosity": 1.0 - solid / room,
            "porosity_between": 1.0 - (solid + pores) / room,
            "low_m": seen.extent[0],
            "high_m": seen.extent[1],
        }

    def moment(self, k: int, seen: _Look, bins: int, tolerance: float) -> Moment:
        """Return what a close look tells."""
        run, tube = self.run, self.bed.tube
        position = seen.frame.unwrapped
        pairs = touching_bodies(position, run.radius, run.grain, tolerance, seen.frame.box)
        centre = self._centres(position)
        height, distance = self.bed.heights(centre), self.bed.distances(centre)
        primaries = packed(self.bed, self.grains, seen.pieces, position, seen.extent)
        return Moment(
            frame=k,
            time=seen.frame.time,
            strain=seen.frame.strain,
            pieces=seen.pieces,
            grading=seen.grading,
            damage=seen.damage,
            coordination=coordination_numbers(pairs, self.grains.count),
            height=over_height(primaries, self.bed.section, bins, height, pairs),
            radius=None if tube is None else over_radius(primaries, tube, bins, distance, pairs),
        )

    def _centres(self, position: Floats) -> Floats:
        """Return the centre of mass of what is there of each grain in m, (g, 3); NaN where nothing is."""
        held = (self.run.grain >= 0) & np.isfinite(position[:, 0])
        grain, mass = self.run.grain[held], self.grains.primary_mass[held]
        moments = [sums(grain, mass * position[held, c], self.grains.count) for c in range(3)]
        with np.errstate(invalid="ignore"):
            return np.column_stack(moments) / sums(grain, mass, self.grains.count)[:, None]


def analyse(
    run: Run, frames: Sequence[int] | None = None, *, bins: int = BINS, tolerance: float = TOLERANCE
) -> Granular:
    """Compute grading, damage, crack maps, profiles and coordination of the grains of a run.

    Parameters
    ----------
    run : Run
        Open; finished or not.
    frames : sequence of int, optional
        Frames to look at closely, negative ones from the end (:func:`frame_at` finds that of a strain); by default
        the first, the last and three between.
    bins : int
        Slabs, shells and steps of strain.
    tolerance : float
        Gap up to which two primaries touch, as a share of the mean primary diameter.

    Raises
    ------
    RunError
        If the run has no grains, kept no frames, cannot be read, or does not tell its densities.
    IndexError
        If there is no such frame.
    """
    eye = _Eye(run)
    close = _chosen(run, frames, SHOWN)
    looked = sorted({*close, *_chosen(run, None, MOST_FRAMES)})
    before = eye.look(0).grading
    rows, moments = [], []
    for k in looked:
        seen = eye.look(k)
        rows.append(eye.row(k, seen, before))
        if k in close:
            moments.append(eye.moment(k, seen, bins, tolerance))
    history = {name: np.array([row[name] for row in rows], float) for name in rows[0]}
    floor = (history["time_s"], history["low_m"])
    height = float(history["high_m"][0] - history["low_m"][0])
    return Granular(eye.grains, eye.bed, history, moments, crack_maps(run, eye.bed, floor, height, bins), eye.smallest)


def frame_at(run: Run, strain: float) -> int:
    """Return the first frame at which a strain is reached.

    Raises
    ------
    ValueError
        If none reaches it.
    """
    reached = run.frame_values("strain") >= strain * (1.0 - 1e-9)
    if not reached.any():
        raise ValueError(f"no frame reaches a strain of {strain:g}; the last one is at {run.frame(-1).strain:g}")
    return int(np.argmax(reached))


def _chosen(run: Run, frames: Sequence[int] | None, most: int) -> list[int]:
    if frames is None:
        return sorted({round(k) for k in np.linspace(0, run.n_frames - 1, min(most, run.n_frames)).tolist()})
    wrong = [k for k in frames if not -run.n_frames <= k < run.n_frames]
    if wrong:
        raise IndexError(f"frame {wrong[0]} of a run with {run.n_frames} frames")
    return sorted({k % run.n_frames for k in frames})

"""Generator: makes particles, and where it knows them, their bonds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.errors import KeyPath
from clast.maths.box import Box, open_space
from clast.parts.params import Params
from clast.parts.room import FilledRoom

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class BondList:
    """Bonds between particles of one packing.

    Attributes
    ----------
    ends : (m, 2) int64
        Particle indices within the packing; no particle is bonded to itself, no two particles twice.
    diameter : (m,) float64
        Bond diameter in m.
    length : (m,) float64
        Initial length L0 in m; ``nan`` stands for the distance of the two centres.
    origin : (k) -> key path or str, optional
        Where the user wrote bond k, for messages: a key path inside the generator's own keys, or file and line.
    """

    ends: Ints
    diameter: Floats
    length: Floats
    origin: Callable[[int], KeyPath | str] = lambda k: ()


@dataclass(frozen=True)
class Packing:
    """What a generator hands to the scene.

    Attributes
    ----------
    position : (n, 3) float64
        Centres in m.
    radius : (n,) float64
        Radii in m.
    material : list of n str
        Name of each particle's material.
    velocity, spin : (n, 3) float64
        Start velocities in m/s and angular velocities in rad/s.
    prescribed : (n,) bool
        Particles that keep their start velocity and spin whatever pushes them.
    grain : (n,) int64
        Number of the grain a particle belongs to, from 0; -1 for loose particles.
    force, torque : (n, 3) float64 or None
        What acts on each particle all the time, in N and N m; None where nothing does.
    bonds : BondList or None
        Bonds the generator knows; None leaves bonding to the scene's ``bonds.between``.
    relieved : bool
        Whether overlaps at the start count as undeformed: contacts then push only beyond them,
        until the particles have been wholly apart.
    report : mapping
        What was reached, for the user: name with unit -> number or text.
    origin : (k) -> key path or str, optional
        Where the user wrote particle k, for messages: a key path inside the generator's own keys, or file and line.
    concerns : tuple of str
        What the user should know before the run, one sentence each, such as what was asked for and not reached.
    """

    position: Floats
    radius: Floats
    material: list[str]
    velocity: Floats
    spin: Floats
    prescribed: NDArray[np.bool_]
    grain: Ints
    force: Floats | None = None
    torque: Floats | None = None
    bonds: BondList | None = None
    relieved: bool = False
    report: Mapping[str, float | int | str] = field(default_factory=dict)
    origin: Callable[[int], KeyPath | str] = lambda k: ()
    concerns: tuple[str, ...] = ()


class Site(NamedTuple):
    """What a generator may know of the scene it works for.

    Attributes
    ----------
    folder : Path
        Folder of the scene file, for relative paths.
    density : mapping
        Density of each material in kg/m³, by name.
    box : Box
        The domain, and the directions in which it repeats itself; open space where there is none.
    """

    folder: Path
    density: Mapping[str, float] = {}
    box: Box = open_space()


class Gaps(NamedTuple):
    """Bounds, both included, of the gap between two surfaces in m; overlaps are negative gaps.

    With ``relative`` the larger bound is a share of the smaller particle's diameter instead.
    """

    least: float
    most: float
    relative: bool = False

    def per(self, diameter: float) -> Gaps:
        """Return the bounds in diameters of particles of this size in m."""
        return Gaps(self.least / diameter, self.most if self.relative else self.most / diameter, True)

    def of(self, diameter: float) -> Gaps:
        """Return the bounds in m for particles of this diameter."""
        return Gaps(self.least, self.most * diameter if self.relative else self.most)


class Estimate(NamedTuple):
    """A number told beforehand: within ``value`` · (1 ± ``band``), most probably; exact with the band 0."""

    value: float
    band: float = 0.0


@dataclass(frozen=True)
class Prediction:
    """What a generator will make, told without making it.

    Attributes
    ----------
    particles : int
    radius : float
        Of the smallest particle in m.
    material : str
        Of the smallest particle.
    bonds : Estimate or None
        Bonds the packing brings itself, and pairs of one grain that the scene bonds for their gap; None where only
        packing can tell.
    particles_band : float
        How sure ``particles`` is, as ``Estimate.band``.
    room : FilledRoom or None
        What it fills, if it takes walls for granted: they are held against it before it packs.
    concerns : tuple of str
        What the user should know before anything is packed, one sentence each, such as what was left out of a file.
    """

    particles: int
    radius: float
    material: str
    bonds: Estimate | None = None
    particles_band: float = 0.0
    room: FilledRoom | None = None
    concerns: tuple[str, ...] = ()


@dataclass(frozen=True)
class Generator:
    """The part a plugin registers with ``registry.generator(name, Generator(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes in YAML.
    generate : (params, site) -> Packing
        ``site`` is the :class:`Site` of the scene.
    predict : (params, site, gaps) -> Prediction, optional
        What ``clast check`` tells, in milliseconds; ``gaps`` are those the scene bonds, None where it bonds none. It
        is asked before ``generate`` too, so that what cannot be is refused at once. Without it ``clast check`` calls
        ``generate``: leave it out where that takes no time.
    """

    summary: str
    Params: type[Params]
    generate: Callable[[Any, Site], Packing]
    predict: Callable[[Any, Site, Gaps | None], Prediction] | None = None

"""The state of a running scene: plain arrays in named records, as the compiled loop takes them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.uint32]
Integers = NDArray[np.int64]
Bytes = NDArray[np.uint8]


class Particles(NamedTuple):
    """Particle tables, (n, 8) float64 each, ``body`` (n, 4); columns in ``kernels.layout``.

    ``seen`` holds the velocities that forces see; ``reference`` (n, 4) the positions at the last neighbour search and
    the squared distance from there at which the lists go stale;
    ``applied`` is a constant load on each particle, (0, 8) where there is none;
    ``present`` (n,) is 0 for particles that left the domain.
    """

    pose: Floats
    twist: Floats
    body: Floats
    seen: Floats
    load: Floats
    acceleration: Floats
    reference: Floats
    applied: Floats
    present: Bytes


class RepeatedParticles(NamedTuple):
    """Particle tables as in :class:`Particles`, which it stands in for in a periodic box, and the table of the box.

    ``box`` (BOX_ROWS, 3) tells in which directions, and how far away, images follow. A table more that is handed on
    costs a scene of few particles a tenth of its time: others do without.
    """

    pose: Floats
    twist: Floats
    body: Floats
    seen: Floats
    load: Floats
    acceleration: Floats
    reference: Floats
    applied: Floats
    present: Bytes
    box: Floats


class Bonds(NamedTuple):
    """Bonds in blocks of lanes: ends (b, LANES), bond numbers (b, LANES), and ``data`` (b, slots * LANES).

    ``sides`` (b, LANES) tells which ends a lane loads, none in lanes that only fill a block; ``begin`` (c + 1,) where
    each chunk's blocks begin.
    """

    first: Indices
    second: Indices
    number: Integers
    sides: Bytes
    data: Floats
    begin: Indices


class Pairs(NamedTuple):
    """Pairs of particles that may touch, in rising order within each chunk.

    ``sides`` tells which ends a row loads; ``bond`` is the place of the pair's bond in the bond table, −1 for none;
    ``rest`` the overlap in m up to which the pair does not push; ``history`` (p, 3 + h) holds the last normal and what
    the contact law remembers. Chunk c has its rows from ``begin[c]`` to ``end[c]``, and behind them room for more up to
    ``begin[c + 1]``: rows that load nothing.
    """

    first: Indices
    second: Indices
    sides: Bytes
    bond: Integers
    rest: Floats
    touching: Bytes
    history: Floats
    begin: Indices
    end: Indices

    @property
    def tables(self) -> list[NDArray[Any]]:
        """What has a row for each pair."""
        return list(self[:-2])


class WallPairs(NamedTuple):
    """Particles near walls, ordered by wall and particle, with a row for each contact that they may have.

    ``slot`` numbers the rows of a particle at a wall.
    """

    wall: Indices
    particle: Indices
    slot: Indices
    touching: Bytes
    history: Floats


class Walls(NamedTuple):
    """Walls: numbers of shape and motion, where they are, and what acts on them.

    ``pose`` (w, 3) is how far each has moved; where some wall turns it is (w, 7), with how it is turned about its
    ``centre``; ``twist`` (w, 3 or 6) and ``reference`` (w, 3 or 5) likewise: columns in ``kernels.layout``. Moments are
    about the centre.

    ``pressing`` (w,) sums up in N how hard contacts press along their normals, where a scene has walls that are not
    flat; ``lists`` holds what shapes and courses have of any length. ``begun`` (w,) is when the present stage of each
    wall's motion began in s, ``stage`` (w, 2) its number and that of the sample at which it began.
    ``answers`` (w,) is 1 for walls that forces move at some stage, so that particles touch them that nothing moves,
    ``pushes`` (w,) how many contacts pushed each of those at the last forces.
    ``slots`` (w,) is the most contacts of a particle with each wall, ``places`` (2 slots + 1, 4) room to find them, and
    ``crowded`` (w,) is 1 for walls that a particle touched in more places.
    """

    shape_kind: Integers
    shape: Floats
    motion_kind: Integers
    course: Floats
    material: Integers
    centre: Floats
    pose: Floats
    twist: Floats
    force: Floats
    moment: Floats
    force_sum: Floats
    moment_sum: Floats
    reference: Floats
    pressing: Floats
    pressing_sum: Floats
    lists: Floats
    begun: Floats
    stage: Integers
    answers: Bytes
    pushes: Integers
    slots: Integers
    places: Floats
    crowded: Bytes

    @property
    def displacement(self) -> Floats:
        """How far each wall, or the centre about which it turns, has moved, (w, 3) in m."""
        return self.pose[:, :3]

    @property
    def velocity(self) -> Floats:
        """Velocity of each wall, or of the centre about which it turns, (w, 3) in m/s."""
        return self.twist[:, :3]


class Cracks(NamedTuple):
    """Crack table: one row a broken bond, in the order of breaking within each chunk.

    Chunk c has room from row ``begin[c]`` on, of which ``filled[c]`` rows are in use.
    """

    begin: Integers
    filled: Integers
    step: Integers
    bond: Integers
    ends: Integers
    position: Floats
    mode: Integers
    load: Floats  # normal force, shear force, energy


class Numbers(NamedTuple):
    """Run-time numbers of the laws and the loop."""

    bond_uniforms: Floats
    contact_table: Floats
    body: Floats
    braking: Floats
    dt: float
    seed: int
    wall_reach2: float  # squared displacement of a wall at which its neighbours go stale
    radius: float  # of every particle, where all have the same; likewise the next two
    inverse_mass: float
    inverse_inertia: float
    lever: float  # 1: forces act at the contact point, 0: at the undeformed radius
    start_kick: float
    fade: float  # share of its load that a breaking bond loses each step
    first_step: int  # step from which the present time step is taken
    first_time: float  # its time in s
    mass: float  # of all particles, in kg
    late: float  # what the time since the forces before is more than usual in that step, in s
    early: float  # and what it is less than walls were told, that keep their velocities for it


class Team(NamedTuple):
    """One of the threads that share a step loop.

    Its number, how many there are, where they wait, and the chunks that are its own: from ``begin`` to ``end``.
    """

    rank: int
    size: int
    barrier: Integers
    begin: int
    end: int


class World(NamedTuple):
    """Everything the step loop reads and writes.

    ``chunks`` (c + 1,) are the particle numbers where chunks begin, ``stale`` (c + 1,) tells of each chunk, and last
    of the walls, whether something is too far from where neighbours were searched; ``scratch`` has a row a chunk.
    ``ledger`` (c + 1, terms) sums up energies in J of each chunk, and last of the walls; terms in ``kernels.layout``.
    """

    particles: Particles
    bonds: Bonds
    pairs: Pairs
    wall_pairs: WallPairs
    walls: Walls
    cracks: Cracks
    numbers: Numbers
    clock: Integers
    chunks: Indices
    stale: Bytes
    scratch: Floats
    ledger: Floats

"""Where things lie: columns of the particle tables, slots of the scratch tables, entries of the clock.

Scratch and bond tables hold *slots* of ``LANES`` numbers each: the value of slot s for lane l is at s * LANES + l.
"""

LANES = 64

# particle tables: one cache line of eight numbers a particle, so that a row moves as two vectors of four
X, RADIUS, Q = 0, 3, 4  # pose: position, radius, orientation (w, x, y, z)
V, W = 0, 4  # twist and seen: velocity, 0, angular velocity, 0
F, M = 0, 4  # load and acceleration: force, 0, moment, 0; acceleration and angular acceleration likewise
INVERSE_MASS, INVERSE_INERTIA, MATERIAL, WEIGHT = 0, 1, 2, 3  # body: 1/m, 1/I, material, share that has weight

# walls: pose holds displacement and orientation (w, x, y, z), twist velocity and angular velocity, reference the
# displacement at the last neighbour search, the angle turned since, and how far from the centre what may touch is; all
# but the first three columns only where some wall turns
WALL_Q, WALL_W, ANGLE, ARM = 3, 3, 3, 4

# box: one row each; 0 in directions that are not periodic
SPAN, PER_SPAN, GROWTH = 0, 1, 2  # distance from an image to the next, its inverse, and how fast it grows
SPAN_AT_START, LOGARITHMIC, ENGINEERING = 3, 4, 5  # from which it grows at constant rates of these strains
SPAN_AT_SEARCH, MIDDLE = 6, 7  # distance at the last neighbour search; what stays where it is
BOX_ROWS = 8
MOST_SHRUNK = 0.01  # share by which lists reach farther where the box shrinks, and are made anew once it has

# bond tables: the first two slots of every bond
INDEX, INTACT = 0, 1
BOND_SLOTS = 2

# which ends of a bond or a pair a chunk loads
FIRST, SECOND = 1, 2

# scratch of the bond sweep
BOND_D, BOND_QI, BOND_QJ, BOND_V, BOND_WI, BOND_WJ = 0, 3, 7, 11, 14, 17
BOND_F, BOND_MI, BOND_MJ, OVERLOAD, FLOWED = 20, 23, 26, 29, 30
RATE_V, RATE_WI, RATE_WJ = 31, 34, 37  # velocities at the instant of the forces, for dashpots
DRAG_F, DRAG_M = 40, 43  # force and moment of the dashpots
BOND_SCRATCH = 46
ENERGY = BOND_F  # where loads are not computed

# scratch of the contact sweep
D, RI, RJ, IM, II, REST, DV, WI, WJ, NORMAL = 0, 3, 4, 5, 6, 7, 8, 11, 14, 17
CONTACT_F, CONTACT_MI, CONTACT_MJ, DRIFT, TURNING, LOST, DRAG, TURNED = 20, 23, 26, 29, 32, 35, 40, 46
HELD, CONTACT_FREE = 49, 50

# energy ledger, in J: what contacts (in the order of ContactLosses) and bonds dissipate, the work done on the scene,
# what left with particles, what was there at the start, what contacts hold that appear as bonds break, what the damping
# of motion took, and the work of a box that is stretched
VISCOUS, SLIDING, ROLLING, STIFFENING = 0, 1, 2, 3
BOND_VISCOUS, PLASTIC, DROPS, BROKEN = 4, 5, 6, 7
WALL_WORK, DRIVEN_WORK, APPLIED_WORK, BODY_WORK = 8, 9, 10, 11
LEFT, START, WOKEN, BRAKED = 12, 13, 14, 15
BOX_WORK, BOX_POWER = 16, 17  # work of a box that is stretched, and its power at the last evaluation of forces
POWER, MOTION, FORCE = 18, 19, 20  # of a chunk's particles together, as in ``clast.parts.damping.Together``
TERMS = 24  # whole cache lines: each chunk has a row, which its thread writes

# scratch of turning
TURN_Q, TURN_W = 0, 4

# clock; DOWNHILL counts how often in a row forces did work on all particles together, for dampings that ask
STEP, STAGE, MOVED, PRIMED, DOWNHILL = 0, 1, 2, 3, 4
CLOCK = 5
DONE, STALE = 0, 1

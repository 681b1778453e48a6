"""What a scene plugs into the step loop. The assembler writes this module anew; here it binds an empty scene."""

from __future__ import annotations

from typing import Any

from clast.engine.compiler import inlined
from clast.parts.integrator import Stage

STAGES = (Stage(0.0, 0.5, 0.0, 1.0, 0.5),)
SPANS = (1.0,)  # time since the last force evaluation, as a fraction of the step
FORCES_AT = (0.5,)  # when forces are evaluated, as a fraction of the step
LAG = 0.0  # how much later than positions velocities belong at the end of a step, as a fraction of the step
CHOICES: Any = None

CHUNKED = False
PERIODIC = False
STRETCHES = False
BONDS = False
BOND_ORIENTATION = False
BOND_VELOCITY = False
BOND_DAMPING = False
BOND_BOOKS = False
BOND_DRAG = 0
BOND_EVENTS = False
BOND_FLOW = False
BOND_LIMIT = False
TURNED_MODE = 0
FADE = False
CONTACTS = False
BONDED_PAIRS_TOUCH = True
ONE_MATERIAL = True
ONE_SIZE = True
RESTS = False
WALLS = False
CURVED_WALLS = MANIFOLDS = WALLS_TURN = TURNED_BY_MOMENTS = False
ANSWERING = False
BODY_FORCES = BODY_LOADS = False
BRAKES = STEERS = False
APPLIED_LOADS = False
LEDGER = False
REMEMBERS = False
ROLLS = False
TURNS = False
YIELDS = False
REACHES = False
CONTACT_LOSSES = False
ORIENTATION = False
SPIN = False
VELOCITY_FORCES = False
HISTORY = 0
CONTACT_CONSTANTS = 0


@inlined
def nothing(*args: Any) -> Any:
    """Stand for a part that the scene lacks."""
    return None


bond_measure = bond_end_loads = bond_load = bond_flow = bond_failure = bond_mode = bond_energy = nothing
bond_overload = bond_on_event = bond_beyond = nothing
read_uniforms = read_reference = read_constants = read_damping = nothing
read_kinematic_state = write_kinematic_state = read_bond_state = write_bond_state = nothing
contact_load = contact_energy = contact_losses = contact_reach = read_contact_constants = row_constants = nothing
read_history = write_history = carry_history = fresh_history = load_history = store_history = no_losses = nothing
wall_nearest = wall_touches = wall_start = wall_velocity = wall_answer = wall_inverse_mass = nothing
wall_start_spin = wall_spin = wall_answer_spin = nothing
body_acceleration = body_load = nothing
braking = steering = nothing

"""How contacts begin and end: how far they hold beyond touch, and what they take and lose by it."""

from __future__ import annotations

from typing import Any

from clast.engine.compiler import inlined
from clast.engine.state import Floats
from clast.maths.vec3 import ZERO, Vec, add, dot
from clast.parts.contact_law import Drag, Touch

from .lanes import row
from .slots import CHOICES, HISTORY, contact_energy, contact_load, contact_reach, fresh_history, load_history


@inlined
def reach_of(r_i: float, r_j: float, constants: Any) -> float:
    """Return how far beyond touch a contact holds that has begun, in m; a wall has radius 0."""
    return contact_reach(constants, r_i if r_j == 0.0 else r_i * r_j / (r_i + r_j))  # type: ignore[no-any-return]


@inlined
def jump_at_touch(touch: Touch, constants: Any, history: Any, force: Vec, drag: Drag, share: float) -> float:
    """Return the energy in J that a force which sets in with a jump took on the way before touch, if that was just now.

    The steps let it act on half of the whole way since the forces before, the law counts its energy from the touch.
    """
    elastic = dot(add(force, drag.force), touch.normal)
    stored: float = contact_energy(touch, constants, history, CHOICES)
    return 0.5 * elastic * touch.overlap / share - stored if share < 1.0 else 0.0


@inlined
def still(r_i: float, r_j: float, overlap: float, n: Vec) -> Touch:
    """Return a contact at rest; a wall has radius 0."""
    radius = r_i if r_j == 0.0 else r_i * r_j / (r_i + r_j)
    return Touch(overlap, n, ZERO, ZERO, ZERO, radius, r_i, r_j, 1.0, 1.0, ZERO, ZERO)


@inlined
def energy_left(r_i: float, r_j: float, constants: Any, histories: Floats, k: int) -> float:
    """Return the elastic energy that contact k still holds as it comes apart, in J: that of springs across it.

    A tangential spring whose stiffness does not vanish with the overlap may be stretched then, and snaps.
    """
    parting = still(r_i, r_j, 0.0, row(histories, k, 0))
    return contact_energy(parting, constants, load_history(histories[k]), CHOICES)  # type: ignore[no-any-return]


@inlined
def energy_let_go(then: Touch, opened: float, constants: Any, histories: Floats, k: int, dt: float) -> float:
    """Return the energy in J that contact k loses as it ends beyond touch, where it pulls still.

    What it held at the forces before, less the work of the force then on half the way since, for none acts now.

    Parameters
    ----------
    then : Touch
        The contact as it was at the forces before, at rest.
    opened : float
        How far the bodies have moved apart since, in m.
    constants : record of the law
    histories : (p, 3 + h) float64
    k : int
    dt : float
    """
    history = fresh_history()
    if HISTORY > 0:
        history = load_history(histories[k])
    load, _ = contact_load(then, constants, history, abs(dt), CHOICES)  # some schemes step back
    held: float = contact_energy(then, constants, history, CHOICES)
    return held - 0.5 * opened * dot(load.force, then.normal)

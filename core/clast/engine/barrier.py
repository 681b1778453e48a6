"""A barrier between the threads of a step loop, in compiled code: a step has three, too many for the system's own."""

from __future__ import annotations

import os
from typing import Any

from numba import types
from numba.extending import intrinsic

from clast.engine.compiler import inlined, routine
from clast.engine.state import Integers, Team

ARRIVED, ROUND = 0, 8
"""Places in the barrier's array: threads that wait, and rounds that are over; a cache line apart."""

SPINS = 400

yield_now: Any = types.ExternalFunction("sched_yield", types.int32()) if os.name == "posix" else None


def _address(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    from numba.np.arrayobj import make_array

    array = make_array(signature.args[0])(context, builder, arguments[0])
    return builder.gep(array.data, [arguments[1]])


@intrinsic  # type: ignore[untyped-decorator]
def fetch_add(typing: Any, array: Any, k: Any, value: Any) -> Any:
    """Add to a number of an int64 array in one piece, and return what it was."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.atomic_rmw("add", _address(context, builder, signature, arguments), arguments[2], "seq_cst")

    return types.int64(array, types.intp, types.int64), generate


@intrinsic  # type: ignore[untyped-decorator]
def fetch(typing: Any, array: Any, k: Any) -> Any:
    """Return a number of an int64 array as the other threads have left it."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.load_atomic(_address(context, builder, signature, arguments), "seq_cst", 8)

    return types.int64(array, types.intp), generate


@inlined
def pause() -> None:
    """Let another thread have the processor."""
    if os.name == "posix":
        yield_now()


@routine
def meet_all(barrier: Integers, size: int) -> None:
    """Wait until all threads of a team have come here."""
    over = fetch(barrier, ROUND)
    if fetch_add(barrier, ARRIVED, 1) == size - 1:
        fetch_add(barrier, ARRIVED, -size)
        fetch_add(barrier, ROUND, 1)
        return
    spins = 0
    while fetch(barrier, ROUND) == over:
        spins += 1
        if spins > SPINS:
            pause()


@inlined
def wait(team: Team) -> None:
    """Wait until all threads of a team have come here; a team of one never waits."""
    if team.size > 1:
        meet_all(team.barrier, team.size)

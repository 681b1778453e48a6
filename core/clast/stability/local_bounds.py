"""Bounds of the time step for every particle by itself: always safe, and cheap."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.stability.springs import Bodies, Springs, chosen

Floats = NDArray[np.float64]
AT_ONCE = 50_000


def local_bounds(springs: Springs, bodies: Bodies, per_time: float = 0.0) -> Floats:
    """Return a bound of every particle, (n,) in rad²/s²; the largest is never below the largest eigenvalue.

    A spring costs |B_i u_i + B_j u_j|² ≤ (1 + t) |B_i u_i|² + (1 + 1/t) |B_j u_j|² for every t > 0; t is taken from
    the traces of both ends. So what a particle's springs, each with its weight, cost it alone bounds the whole: the
    largest eigenvalue of one 6 x 6 matrix a particle. It refines Gershgorin's circles to blocks.

    Parameters
    ----------
    springs : Springs
    bodies : Bodies
    per_time : float
        Factor on the dashpots in 1/s.
    """
    blocks = np.zeros((len(bodies.radius) + 1, 6, 6))
    for begin in range(0, len(springs.first), AT_ONCE):
        part = chosen(springs, slice(begin, begin + AT_ONCE))
        strengths = part.stiffness + per_time * part.damping
        ends = [_end(part, strengths, bodies, 0), _end(part, strengths, bodies, 1)]
        traces = [np.trace(block, axis1=1, axis2=2) for block in ends]
        for e, number in enumerate((part.first, part.second)):
            mine, other = traces[e], traces[1 - e]
            weight = 1.0 + np.sqrt(np.divide(other, mine, out=np.zeros_like(mine), where=mine > 0.0))
            np.add.at(blocks, number, weight[:, None, None] * ends[e])
    return np.asarray(np.linalg.eigvalsh(blocks[:-1])[:, -1])


def rough_bound(springs: Springs, bodies: Bodies, per_time: float) -> float:
    """Return a bound of the largest eigenvalue in rad²/s² that is cheaper still: traces, without directions."""
    strengths = springs.stiffness + per_time * springs.damping
    along, across, twist, bending = strengths.T
    sizes = []
    for e, number in enumerate((springs.first, springs.second)):
        moving = np.append(bodies.inverse_mass, 0.0)[number] * np.maximum(along, across)
        levers = across * springs.arms[:, e] ** 2 + np.maximum(twist, bending)
        sizes.append(np.sqrt(moving + np.append(bodies.inverse_inertia, 0.0)[number] * levers))
    sums = np.zeros(len(bodies.radius) + 1)
    np.add.at(sums, springs.first, sizes[0] * (sizes[0] + sizes[1]))
    np.add.at(sums, springs.second, sizes[1] * (sizes[0] + sizes[1]))
    return float(sums[:-1].max(initial=0.0))


def _end(springs: Springs, strengths: Floats, bodies: Bodies, e: int) -> Floats:
    """Return BᵀB of one end of every spring, (s, 6, 6), with the roots of mass and inertia divided out."""
    number = springs.second if e else springs.first
    move = np.sqrt(np.append(bodies.inverse_mass, 0.0))[number][:, None, None]
    turn = np.sqrt(np.append(bodies.inverse_inertia, 0.0))[number][:, None, None]
    n, arm = springs.normal, springs.arms[:, e, None, None]
    along = n[:, :, None] * n[:, None, :]
    across = np.eye(3) - along
    stretch, shear, twist, bending = (strengths[:, c, None, None] for c in range(4))
    block = np.zeros((len(n), 6, 6))
    block[:, :3, :3] = move * move * (stretch * along + shear * across)
    block[:, 3:, 3:] = turn * turn * (twist * along + (shear * arm * arm + bending) * across)
    side = (1.0 if e else -1.0) * move * turn * shear * arm * cross_matrices(n)
    block[:, :3, 3:] = side
    block[:, 3:, :3] = side.transpose(0, 2, 1)
    return block


def cross_matrices(a: Floats) -> Floats:
    """Return the matrices A with A b = a x b, (m, 3, 3)."""
    A = np.zeros((len(a), 3, 3))
    A[:, 0, 1], A[:, 0, 2] = -a[:, 2], a[:, 1]
    A[:, 1, 0], A[:, 1, 2] = a[:, 2], -a[:, 0]
    A[:, 2, 0], A[:, 2, 1] = -a[:, 1], a[:, 0]
    return A

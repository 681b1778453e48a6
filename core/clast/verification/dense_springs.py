"""Springs as a dense matrix, assembled from strain measures: what matrix-free products are compared with."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigvalsh

from clast.stability.local_bounds import cross_matrices
from clast.stability.springs import Bodies, Springs


def assembled(springs: Springs, bodies: Bodies, per_time: float = 0.0) -> np.ndarray:
    """Return M⁻½ (K + C · per_time) M⁻½, (6n, 6n), from six strain measures a spring."""
    n = len(bodies.radius)
    K = np.zeros((6 * n + 6, 6 * n + 6))
    for s in range(len(springs.first)):
        measures, strengths = _measures(springs, s), _strengths(springs, s, per_time)
        here = np.r_[6 * springs.first[s] + np.arange(6), 6 * springs.second[s] + np.arange(6)]
        K[np.ix_(here, here)] += measures.T @ strengths @ measures
    inverse = np.column_stack([bodies.inverse_mass] * 3 + [bodies.inverse_inertia] * 3).ravel()
    return K[:-6, :-6] * np.sqrt(inverse)[:, None] * np.sqrt(inverse)


def _measures(springs: Springs, s: int) -> np.ndarray:
    """Return the (6, 12) matrix from the motion of both ends to the strain measures in space."""
    B = np.zeros((6, 12))
    turn = cross_matrices(springs.normal[s : s + 1])[0]
    B[:3, :3], B[:3, 6:9] = -np.eye(3), np.eye(3)
    B[:3, 3:6], B[:3, 9:] = springs.arms[s, 0] * turn, springs.arms[s, 1] * turn
    B[3:, 3:6], B[3:, 9:] = -np.eye(3), np.eye(3)
    return B


def _strengths(springs: Springs, s: int, per_time: float) -> np.ndarray:
    along = np.outer(springs.normal[s], springs.normal[s])
    k = springs.stiffness[s] + per_time * springs.damping[s]
    D = np.zeros((6, 6))
    D[:3, :3] = k[0] * along + k[1] * (np.eye(3) - along)
    D[3:, 3:] = k[2] * along + k[3] * (np.eye(3) - along)
    return D


def largest(springs: Springs, bodies: Bodies, per_time: float = 0.0) -> float:
    """Return the largest eigenvalue of the dense matrix in rad²/s²."""
    last = 6 * len(bodies.radius) - 1
    return float(eigvalsh(assembled(springs, bodies, per_time), subset_by_index=(last, last))[0])

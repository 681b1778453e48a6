"""The undeformed bond network as a linear system: its largest frequency bounds the time step."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.scene.plan import bond_stiffness
from clast.scene.scene import Scene


def largest_frequency(scene: Scene) -> float:
    """Return ω_max in rad/s of M⁻½ K M⁻½ with three translations and three rotations a particle.

    The largest eigenvalue comes from Lanczos iterations on the matrix-free product, started from fixed numbers, so
    it is the same in every run; it is exact to 1e-4.
    """
    from scipy.sparse.linalg import LinearOperator, eigsh

    n = len(scene.radius)
    rows = _stiff_rows(scene)
    if 6 * n <= 12:
        return float(np.linalg.norm(rows.toarray(), 2))

    def product(u: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(rows.T @ (rows @ u.ravel()))

    first = np.cos(np.arange(6 * n) * 2.399963) + 0.5
    if not product(first).any():  # nothing that bonds could move
        return 0.0
    operator = LinearOperator((6 * n, 6 * n), matvec=product, dtype=np.float64)  # type: ignore[call-arg, arg-type, unused-ignore]
    largest = eigsh(operator, k=1, which="LA", v0=first, tol=1e-4, return_eigenvectors=False)
    return float(np.sqrt(max(largest[0], 0.0)))


def _stiff_rows(scene: Scene) -> Any:
    """Return the sparse B, six rows a bond, with BᵀB = M⁻½ K M⁻½.

    The rows are √stiffness times the strain measures: u_j − u_i + d/2 x (θ_i + θ_j) and θ_j − θ_i, each stiff in one
    way along the bond and in another across it.
    """
    from scipy.sparse import csr_matrix

    d = scene.bond_vectors
    n = d / np.linalg.norm(d, axis=1)[:, None]
    k = bond_stiffness(scene)
    along = n[:, :, None] * n[:, None, :]
    across = np.eye(3)[None] - along
    moving = np.sqrt(k.axial)[:, None, None] * along + np.sqrt(k.shear)[:, None, None] * across
    turning = np.sqrt(k.torsion)[:, None, None] * along + np.sqrt(k.bending)[:, None, None] * across
    lever = moving @ _cross_matrices(0.5 * d)
    nothing = np.zeros_like(moving)
    moves = np.concatenate([-moving, lever, moving, lever], axis=2)
    turns = np.concatenate([nothing, -turning, nothing, turning], axis=2)
    i, j = scene.ends.T
    columns = np.concatenate([6 * i[:, None] + np.arange(6), 6 * j[:, None] + np.arange(6)], axis=1)
    values = np.concatenate([moves, turns], axis=1) * _inverse_root_mass(scene)[columns][:, None, :]
    wide = np.repeat(columns[:, None, :], 6, axis=1)
    begins = np.arange(0, values.size + 1, 12)
    return csr_matrix((values.ravel(), wide.ravel(), begins), shape=(6 * len(d), 6 * len(scene.radius)))


def _cross_matrices(a: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the matrices A with A b = a x b, (m, 3, 3)."""
    A = np.zeros((len(a), 3, 3))
    A[:, 0, 1], A[:, 0, 2] = -a[:, 2], a[:, 1]
    A[:, 1, 0], A[:, 1, 2] = a[:, 2], -a[:, 0]
    A[:, 2, 0], A[:, 2, 1] = -a[:, 1], a[:, 0]
    return A


def _inverse_root_mass(scene: Scene) -> NDArray[np.float64]:
    inertia = 0.4 * scene.mass * scene.radius**2
    table = np.column_stack([scene.mass] * 3 + [inertia] * 3)
    table[scene.prescribed] = np.inf
    return np.asarray(1.0 / np.sqrt(table.ravel()))

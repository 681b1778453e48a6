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
    it is the same in every run; it is exact to 1e-6.
    """
    from scipy.sparse.linalg import LinearOperator, eigsh

    n = len(scene.radius)
    strain, stiffness, weight = _strain_rows(scene)
    scaled = strain.multiply(weight[None, :]).tocsr()
    weighted = scaled.multiply(stiffness[:, None]).tocsr()
    transposed = scaled.T.tocsr()

    def product(u: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(transposed @ (weighted @ u.ravel()))

    operator = LinearOperator((6 * n, 6 * n), matvec=product, dtype=np.float64)  # type: ignore[call-arg, arg-type, unused-ignore]
    first = np.cos(np.arange(6 * n) * 2.399963) + 0.5
    if 6 * n <= 12:
        dense = (transposed @ weighted).toarray()
        return float(np.sqrt(max(np.linalg.eigvalsh(dense)[-1], 0.0)))
    largest = eigsh(operator, k=1, which="LA", v0=first, tol=1e-6, return_eigenvectors=False)
    return float(np.sqrt(max(largest[0], 0.0)))


def _strain_rows(scene: Scene) -> tuple[Any, NDArray[np.float64], NDArray[np.float64]]:
    """Return the sparse map from displacements and rotations to strain measures, their stiffness, and M⁻½."""
    from scipy.sparse import csr_matrix

    d = scene.bond_vectors
    n = d / np.linalg.norm(d, axis=1)[:, None]
    m = len(n)
    k = bond_stiffness(scene)
    across = np.eye(3)[None] - n[:, :, None] * n[:, None, :]
    along = n[:, :, None] * n[:, None, :]
    lever = _cross_matrices(0.5 * d)
    # axial and shear: projections of u_j − u_i + d/2 x (θ_i + θ_j); twist and bending: projections of θ_j − θ_i
    blocks, stiffness = [], []
    for projection, moves, value in (
        (along, True, k.axial),
        (across, True, k.shear),
        (along, False, k.torsion),
        (across, False, k.bending),
    ):
        block = np.zeros((m, 3, 12))
        if moves:
            block[:, :, 0:3], block[:, :, 6:9] = -projection, projection
            block[:, :, 3:6] = block[:, :, 9:12] = projection @ lever
        else:
            block[:, :, 3:6], block[:, :, 9:12] = -projection, projection
        blocks.append(block)
        stiffness.append(np.repeat(value, 3))
    i, j = scene.ends.T
    columns = np.concatenate([6 * i[:, None] + np.arange(6), 6 * j[:, None] + np.arange(6)], axis=1)
    everything = np.concatenate(blocks).reshape(-1, 12)
    rows = np.repeat(np.arange(len(everything)), 12)
    wide = np.tile(np.repeat(columns, 3, axis=0), (4, 1))
    matrix = csr_matrix((everything.ravel(), (rows, wide.ravel())), shape=(len(everything), 6 * len(scene.radius)))
    return matrix, np.concatenate(stiffness), _inverse_root_mass(scene)


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

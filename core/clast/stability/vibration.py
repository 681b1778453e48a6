"""Vibration: the compiled product of springs with displacements, and its largest eigenvalue.

Own loops in a fixed order instead of a library's: sums in linear algebra libraries depend on the number of threads.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from clast.engine.compiler import compiled
from clast.stability.springs import Bodies, Springs

Floats = NDArray[np.float64]
ACCURACY, SETTLED = 0.01, 1e-3
LOOK_EVERY, MOST = 8, 400


def largest_eigenvalue(springs: Springs, bodies: Bodies, per_time: float = 0.0) -> float:
    """Return an upper estimate of the largest eigenvalue of M⁻½ (K + C · per_time) M⁻½ in rad²/s².

    Lanczos iterations from a fixed random vector until the residual of the largest Ritz pair is below 1 % of its
    value and eight more iterations change the value by less than 0.1 %. The residual is added to the value, so the
    estimate is at most 1 % above; where a second mode is nearly as fast it may be below by a fraction of a percent.
    Source: Parlett, The Symmetric Eigenvalue Problem (1998), Chapters 4 and 13.

    Parameters
    ----------
    springs : Springs
    bodies : Bodies
    per_time : float
        Factor on the dashpots in 1/s.
    """
    roots = inverse_roots(bodies)
    strengths = springs.stiffness + per_time * springs.damping
    v = np.random.RandomState(1).uniform(-1.0, 1.0, roots.shape) * (roots > 0.0)
    before, product = np.zeros_like(v), np.zeros_like(v)
    v /= sqrt(dot(v, v)) or 1.0
    diagonal: list[float] = []
    beside: list[float] = []
    last = 0.0
    for count in range(1, MOST + 1):
        multiply(springs, strengths, roots, v, product)
        diagonal.append(dot(v, product))
        orthogonalise(product, v, before, diagonal[-1], beside[-1] if beside else 0.0)
        beside.append(sqrt(dot(product, product)))
        ended = not beside[-1] > 1e-12 * abs(diagonal[0])
        if ended or count % LOOK_EVERY == 0 or count == MOST:
            value, residual = largest_ritz(diagonal, beside)
            settled = residual <= ACCURACY * value and value - last <= SETTLED * value
            if ended or settled or count == MOST:
                return value + residual
            last = value
        before, v, product = v, product / beside[-1], before
    raise AssertionError("the loop returns")


def largest_ritz(diagonal: list[float], beside: list[float]) -> tuple[float, float]:
    """Return the largest eigenvalue of the tridiagonal matrix so far, and the residual of its Ritz pair."""
    from scipy.linalg import eigh_tridiagonal

    last = len(diagonal) - 1
    if last == 0:
        return max(diagonal[0], 0.0), beside[0]
    values, vectors = eigh_tridiagonal(diagonal, beside[:-1], select="i", select_range=(last, last))
    return max(float(values[0]), 0.0), float(beside[-1] * abs(vectors[-1, 0]))


def inverse_roots(bodies: Bodies) -> Floats:
    """Return 1/√m and 1/√I of all bodies, (n + 1, 6); the last is the wall."""
    roots = np.zeros((len(bodies.radius) + 1, 6))
    roots[:-1, :3] = np.sqrt(bodies.inverse_mass)[:, None]
    roots[:-1, 3:] = np.sqrt(bodies.inverse_inertia)[:, None]
    return roots


@compiled
def dot(a: Floats, b: Floats) -> float:
    """Return the sum of products of two (n, 6) tables, row by row."""
    total = 0.0
    for k in range(len(a)):
        for c in range(6):
            total += a[k, c] * b[k, c]
    return total


@compiled
def orthogonalise(product: Floats, v: Floats, before: Floats, along: float, beside: float) -> None:
    """Take away from a product what lies along the last two vectors."""
    for k in range(len(v)):
        for c in range(6):
            product[k, c] -= along * v[k, c] + beside * before[k, c]


@compiled
def multiply(springs: Springs, strengths: Floats, roots: Floats, v: Floats, product: Floats) -> None:
    """Write M⁻½ K M⁻½ v into ``product``, both (n + 1, 6): spring after spring."""
    product[:] = 0.0
    for s in range(len(springs.first)):
        i, j = springs.first[s], springs.second[s]
        nx, ny, nz = springs.normal[s]
        a, b = springs.arms[s]
        along, across, twist, bending = strengths[s]
        m_i, m_j, t_i, t_j = roots[i, 0], roots[j, 0], roots[i, 3], roots[j, 3]
        # a θ_i + b θ_j, and the strain measures
        rx = a * t_i * v[i, 3] + b * t_j * v[j, 3]
        ry = a * t_i * v[i, 4] + b * t_j * v[j, 4]
        rz = a * t_i * v[i, 5] + b * t_j * v[j, 5]
        ux = m_j * v[j, 0] - m_i * v[i, 0] + ny * rz - nz * ry
        uy = m_j * v[j, 1] - m_i * v[i, 1] + nz * rx - nx * rz
        uz = m_j * v[j, 2] - m_i * v[i, 2] + nx * ry - ny * rx
        wx = t_j * v[j, 3] - t_i * v[i, 3]
        wy = t_j * v[j, 4] - t_i * v[i, 4]
        wz = t_j * v[j, 5] - t_i * v[i, 5]
        more = (along - across) * (nx * ux + ny * uy + nz * uz)
        fx, fy, fz = across * ux + more * nx, across * uy + more * ny, across * uz + more * nz
        more = (twist - bending) * (nx * wx + ny * wy + nz * wz)
        mx, my, mz = bending * wx + more * nx, bending * wy + more * ny, bending * wz + more * nz
        # the force about the centres: f x n
        gx, gy, gz = fy * nz - fz * ny, fz * nx - fx * nz, fx * ny - fy * nx
        product[i, 0] -= m_i * fx
        product[i, 1] -= m_i * fy
        product[i, 2] -= m_i * fz
        product[i, 3] += t_i * (a * gx - mx)
        product[i, 4] += t_i * (a * gy - my)
        product[i, 5] += t_i * (a * gz - mz)
        product[j, 0] += m_j * fx
        product[j, 1] += m_j * fy
        product[j, 2] += m_j * fz
        product[j, 3] += t_j * (b * gx + mx)
        product[j, 4] += t_j * (b * gy + my)
        product[j, 5] += t_j * (b * gz + mz)

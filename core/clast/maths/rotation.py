"""Rotations: unit quaternions ``(w, x, y, z)`` and their exact, cheap relatives.

Only + − x ÷ √ are used, so compiled and plain Python agree to the bit and loops over lanes vectorise.
"""

from __future__ import annotations

from clast.maths.vec3 import Vec, add, cross, dot, scale

Quat = tuple[float, float, float, float]

Matrix = tuple[Vec, Vec, Vec]
"""Rows of a rotation matrix."""

IDENTITY: Quat = (1.0, 0.0, 0.0, 0.0)


def multiply(p: Quat, q: Quat) -> Quat:
    """Return the quaternion product p q (first q, then p).

    >>> multiply((0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0))
    (0.0, 0.0, 0.0, 1.0)
    """
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3],
        p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1],
    )


def relative(p: Quat, q: Quat) -> Quat:
    """Return p⁻¹ q, grouped so that swapping p and q gives the inverse to the bit.

    >>> relative((1.0, 0.0, 0.0, 0.0), (0.6, 0.8, 0.0, 0.0))
    (0.6, 0.8, 0.0, 0.0)
    """
    return (
        (p[0] * q[0] + p[1] * q[1]) + (p[2] * q[2] + p[3] * q[3]),
        (p[0] * q[1] - p[1] * q[0]) + (p[3] * q[2] - p[2] * q[3]),
        (p[0] * q[2] - p[2] * q[0]) + (p[1] * q[3] - p[3] * q[1]),
        (p[0] * q[3] - p[3] * q[0]) + (p[2] * q[1] - p[1] * q[2]),
    )


def matrix(q: Quat, g: float = 2.0) -> Matrix:
    """Return the rotation matrix of a quaternion of any length, which takes the material frame into space.

    Parameters
    ----------
    q : quaternion
    g : float
        2/|q|²; 2 for a unit quaternion.

    >>> matrix((0.0, 0.0, 0.0, 1.0))
    ((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))
    """
    w, x, y, z = q
    x2, y2, z2 = g * x, g * y, g * z
    wx, wy, wz = w * x2, w * y2, w * z2
    xx, xy, xz = x * x2, x * y2, x * z2
    yy, yz, zz = y * y2, y * z2, z * z2
    return (
        (1.0 - (yy + zz), xy - wz, xz + wy),
        (xy + wz, 1.0 - (xx + zz), yz - wx),
        (xz - wy, yz + wx, 1.0 - (xx + yy)),
    )


def rotate(R: Matrix, a: Vec) -> Vec:
    """Return R a: from the material frame into space."""
    return (dot(R[0], a), dot(R[1], a), dot(R[2], a))


def rotate_back(R: Matrix, a: Vec) -> Vec:
    """Return Rᵀ a: from space into the material frame."""
    return add(add(scale(a[0], R[0]), scale(a[1], R[1])), scale(a[2], R[2]))


def turn(q: Quat, spin: Vec, time: float) -> Quat:
    """Return q after turning with the constant spin (in space) for some time.

    Sine and cosine of the half angle are series to the seventh and sixth order, and one Newton step brings the norm
    back to 1: angle and norm are exact to 1e-12 for turns up to 0.2 rad, to 1e-5 up to 1.5 rad per call.

    Parameters
    ----------
    q : quaternion
    spin : vector, rad/s
    time : float, s
    """
    h = scale(0.5 * time, spin)
    z = dot(h, h)
    s = 1.0 - z * (1.0 / 6.0 - z * (1.0 / 120.0 - z * (1.0 / 5040.0)))
    c = 1.0 - z * (0.5 - z * (1.0 / 24.0 - z * (1.0 / 720.0)))
    r = multiply((c, s * h[0], s * h[1], s * h[2]), q)
    n = 1.5 - 0.5 * (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3])
    return (n * r[0], n * r[1], n * r[2], n * r[3])


def chord(spin: Vec, time: float) -> Vec:
    """Return the vector c by which turning with a constant spin changes a vector: new − old = c x ½ (old + new).

    It lies along the spin and is 2 tan(φ/2) long for the angle φ (Rodrigues' vector, twice); a share of (φ/2)⁶/18 is
    left out: 6e-8 for 0.2 rad, 1e-3 for 1 rad.

    >>> chord((0.0, 0.0, 0.0), 1.0)
    (0.0, 0.0, 0.0)
    """
    turned = scale(time, spin)
    z = 0.25 * dot(turned, turned)
    return scale(1.0 + z * (1.0 / 3.0 + z * (2.0 / 15.0)), turned)


def swing(a: Vec, old: Vec, new: Vec) -> Vec:
    """Carry a vector perpendicular to the unit vector ``old`` along the shortest rotation from old to new.

    The rotation is exact. ``old`` and ``new`` must not be opposite.
    """
    f = dot(a, new) / (1.0 + dot(old, new))
    return (a[0] - f * (old[0] + new[0]), a[1] - f * (old[1] + new[1]), a[2] - f * (old[2] + new[2]))


def spin_about(a: Vec, axis: Vec, angle: float) -> Vec:
    """Rotate a vector perpendicular to the unit vector ``axis`` about it by a small angle.

    Cayley's form keeps the length exactly; the angle is 2 atan(angle/2), third order exact.
    """
    t = 0.5 * angle
    f = 1.0 / (1.0 + t * t)
    return add(scale((1.0 - t * t) * f, a), scale(2.0 * t * f, cross(axis, a)))

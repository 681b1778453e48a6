"""Packings: regular ones have the neighbours that crystallography tells, random ones the volume and sizes asked for."""

from __future__ import annotations

from math import erf, exp, log1p, pi, sqrt
from typing import Any

import numpy as np

from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.finding import Finding
from clast.verification.sketch import Line, Sketch

SHELLS = {
    "sc": ((1.0, 6), (sqrt(2.0), 12), (sqrt(3.0), 8), (2.0, 6)),
    "bcc": ((1.0, 8), (2.0 / sqrt(3.0), 6), (sqrt(8.0 / 3.0), 12), (sqrt(11.0 / 3.0), 24)),
    "fcc": ((1.0, 12), (sqrt(2.0), 6), (sqrt(3.0), 24), (2.0, 12)),
    "hcp": ((1.0, 12), (sqrt(2.0), 6), (sqrt(8.0 / 3.0), 2), (sqrt(3.0), 18)),
}
"""Distances of the shells around a sphere, in those of the nearest, and how many spheres each has."""

WITHIN = 1e-9
"""Share of a distance by which a sphere may be off its shell."""


def judge_lattice(bench: Bench) -> Findings:
    """Count the spheres around the middle one of a ball, shell by shell, and its bonds."""
    lines = []
    for lattice, shells in SHELLS.items():
        scene = bench.start({"particles.lattice": lattice}).scene
        distance = np.linalg.norm(scene.position, axis=1)
        middle, nearest = int(np.argmin(distance)), 2.0 * float(scene.radius[0])
        for k, (far, count) in enumerate(shells):
            found = np.count_nonzero(np.abs(distance / nearest - far) < WITHIN * far)
            yield Finding(f"{lattice}: spheres of shell {k + 1}", float(count), float(found), 0.0)
        bonds = float(np.count_nonzero(scene.ends == middle))
        yield Finding(f"{lattice}: bonds of a sphere", float(shells[0][1]), bonds, 0.0)
        sums = np.cumsum([count for _, count in shells]).astype(float)
        lines.append(Line(lattice, np.array([far for far, _ in shells]), sums, dots=True))
        place = np.linspace(0.9, 2.05, 300)
        lines.append(
            Line(
                f"{lattice}: Clast",
                place,
                np.asarray(np.searchsorted(np.sort(distance / nearest), place) - 1.0, np.float64),
            )
        )
    yield Sketch("spheres around one on a lattice", "distance, in those of the nearest", "spheres", tuple(lines))


CUT = 3.0
"""Where the distributions of sizes are cut, in deviations."""

ASKED = 0.2


def cut_normal_deviation(cut: float) -> float:
    """Return the standard deviation of the standard normal distribution within ± ``cut``.

    >>> round(cut_normal_deviation(1e3), 12), round(cut_normal_deviation(3.0), 4)
    (1.0, 0.9866)
    """
    inside = erf(cut / sqrt(2.0))
    return sqrt(1.0 - 2.0 * cut * exp(-0.5 * cut**2) / sqrt(2.0 * pi) / inside)


def judge_scatter(bench: Bench) -> Findings:
    """Compare the volume of primaries of scattered sizes with that of equal ones, and how far they scatter."""
    equal = bench.start({"particles.primary_deviation": 0.0}).scene.radius
    lines = []
    for distribution in ("normal", "lognormal"):
        radius = bench.start({"particles.primary_distribution": distribution}).scene.radius
        yield Finding(
            f"{distribution}: volume of all primaries, m3",
            float(4.0 / 3.0 * pi * np.sum(equal**3)),
            float(4.0 / 3.0 * pi * np.sum(radius**3)),
            1e-12,
        )
        scatter = radius / radius.mean() if distribution == "normal" else np.log(radius)
        whole = ASKED if distribution == "normal" else sqrt(log1p(ASKED**2))
        found = float(scatter.std())
        yield Finding(
            f"{distribution}: deviation of {'sizes' if distribution == 'normal' else 'their logarithms'}",
            whole * cut_normal_deviation(CUT),
            found,
            0.01,
        )
        share = (np.arange(len(radius)) + 0.5) / len(radius)
        lines.append(Line(f"{distribution}: Clast", np.sort(radius) / equal[0], share))
    yield Sketch("sizes of scattered primaries", "diameter, in that of equal ones", "share below", tuple(lines))


SMALL = 0.1e-3
"""Diameter of the spheres that fill a body thinly, in m."""

FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
CORNERS = [[x, y, z] for x in (0.0, 4e-3) for y in (0.0, 6e-3) for z in (0.0, 8e-3)]
BOX_OF_TRIANGLES = [[CORNERS[k] for k in cut] for a, b, c, d in FACES for cut in ((a, b, c), (a, c, d))]
"""The surface of a box, cut into triangles."""

BODIES: dict[str, tuple[dict[str, Any], tuple[float, float, float], tuple[float, float, float]]] = {
    "box": ({"type": "random_packing", "box": [4e-3, 6e-3, 8e-3]}, (2e-3, 3e-3, 4e-3), (3.0, 3.0, 3.0)),
    "tube": ({"type": "random_packing", "diameter": 6e-3, "height": 8e-3}, (3e-3, 3e-3, 4e-3), (4.0, 4.0, 3.0)),
    "triangles": (
        {"type": "mesh_agglomerate", "triangles": BOX_OF_TRIANGLES},
        (2e-3, 3e-3, 4e-3),
        (3.0, 3.0, 3.0),
    ),
    "ellipsoid": (
        {"type": "ellipsoidal_agglomerate", "semi_axes": [5e-3, 4e-3, 3e-3]},
        (5e-3, 4e-3, 3e-3),
        (5.0, 5.0, 5.0),
    ),
}
"""How each body is asked for, its half lengths in m, and the square of each over the mean square of its places."""


def judge_bodies(bench: Bench) -> Findings:
    """Compare the second moments of thin packings with those of the bodies in which their centres have room."""
    lines = []
    for name, (asked, half, share) in BODIES.items():
        thin = {"material": "glass", "primary_diameter": SMALL, "porosity": 0.99}
        position = bench.start({"particles": asked | thin}).scene.position
        for k, axis in enumerate("xyz"):
            expected = (half[k] - 0.5 * SMALL) ** 2 / share[k]
            yield Finding(f"{name}: mean square of {axis}, m2", expected, float(np.mean(position[:, k] ** 2)), 0.05)
        below = (np.arange(len(position)) + 0.5) / len(position)
        lines.append(Line(f"{name}: Clast", np.sort(position[:, 0]) / half[0], below))
    yield Sketch("places of thinly packed spheres", "x, in half the length of the body", "share below", tuple(lines))


FAMILY = Family(
    "packings",
    "Packings",
    "Around the middle of a ball of spheres on a lattice: how many there are at each distance, and how many of them "
    "are bonded to it. Spheres packed at random: their volume, their sizes and the body they fill. Nothing moves.",
    (
        Case(
            "lattice_shells",
            "shells of neighbours on a lattice",
            "lattice",
            judge_lattice,
            "C. Kittel (2005), Introduction to Solid State Physics, 8th ed., ch. 1: neighbours of the cubic and the "
            "hexagonal lattices",
        ),
        Case(
            "scattered_primaries",
            "volume and deviation of primaries of scattered sizes",
            "packing",
            judge_scatter,
            "the volume of as many equal primaries; normal distribution cut at ± c: deviation "
            "√(1 − 2 c φ(c)/(2 Φ(c) − 1)) of that of the whole one (N. L. Johnson, S. Kotz, N. Balakrishnan (1994), "
            "Continuous Univariate Distributions 1, 2nd ed., § 13.10)",
        ),
        Case(
            "packed_bodies",
            "spheres fill a body evenly",
            "packing",
            judge_bodies,
            "second moments of solid bodies: a²/3 for a box, a²/4 across a cylinder, a²/5 for an ellipsoid, "
            "with half lengths a less the radius of a sphere",
        ),
    ),
)

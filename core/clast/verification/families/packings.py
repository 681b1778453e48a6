"""Packings: what is regular has the neighbours that crystallography tells."""

from __future__ import annotations

from math import sqrt

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


FAMILY = Family(
    "packings",
    "Regular packings",
    "Around the middle of a ball of spheres on a lattice: how many there are at each distance, and how many of them "
    "are bonded to it. Nothing moves.",
    (
        Case(
            "lattice_shells",
            "shells of neighbours on a lattice",
            "lattice",
            judge_lattice,
            "C. Kittel (2005), Introduction to Solid State Physics, 8th ed., ch. 1: neighbours of the cubic and the "
            "hexagonal lattices",
        ),
    ),
)

"""Random packings in a periodic box: no wall is felt at its faces, and none overlaps another across them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from clast.maths.box import Box
from clast.parts.generator import Site
from clast.scene.bonding import close_pairs
from clast.scene.packing_report import overlaps
from clast_plugins.generators import random_packing
from clast_plugins.generators.random_packing import RandomPacking

EDGES = (5e-3, 5e-3, 6e-3)


def packed(periodic: tuple[bool, bool, bool], **changes: object) -> tuple[np.ndarray, np.ndarray, Box]:
    """Return centres, radii and box of a packing that fills a box."""
    given = {"material": "glass", "primary_diameter": 1e-3, "porosity": 0.42, "box": EDGES, "centre": (9e-3, 0.0, 0.0)}
    half = 0.5 * np.array(EDGES)
    box = Box(np.array([9e-3, 0.0, 0.0]) - half, np.array([9e-3, 0.0, 0.0]) + half, np.array(periodic))
    made = random_packing.generate(RandomPacking(**(given | changes)), Site(Path(), box=box))
    return made.position, made.radius, box


@pytest.mark.parametrize("periodic", [(True, True, True), (True, False, False)])
def test_none_overlaps_another_across_a_face_and_none_sticks_through_a_wall(periodic):
    x, r, box = packed(periodic)
    assert overlaps(x, r, box).largest <= 1e-7
    walls = ~np.array(periodic)
    inside = np.minimum(x - box.lower, box.upper - x)[:, walls]
    assert (inside >= r[:, None] - 1e-12).all()


def test_there_is_no_layer_at_a_periodic_face():
    x, r, box = packed((True, True, True))
    neighbours = np.bincount(close_pairs(x, r, 0.2e-3, box)[0].ravel(), minlength=len(x))
    at_the_face = np.minimum(box.wrapped(x) - box.lower, box.upper - box.wrapped(x)).min(axis=1) < 0.5e-3
    assert at_the_face.sum() > 20
    assert abs(neighbours[at_the_face].mean() / neighbours.mean() - 1.0) < 0.1


def test_a_box_smaller_than_the_domain_has_walls():
    x, r, _ = packed((True, True, True), box=(4.9e-3, 4.9e-3, 5.9e-3), porosity=0.5)
    half = 0.5 * np.array([4.9e-3, 4.9e-3, 5.9e-3])
    assert (np.abs(x - np.array([9e-3, 0.0, 0.0])) <= half - r[:, None] + 1e-12).all()

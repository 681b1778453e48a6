"""Spheres cut by planes and tubes have the volumes of closed forms, and nothing gets lost between cuts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.granular.cut_spheres import below_plane, inside_tube, shell_volumes, slab_volumes, sphere_volumes
from clast.scene.packing_report import cut_sphere_volume

ONE = np.ones(1)
SPHERES = st.lists(st.tuples(st.floats(0.0, 5.0), st.floats(0.05, 1.5), st.floats(0.5, 3.0)), min_size=1, max_size=20)
EDGES = st.lists(st.floats(0.01, 6.0), min_size=1, max_size=8, unique=True)


@pytest.mark.parametrize("height", [0.1, 0.7, 1.3, 2.0])
def test_a_slab_about_the_middle_of_a_sphere_holds_what_the_closed_form_says(height: float) -> None:
    edges = np.array([-9.0, 2.0 - height / 2.0, 2.0 + height / 2.0, 9.0])
    held = slab_volumes(2.0 * ONE, ONE, edges)
    assert held[1] == pytest.approx(cut_sphere_volume(2.0, height), rel=1e-13)
    assert held[0] == pytest.approx(held[2], rel=1e-12)


def test_a_plane_beside_a_sphere_cuts_nothing_off_or_all() -> None:
    assert below_plane(ONE, ONE, -0.1) == 0.0
    assert below_plane(ONE, ONE, 2.1) == pytest.approx(sphere_volumes(ONE))


@pytest.mark.parametrize("hole", [0.05, 0.3, 0.8, 0.99])
def test_what_a_hole_through_a_sphere_leaves_is_a_napkin_ring(hole: float) -> None:
    ring = 4.0 / 3.0 * np.pi * (1.0 - hole**2) ** 1.5
    assert inside_tube(0.0 * ONE, ONE, hole) == pytest.approx(4.0 / 3.0 * np.pi - ring, abs=1e-5)


@pytest.mark.parametrize("distance", [0.02, 0.5, 1.0, 1.4, 2.3])
@pytest.mark.parametrize("tube", [0.2, 1.0, 1.5])
def test_a_sphere_beside_the_axis_holds_the_sum_of_its_heights_over_the_section_of_the_tube(
    distance: float, tube: float
) -> None:
    """Midpoints of 1500 rings by 1500 angles of the tube's section; there the sphere is 2 √(1 − s²) high."""
    out = tube * (np.arange(1500) + 0.5) / 1500
    angle = 2.0 * np.pi * (np.arange(1500) + 0.5) / 1500
    square = out[:, None] ** 2 + distance**2 - 2.0 * distance * np.outer(out, np.cos(angle))
    held = out @ (2.0 * np.sqrt(np.maximum(1.0 - square, 0.0))).sum(axis=1) * tube / 1500 * 2.0 * np.pi / 1500
    assert inside_tube(distance * ONE, ONE, tube)[0] == pytest.approx(held, abs=3e-5)


def test_a_tube_of_a_great_radius_cuts_as_a_plane() -> None:
    assert inside_tube(1e4 * ONE, ONE, 1e4 + 0.3) == pytest.approx(below_plane(0.0 * ONE, ONE, 0.3), rel=1e-3)


@given(SPHERES, EDGES)
def test_slabs_and_shells_hold_together_what_the_spheres_weigh(
    spheres: list[tuple[float, float, float]], edges: list[float]
) -> None:
    place, radius, weight = np.array(spheres).T
    bounds = np.array([0.0, *sorted(edges)])
    whole = pytest.approx(float(weight @ sphere_volumes(radius)), rel=1e-9)
    assert slab_volumes(place, radius, bounds, weight).sum() == whole
    shells = shell_volumes(place, radius, bounds, weight)
    assert shells.sum() == whole
    assert (shells > -1e-9 * shells.sum()).all()

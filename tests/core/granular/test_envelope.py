"""The envelope of a grain is the convex hull of its primaries, for few of them and unequal ones too."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.granular.envelope import hull_volume

SPHERE = 4.0 / 3.0 * np.pi


def test_one_sphere_is_its_own_envelope() -> None:
    assert hull_volume(np.zeros((1, 3)), 2.0 * np.ones(1)) == pytest.approx(8.0 * SPHERE, rel=2e-3)


def test_two_spheres_have_the_envelope_of_a_capsule() -> None:
    centres = np.array([[0.0, 0.0, 0.0], [0.0, 3.0, 0.0]])
    assert hull_volume(centres, np.ones(2)) == pytest.approx(SPHERE + 3.0 * np.pi, rel=2e-3)


def test_spheres_in_a_plane_have_the_envelope_of_a_slab_with_round_edges() -> None:
    centres = np.array([[x, y, 0.0] for x in (0.0, 1.0, 2.0) for y in (0.0, 1.0, 2.0)])
    slab = 2.0 * 4.0 + np.pi * 8.0 / 2.0 + SPHERE
    assert hull_volume(centres, np.ones(9)) == pytest.approx(slab, rel=2e-3)


def test_a_small_sphere_inside_the_hull_of_large_ones_adds_nothing() -> None:
    large = np.array([[x, y, z] for x in (0.0, 2.0) for y in (0.0, 2.0) for z in (0.0, 2.0)])
    alone = hull_volume(large, np.ones(8))
    together = hull_volume(np.vstack([large, [[1.0, 1.0, 1.0]]]), np.array([*np.ones(8), 0.5]))
    assert together == pytest.approx(alone, rel=0.03)
    assert together <= alone


def test_a_grain_that_has_lost_a_primary_has_no_envelope() -> None:
    assert np.isnan(hull_volume(np.array([[0.0, 0.0, 0.0], [np.nan, 0.0, 0.0]]), np.ones(2)))


@given(st.integers(5, 60), st.integers(0, 1000), st.floats(1e-4, 1e3))
def test_an_envelope_grows_with_its_size_and_holds_the_hull_of_the_centres(n: int, seed: int, scale: float) -> None:
    from scipy.spatial import ConvexHull

    centres = np.random.default_rng(seed).normal(size=(n, 3))
    volume = hull_volume(centres, np.ones(n))
    assert volume > ConvexHull(centres).volume + SPHERE
    assert hull_volume(scale * centres + scale, scale * np.ones(n)) == pytest.approx(scale**3 * volume, rel=1e-9)

"""The relaxation gives packings without overlap, always the same ones."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from clast_plugins.generators.packing.relax import Relaxed, relax
from clast_plugins.generators.packing.room import CutBall


def packed_equal(count: int, room: CutBall, seed: int) -> Relaxed:
    return relax(np.ones(count), room, seed, 1e-4)


def nearest_distance(x: np.ndarray) -> float:
    way = x[:, None, :] - x[None, :, :]
    distance = np.sqrt((way**2).sum(axis=2))
    return float(distance[np.triu_indices(len(x), 1)].min(initial=np.inf))


@settings(max_examples=25, deadline=None)
@given(count=st.integers(1, 40), seed=st.integers(0, 2**63), flat=st.booleans())
def test_loose_packings_keep_the_tolerance_inside_the_container(count: int, seed: int, flat: bool) -> None:
    packed = packed_equal(count, CutBall(2.5, 2.0 if flat else np.inf), seed)
    assert packed.overlap <= 1e-4
    assert nearest_distance(packed.position) >= 1 - 1e-4 - 1e-12
    assert np.linalg.norm(packed.position, axis=1).max() <= 2.0 * (1 + 1e-12)
    assert np.abs(packed.position[:, 2]).max() <= (1.5 if flat else np.inf)


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32), half_height=st.floats(0.1, 3.0))
def test_confining_moves_only_what_is_outside_and_does_so_once(seed: int, half_height: float) -> None:
    room, margin = CutBall(2.0, half_height), np.zeros(50)
    points = np.random.default_rng(seed).uniform(-3, 3, (50, 3))
    inside = (np.linalg.norm(points, axis=1) <= 2.0) & (np.abs(points[:, 2]) <= half_height)
    moved = room.confine(points, margin)
    np.testing.assert_array_equal(moved[inside], points[inside])
    np.testing.assert_allclose(room.confine(moved, margin), moved, rtol=1e-15)


def test_random_centres_fill_the_container_evenly() -> None:
    points = CutBall(2.5).random(np.random.Philox(3), 20_000, 0.5)
    share_in_half_the_volume = np.mean(np.linalg.norm(points, axis=1) < 2.0 * 0.5 ** (1 / 3))
    assert abs(share_in_half_the_volume - 0.5) < 0.02
    assert np.abs(points.mean(axis=0)).max() < 0.05


def test_a_seed_starts_from_the_same_points_for_ever() -> None:
    points = CutBall(1.0).random(np.random.Philox(1), 2, 0.0)
    expected = [
        [0.6131133882699074, -0.5097883951590014, -0.39873002097390753],
        [-0.2808836380681894, -0.07181898719013269, 0.10524616],
    ]
    np.testing.assert_allclose(points, expected, atol=1e-8)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**63), smallest=st.floats(0.2, 1.0))
def test_spheres_of_different_sizes_do_not_overlap_and_lie_wholly_inside(seed: int, smallest: float) -> None:
    diameter = np.linspace(smallest, 1.5, 30)
    packed = relax(diameter, CutBall(2.5, 2.2), seed, 1e-4)
    reach = 0.5 * (diameter[:, None] + diameter)
    gap = np.linalg.norm(packed.position[:, None] - packed.position, axis=2) - reach + 9.0 * np.eye(30)
    assert gap.min() >= -1e-4 - 1e-12
    assert -gap.min() <= packed.overlap + 1e-12
    assert (np.linalg.norm(packed.position, axis=1) + 0.5 * diameter).max() <= 2.5 * (1 + 1e-12)
    assert (np.abs(packed.position[:, 2]) + 0.5 * diameter).max() <= 2.2 * (1 + 1e-12)


def test_other_seeds_give_other_packings() -> None:
    one, two = (packed_equal(30, CutBall(2.5), seed).position for seed in (1, 2))
    assert np.abs(one - two).max() > 0.1


def test_an_impossible_packing_returns_its_best_and_the_overlap_left() -> None:
    packed = packed_equal(3, CutBall(1.1), 1)
    # three spheres of diameter 1 on a circle of radius 0.6 have their centres 0.6·√3 apart: they fit
    assert packed.overlap <= 1e-4
    crowded = packed_equal(6, CutBall(1.1), 1)
    assert crowded.overlap > 0.1
    assert abs(1 - nearest_distance(crowded.position) - crowded.overlap) < 1e-12


def test_spheres_without_room_to_move_end_with_full_overlap() -> None:
    assert packed_equal(1, CutBall(0.5), 1).overlap == 0.0
    assert packed_equal(2, CutBall(0.5), 1).overlap == 1.0


def test_a_seed_gives_the_same_bytes_in_every_process_and_on_any_number_of_threads() -> None:
    script = (
        "import hashlib\n"
        "import numpy as np\n"
        "from clast_plugins.generators.packing.relax import relax\n"
        "from clast_plugins.generators.packing.room import CutBall\n"
        "print(hashlib.sha256(relax(np.ones(150), CutBall(3.4), 7, 1e-4).position.tobytes()).hexdigest())\n"
    )
    threads = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
    digests = {
        subprocess.run(
            [sys.executable, "-c", script],
            env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)} | dict.fromkeys(threads, number),
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for number in ("1", "2")
    }
    assert len(digests) == 1

"""Runaways: lists mended for those that outran them hold what they must, and no bit of a run depends on it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast import load
from clast.config.scene import SceneConfig, from_mapping
from clast.engine import chunks, histories, runaways
from clast.engine.kernels.layout import FIRST, RADIUS, X
from clast.results import checkpoint
from clast.simulation import Simulation
from tests.scenes import CRUSH, write

GLASS = {"glass": {"density": 2500, "young_modulus": 5e7, "poisson_ratio": 0.2}}
SOME, NONE = {"BASE": 0.0, "EACH": 0.03}, {"BASE": np.inf}
DOMAIN = {"lower": [0, 0, 0], "upper": [12e-3] * 3, "periodic": ["x", "y"]}


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chunks, "SIZE", 24)
    monkeypatch.setattr(chunks, "LARGE", 40)


def crowd(seed: int) -> list[dict[str, Any]]:
    """Return 125 spheres of two sizes that fly about, most of them slowly."""
    draw = np.random.default_rng(seed)
    places = (np.stack(np.meshgrid(*[range(5)] * 3, indexing="ij"), axis=-1).reshape(-1, 3) + 0.5) * 2.4e-3
    speed = 0.02 * draw.exponential(1.0, 125) ** 2
    return [
        {"position": x.tolist(), "radius": r, "velocity": (v * way).tolist()}
        for x, r, v, way in zip(
            places, draw.choice([0.8e-3, 1.1e-3], 125), speed, draw.normal(size=(125, 3)), strict=True
        )
    ]


def gas(seed: int = 1, **sections: Any) -> SceneConfig:
    """Return a gas in a box that is periodic along x and y and has walls across z, which stick a little."""
    return from_mapping(
        {
            "materials": GLASS,
            "particles": {"type": "explicit", "material": "glass", "particles": crowd(seed)},
            "contacts": {
                "law": {"type": "jkr", "work_of_adhesion": 1e-3},
                "pairs": {"default": {"restitution": 0.9, "sliding_friction": 0.5}},
            },
            "walls": {
                "lower": {"type": "plane", "material": "glass", "point": [0, 0, 0], "normal": [0, 0, 1]},
                "upper": {"type": "plane", "material": "glass", "point": [0, 0, 12e-3], "normal": [0, 0, -1]},
            },
            "boundaries": {"domain": DOMAIN},
            "neighbours": {"skin": "0.1 mm"},
            "time": {"step": "5 us", "end": {"time": "20 ms"}},
            "output": {"ledger": True, "writers": []},
        }
        | sections
    )


def drum() -> SceneConfig:
    """Return spheres that fall about in a drum with lifters."""
    shrunk = {"particles.primaries": 100, "time.end.time": "0.1 s", "output.ledger": True, "neighbours.skin": "0.2 mm"}
    return load(Path("configs/parts/motion/rotation.yaml")).changed(shrunk)


def grain(folder: Path) -> SceneConfig:
    """Return a grain that is crushed so fast that its pieces fly about."""
    return load(write(folder, CRUSH), ["walls.upper.motion.velocity=[0, 0, -0.3]", "neighbours.skin=4 um"])


def advanced(monkeypatch: pytest.MonkeyPatch, scene: SceneConfig, rule: dict[str, float], steps: int) -> Simulation:
    """Return a scene after some steps on two threads, mended by a rule."""
    for name, value in rule.items():
        monkeypatch.setattr(runaways, name, value)
    simulation = Simulation(scene, 2)
    simulation.advance_to(steps)
    return simulation


def assert_same(one: Simulation, other: Simulation) -> None:
    for name in ("pose", "twist", "acceleration"):
        first, second = (getattr(each.world.particles, name) for each in (one, other))
        np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(one.world.bonds.data, other.world.bonds.data)
    assert one.ledger() == other.ledger()


@pytest.mark.parametrize(
    ("scene", "steps"),
    [
        pytest.param(lambda _: gas(), 4000, id="gas in a periodic box"),
        pytest.param(lambda _: drum(), 4000, id="drum", marks=pytest.mark.long),
        pytest.param(grain, 5000, id="grain"),
    ],
)
def test_no_bit_depends_on_who_is_looked_at(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, scene: Callable[[Path], SceneConfig], steps: int
) -> None:
    anew = advanced(monkeypatch, scene(tmp_path), NONE, steps)
    mended = advanced(monkeypatch, scene(tmp_path), SOME, steps)
    assert len(mended.world.chunks) > 2
    assert anew.lists.mended == 0
    assert mended.lists.mended > mended.lists.made > 1
    assert mended.lists.made < anew.lists.made
    assert_same(anew, mended)


def listed(simulation: Simulation) -> set[tuple[int, int]]:
    pairs = simulation.world.pairs
    mine = (pairs.sides & FIRST) != 0
    return set(zip(pairs.first[mine].tolist(), pairs.second[mine].tolist(), strict=True))


def can_meet(simulation: Simulation) -> set[tuple[int, int]]:
    """Return all pairs that can come to hold while each goes its way from where it was looked at last."""
    particles = simulation.world.particles
    place = particles.reference[:, :3]
    reach = particles.pose[:, RADIUS] + np.sqrt(particles.reference[:, 3]) + 0.5 * simulation.lists.reach
    i, j = np.triu_indices(len(place), 1)
    way = simulation.box.nearest(place[j] - place[i])
    near = np.linalg.norm(way, axis=1) < reach[i] + reach[j]
    return set(zip(i[near].tolist(), j[near].tolist(), strict=True))


@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), steps=st.integers(100, 1500))
def test_mended_lists_are_those_that_would_be_made(seed: int, steps: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        simulation = advanced(patch, gas(seed, neighbours={"skin": "0.4 mm"}), SOME, steps)
    assert simulation.lists.mended > 0
    assert listed(simulation) == can_meet(simulation)
    rows = simulation.world.pairs
    for c in range(len(rows.end)):
        here = slice(rows.begin[c], rows.end[c])
        keys = histories.key(rows.first[here], rows.second[here])
        assert (np.diff(keys) > 0).all()
        assert (rows.sides[here] > 0).all()
        assert not rows.sides[rows.end[c] : rows.begin[c + 1]].any()
        assert not rows.touching[rows.end[c] : rows.begin[c + 1]].any()


def test_where_there_is_no_room_lists_are_made_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    anew = advanced(monkeypatch, gas(), NONE, 2000)
    monkeypatch.setattr(histories, "ROOM", 1)
    monkeypatch.setattr(histories, "ROOM_SHARE", 10**9)
    narrow = advanced(monkeypatch, gas(), SOME, 2000)
    assert narrow.lists.mended > 0
    assert narrow.lists.made > 3
    assert_same(anew, narrow)


def test_a_mended_run_resumes_with_the_same_bits(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    whole = advanced(monkeypatch, gas(), SOME, 1500)
    checkpoint.save(tmp_path, whole, {})
    resumed = Simulation(gas(), 1)
    checkpoint.load(tmp_path, resumed)
    for each in (whole, resumed):
        each.advance_to(3000)
    assert_same(whole, resumed)
    assert (whole.lists.made, whole.lists.mended, whole.lists.spent) == (
        resumed.lists.made,
        resumed.lists.mended,
        resumed.lists.spent,
    )
    np.testing.assert_array_equal(whole.world.pairs.first, resumed.world.pairs.first)


def test_nobody_meets_a_particle_that_left(monkeypatch: pytest.MonkeyPatch) -> None:
    leaving = gas(boundaries={"domain": DOMAIN | {"upper": [12e-3, 12e-3, 11e-3]}}, walls={})
    anew, mended = (advanced(monkeypatch, leaving, rule, 4000) for rule in (NONE, SOME))
    assert mended.removed > 10
    assert mended.lists.mended > 0
    gone = np.flatnonzero(mended.world.particles.present == 0)
    assert not np.isin(np.array(sorted(listed(mended))), gone).any()
    assert mended.removed == anew.removed
    assert_same(anew, mended)


def test_places_of_runaways_are_asked_of_stale_chunks_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    world = advanced(monkeypatch, gas(), SOME, 10).world
    world.particles.pose[[3, 90], X] += 1e-3
    stale = np.zeros_like(world.stale)
    stale[0] = 1
    assert runaways.runaways(world.particles, world.chunks, stale).tolist() == [3]

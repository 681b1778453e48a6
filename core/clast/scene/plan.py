"""From scene to blueprint and world: which parts are compiled, and the numbers they run on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.config.beside import WallChoice
from clast.config.choice import Chosen
from clast.engine.blueprint import Blueprint, BondPlan, ContactPlan
from clast.engine.chunks import cut
from clast.engine.kernels.layout import BOND_SCRATCH, CONTACT_FREE, LANES, TERMS
from clast.engine.records import fields, leaves, numbers, width
from clast.engine.state import Bonds, Floats, Indices, Numbers, Pairs, Walls, World
from clast.engine.tables import (
    bond_table,
    crack_table,
    empty_pairs,
    empty_wall_pairs,
    no_bonds,
    particle_tables,
)
from clast.parts.bond_model import Stiffness
from clast.parts.contact_law import Features, MaterialPair
from clast.scene.scene import Scene


def blueprint(scene: Scene) -> Blueprint:
    """Return what must be compiled for a scene."""
    config = scene.config
    return Blueprint(
        integrator=config.integrator.part,
        bonds=_bond_plan(scene),
        contacts=_contact_plan(scene),
        walls=_distinct(wall.shape for wall in config.walls.values()),
        motions=_distinct(wall.motion for wall in config.walls.values() if wall.motion is not None),
        body_forces=tuple(chosen.part for chosen in config.body_forces),
        applied_loads=len(_applied_loads(scene)) > 0,
        ledger=config.output.ledger,
        chunked=len(cut(len(scene.radius), scene.ends)) > 2,
    )


def _distinct(chosen: Iterable[Chosen]) -> tuple[Any, ...]:
    return tuple({each.name: each.part for each in chosen}.values())


def _bond_plan(scene: Scene) -> BondPlan | None:
    config = scene.config.bonds
    if config is None or len(scene.ends) == 0:
        return None
    record = config.model.part.constants(config.model.params, scene.bond_geometry)
    uniform = [
        np.ndim(v) < (1 if f.size == 1 else 2)
        for f, v in zip(fields(type(record)), leaves(record), strict=True)
        for _ in range(f.size)
    ]
    return BondPlan(
        config.model.part, config.kinematics.part, tuple(uniform), config.damping > 0.0, config.fade_steps > 0
    )


def _contact_plan(scene: Scene) -> ContactPlan | None:
    config = scene.config.contacts
    if config is None:
        return None
    pairs = [pair for _, _, pair in material_pairs(scene)]
    features = Features(
        damping=any(pair.restitution < 1.0 for pair in pairs),
        sliding=any(pair.sliding_friction > 0.0 for pair in pairs),
        rolling=any(pair.rolling_friction > 0.0 for pair in pairs),
    )
    return ContactPlan(
        law=config.law.part,
        features=features,
        choices=config.law.part.choices(config.law.params, features),
        bonded_pairs=config.bonded_pairs,
        between_particles=len(scene.radius) > 1,
        one_material=len(set(scene.material.tolist())) == 1,
        rests=bool(scene.relieved.any()),
    )


def material_pairs(scene: Scene) -> list[tuple[int, int, MaterialPair]]:
    """Return every pair of materials that can touch in a scene, by index, particle first.

    Raises
    ------
    ConfigError
        If the contact settings lack such a pair.
    """
    config = scene.config
    assert config.contacts is not None
    names = list(config.materials)
    particles = sorted({int(k) for k in scene.material})
    walls = sorted({names.index(wall.material) for wall in config.walls.values()})
    found = []
    for i in particles:
        for j in sorted({*walls, *(particles if len(scene.radius) > 1 else ())}):
            a, b = config.materials[names[i]], config.materials[names[j]]
            settings = config.contacts.pair(names[i], names[j])
            if settings is None:
                raise config.problem(
                    ("contacts", "pairs"),
                    f"{names[i]} and {names[j]} can touch but have no settings; add '{names[i]}-{names[j]}' or "
                    "'default'",
                )
            pair = MaterialPair(
                a.young_modulus,
                a.poisson_ratio,
                b.young_modulus,
                b.poisson_ratio,
                settings.restitution,
                settings.sliding_friction,
                settings.rolling_friction,
            )
            found.append((i, j, pair))
    return found


def build_world(scene: Scene, plan: Blueprint, dt: float, skin: float) -> World:
    """Return the tables of a scene at its start, neighbour lists still empty."""
    chunks = cut(len(scene.radius), scene.ends)
    bonds, uniforms = _bonds(scene, plan, chunks)
    return World(
        particles=particle_tables(
            scene.position,
            scene.radius,
            scene.mass,
            scene.velocity,
            scene.spin,
            scene.material,
            scene.prescribed,
            weights(scene),
            _applied_loads(scene),
        ),
        bonds=bonds,
        pairs=empty_pairs(chunks, plan.remembered),
        wall_pairs=empty_wall_pairs(plan.remembered),
        walls=_walls(scene, plan),
        cracks=crack_table(chunks, scene.ends),
        numbers=_numbers(scene, plan, uniforms, dt, skin),
        clock=np.zeros(4, np.int64),
        chunks=chunks,
        stale=np.zeros(len(chunks), np.uint8),
        scratch=np.zeros((len(chunks) - 1, _scratch_slots(plan) * LANES)),
        ledger=np.zeros((len(chunks), TERMS)),
    )


def _applied_loads(scene: Scene) -> Floats:
    """Return the constant force and torque on each particle, (n, 6); no rows where none acts."""
    loads = np.column_stack([scene.force, scene.torque])
    return loads if loads.any() else loads[:0]


def weights(scene: Scene) -> Floats:
    """Return the share of its mass that body forces act on, (n,): below 1 where a particle was made heavier."""
    if scene.config.time.selective_mass_scaling is None:
        return np.ones(len(scene.radius))
    return scene.true_mass * scene.config.time.mass_scaling / scene.mass


def _scratch_slots(plan: Blueprint) -> int:
    if plan.contacts is None:
        return BOND_SCRATCH
    return max(BOND_SCRATCH, CONTACT_FREE + width(plan.contacts.law.Constants) + width(plan.history) + 1)


def _numbers(scene: Scene, plan: Blueprint, uniforms: Floats, dt: float, skin: float) -> Numbers:
    config = scene.config
    body = [
        value
        for chosen in config.body_forces
        for value in numbers(chosen.part.numbers(chosen.params, config.time.mass_scaling))
    ]
    seed = getattr(config.bonds.model.params, "seed", 0) if config.bonds else 0
    return Numbers(
        bond_uniforms=uniforms,
        contact_table=_contact_table(scene, plan),
        body=np.array(body, float),
        dt=dt,
        seed=int(seed),
        wall_reach2=(0.5 * skin) ** 2,
        lever=0.0 if config.contacts and config.contacts.lever == "radius" else 1.0,
        start_kick=float(config.integrator.part.start_kick(config.integrator.params)),
        fade=1.0 / (1 + (config.bonds.fade_steps if config.bonds else 0)),
        first_step=0,
        first_time=0.0,
        late=0.0,
    )


def _bonds(scene: Scene, plan: Blueprint, chunks: Indices) -> tuple[Bonds, Floats]:
    config = scene.config.bonds
    if plan.bonds is None or config is None:
        return no_bonds(chunks), np.zeros(0)
    d, kinematics = scene.bond_vectors, plan.bonds.kinematics
    constants = config.model.part.constants(config.model.params, scene.bond_geometry)
    start = kinematics.start(d, scene.length) if kinematics.start is not None else None
    damping = damping_coefficients(scene) if plan.bonds.damping else np.zeros((len(d), 4))
    reference = kinematics.reference(d, scene.length)
    table = bond_table(plan.bonds, chunks, scene.ends, reference, constants, start, damping)
    shared = [
        np.ravel(v)
        for f, v in zip(fields(type(constants)), leaves(constants), strict=True)
        if np.ndim(v) < (1 if f.size == 1 else 2)
    ]
    return table, np.concatenate([*shared, np.zeros(0)]).astype(float)


def bond_stiffness(scene: Scene) -> Stiffness:
    """Return the elastic stiffness of every bond of a scene that has bonds."""
    assert scene.config.bonds is not None
    model = scene.config.bonds.model
    found: Stiffness = model.part.stiffness(model.params, scene.bond_geometry)
    return found


def damping_coefficients(scene: Scene) -> NDArray[np.float64]:
    """Return the dashpots 2 ζ √(k m*) of every bond, (m, 4): stretch, shear, twist, bending."""
    assert scene.config.bonds is not None
    i, j = scene.ends.T
    inertia = 0.4 * scene.mass * scene.radius**2
    reduced_mass = scene.mass[i] * scene.mass[j] / (scene.mass[i] + scene.mass[j])
    reduced_inertia = inertia[i] * inertia[j] / (inertia[i] + inertia[j])
    k = bond_stiffness(scene)
    pairs = [
        (k.axial, reduced_mass),
        (k.shear, reduced_mass),
        (k.torsion, reduced_inertia),
        (k.bending, reduced_inertia),
    ]
    return np.column_stack([2.0 * scene.config.bonds.damping * np.sqrt(a * b) for a, b in pairs])


def _contact_table(scene: Scene, plan: Blueprint) -> Floats:
    count = len(scene.config.materials)
    if plan.contacts is None or scene.config.contacts is None:
        return np.zeros((count, count, 0))
    law, chosen = plan.contacts.law, scene.config.contacts.law
    table = np.zeros((count, count, width(law.Constants)))
    for i, j, pair in material_pairs(scene):
        row = numbers(law.constants(chosen.params, pair))
        table[i, j] = row
        table[j, i] = row
    return table


def relieve(scene: Scene, pairs: Pairs) -> None:
    """Let the overlaps that relieved particles start with count as undeformed."""
    i, j = pairs.first.astype(np.int64), pairs.second.astype(np.int64)
    distance = np.linalg.norm(scene.position[i] - scene.position[j], axis=1)
    overlap = np.maximum(scene.radius[i] + scene.radius[j] - distance, 0.0)
    pairs.rest[:] = np.where(scene.relieved[i] & scene.relieved[j], overlap, 0.0)


def wall_shapes(scene: Scene) -> list[tuple[Any, Any]]:
    """Return the nearest-point function and the numbers of each wall's shape."""
    walls = scene.config.walls.values()
    return [(wall.shape.part.nearest, wall.shape.part.shape(wall.shape.params)) for wall in walls]


def _walls(scene: Scene, plan: Blueprint) -> Walls:
    chosen = list(scene.config.walls.values())
    names = list(scene.config.materials)
    shapes = [numbers(shape) for _, shape in wall_shapes(scene)]
    courses = [numbers(w.motion.part.course(w.motion.params)) if w.motion else [] for w in chosen]
    centres = [wall.shape.part.centre(wall.shape.params) for wall in chosen]
    still = [np.zeros((len(chosen), 3)) for _ in range(7)]
    return Walls(
        np.array([plan.walls.index(wall.shape.part) for wall in chosen], np.int64),
        _table(shapes),
        np.array([_motion_kind(plan, wall) for wall in chosen], np.int64),
        _table(courses),
        np.array([names.index(wall.material) for wall in chosen], np.int64),
        np.array(centres, float).reshape(-1, 3),
        *still,
    )


def _motion_kind(plan: Blueprint, wall: WallChoice) -> int:
    return len(plan.motions) if wall.motion is None else plan.motions.index(wall.motion.part)


def _table(rows: list[list[float]]) -> Floats:
    table = np.zeros((len(rows), max([0, *map(len, rows)])))
    for k, row in enumerate(rows):
        table[k, : len(row)] = row
    return table

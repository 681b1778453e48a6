"""World: the tables that a scene runs on, at its start."""

from __future__ import annotations

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.cache_lines import on_line, on_lines
from clast.engine.chunks import cut
from clast.engine.kernels.layout import (
    BOND_SCRATCH,
    CLOCK,
    CONTACT_FREE,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LANES,
    RADIUS,
    TERMS,
    WALL_Q,
)
from clast.engine.records import fields, leaves, numbers
from clast.engine.state import Bonds, Floats, Indices, Integers, Numbers, Pairs, Particles, Walls, World
from clast.engine.tables import (
    bond_table,
    crack_table,
    empty_pairs,
    empty_wall_pairs,
    no_bonds,
    particle_tables,
    repeated,
)
from clast.scene.plan import applied_loads, bond_constants, damping_coefficients, material_pairs, wall_answers
from clast.scene.scene import Scene, is_logarithmic, strain_rates
from clast.scene.wall_rows import padded, wall_rows

SUMMED = ("force", "moment", "force_sum", "moment_sum")
"""What acts on walls."""


def build_world(scene: Scene, plan: Blueprint, dt: float, skin: float) -> World:
    """Return the tables of a scene at its start, neighbour lists still empty."""
    chunks = cut(len(scene.radius), scene.ends)
    bonds, uniforms = _bonds(scene, plan, chunks)
    particles = particle_tables(
        scene.position,
        scene.radius,
        scene.mass,
        scene.velocity,
        scene.spin,
        scene.material,
        scene.prescribed,
        weights(scene),
        applied_loads(scene),
    )
    particles = repeated(particles, scene.box, strain_rates(scene.config), is_logarithmic(scene.config))
    return World(
        particles=on_lines(particles),
        bonds=on_lines(bonds),
        pairs=empty_pairs(chunks, plan.remembered),
        wall_pairs=empty_wall_pairs(plan.remembered),
        walls=_walls(scene, plan),
        cracks=crack_table(chunks, scene.ends),
        numbers=_numbers(scene, plan, uniforms, particles, dt, skin),
        clock=np.zeros(CLOCK, np.int64),
        chunks=chunks,
        stale=np.zeros(len(chunks), np.uint8),
        scratch=on_line(np.zeros((len(chunks) - 1, _scratch_slots(plan) * LANES))),
        ledger=np.zeros((len(chunks), TERMS)),
    )


def weights(scene: Scene) -> Floats:
    """Return the share of its mass that body forces act on, (n,): below 1 where a particle was made heavier."""
    if scene.config.time.selective_mass_scaling is None:
        return np.ones(len(scene.radius))
    return scene.true_mass * scene.config.time.mass_scaling / scene.mass


def _scratch_slots(plan: Blueprint) -> int:
    if plan.contacts is None:
        return BOND_SCRATCH
    return max(BOND_SCRATCH, CONTACT_FREE + plan.contacts.constants + plan.history + 1)


def _numbers(scene: Scene, plan: Blueprint, uniforms: Floats, particles: Particles, dt: float, skin: float) -> Numbers:
    config = scene.config
    body = [
        value
        for chosen in config.body_forces
        for value in numbers(chosen.part.numbers(chosen.params, config.time.mass_scaling))
    ]
    seed = getattr(config.bonds.model.params, "seed", 0) if config.bonds else 0
    damping = config.damping
    return Numbers(
        bond_uniforms=uniforms,
        contact_table=_contact_table(scene, plan),
        body=np.array(body, float),
        braking=np.array(numbers(damping.part.numbers(damping.params)) if damping is not None else [], float),
        dt=dt,
        seed=int(seed),
        wall_reach2=(0.5 * skin) ** 2,
        radius=float(particles.pose[0, RADIUS]),
        inverse_mass=float(particles.body[0, INVERSE_MASS]),
        inverse_inertia=float(particles.body[0, INVERSE_INERTIA]),
        lever=0.0 if config.contacts and config.contacts.lever == "radius" else 1.0,
        start_kick=float(config.integrator.part.start_kick(config.integrator.params)),
        fade=1.0 / (1 + (config.bonds.fade_steps if config.bonds else 0)),
        first_step=0,
        first_time=0.0,
        mass=float(scene.mass.sum()),
        late=0.0,
        early=0.0,
    )


def _bonds(scene: Scene, plan: Blueprint, chunks: Indices) -> tuple[Bonds, Floats]:
    config = scene.config.bonds
    if plan.bonds is None or config is None:
        return no_bonds(chunks), np.zeros(0)
    d, kinematics = scene.bond_vectors, plan.bonds.kinematics
    constants = bond_constants(scene)
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


def _contact_table(scene: Scene, plan: Blueprint) -> Floats:
    count = len(scene.config.materials)
    if plan.contacts is None or scene.config.contacts is None:
        return np.zeros((count, count, 0))
    config, rolling = scene.config.contacts, plan.contacts.rolling
    table = np.zeros((count, count, plan.contacts.constants))
    for i, j, pair in material_pairs(scene):
        row = numbers(plan.contacts.law.constants(config.law.params, pair))
        row += numbers(rolling.constants(config.rolling.params, pair)) if rolling is not None else []
        table[i, j] = row
        table[j, i] = row
    return table


def relieve(scene: Scene, pairs: Pairs) -> None:
    """Let the overlaps that relieved particles start with count as undeformed, until they have been wholly apart."""
    pairs.rest[:] = overlaps_at_rest(scene, np.column_stack([pairs.first, pairs.second]).astype(np.int64))


def overlaps_at_rest(scene: Scene, pairs: Integers) -> Floats:
    """Return the overlaps up to which pairs (p, 2) do not push at the start, (p,) in m."""
    i, j = pairs.T
    distance = np.linalg.norm(scene.ways(pairs), axis=1)
    overlap = np.maximum(scene.radius[i] + scene.radius[j] - distance, 0.0)
    return np.asarray(np.where(scene.relieved[i] & scene.relieved[j], overlap, 0.0))


def _walls(scene: Scene, plan: Blueprint) -> Walls:
    chosen = list(scene.config.walls.values())
    names = list(scene.config.materials)
    rows = wall_rows(scene, plan)
    centres = [wall.pivot or wall.shape.part.centre(wall.shape.params) for wall in chosen]
    pose = np.zeros((len(chosen), 7 if plan.walls_turn else 3))
    pose[:, WALL_Q : WALL_Q + 1] = 1.0
    slots = np.array([wall.shape.part.slots(wall.shape.params) for wall in chosen], np.int64)
    return Walls(
        shape_kind=np.array([plan.walls.index(wall.shape.part) for wall in chosen], np.int64),
        shape=rows.shapes,
        motion_kind=np.array([courses[0].kind for courses in rows.courses], np.int64),
        course=padded([courses[0].row for courses in rows.courses], rows.width),
        material=np.array([names.index(wall.material) for wall in chosen], np.int64),
        centre=np.array(centres, float).reshape(-1, 3),
        lists=rows.lists,
        stage=np.zeros((len(chosen), 2), np.int64),
        answers=np.array([wall_answers(wall) for wall in chosen], np.uint8),
        pushes=np.zeros(len(chosen), np.int64),
        slots=slots,
        places=np.zeros((2 * int(slots.max(initial=1)) + 1, 4)),
        crowded=np.zeros(len(slots), np.uint8),
        pose=pose,
        twist=np.zeros((len(chosen), 6 if plan.walls_turn else 3)),
        reference=np.zeros((len(chosen), 5 if plan.walls_turn else 3)),
        **{name: np.zeros((len(chosen), 3)) for name in SUMMED},
        **{name: np.zeros(len(chosen)) for name in ("pressing", "pressing_sum", "begun")},
    )

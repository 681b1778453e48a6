"""Plan: which parts of a scene are compiled, and what they say of its bonds, contacts and walls."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.config.beside import WallChoice
from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.engine.blueprint import Blueprint, BondPlan, ContactPlan
from clast.engine.chunks import cut
from clast.engine.records import fields, leaves
from clast.engine.state import Floats
from clast.parts.bond_model import Stiffness
from clast.parts.contact_law import Features, MaterialPair
from clast.scene.scatter import DASHPOTS, STIFFNESS, Form, form_of_constants, of_each_bond, scatter_entries
from clast.scene.scene import Scene, strain_rates
from clast.scene.turning import arm


def blueprint(scene: Scene) -> Blueprint:
    """Return what must be compiled for a scene.

    Raises
    ------
    ConfigError
        Energies shall be booked that the integrator does not let one book, or all particles be steered between its
        evaluations of forces.
    """
    config = scene.config
    refuse_ledger(config)
    refuse_steering(config)
    return Blueprint(
        integrator=config.integrator.part,
        bonds=_bond_plan(scene),
        contacts=_contact_plan(scene),
        walls=distinct(wall.shape for wall in config.walls.values()),
        motions=distinct(stage.motion for wall in config.walls.values() for stage in wall.stages),
        body_forces=tuple(chosen.part for chosen in config.body_forces),
        applied_loads=len(applied_loads(scene)) > 0,
        ledger=config.output.ledger,
        chunked=len(cut(len(scene.radius), scene.ends)) > 2,
        periodic=scene.box.repeats,
        stretches=bool(strain_rates(config).any()),
        damping=config.damping.part if config.damping is not None else None,
        step_share=step_share(scene),
        curved_walls=not all(wall.flat for wall in config.walls.values()),
    )


def refuse_ledger(config: SceneConfig) -> None:
    """Refuse an energy ledger with an integrator that evaluates forces several times a step.

    What forces do along a way that goes back and forth is no sum over evaluations that would close.

    Raises
    ------
    ConfigError
    """
    if config.output.ledger and len(config.integrator.part.stages) > 1:
        raise config.problem(
            ("output", "ledger"),
            f"the integrator {config.integrator.name!r} evaluates forces {len(config.integrator.part.stages)} times a "
            "step, and energies can be booked only where it is once; take another integrator, or ledger: false",
        )


def refuse_steering(config: SceneConfig) -> None:
    """Refuse a damping that steers all particles with an integrator that evaluates forces several times a step.

    Such a scheme goes back and forth within a step: work at one of its evaluations does not tell which way it leads.

    Raises
    ------
    ConfigError
    """
    damping, stages = config.damping, len(config.integrator.part.stages)
    if damping is not None and damping.part.steering is not None and stages > 1:
        raise config.problem(
            ("damping",),
            f"{damping.name!r} steers all particles once a step, and the integrator {config.integrator.name!r} "
            f"evaluates forces {stages} times; take another integrator, or the damping 'local'",
        )


def step_share(scene: Scene) -> float:
    """Return the share of the stable step that the damping of motion and walls that give way leave."""
    damping = scene.config.damping
    return (1.0 if damping is None else float(damping.part.step_share(damping.params))) * share_of_walls(scene)


def share_of_walls(scene: Scene) -> float:
    """Return the share of the stable step that walls leave, if all particles touch them and they give way."""
    mass, share = float(scene.mass.sum()), 1.0
    for wall in scene.config.walls.values():
        share *= min([1.0, *(_share_left(stage.motion, mass, arm(wall)) for stage in wall.stages)])
    return share


def giving_way(wall: WallChoice) -> float:
    """Return how much a wall gives way to a push, wherever that is, as the inverse of a mass in 1/kg; 0 at rest."""
    share = min([1.0, *(_share_left(stage.motion, 1.0, arm(wall)) for stage in wall.stages)])
    return 1.0 / share**2 - 1.0  # of the step with a particle of 1 kg


def wall_answers(wall: WallChoice) -> bool:
    """Tell whether forces move a wall at some stage, so that it touches particles too that nothing moves."""
    return any(stage.motion.part.inverse_mass is not None for stage in wall.stages)


def _share_left(motion: Chosen, mass: float, reach: float) -> float:
    part = motion.part
    return 1.0 if part.step_share is None else float(part.step_share(part.course(motion.params), mass, reach))


def distinct(chosen: Iterable[Chosen]) -> tuple[Any, ...]:
    """Return the parts that are chosen, each once, in the order of their first choice."""
    return tuple({each.name: each.part for each in chosen}.values())


def _bond_plan(scene: Scene) -> BondPlan | None:
    config = scene.config.bonds
    if config is None or len(scene.ends) == 0:
        return None
    record = bond_constants(scene)
    uniform = [
        np.ndim(v) < (1 if f.size == 1 else 2)
        for f, v in zip(fields(type(record)), leaves(record), strict=True)
        for _ in range(f.size)
    ]
    damping = config.damping > 0.0 or config.model.part.dashpots is not None
    return BondPlan(
        config.model.part,
        config.kinematics.part,
        tuple(uniform),
        damping,
        fade=config.fade_steps > 0,
        books=damping and scene.config.output.ledger,
    )


def _contact_plan(scene: Scene) -> ContactPlan | None:
    config = scene.config.contacts
    if config is None:
        return None
    pairs = [pair for _, _, pair in material_pairs(scene)]
    own_damping = config.law.part.damping
    features = Features(
        damping=own_damping(config.law.params) if own_damping else any(pair.restitution < 1.0 for pair in pairs),
        sliding=any(pair.sliding_friction > 0.0 for pair in pairs),
        rolling=any(pair.rolling_friction > 0.0 for pair in pairs),
    )
    rolls = features.rolling and config.law.part.limits_rolling
    return ContactPlan(
        law=config.law.part,
        features=features,
        choices=config.law.part.choices(config.law.params, features),
        rolling=config.rolling.part if rolls else None,
        rolling_choices=config.rolling.part.choices(config.rolling.params) if rolls else None,
        bonded_pairs=config.bonded_pairs,
        between_particles=len(scene.radius) > 1,
        one_material=len(set(scene.material.tolist())) == 1,
        one_size=_one_size(scene),
        rests=bool(scene.relieved.any()),
    )


def _one_size(scene: Scene) -> bool:
    """Tell whether every particle has the same radius and mass; driven ones count as infinitely heavy."""
    return len(np.unique(scene.radius)) == len(np.unique(scene.mass)) == 1 and not scene.prescribed.any()


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


def largest_reach(scene: Scene) -> float:
    """Return how far beyond touch any contact of a scene can hold, in m; 0 where contacts end as they begin."""
    contacts = scene.config.contacts
    if contacts is None or contacts.law.part.reach is None:
        return 0.0
    law, largest = contacts.law, float(scene.radius.max())
    pairs = material_pairs(scene)
    return max(float(law.part.reach(law.part.constants(law.params, pair), largest)) for _, _, pair in pairs)


def applied_loads(scene: Scene) -> Floats:
    """Return the constant force and torque on each particle, (n, 6); no rows where none acts."""
    loads = np.column_stack([scene.force, scene.torque])
    return loads if loads.any() else loads[:0]


def bond_stiffness(scene: Scene) -> Stiffness:
    """Return the elastic stiffness of every bond of a scene that has bonds."""
    assert scene.config.bonds is not None
    found: Stiffness = _of_each_bond(scene, scene.config.bonds.model.part.stiffness, STIFFNESS)
    return found


def bond_constants(scene: Scene) -> Any:
    """Return the constants of the bond model for every bond of a scene that has bonds."""
    assert scene.config.bonds is not None
    part = scene.config.bonds.model.part
    return _of_each_bond(scene, part.constants, form_of_constants(part.Constants))


def _of_each_bond(scene: Scene, function: Callable[..., Any], form: Form) -> Any:
    config = scene.config
    assert config.bonds is not None
    entries = scatter_entries(config)
    return of_each_bond(function, form, config.bonds.model.params, entries, scene.factors, scene.bond_geometry)


def damping_coefficients(scene: Scene) -> NDArray[np.float64]:
    """Return the dashpots of every bond, (m, 4): stretch, shear, twist, bending.

    Those of its model, and 2 ζ √(k m*) where the scene damps its bonds.
    """
    assert scene.config.bonds is not None
    own = scene.config.bonds.model.part.dashpots
    of_scene = _damping_of_scene(scene, scene.config.bonds.damping)
    return of_scene if own is None else of_scene + np.column_stack(_of_each_bond(scene, own, DASHPOTS))


def _damping_of_scene(scene: Scene, zeta: float) -> NDArray[np.float64]:
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
    return np.column_stack([2.0 * zeta * np.sqrt(a * b) for a, b in pairs])


def wall_shapes(scene: Scene) -> list[tuple[Any, Any]]:
    """Return the nearest-point function and the numbers of each wall's shape."""
    walls = scene.config.walls.values()
    return [(wall.shape.part.nearest, wall.shape.part.shape(wall.shape.params)) for wall in walls]

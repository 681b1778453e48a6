"""``clast check --build``: packs a scene and tells exact numbers, without running it."""

from __future__ import annotations

from math import isfinite

import numpy as np

from clast.building import build_scene
from clast.config.scene import SceneConfig
from clast.engine.blueprint import Blueprint
from clast.engine.neighbours import find_pairs
from clast.engine.skins import Skin, choose_skin, choose_slack
from clast.engine.slots_text import bond_offsets
from clast.engine.state import World
from clast.engine.tables import empty_pairs
from clast.parts.generator import BondList
from clast.results.fragments import fragments
from clast.scene.compression import Gauge
from clast.scene.concerns import concerns
from clast.scene.packing_report import bond_coordination, contact_coordination, overlaps
from clast.scene.plan import blueprint
from clast.scene.repeats import most_skin
from clast.scene.scatter import scatter_entries
from clast.scene.scene import Scene
from clast.scene.start import check_start
from clast.scene.world import build_world
from clast.stability.time_step import Limits, choose_step, limits, ruling

Rows = list[tuple[str, str]]
LIMIT_NAMES = {
    "spectral": "true limit: bonds, contacts, walls, with damping",
    "network": "bond network 2/omega_max, undamped",
    "local": "bound of every particle by itself",
    "bond": "single bond, Eqs. 16-17",
    "rayleigh": "Rayleigh, Eq. 15",
    "contact": "a twentieth of an impact",
}


def report(config: SceneConfig) -> str:
    """Return what a scene is once packed: counts, packing, time step limits, compiled parts.

    Raises
    ------
    ClastError
        Whatever would stop the run from starting.
    """
    gauge = Gauge(config)
    scene = build_scene(config)
    check_start(scene)
    plan = blueprint(scene)
    found = limits(scene, plan)
    step = choose_step(scene, found)
    world = build_world(scene, plan, step, 2.0 * _skin(scene).most)
    sections = [
        ("Scene", scene_rows(scene)),
        *((f"Generator {name}", generator_rows(told)) for name, told in scene.report.items()),
        *(("Look here", [("warning", text)]) for text in concerns(scene)),
        ("Time step", step_rows(scene, found, step, gauge)),
        ("Compiled in", [(name, text) for name, on, text in features(plan) if on]),
        (
            "Left out: this scene does not need it",
            [(name, text) for name, on, text in features(plan) if not on],
        ),
        ("Memory", memory_rows(scene, plan, world)),
    ]
    return "\n\n".join(f"{title}\n{table(rows)}" for title, rows in sections if rows)


def _skin(scene: Scene) -> Skin:
    """Return how far neighbour lists reach beyond contact."""
    return choose_skin(scene.config.neighbours.skin, float(scene.radius.min()))


def table(rows: Rows) -> str:
    """Return rows as aligned lines."""
    wide = max(len(name) for name, _ in rows)
    return "\n".join(f"  {name:{wide}}  {text}" for name, text in rows)


def scene_rows(scene: Scene) -> Rows:
    """Return counts, coordination and overlaps."""
    n = len(scene.radius)
    bonds = BondList(scene.ends, scene.diameter, scene.length)
    found = overlaps(scene.position, scene.radius, scene.box)
    degree = np.bincount(scene.ends.ravel(), minlength=n)
    rows = [
        ("particles", f"{n}, radii {scene.radius.min():.4g} to {scene.radius.max():.4g} m"),
        ("mass", mass_text(scene)),
        (
            "bonds",
            f"{len(scene.ends)}, {bond_coordination(n, bonds):.2f} a particle ({degree.min()} to {degree.max()})",
        ),
        ("touching neighbours", f"{contact_coordination(scene.position, scene.radius, box=scene.box):.2f} a particle"),
        ("overlaps", f"{found.pairs} pairs, largest {found.largest:.3g} m, mean {found.mean:.3g} m"),
        *piece_rows(scene),
        *scatter_rows(scene),
    ]
    loose = int(np.count_nonzero(degree == 0)) if len(scene.ends) else 0
    return rows + ([("particles without a bond", str(loose))] if loose else [])


def piece_rows(scene: Scene) -> Rows:
    """Return how many pieces the bonds make of the grains, where they make more than there are grains."""
    if not len(scene.ends):
        return []
    piece = fragments(len(scene.radius), scene.ends, np.ones(len(scene.ends), bool))
    sizes = np.bincount(piece[scene.grain >= 0])
    grains, pieces = len(np.unique(scene.grain[scene.grain >= 0])), int(np.count_nonzero(sizes))
    if pieces == grains:
        return [("pieces", f"{pieces}, one a grain")]
    return [("pieces", f"{pieces} in place of {grains}, the smallest of {sizes[sizes > 0].min()} particles")]


def scatter_rows(scene: Scene) -> Rows:
    """Return what the factors of the bonds came to."""
    return [
        (
            f"scatter of {', '.join(entry.parameters)}",
            f"{entry.distribution}: factors {each.mean():.4g} ± {each.std():.3g}, {each.min():.3g} to {each.max():.3g}",
        )
        for entry, each in zip(scatter_entries(scene.config), scene.factors, strict=True)
        if len(each)
    ]


def mass_text(scene: Scene) -> str:
    """Return the true mass, and what scaling adds to it."""
    true, time = float(scene.true_mass.sum()), scene.config.time
    text = f"{true:.4g} kg, scaled by {time.mass_scaling:g}"
    if time.selective_mass_scaling is None:
        return text
    uniform = time.mass_scaling * scene.true_mass
    heavier = int(np.count_nonzero(scene.mass > uniform * (1.0 + 1e-9)))
    more = float((scene.mass - uniform).sum())
    return f"{text}; {heavier} particles made heavier, by {more:.4g} kg, {more / uniform.sum():.2%}, in all"


def generator_rows(told: object) -> Rows:
    """Return what a generator says it reached."""
    assert hasattr(told, "items")
    return [(str(name), f"{value:.5g}" if isinstance(value, float) else str(value)) for name, value in told.items()]


def step_rows(scene: Scene, found: Limits, step: float, gauge: Gauge) -> Rows:
    """Return every limit, the step that was chosen, and how far it is from instability."""
    rules = ruling(scene.config, found)
    rows = [
        (text, f"{getattr(found, name):.4g} s" + (", which rules" if name == rules else ""))
        for name, text in LIMIT_NAMES.items()
        if isfinite(getattr(found, name))
    ]
    rule = scene.config.time.step
    origin = "fixed" if isinstance(rule, float) else f"rule '{rule.rule}', factor {rule.factor:g}"
    rows.append(("step taken", f"{step:.4g} s ({origin})"))
    if isfinite(found.stable):
        rows.append(("share of the stable step", f"{step / found.stable:.2f}"))
    return [*rows, ("steps to the end", f"{gauge.last_step(step):,}")]


def features(plan: Blueprint) -> list[tuple[str, bool, str]]:
    """Return every feature of the step loop, whether it is compiled in, and what it is."""
    bonds, contacts = plan.bonds, plan.contacts
    law = contacts.features if contacts is not None else None
    names = ", ".join(wall.summary for wall in plan.walls)
    return [
        ("bonds", bonds is not None, "gather, kinematics, law, scatter in blocks of lanes"),
        ("bond state", bonds is not None and bonds.model.State is not None, "plastic strains and the like"),
        ("bond events", bonds is not None and bonds.model.on_event is not None, "stress drops"),
        ("bond damping", bonds is not None and bonds.damping, "dashpots beside the bonds"),
        ("bond history", bonds is not None and bonds.kinematics.State is not None, "sums over the steps"),
        ("fading of broken bonds", bonds is not None and bonds.fade, "load let go over several steps"),
        (
            "contacts of particles",
            contacts is not None and contacts.between_particles,
            "Verlet list and contact law",
        ),
        (
            "contacts of bonded pairs",
            bonds is not None and contacts is not None and contacts.bonded_pairs,
            "beside the bond",
        ),
        ("contact damping", law is not None and law.damping, "dashpots"),
        ("sliding friction", law is not None and law.sliding, "tangential history a contact"),
        ("rolling friction", law is not None and law.rolling, "rolling torques"),
        ("walls", bool(plan.walls), names or "planes, cylinders"),
        ("moving walls", bool(plan.motions), "velocities of walls"),
        ("periodic box", plan.periodic, "ways to the nearest images"),
        ("stretching of the box", plan.stretches, "velocities of images, and work on them"),
        ("body forces", bool(plan.body_forces), "gravity and others"),
        ("damping of motion", plan.damping is not None, "what brakes every particle"),
        ("applied loads", plan.applied_loads, "constant forces and torques on particles"),
        ("orientations", plan.orientation, "a quaternion a particle"),
        ("spins", plan.spin, "rotation of particles"),
        ("energy ledger", plan.ledger, "what is lost, booked at every force evaluation"),
    ]


def memory_rows(scene: Scene, plan: Blueprint, world: World) -> Rows:
    """Return the bytes of the tables, measured."""
    n, m = len(scene.radius), len(scene.ends)
    rows = [("particles", f"{sum(a.nbytes for a in world.particles) / n:.0f} bytes each")]
    if plan.bonds is not None:
        size = sum(a.nbytes for a in world.bonds) / m
        rows.append(("bonds", f"{size:.0f} bytes each, {bond_offsets(plan.bonds)['end']} numbers"))
    if plan.contacts is not None and plan.contacts.between_particles:
        search = scene.config.neighbours.search.part
        slack = choose_slack(world.particles, _skin(scene), world.numbers.dt, most_skin(scene))
        if search.told is not None:
            rows.append(("neighbour search", search.told(scene.radius + slack)))
        none = empty_pairs(world.chunks, plan.remembered)
        pairs = find_pairs(world.particles, world.chunks, world.bonds, none, search, slack, scene.box)
        count = len(pairs.first)
        if count:
            size = sum(a.nbytes for a in pairs) / count
            rows.append(("near pairs", f"{count}, {size:.0f} bytes each, skin {2.0 * slack.min():.3g} m"))
    return rows

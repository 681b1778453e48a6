"""Suspects: the laws that may have given no number where a particle is lost."""

from __future__ import annotations

import inspect

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.engine.state import World
from clast.engine.tables import failure_index, intact
from clast.plugins.blame import OWN_DISTRIBUTION
from clast.scene.scene import Scene

LAWS = ("bond_model", "bond_kinematics", "contact_law", "rolling_resistance", "body_force", "damping", "integrator")
"""Kinds of parts that give forces, or move by them."""


def suspects(world: World, scene: Scene, lost: NDArray[np.bool_]) -> str:
    """Return which law gave no number, or which laws act on what is lost.

    Lists of neighbours are stale as soon as a particle is lost, before laws are asked again. So a bond whose failure
    index is no number got it from its law while its ends were still somewhere; and a law that acts on two bodies has
    lost both.

    Parameters
    ----------
    world : World
    scene : Scene
    lost : (n,) bool
        Particles without position or velocity.
    """
    config, found = scene.config, []
    if config.bonds is not None and len(scene.ends):
        wrong = intact(world.bonds) & ~np.isfinite(failure_index(world.bonds))
        if wrong.any():
            k = int(np.argmax(wrong))
            i, j = scene.ends[k]
            return f"{told(config.bonds.model)} gave no number for bond {k} between particles {i} and {j}"
        if lost[scene.ends].all(axis=1).any():
            found.append(told(config.bonds.model))
    pairs = world.pairs
    touched = (lost[pairs.first] & lost[pairs.second]).any() or lost[world.wall_pairs.particle].any()
    if config.contacts is not None and touched:
        found.append(told(config.contacts.law))
    if touched:
        found += [told(motion) for motion in answering(config)]
    found += [told(force) for force in config.body_forces]
    return f"look at {' and '.join(found)}" if found else "look at the loads on it"


def answering(config: SceneConfig) -> list[Chosen]:
    """Return the motions that are not Clast's own and tell contacts how a wall gives way."""
    motions = [stage.motion for wall in config.walls.values() for stage in wall.stages]
    return [each for each in motions if each.part.inverse_mass is not None and each.source.origin != OWN_DISTRIBUTION]


def foreign_laws(config: SceneConfig) -> str:
    """Return the advice to try the laws that are not Clast's own; nothing where there are none."""
    laws = [each for each in config.chosen if each.kind in LAWS and each.source.origin != OWN_DISTRIBUTION]
    if not laws:
        return ""
    named = ", ".join(told(each) for each in laws)
    return f"; or a law gives out what it should not: try {named} with 'clast plugins check'"


def told(chosen: Chosen) -> str:
    """Return kind, name and file of a part."""
    return f"{chosen.kind.replace('_', ' ')} '{chosen.name}' ({inspect.getsourcefile(chosen.part.Params)})"

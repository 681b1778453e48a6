"""Foretold: what a generator says it will make, and that it can be in this scene, before anything is packed."""

from __future__ import annotations

import math

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.parts.generator import Gaps, Prediction, Site
from clast.scene.rooms import refuse_intruders
from clast.scene.scene import box_of


def foretold(config: SceneConfig, chosen: Chosen) -> Prediction | None:
    """Return what a generator of a scene says it will make; None for one that makes it at once.

    Raises
    ------
    ConfigError
        What cannot be, as far as the generator knows without packing; a wall that stands in the room it fills.
    """
    predict = chosen.part.predict
    if predict is None:
        return None
    between = config.bonds.between if config.bonds is not None else None
    with config.placing(config.path_of(chosen)):
        told: Prediction = predict(chosen.params, site(config), bonded_gaps(config))
        if between is not None and between.materials is not None and told.material not in between.materials:
            told = predict(chosen.params, site(config), None)
    refuse_intruders(config, told)
    return told


def site(config: SceneConfig) -> Site:
    """Return what the generators of a scene may know of it."""
    densities = {name: material.density for name, material in config.materials.items()}
    return Site(config.folder, densities, box_of(config))


def bonded_gaps(config: SceneConfig) -> Gaps | None:
    """Return the gaps between which a scene bonds; None where it bonds none."""
    between = config.bonds.between if config.bonds is not None else None
    if between is None:
        return None
    least = -math.inf if between.min_gap is None else between.min_gap
    if between.relative_gap is not None:
        return Gaps(least, between.relative_gap, relative=True)
    assert between.max_gap is not None
    return Gaps(least, between.max_gap)

"""Build: the scene that a config describes, from what its generators make."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.errors import ConfigError, KeyPath
from clast.maths.box import Box
from clast.parts.generator import BondList, Packing
from clast.plugins.nearest import suggestion
from clast.scene.bonding import bond_neighbours, doubled
from clast.scene.foretold import foretold, site
from clast.scene.scatter import draw_factors, scatter_entries
from clast.scene.scene import Origin, Scene, box_of, strain_rates
from clast.stability.mass_scaling import with_heavier_particles

EXTREME = 1e-100
"""Smallest mass in kg and inertia in kg m² that is computed with; the largest are its inverse."""
Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def build_scene(config: SceneConfig) -> Scene:
    """Run the generators of a config, join what they make, and make heavier what the config wants heavier.

    Raises
    ------
    PackingError, ConfigError
        From the generators, and from :func:`generated` and :func:`join`.
    """
    scene = join(config, [(chosen, generated(config, chosen)) for chosen in config.generators])
    step = config.time.selective_mass_scaling
    return scene if step is None else with_heavier_particles(scene, step)


def generated(config: SceneConfig, chosen: Chosen) -> Packing:
    """Run one generator of a config, if it can be; its errors are told with their place in the scene.

    Raises
    ------
    PackingError, ConfigError
        From the generator and from :func:`foretold`; and where it bonds a particle that is not there, one to itself,
        or two of them twice, or brings bonds to a scene without a bond model.
    """
    foretold(config, chosen)
    with config.placing(config.path_of(chosen)):
        packing: Packing = chosen.part.generate(chosen.params, site(config))
    if packing.bonds is not None and len(packing.bonds.ends):
        if config.bonds is None:
            text = "the scene has no section 'bonds' with a 'model' for these bonds; add it, or remove them"
            raise config.problem((*config.path_of(chosen), "bonds"), text)
        _refuse_senseless_bonds(config, chosen, packing.bonds, len(packing.radius))
    return packing


def _refuse_senseless_bonds(config: SceneConfig, chosen: Chosen, bonds: BondList, particles: int) -> None:
    """Refuse bonds with particles that are not there, with themselves, or between two that are bonded already."""

    def wrong(k: int, text: str) -> ConfigError:
        i, j = bonds.ends[k]
        return config.problem(place(k), f"bond {k} connects particles {i} and {j}, counted from 0{text}")

    def place(k: int) -> KeyPath | str:
        found = bonds.origin(k)
        return found if isinstance(found, str) else (*config.path_of(chosen), *found)

    missing = ((bonds.ends < 0) | (bonds.ends >= particles)).any(axis=1)
    if missing.any():
        raise wrong(int(np.argmax(missing)), f", but the last is {particles - 1}")
    alone = bonds.ends[:, 0] == bonds.ends[:, 1]
    if alone.any():
        raise wrong(int(np.argmax(alone)), ": one with itself; two different particles are needed")
    twice = doubled(bonds.ends)
    if twice is not None:
        k, first = twice
        there = place(first)
        where = there if isinstance(there, str) else ".".join(map(str, there))
        raise wrong(k, f", as bond {first} does already ({where}); remove one of them")


def join(config: SceneConfig, made: Sequence[tuple[Chosen, Packing]]) -> Scene:
    """Join what generators made into one scene, bonded as the config says.

    Raises
    ------
    ConfigError
        A particle is of a material that the config does not have, or its mass is beyond all numbers.
    """
    packings = [packing for _, packing in made]
    origins = _origins(config, made)
    material = _materials(config, packings, origins)
    radius = np.concatenate([packing.radius for packing in packings])
    density = np.array([each.density for each in config.materials.values()])[material]
    position = np.concatenate([packing.position for packing in packings])
    grain, prescribed = _joined_grains(packings), np.concatenate([packing.prescribed for packing in packings])
    bonds = _bonds(config, packings, position, radius, material, grain)
    with np.errstate(over="ignore", under="ignore"):
        mass = density * config.time.mass_scaling * 4.0 / 3.0 * np.pi * radius**3
    scene = Scene(
        config=config,
        position=position,
        velocity=_velocities(config, packings, position, prescribed),
        spin=np.concatenate([packing.spin for packing in packings]),
        radius=radius,
        mass=mass,
        material=material,
        grain=grain,
        prescribed=prescribed,
        force=np.concatenate([_vectors(packing.force, packing) for packing in packings]),
        torque=np.concatenate([_vectors(packing.torque, packing) for packing in packings]),
        ends=np.sort(bonds.ends, axis=1),
        diameter=bonds.diameter,
        length=_lengths(bonds, position, box_of(config)),
        relieved=np.concatenate([np.full(len(p.radius), p.relieved) for p in packings]),
        factors=draw_factors(scatter_entries(config), len(bonds.ends)),
        origins=origins,
        report={f"{k + 1}. {chosen.name}": packing.report for k, (chosen, packing) in enumerate(made)},
        concerns=tuple(
            config.remark(config.path_of(chosen), text) for chosen, packing in made for text in packing.concerns
        ),
    )
    _refuse_extreme_masses(scene)
    return scene


def _refuse_extreme_masses(scene: Scene) -> None:
    """Refuse masses and inertias with which nothing can be computed."""
    with np.errstate(over="ignore", under="ignore"):
        inertia = 0.4 * scene.mass * scene.radius**2
    wrong = ~((np.minimum(scene.mass, inertia) > EXTREME) & (np.maximum(scene.mass, inertia) < 1.0 / EXTREME))
    if wrong.any():
        k = int(np.argmax(wrong))
        raise scene.config.problem(
            scene.origin(k),
            f"particle {k} has a mass of {scene.mass[k]:.3g} kg and a radius of {scene.radius[k]:.3g} m, beyond what "
            "can be computed with; check the units of radius and density, and time.mass_scaling",
        )


def _origins(config: SceneConfig, made: Sequence[tuple[Chosen, Packing]]) -> tuple[Origin, ...]:
    first = np.cumsum([0, *(len(packing.radius) for _, packing in made)])
    return tuple(
        Origin(int(k), config.path_of(chosen), packing.origin)
        for k, (chosen, packing) in zip(first, made, strict=False)
    )


def _materials(config: SceneConfig, packings: list[Packing], origins: tuple[Origin, ...]) -> Integers:
    names = {name: k for k, name in enumerate(config.materials)}
    for packing, origin in zip(packings, origins, strict=True):
        for k, name in enumerate(packing.material):
            if name not in names:
                text = f"there is no material {name!r}; {suggestion(name, names)}"
                raise config.problem(origin.place(origin.first + k), text)
    return np.array([names[name] for packing in packings for name in packing.material], np.int64)


def _vectors(given: Floats | None, packing: Packing) -> Floats:
    """Return a vector for every particle of a packing; zeros where none are given."""
    return np.zeros((len(packing.radius), 3)) if given is None else given


def _joined_grains(packings: list[Packing]) -> Integers:
    joined, first = [], 0
    for packing in packings:
        joined.append(np.where(packing.grain >= 0, packing.grain + first, -1))
        first = max([first, *(joined[-1] + 1)])
    return np.concatenate(joined)


def _bonds(
    config: SceneConfig,
    packings: list[Packing],
    position: Floats,
    radius: Floats,
    material: Integers,
    grain: Integers,
) -> BondList:
    """Return the generators' own bonds and those between near particles of one grain."""
    lists = [BondList(np.zeros((0, 2), np.int64), np.zeros(0), np.zeros(0))]
    first = 0
    for packing in packings:
        if packing.bonds is not None and config.bonds is not None:
            lists.append(BondList(packing.bonds.ends + first, packing.bonds.diameter, packing.bonds.length))
        first += len(packing.radius)
    if config.bonds is not None and config.bonds.between is not None:
        lists.append(_near_bonds(config, position, radius, material, grain, lists))
    return BondList(
        np.concatenate([each.ends for each in lists]),
        np.concatenate([each.diameter for each in lists]),
        np.concatenate([each.length for each in lists]),
    )


def _near_bonds(
    config: SceneConfig,
    position: Floats,
    radius: Floats,
    material: Integers,
    grain: Integers,
    given: list[BondList],
) -> BondList:
    """Return bonds between near particles of the same grain that are not bonded yet."""
    assert config.bonds is not None
    between = config.bonds.between
    assert between is not None
    min_gap = -np.inf if between.min_gap is None else between.min_gap
    relative = between.max_gap is None
    max_gap = between.relative_gap if between.max_gap is None else between.max_gap
    assert max_gap is not None
    near = bond_neighbours(position, radius, max_gap, min_gap, between.diameter, relative, box_of(config))
    i, j = near.ends.T
    wanted = grain[i] == grain[j]
    if between.materials is not None:
        allowed = np.isin(material, [list(config.materials).index(name) for name in between.materials])
        wanted &= allowed[i] & allowed[j]
    taken = {tuple(sorted(pair)) for each in given for pair in each.ends.tolist()}
    if taken:
        wanted &= np.array([tuple(sorted(pair)) not in taken for pair in near.ends.tolist()], bool)
    return BondList(near.ends[wanted], near.diameter[wanted], near.length[wanted])


def _velocities(
    config: SceneConfig, packings: list[Packing], position: Floats, prescribed: NDArray[np.bool_]
) -> Floats:
    """Return the start velocities, (n, 3); in a box that is stretched particles that are free go with it."""
    velocity = np.concatenate([packing.velocity for packing in packings])
    rates = strain_rates(config)
    if rates.any():
        velocity[~prescribed] += (rates * (position - box_of(config).middle))[~prescribed]
    return velocity


def _lengths(bonds: BondList, position: Floats, box: Box) -> Floats:
    d = box.nearest(position[bonds.ends[:, 1]] - position[bonds.ends[:, 0]])
    return np.where(np.isnan(bonds.length), np.linalg.norm(d, axis=1), bonds.length)

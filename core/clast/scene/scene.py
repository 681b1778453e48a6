"""Scene: particles and bonds as plain arrays, before anything is compiled."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.errors import KeyPath
from clast.parts.bond_model import BondGeometry
from clast.parts.generator import BondList, Packing
from clast.plugins.nearest import suggestion

EXTREME = 1e-100
"""Smallest mass in kg and inertia in kg m² that is computed with; the largest are its inverse."""
Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class Origin(NamedTuple):
    """Where particles come from: number of the first, key path of their generator, and ``Packing.origin``."""

    first: int
    path: KeyPath
    within: Callable[[int], KeyPath | str]

    def place(self, particle: int) -> KeyPath | str:
        """Where the user wrote a particle: a key path of the scene, or file and line."""
        place = self.within(particle - self.first)
        return place if isinstance(place, str) else (*self.path, *place)


@dataclass(frozen=True)
class Scene:
    """What the generators made of a config.

    Attributes
    ----------
    config : SceneConfig
    position, velocity, spin : (n, 3) float64
        m, m/s, rad/s.
    radius, mass : (n,) float64
        m and kg; masses are scaled by ``time.mass_scaling`` and ``time.selective_mass_scaling``.
    material, grain : (n,) int64
        Index into ``config.materials``, and number of the grain, −1 for loose particles.
    prescribed : (n,) bool
    force, torque : (n, 3) float64
        What acts on each particle all the time, in N and N m.
    ends : (m, 2) int64
        Particles of each bond, the lower number first.
    diameter, length : (m,) float64
        Diameter and initial length of each bond in m.
    relieved : (n,) bool
        Particles whose overlaps at the start count as undeformed.
    origins : tuple of Origin
        Where the particles of each generator come from, in order.
    report : mapping
        What each generator reached.
    """

    config: SceneConfig
    position: Floats
    velocity: Floats
    spin: Floats
    radius: Floats
    mass: Floats
    material: Integers
    grain: Integers
    prescribed: NDArray[np.bool_]
    force: Floats
    torque: Floats
    ends: Integers
    diameter: Floats
    length: Floats
    relieved: NDArray[np.bool_]
    origins: tuple[Origin, ...] = ()
    report: Mapping[str, Mapping[str, float | int | str]] = field(default_factory=dict)

    @property
    def bond_vectors(self) -> Floats:
        """Centre of j minus centre of i for every bond, (m, 3) in m."""
        return self.position[self.ends[:, 1]] - self.position[self.ends[:, 0]]

    @property
    def bond_geometry(self) -> BondGeometry:
        """Shape of all bonds; radius, section and second moment are single numbers when all bonds agree."""
        R = 0.5 * self.diameter
        if len(R) and np.all(R[0] == R):
            R = R[0]
        return BondGeometry(self.length, R, np.pi * R**2, 0.25 * np.pi * R**4)

    @property
    def true_mass(self) -> Floats:
        """Density times volume of every particle, (n,) in kg: the mass before any scaling."""
        density = np.array([each.density for each in self.config.materials.values()])[self.material]
        return np.asarray(density * 4.0 / 3.0 * np.pi * self.radius**3)

    def origin(self, particle: int) -> KeyPath | str:
        """Where the user wrote a particle: a key path of the scene, or file and line."""
        return next(each for each in reversed(self.origins) if each.first <= particle).place(particle)


def build_scene(config: SceneConfig) -> Scene:
    """Run the generators of a config, join what they make, and make heavier what the config wants heavier.

    Raises
    ------
    PackingError, ConfigError
        From the generators, and from :func:`join`.
    """
    scene = join(config, [(chosen, generated(config, chosen)) for chosen in config.generators])
    step = config.time.selective_mass_scaling
    if step is None:
        return scene
    from clast.engine.mass_scaling import with_heavier_particles

    return with_heavier_particles(scene, step)


def generated(config: SceneConfig, chosen: Chosen) -> Packing:
    """Run one generator of a config; its errors are told with their place in the scene."""
    with config.placing(config.path_of(chosen)):
        packing: Packing = chosen.part.generate(chosen.params, config.folder)
    return packing


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
    grain = _joined_grains(packings)
    bonds = _bonds(config, packings, position, radius, material, grain)
    with np.errstate(over="ignore", under="ignore"):
        mass = density * config.time.mass_scaling * 4.0 / 3.0 * np.pi * radius**3
    scene = Scene(
        config=config,
        position=position,
        velocity=np.concatenate([packing.velocity for packing in packings]),
        spin=np.concatenate([packing.spin for packing in packings]),
        radius=radius,
        mass=mass,
        material=material,
        grain=grain,
        prescribed=np.concatenate([packing.prescribed for packing in packings]),
        force=np.concatenate([_vectors(packing.force, packing) for packing in packings]),
        torque=np.concatenate([_vectors(packing.torque, packing) for packing in packings]),
        ends=np.sort(bonds.ends, axis=1),
        diameter=bonds.diameter,
        length=_lengths(bonds, position),
        relieved=np.concatenate([np.full(len(p.radius), p.relieved) for p in packings]),
        origins=origins,
        report={f"{k + 1}. {chosen.name}": packing.report for k, (chosen, packing) in enumerate(made)},
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
    from clast.scene.bonding import bond_neighbours

    assert config.bonds is not None
    between = config.bonds.between
    assert between is not None
    min_gap = -np.inf if between.min_gap is None else between.min_gap
    near = bond_neighbours(position, radius, between.max_gap, min_gap, between.diameter)
    i, j = near.ends.T
    wanted = grain[i] == grain[j]
    if between.materials is not None:
        allowed = np.isin(material, [list(config.materials).index(name) for name in between.materials])
        wanted &= allowed[i] & allowed[j]
    taken = {tuple(sorted(pair)) for each in given for pair in each.ends.tolist()}
    if taken:
        wanted &= np.array([tuple(sorted(pair)) not in taken for pair in near.ends.tolist()], bool)
    return BondList(near.ends[wanted], near.diameter[wanted], near.length[wanted])


def _lengths(bonds: BondList, position: Floats) -> Floats:
    d = position[bonds.ends[:, 1]] - position[bonds.ends[:, 0]]
    return np.where(np.isnan(bonds.length), np.linalg.norm(d, axis=1), bonds.length)

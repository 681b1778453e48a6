"""Scene: particles and bonds as plain arrays, before anything is compiled."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.config.scene import SceneConfig
from clast.errors import KeyPath
from clast.maths.box import Box, open_space
from clast.parts.bond_model import BondGeometry

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
    factors : tuple of (m,) float64
        For each entry of ``bonds.scatter``, what the parameters it names are multiplied by, bond by bond.
    origins : tuple of Origin
        Where the particles of each generator come from, in order.
    report : mapping
        What each generator reached.
    concerns : tuple of str
        What generators want the user to know before the run, each with the place of its generator.
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
    factors: tuple[Floats, ...] = ()
    origins: tuple[Origin, ...] = ()
    report: Mapping[str, Mapping[str, float | int | str]] = field(default_factory=dict)
    concerns: tuple[str, ...] = ()

    @property
    def box(self) -> Box:
        """The box that repeats itself, or holds the particles, at the start."""
        return box_of(self.config)

    def ways(self, pairs: Integers) -> Floats:
        """From the centre of the first of each pair, (p, 2), to the nearest image of the second, (p, 3) in m."""
        return self.box.nearest(self.position[pairs[:, 1]] - self.position[pairs[:, 0]])

    @property
    def bond_vectors(self) -> Floats:
        """Centre of j minus centre of i for every bond, (m, 3) in m."""
        return self.ways(self.ends)

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


def box_of(config: SceneConfig) -> Box:
    """Return the box of a scene at its start: its domain; one without bounds where it has none."""
    domain = config.boundaries.domain
    if domain is None:
        return open_space()
    periodic = np.array([axis in domain.periodic for axis in "xyz"])
    return Box(np.array(domain.lower), np.array(domain.upper), periodic)


def strain_rates(config: SceneConfig) -> Floats:
    """Return the rates at which the box of a scene is stretched, (3,) in 1/s."""
    domain = config.boundaries.domain
    rates = None if domain is None else domain.strain_rate
    return np.zeros(3) if rates is None else np.array(rates)


def is_logarithmic(config: SceneConfig) -> bool:
    """Tell whether the rates at which a box is stretched are those of the logarithmic strain."""
    domain = config.boundaries.domain
    return domain is not None and domain.strain_measure == "logarithmic"


def spans_at(config: SceneConfig, time: Floats) -> Floats:
    """Return how far apart images are at times (k,) in s since the start, (k, 3) in m; 0 where none follow."""
    span, strain = box_of(config).span, strain_rates(config) * time[:, None]
    return span * (np.exp(strain) if is_logarithmic(config) else 1.0 + strain)

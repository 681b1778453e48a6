"""A problem: a scene, what is looked at in it, and what is varied."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import product
from math import inf
from pathlib import Path
from typing import Any

from clast.bench.places import scene_file
from clast.config.scene import SceneConfig, from_mapping, load
from clast.engine.state import Floats
from clast.simulation import Simulation

Way = dict[str, str]
"""One choice for every kind of part that is varied: kind -> name."""

KEYS = {"integrator": "integrator", "bond_kinematics": "bonds.kinematics"}


@dataclass(frozen=True)
class Problem:
    """A scene whose error is known against a much finer step.

    Attributes
    ----------
    name : str
        Of the problem and of its scene in ``configs/benchmarks``.
    title, text : str
        For the page.
    quantity : str
        What the error is of: it is the root mean square of the difference over that of the reference.
    observe : (simulation, steps, instants) -> array
        What is looked at.
    steps : tuple of int
        Numbers of steps to the end of the scene; multiples of ``instants``.
    fine : int
        Steps of the reference; half of them tell how well it is known itself.
    instants : int
        How often is looked.
    varies : tuple of str
        Kinds of parts of which every one that is installed is tried.
    copies : int
        How often the scene stands side by side where time is measured, so that it is long enough to be known.
    apart : float
        Distance of the copies along y, in m.
    damping_ratio : float
        Of the oscillator whose order is the scheme's order here.
    kinks : float
        Highest order that the forces' kinks leave.
    """

    name: str
    title: str
    text: str
    quantity: str
    observe: Callable[[Simulation, int, int], Floats]
    steps: tuple[int, ...]
    fine: int
    instants: int
    varies: tuple[str, ...]
    copies: int = 1
    apart: float = 0.0
    damping_ratio: float = 0.0
    kinks: float = inf

    @property
    def end(self) -> float:
        """Simulated time in s."""
        end = self.scene().time.end.time
        assert end is not None
        return end

    def scene(self, copies: int = 1, files: tuple[Path, ...] = ()) -> SceneConfig:
        """Return the scene, or copies of it side by side, with the user's plugin files."""
        return _scene(self.name, copies, self.apart, files)

    @property
    def own(self) -> Way:
        """The scene's own choice of what is varied."""
        scene = self.scene()
        mine = {"integrator": scene.integrator.name}
        if scene.bonds is not None:
            mine["bond_kinematics"] = scene.bonds.kinematics.name
        return {kind: mine[kind] for kind in self.varies}

    def ways(self, names: Callable[[str], list[str]]) -> list[Way]:
        """Return every combination of installed parts; ``names`` tells those of a kind."""
        choices = product(*(names(kind) for kind in self.varies))
        return [dict(zip(self.varies, names, strict=True)) for names in choices]

    def changes(self, way: Mapping[str, str], steps: int) -> dict[str, Any]:
        """Return what the scene must be told for some parts and a number of steps."""
        return {KEYS[kind]: name for kind, name in way.items()} | {"time.step": self.end / steps}


@cache
def _scene(name: str, copies: int, apart: float, files: tuple[Path, ...]) -> SceneConfig:
    config = load(scene_file(name))
    if copies == 1 and not files:
        return config
    data = config.resolved()
    if copies > 1:
        data["particles"] = side_by_side(data["particles"], copies, apart)
    return from_mapping(data | {"plugins": [str(file.resolve()) for file in files]}, config.folder, name)


def side_by_side(explicit: Mapping[str, Any], copies: int, apart: float) -> dict[str, Any]:
    """Return an explicit generator with copies along y."""
    particles, bonds = explicit["particles"], explicit["bonds"]
    everyone, every_bond = [], []
    for k in range(copies):
        for particle in particles:
            x, y, z = particle["position"]
            everyone.append({**particle, "position": [x, y + k * apart, z]})
        for bond in bonds:
            every_bond.append({**bond, "between": [end + k * len(particles) for end in bond["between"]]})
    return {**explicit, "particles": everyone, "bonds": every_bond}

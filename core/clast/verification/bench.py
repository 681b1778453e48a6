"""The bench on which a case is run: its scene, ready to run in variants."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from clast.config.scene import SceneConfig, load
from clast.simulation import Simulation
from clast.verification.replacement import Replacement

INSTALLED = Path(__file__).parent / "configs"
IN_THE_SOURCES = Path(__file__).parents[3] / "configs" / "verification"


def scene_file(config: str) -> Path:
    """Return the scene of a case: in the installed package, or among the sources of Clast."""
    folder = INSTALLED if INSTALLED.is_dir() else IN_THE_SOURCES
    return folder / f"{config}.yaml"


class Bench:
    """One case's scene, with the parts that the user puts in the place of Clast's own.

    Parameters
    ----------
    config : str
        File name of the scene, without ``.yaml``.
    replacement : Replacement or None

    Raises
    ------
    ConfigError
        The replacement does not fit the scene.
    """

    def __init__(self, config: str, replacement: Replacement | None = None) -> None:
        scene = load(scene_file(config))
        self._scene = scene if replacement is None else replacement.into(scene)

    def scene(self, changes: Mapping[str, Any] | None = None) -> SceneConfig:
        """Return the scene with some values changed, as :meth:`clast.config.scene.SceneConfig.changed` takes them."""
        return self._scene.changed(changes) if changes else self._scene

    def start(self, changes: Mapping[str, Any] | None = None, threads: int | None = None) -> Simulation:
        """Return a simulation of the scene at its start, its steps shared by some threads; by all, if not given."""
        return Simulation(self.scene(changes), threads)

    def run(self, changes: Mapping[str, Any] | None = None, threads: int | None = None) -> Simulation:
        """Return a simulation of the scene at its end."""
        simulation = self.start(changes, threads)
        simulation.advance_to(simulation.last_step)
        return simulation

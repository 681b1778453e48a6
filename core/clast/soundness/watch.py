"""Soundness: what in a running scene its time step cannot follow, and what to change."""

from __future__ import annotations

from clast.engine.blueprint import Blueprint
from clast.engine.state import World
from clast.scene.scene import Scene
from clast.soundness.energy import ClosedEnergy
from clast.soundness.impacts import ImpactsAhead
from clast.soundness.motion import lost, passed_through, too_fast


class Soundness:
    """Looks at a scene when neighbour lists are made and at samples: at steps that are the same in every run.

    Parameters
    ----------
    scene : Scene
    plan : Blueprint
    share : float
        Time step over the limit of the scene at its start.
    """

    def __init__(self, scene: Scene, plan: Blueprint, share: float) -> None:
        self.scene, self.plan = scene, plan
        self.impacts = ImpactsAhead(scene, plan)
        self.energy = ClosedEnergy(scene, plan, share)

    def complaint(self, world: World, dt: float) -> str | None:
        """Return what cannot be followed with steps of ``dt`` seconds; None if all can."""
        return (
            self.motion_complaint(world, dt)
            or passed_through(world, self.scene, self.plan)
            or self.impacts.complaint(world, dt)
        )

    def motion_complaint(self, world: World, dt: float) -> str | None:
        """Return the same of single particles, for which neighbour lists need not be fresh."""
        return lost(world) or too_fast(world, self.scene, self.plan, dt)

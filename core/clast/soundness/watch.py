"""Soundness: what in a running scene its time step cannot follow, and what to change."""

from __future__ import annotations

from clast.engine.blueprint import Blueprint
from clast.engine.state import World
from clast.scene.scene import Scene
from clast.soundness.crowded import crowded
from clast.soundness.energy import EnergyWatch
from clast.soundness.impacts import ImpactsAhead
from clast.soundness.motion import ALL, Some, lost, passed_through, round_the_other_way, too_fast, wall_out_of_hand
from clast.soundness.near import Gaps, Nearness


class Soundness:
    """Looks at a scene when neighbour lists are made and at samples: at steps that are the same in every run.

    Parameters
    ----------
    scene : Scene
    plan : Blueprint
    share : float
        Time step over the limit of the scene at its start.
    gaps : compiled function
        See :func:`clast.engine.kernels.gaps.gaps`.

    Attributes
    ----------
    energy : EnergyWatch
        Finds energy from nowhere, at samples.
    """

    def __init__(self, scene: Scene, plan: Blueprint, share: float, gaps: Gaps) -> None:
        self.scene, self.plan, self.gaps = scene, plan, gaps
        self.impacts = ImpactsAhead(scene, plan)
        self.energy = EnergyWatch(scene, share)

    def complaint(self, world: World, dt: float) -> str | None:
        """Return what cannot be followed with steps of ``dt`` seconds; None if all can."""
        return self.motion_complaint(world, dt) or self.contact_complaint(world, dt)

    def motion_complaint(self, world: World, dt: float) -> str | None:
        """Return the same of single particles and bonds, for which neighbour lists need not be fresh."""
        return (
            self.complaint_of(ALL, world, dt) or wall_out_of_hand(world, self.scene, dt) or round_the_other_way(world)
        )

    def complaint_of(self, some: Some, world: World, dt: float) -> str | None:
        """Return the same of some particles alone."""
        return lost(world, self.scene, some) or too_fast(world, self.scene, self.plan, dt, some)

    def contact_complaint(self, world: World, dt: float) -> str | None:
        """Return the same of what is on the neighbour lists."""
        if (found := crowded(world, self.scene)) is not None:
            return found
        near = Nearness(world, self.gaps)
        return passed_through(near, world, self.scene) or self.impacts.complaint(near, world, dt)

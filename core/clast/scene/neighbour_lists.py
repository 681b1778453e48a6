"""Neighbour lists of a running scene: made at the start, and mended or made anew whenever they go stale."""

from __future__ import annotations

from clast.engine import runaways
from clast.engine.blueprint import Blueprint
from clast.engine.histories import pair_rows
from clast.engine.neighbours import NearWalls, find_pairs, find_wall_pairs, remember_positions, wall_rows
from clast.engine.skins import choose_skin, choose_slack
from clast.engine.state import Integers, Particles, World
from clast.engine.tables import box_now
from clast.scene.plan import largest_reach
from clast.scene.repeats import most_skin, search_slack
from clast.scene.scene import Scene


class NeighbourLists:
    """Keeps the neighbour lists of a scene.

    Parameters
    ----------
    scene : Scene
    plan : Blueprint
    near_walls : compiled function
        See :func:`clast.engine.kernels.near_walls.near_walls`.

    Attributes
    ----------
    skin : Skin
        How wide lists reach.
    made, mended : int
        How often all neighbours were searched, and how often only those of the few particles that outran their lists.
    spent : float
        What mending has cost since lists were made, over what it costs to make them.
    """

    def __init__(self, scene: Scene, plan: Blueprint, near_walls: NearWalls) -> None:
        self.scene, self.near_walls = scene, near_walls
        self.skin = choose_skin(scene.config.neighbours.skin, float(scene.radius.min()))
        self.reach = largest_reach(scene)
        self.between_particles = plan.contacts is not None and plan.contacts.between_particles
        self.at_walls = plan.contacts is not None and bool(plan.walls)
        self.made = self.mended = 0
        self.spent = 0.0
        self.extents: runaways.Extents | None = None

    def made_anew(self, world: World, dt: float) -> World:
        """Return the world with lists for the present positions and velocities, and steps of ``dt`` seconds."""
        particles, walls, box = world.particles, world.walls, box_now(self.scene.box, world.particles)
        slack = choose_slack(particles, self.skin, dt, most_skin(self.scene, box))
        if self.between_particles:
            search = self.scene.config.neighbours.search.part
            wide = search_slack(self.scene, slack + 0.5 * self.reach)
            pairs = find_pairs(particles, world.chunks, world.bonds, world.pairs, search, wide, box)
            world = world._replace(pairs=pairs)
        if self.at_walls:
            far = self.skin.most + self.reach
            near = find_wall_pairs(particles, walls, world.wall_pairs, self.near_walls, slack, far)
            world = world._replace(wall_pairs=near)
        remember_positions(particles, walls, slack)
        self.made += 1
        self.spent = 0.0
        self.extents = None
        return world

    def brought_up_to_date(self, world: World, away: Integers, dt: float) -> tuple[World, World]:
        """Return the world with lists that fit again, and the same with nothing on them but what is new.

        Lists are mended for those that ran ``away`` until that has cost as much as to make them: then they have become
        so old that more and more outrun them.
        """
        cost = self.spent + runaways.cost(away, world.particles, world.stale)
        mended = self._mended(world, away, dt) if cost <= 1.0 else None
        if mended is None:
            world = self.made_anew(world, dt)
            return world, world
        self.mended += 1
        self.spent = cost
        return mended

    def _mended(self, world: World, away: Integers, dt: float) -> tuple[World, World] | None:
        """Return the same where only some particles outran their lists; None if there is no room for new pairs."""
        particles, walls, box = world.particles, world.walls, box_now(self.scene.box, world.particles)
        slack = choose_slack(runaways.rows_of(particles, away), self.skin, dt, most_skin(self.scene, box))
        runaways.look_again(particles, walls, away, slack)
        fresh = world
        if self.between_particles:
            most = float(self.scene.radius.max()) + self.skin.most
            found = runaways.pairs_of(particles, self._extents(particles, away), away, most, self.reach, box)
            gone = runaways.rows_with(world.pairs, world.chunks, away)
            fresh = fresh._replace(pairs=pair_rows(found, world.chunks, world.bonds, world.pairs, gone))
            if not runaways.exchange(world.pairs, gone, fresh.pairs):
                return None
        if self.at_walls:
            far = 2.0 * self.skin.most + self.reach  # walls may have gone their way already, and come back
            contacts = runaways.contacts_at_walls(particles, away, walls, self.near_walls, slack, far)
            fresh = fresh._replace(wall_pairs=wall_rows(contacts, world.wall_pairs))
            near = runaways.exchanged_at_walls(world.wall_pairs, away, contacts)
            world = world._replace(wall_pairs=near)
        return world, fresh

    def _extents(self, particles: Particles, away: Integers) -> runaways.Extents:
        """Return where all particles go from, those that ran away among them."""
        if self.extents is None:
            self.extents = runaways.extents(particles)
        self.extents.widen(particles, away)
        return self.extents

"""Springs: bonds, contacts and walls as they stand, linearised for the limits of the time step."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.engine.blueprint import Blueprint
from clast.engine.wall_feet import feet
from clast.engine.wall_frames import WallFrames, at_start
from clast.maths.box import Box, open_space
from clast.parts.contact_law import ContactLaw
from clast.scene.bonding import close_pairs
from clast.scene.near_walls import near_walls
from clast.scene.plan import bond_stiffness, damping_coefficients, largest_reach, material_pairs, wall_answers
from clast.scene.scene import Scene
from clast.scene.world import overlaps_at_rest
from clast.stability.response import Response, respond, rolling_response

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Responses = dict[tuple[int, int], tuple[ContactLaw, Any, Response]]


class Springs(NamedTuple):
    """Springs and dashpots between n bodies; a wall is body number n, which nothing moves.

    The measures of a spring between i and j are u_j − u_i + normal x (arm_i θ_i + arm_j θ_j), along the normal and
    across it, and θ_j − θ_i likewise, for small displacements u and rotations θ.

    Attributes
    ----------
    first, second : (s,) int64
    normal : (s, 3) float64
        From first to second.
    arms : (s, 2) float64
        From the centres to where the force acts, in m.
    stiffness, damping : (s, 4) float64
        Against stretch, shear (N/m, N s/m), twist and bending (N m, N m s).
    """

    first: Integers
    second: Integers
    normal: Floats
    arms: Floats
    stiffness: Floats
    damping: Floats


class Bodies(NamedTuple):
    """What springs hold together: n particles, where they are and how heavy.

    Attributes
    ----------
    position : (n, 3) float64
    radius, inverse_mass, inverse_inertia : (n,) float64
    box : Box
        In which they repeat themselves, if they do.
    """

    position: Floats
    radius: Floats
    inverse_mass: Floats
    inverse_inertia: Floats
    box: Box = open_space()


def bodies_at_start(scene: Scene) -> Bodies:
    """Return the particles of a scene as they stand at its start."""
    per_mass = np.where(counts_as_held(scene), 0.0, 1.0 / scene.mass)
    return Bodies(scene.position, scene.radius, per_mass, 2.5 * per_mass / scene.radius**2, scene.box)


def counts_as_held(scene: Scene) -> NDArray[np.bool_]:
    """Return which particles, (n,), have no inverse mass in limits of the step: prescribed ones.

    But where walls give way that touch them, they count as free. What a wall with the mass M gives way by, ΣK/M, is
    then at most Σm/M times the largest K/m, for which the share of the step stands that such motions leave.
    """
    answering = any(wall_answers(wall) for wall in scene.config.walls.values())
    return np.zeros(len(scene.radius), bool) if answering else scene.prescribed


def springs_at_start(scene: Scene, plan: Blueprint) -> Springs:
    """Return everything that holds or touches at the start of a scene."""
    bodies = bodies_at_start(scene)
    pairs = close_pairs(scene.position, scene.radius, 0.0, scene.box)[0]
    pairs = pairs[~scene.prescribed[pairs].all(axis=1)]
    everything = np.ones(len(scene.ends), bool)
    still = at_start(len(scene.config.walls))
    near = near_walls(scene, scene.position, still)
    responses = contact_responses(scene, plan)
    bonded_pairs_touch = plan.contacts is not None and plan.contacts.bonded_pairs
    return joined(
        bond_springs(scene, bodies, everything),
        contact_springs(
            scene, responses, bodies, pairs, overlaps_at_rest(scene, pairs), everything & (not bonded_pairs_touch)
        ),
        wall_springs(scene, responses, bodies, near, still),
        drag_springs(scene, bodies, scene.velocity),
    )


def joined(*each: Springs) -> Springs:
    """Return several tables of springs as one."""
    return Springs(*(np.concatenate(columns) for columns in zip(*each, strict=True)))


def chosen(springs: Springs, rows: slice) -> Springs:
    """Return some rows of a table of springs."""
    return Springs(
        springs.first[rows],
        springs.second[rows],
        springs.normal[rows],
        springs.arms[rows],
        springs.stiffness[rows],
        springs.damping[rows],
    )


def bond_springs(scene: Scene, bodies: Bodies, intact: NDArray[np.bool_]) -> Springs:
    """Return the springs of the bonds that hold, with their elastic stiffness: no law makes them stiffer."""
    if not intact.any():
        return no_springs()
    first, second = scene.ends[intact].T
    d = bodies.box.nearest(bodies.position[second] - bodies.position[first])
    length = np.linalg.norm(d, axis=1)
    size = len(scene.ends)
    stiffness = np.column_stack([np.broadcast_to(k, size) for k in bond_stiffness(scene)])
    normal = d / np.where(length > 0.0, length, 1.0)[:, None]
    arms = 0.5 * np.column_stack([length, length])
    return Springs(first, second, normal, arms, stiffness[intact], damping_coefficients(scene)[intact])


def drag_springs(scene: Scene, bodies: Bodies, velocity: Floats) -> Springs:
    """Return the dashpots that body forces are to every particle, with velocities (n, 3) in m/s."""
    found = [no_springs()]
    n = len(bodies.radius)
    for chosen in scene.config.body_forces:
        if chosen.part.damping is not None:
            numbers = chosen.part.numbers(chosen.params, scene.config.time.mass_scaling)
            moving, turning = chosen.part.damping(numbers, bodies.radius, velocity)
            damping = np.column_stack([moving, moving, turning, turning])
            normal, still = np.tile([0.0, 0.0, 1.0], (n, 1)), np.zeros((n, 4))
            found.append(Springs(np.arange(n), np.full(n, n), normal, np.zeros((n, 2)), still, damping))
    return joined(*found)


def contact_springs(
    scene: Scene, responses: Responses, bodies: Bodies, pairs: Integers, rest: Floats, instead: NDArray[np.bool_]
) -> Springs:
    """Return the springs of the pairs (p, 2) that touch, but for those in whose stead a bond holds, (m,) bool.

    Up to an overlap of ``rest`` (p,) in m they do not push.

    With a law whose contacts hold beyond touch, all pairs within their reach count, whether they have touched or not.
    """
    if not responses or len(pairs) == 0:
        return no_springs()
    if instead.any():
        free = ~np.isin(pair_numbers(scene, pairs), pair_numbers(scene, scene.ends[instead]))
        pairs, rest = pairs[free], rest[free]
    i, j = pairs.T
    d = bodies.box.nearest(bodies.position[j] - bodies.position[i])
    distance = np.sqrt(d[:, 0] ** 2 + d[:, 1] ** 2 + d[:, 2] ** 2)
    reach = bodies.radius[i] + bodies.radius[j]
    overlap = reach - distance - rest
    touching = (
        (overlap > -largest_reach(scene)) & (distance > 0.0) & (bodies.inverse_mass[i] + bodies.inverse_mass[j] > 0.0)
    )
    i, j, overlap, reach = i[touching], j[touching], overlap[touching], reach[touching]
    d, distance = d[touching], distance[touching]
    share = distance / reach if scene.config.contacts and scene.config.contacts.lever == "contact_point" else 1.0
    return touching_springs(
        responses,
        bodies,
        first=i,
        second=j,
        materials=np.column_stack([scene.material[i], scene.material[j]]),
        normal=d / distance[:, None],
        arms=np.column_stack([share * bodies.radius[i], share * bodies.radius[j]]),
        radius=bodies.radius[i] * bodies.radius[j] / reach,
        overlap=overlap,
    )


def wall_springs(scene: Scene, responses: Responses, bodies: Bodies, near: Integers, frames: WallFrames) -> Springs:
    """Return the springs of the rows of ``near`` (p, 2), wall and particle, that touch.

    Parameters
    ----------
    frames : WallFrames
        Where the walls are.
    """
    names = list(scene.config.materials)
    rows, materials, reach = [], [], bodies.radius + largest_reach(scene)
    for w, wall in enumerate(scene.config.walls.values() if responses else ()):
        mine = near[near[:, 0] == w, 1]
        mine = mine[bodies.inverse_mass[mine] > 0.0]
        found = feet(wall.shape.part, wall.shape.params, frames.seen(w, bodies.position[mine]), reach[mine])
        normals = frames.in_space(w, found.normal)
        rows.append(np.column_stack([mine[found.point], found.distance, normals]))
        materials.append(np.full(len(found.point), names.index(wall.material)))
    table = np.concatenate([np.zeros((0, 5)), *rows])
    if len(table) == 0:
        return no_springs()
    particle, distance = table[:, 0].astype(np.int64), table[:, 1]
    radius = bodies.radius[particle]
    lever = distance if scene.config.contacts and scene.config.contacts.lever == "contact_point" else radius
    return touching_springs(
        responses,
        bodies,
        first=particle,
        second=np.full(len(particle), len(bodies.radius)),
        materials=np.column_stack([scene.material[particle], np.concatenate(materials)]),
        normal=table[:, 2:],
        arms=np.column_stack([lever, np.zeros(len(lever))]),
        radius=radius,
        overlap=radius - distance,
    )


def touching_springs(
    responses: Responses,
    bodies: Bodies,
    first: Integers,
    second: Integers,
    materials: Integers,
    normal: Floats,
    arms: Floats,
    radius: Floats,
    overlap: Floats,
) -> Springs:
    """Return the springs of contacts from their effective radii and overlaps, (p,) each in m."""
    stiffness, damping = np.zeros((len(first), 4)), np.zeros((len(first), 4))
    per_mass, per_inertia = np.append(bodies.inverse_mass, 0.0), np.append(bodies.inverse_inertia, 0.0)
    for (a, b), (law, constants, response) in responses.items():
        rows = np.nonzero((materials == (a, b)).all(axis=1))[0]
        each = zip(radius[rows].tolist(), overlap[rows].tolist(), strict=True)
        k = np.array([law.stiffness(constants, R, delta) for R, delta in each], float)
        critical = 2.0 * np.sqrt(k / (per_mass[first[rows]] + per_mass[second[rows]]))
        stiffness[rows, 0], stiffness[rows, 1] = k, response.across * k
        damping[rows, 0], damping[rows, 1] = response.damping_along * critical, response.damping_across * critical
        bending = k * radius[rows] ** 2
        stiffness[rows, 3] = response.rolling * bending
        critical_roll = 2.0 * np.sqrt(bending / (per_inertia[first[rows]] + per_inertia[second[rows]]))
        damping[rows, 3] = response.damping_rolling * critical_roll
    return Springs(first, second, normal, arms, stiffness, damping)


def contact_responses(scene: Scene, plan: Blueprint) -> Responses:
    """Return law, constants and response by pair of materials, in either order; nothing without contacts."""
    if plan.contacts is None or scene.config.contacts is None:
        return {}
    law, chosen = plan.contacts.law, scene.config.contacts.law
    k = int(np.argmin(scene.radius))
    found: Responses = {}
    for a, b, pair in material_pairs(scene):
        constants = law.constants(chosen.params, pair)
        radius, mass = float(scene.radius[k]), float(scene.mass[k])
        response = respond(law, constants, plan.contacts.choices, radius, mass)
        if plan.contacts.rolling is not None:
            rolled = plan.contacts.rolling.constants(scene.config.contacts.rolling.params, pair)
            k_n = law.stiffness(constants, 0.5 * radius, 0.005 * radius)
            shares = rolling_response(plan.contacts.rolling, rolled, plan.contacts.rolling_choices, k_n, radius, mass)
            response = response._replace(rolling=shares[0], damping_rolling=shares[1])
        found[a, b] = found[b, a] = (law, constants, response)
    return found


def pair_numbers(scene: Scene, pairs: Integers) -> Integers:
    """Return one number for each pair of particles, whichever stands first."""
    return np.asarray(np.sort(pairs, axis=1) @ np.array([len(scene.radius), 1]))


def no_springs() -> Springs:
    """Return a table without springs."""
    none = np.zeros(0, np.int64)
    return Springs(none, none, np.zeros((0, 3)), np.zeros((0, 2)), np.zeros((0, 4)), np.zeros((0, 4)))

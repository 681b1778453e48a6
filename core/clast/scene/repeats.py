"""Repeats: whether a scene can repeat itself in the directions in which its domain is periodic.

Nothing may tell one image from the next: sides are long enough that two particles meet at one place only, and walls
and body forces are the same in every image.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.config.beside import WallChoice
from clast.config.scene import SceneConfig
from clast.engine.kernels.layout import MOST_SHRUNK
from clast.engine.skins import LEAST_SKIN
from clast.errors import ConfigError
from clast.maths.box import Box
from clast.maths.vec3 import ZERO, Vec
from clast.scene.held import pull_of
from clast.scene.plan import largest_reach
from clast.scene.scene import Scene, strain_rates
from clast.scene.turning import spins

Floats = NDArray[np.float64]
LONGEST_BOND = 0.4
"""Longest bond at the start as a share of a side: it may stretch by a quarter before its ends are nearer round the
other way."""
PLACES = 64
ALIKE = 1e-9
"""Difference of two distances or accelerations that rounding may make, as a share."""


def most_skin(scene: Scene, box: Box | None = None) -> float:
    """Return how far each particle may go between two searches, in m, so that two are near in one image only.

    Both images of a particle are then farther apart than twice what two particles reach: 4 (r + skin) + 2 reach ≤ side,
    and by a margin more where the box shrinks.

    Parameters
    ----------
    scene : Scene
    box : Box, optional
        As it is now; by default that of the start.
    """
    box = box or scene.box
    if not box.repeats or scene.config.contacts is None:
        return np.inf
    side = float(box.span[box.periodic].min()) / (1.0 + shrinkage(scene))
    return 0.25 * side - float(scene.radius.max()) - 0.5 * largest_reach(scene)


def shrinkage(scene: Scene) -> float:
    """Return the share by which a box may shrink between two searches; 0 where it does not."""
    return MOST_SHRUNK if (strain_rates(scene.config) < 0.0).any() else 0.0


def search_slack(scene: Scene, slack: Floats) -> Floats:
    """Return the slack with which neighbours are searched, (n,) in m: the box may shrink until the next search, too."""
    share = shrinkage(scene)
    return slack if share == 0.0 else slack + share * (scene.radius + slack)


def check_repeats(scene: Scene) -> None:
    """Check that a scene can repeat itself.

    Raises
    ------
    ConfigError
        If a periodic side is too short for its particles or bonds, walls or body forces differ from image to image, or
        something would not go with a box that is stretched.
    """
    if scene.box.repeats:
        _refuse_short_sides(scene)
        _refuse_long_bonds(scene)
        _refuse_uneven_walls(scene)
        _refuse_turned_images(scene)
        _refuse_uneven_forces(scene)
        _refuse_what_stays_behind(scene)


def _refuse_short_sides(scene: Scene) -> None:
    skin, smallest = scene.config.neighbours.skin, float(scene.radius.min())
    least = LEAST_SKIN * smallest if isinstance(skin, str) else 0.5 * skin
    lacking = (least - most_skin(scene)) * (1.0 + shrinkage(scene))
    if lacking > 0.0:
        span = scene.box.span
        axis = int(np.argmin(np.where(scene.box.periodic, span, np.inf)))
        raise _problem(
            scene.config,
            f"a side of {span[axis]:.4g} m along {'xyz'[axis]} is too short: the largest particles, with a radius of "
            f"{scene.radius.max():.4g} m and a skin of {2.0 * least:.4g} m, would meet each other in two images; "
            f"{span[axis] + 4.0 * lacking:.4g} m are the least, twice the distance at which two are neighbours",
        )


def _refuse_long_bonds(scene: Scene) -> None:
    box = scene.box
    share = np.abs(scene.bond_vectors[:, box.periodic]) / box.span[box.periodic]
    if len(share) and share.max() > LONGEST_BOND:
        k, axis = divmod(int(np.argmax(share)), share.shape[1])
        side = float(box.span[box.periodic][axis])
        i, j = scene.ends[k].tolist()
        raise _problem(
            scene.config,
            f"bond {k} of particles {i} and {j} spans {share[k, axis]:.0%} of a side of {side:.4g} m: too much to tell "
            f"which way round it goes. {share[k, axis] / LONGEST_BOND * side:.4g} m are the least",
        )


def _refuse_uneven_walls(scene: Scene) -> None:
    for name, wall in scene.config.walls.items():
        for axis in np.flatnonzero(scene.box.periodic):
            if not _even(wall, scene, int(axis)):
                raise scene.config.problem(
                    ("walls", name),
                    f"this wall is not the same in every image, and the domain is periodic along {'xyz'[axis]}; take a "
                    "wall that goes on along it, such as a plane, or remove the direction from "
                    "boundaries.domain.periodic",
                )


def _even(wall: WallChoice, scene: Scene, axis: int) -> bool:
    """Tell whether a wall is as far from particles as from their images along an axis."""
    step = np.zeros(3)
    step[axis] = scene.box.span[axis]
    asked = scene.position[:: -(-len(scene.position) // PLACES)]
    here = np.array([wall.distance(x) for x in asked])
    there = np.array([wall.distance(x) for x in asked + step])
    return bool(np.all(np.abs(here - there) <= ALIKE * (np.abs(here) + step[axis])))


def _refuse_turned_images(scene: Scene) -> None:
    """Refuse walls that turn about another axis than that of the images: they would tilt, or move apart, for some."""
    for path, motion in scene.config.motions:
        for axis in np.flatnonzero(scene.box.periodic):
            across = spins(motion)[:, np.arange(3) != axis]
            if np.any(across):
                raise scene.config.problem(
                    path,
                    f"the domain is periodic along {'xyz'[axis]}, and what turns about another axis is not the same in "
                    "every image; turn it about that one, or remove the direction from boundaries.domain.periodic",
                )


def _refuse_uneven_forces(scene: Scene) -> None:
    """Refuse body forces that a particle does not feel as its images do, which move on where the box is stretched."""
    x, radius, span = scene.position[0], float(scene.radius[0]), scene.box.span
    for k, chosen in enumerate(scene.config.body_forces):
        numbers = chosen.part.numbers(chosen.params, scene.config.time.mass_scaling)
        here = pull_of(chosen, numbers, _vector(x), ZERO, radius)
        for axis in np.flatnonzero(scene.box.periodic):
            step = span * (np.arange(3) == axis)
            v = _vector(strain_rates(scene.config) * step)
            there = pull_of(chosen, numbers, _vector(x + step), v, radius)
            if np.abs(here - there).max() > ALIKE * np.abs(here).max():
                raise scene.config.problem(
                    ("body_forces", k),
                    f"{chosen.name!r} is not the same in every image, and the domain is periodic along {'xyz'[axis]}; "
                    "remove it, or the direction from boundaries.domain.periodic or strain_rate",
                )


def _vector(place: Floats) -> Vec:
    x, y, z = place.tolist()
    return (x, y, z)


def _refuse_what_stays_behind(scene: Scene) -> None:
    """Refuse walls and damping in a box that is stretched: they do not move with its images."""
    if not strain_rates(scene.config).any():
        return
    for name in scene.config.walls:
        text = "walls are not stretched with the domain; remove them, or boundaries.domain.strain_rate"
        raise scene.config.problem(("walls", name), text)
    if scene.config.damping is not None:
        raise scene.config.problem(
            ("damping",),
            "it brakes velocities, which differ from image to image where boundaries.domain.strain_rate stretches the "
            "domain; take bonds.damping and restitution instead",
        )


def _problem(config: SceneConfig, text: str) -> ConfigError:
    return config.problem(("boundaries", "domain"), text)

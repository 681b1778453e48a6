"""Recipe: how many grains of which size and template, before any of them has a place."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError
from clast.parts.generator import Site
from clast_plugins.generators.filling.counts import MOST_SCALING, Counts, Share, counts
from clast_plugins.generators.filling.dice import random_order
from clast_plugins.generators.filling.fraction import Fraction
from clast_plugins.generators.filling.templates import Template, templates
from clast_plugins.generators.sizes import mean_cube, sizes

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

MOST_OFF = 0.15
"""Share by which the sphere about a template may differ from the fraction's diameter: a flattened grain is wider."""


class Recipe(NamedTuple):
    """Grains in the order in which they are poured.

    ``scale`` (g,) is the size of each over that of its template, ``kind`` (g,) its fraction, ``template`` the template
    of each; ``diameter`` (g,) in m; ``factor`` what all diameters were multiplied by to meet the mass.
    """

    template: list[Template]
    scale: Floats
    kind: Ints
    diameter: Floats
    counts: Counts
    factor: float

    @property
    def mass(self) -> Floats:
        """Mass of each grain in kg, (g,)."""
        whole = np.array([float(each.mass.sum()) for each in self.template])
        return whole * self.scale**3


def shares_of(fractions: Mapping[str, Fraction], mass: Mapping[str, float]) -> list[Share]:
    """Return what is known of every fraction; ``mass`` is that of a grain of its mean diameter in kg."""
    return [
        Share(name, mass[name] * mean_cube(*each.distribution), each.grains, each.share, each.prior)
        for name, each in fractions.items()
    ]


def make_recipe(
    fractions: Mapping[str, Fraction], grains: int | None, mass: float | None, site: Site, stream: np.random.Philox
) -> Recipe:
    """Decide how many grains there are of each fraction, and draw their sizes, templates and order.

    Parameters
    ----------
    fractions : mapping
    grains : int or None
        Number of all grains.
    mass : float or None
        Mass of all grains in kg; all diameters are multiplied by one factor to meet it.

    Raises
    ------
    ConfigError
        Counts that do not add up, or a mass that these grains do not have.
    PackingError
        A template that cannot be packed.
    """
    made = {
        name: _templates(name, each, site, (int(stream.random_raw()), number))
        for number, (name, each) in enumerate(fractions.items())
    }
    mean = {name: float(np.mean([each.mass.sum() for each in kinds])) for name, kinds in made.items()}
    told = counts(shares_of(fractions, mean), grains, mass)
    diameter, scale, template, kind = [], [], [], []
    for k, ((name, each), count) in enumerate(zip(fractions.items(), told.grains.tolist(), strict=True)):
        drawn = sizes(count, *each.distribution)[random_order(stream, count)]
        diameter += drawn.tolist()
        scale += (drawn / each.diameter).tolist()
        template += [made[name][n % len(made[name])] for n in range(count)]
        kind += [k] * count
    order = random_order(stream, len(kind))
    recipe = Recipe(
        template=[template[k] for k in order],
        scale=np.array(scale)[order],
        kind=np.array(kind)[order],
        diameter=np.array(diameter)[order],
        counts=told,
        factor=1.0,
    )
    return recipe if mass is None else _with_mass(recipe, mass)


def _templates(name: str, fraction: Fraction, site: Site, dice: tuple[int, int]) -> list[Template]:
    made = templates(fraction.template, fraction.templates, site, ("fractions", name, "template"), dice)
    wide = 2.0 * float(np.mean([each.reach for each in made]))
    if abs(wide / fraction.diameter - 1.0) > MOST_OFF:
        raise ConfigError(
            f"the template makes grains {1e3 * wide:.4g} mm wide, not {1e3 * fraction.diameter:.4g} mm; give it the "
            "mean diameter of the fraction",
            ("fractions", name, "diameter"),
        )
    return made


def _with_mass(recipe: Recipe, mass: float) -> Recipe:
    """Return a recipe whose grains weigh exactly ``mass`` in kg together."""
    factor = mass_factor(len(recipe.kind), float(recipe.mass.sum()), mass)
    return recipe._replace(scale=factor * recipe.scale, diameter=factor * recipe.diameter, factor=factor)


def mass_factor(grains: int, there: float, mass: float) -> float:
    """Return what diameters are multiplied by so that grains that weigh ``there`` weigh ``mass``, both in kg.

    Raises
    ------
    ConfigError
        If they would change by more than a little.
    """
    factor = float(np.cbrt(mass / there))
    if abs(factor - 1.0) > MOST_SCALING:
        raise ConfigError(
            f"{grains} grains of these sizes weigh {1e3 * there:.4g} g, not {1e3 * mass:.4g} g: diameters would have "
            f"to be {factor:.3f} times as large, and {MOST_SCALING:.0%} at most are changed; give another 'mass' or "
            "other counts, or check density and porosity",
            ("mass",),
        )
    return factor

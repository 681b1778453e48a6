"""All families of cases. To add one: write its file, and name it in ``FAMILIES``."""

from __future__ import annotations

from collections.abc import Collection

from clast.errors import ConfigError
from clast.plugins.nearest import suggestion
from clast.verification.case import Case, Family
from clast.verification.families import (
    beams,
    bond_laws,
    bond_models,
    bonds,
    contact_laws,
    damping,
    fluid,
    impacts,
    meshes,
    oblique_impacts,
    packings,
    periodic,
    rigid_bodies,
    rotations,
    scatter,
    solitary_wave,
    spinning_impacts,
    surroundings,
    time_steps,
    turning_walls,
    waves,
    whole_runs,
)

FAMILIES: tuple[Family, ...] = (
    impacts.FAMILY,
    oblique_impacts.FAMILY,
    spinning_impacts.FAMILY,
    solitary_wave.FAMILY,
    contact_laws.FAMILY,
    bonds.FAMILY,
    bond_models.FAMILY,
    bond_laws.FAMILY,
    scatter.FAMILY,
    beams.FAMILY,
    rotations.FAMILY,
    waves.FAMILY,
    damping.FAMILY,
    fluid.FAMILY,
    time_steps.FAMILY,
    surroundings.FAMILY,
    turning_walls.FAMILY,
    rigid_bodies.FAMILY,
    meshes.FAMILY,
    periodic.FAMILY,
    packings.FAMILY,
    whole_runs.FAMILY,
)


def chosen(cases: Collection[str] = (), families: Collection[str] = ()) -> list[tuple[Family, Case]]:
    """Return the cases of some names and those of some families, in the order of the suite; all, where none is named.

    Raises
    ------
    ConfigError
        No case or no family has a name.
    """
    every = [(family, case) for family in FAMILIES for case in family.cases]
    refuse_unknown("case", cases, {case.name for _, case in every})
    refuse_unknown("family", families, {family.name for family in FAMILIES})
    if not cases and not families:
        return every
    return [(family, case) for family, case in every if case.name in cases or family.name in families]


def refuse_unknown(what: str, names: Collection[str], known: Collection[str]) -> None:
    """Refuse names that nothing has."""
    for name in names:
        if name not in known:
            raise ConfigError(f"no {what} is named {name!r}; {suggestion(name, known)}")

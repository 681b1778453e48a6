"""Columns of the curves that conditions may name, and that a scene may lack."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from clast.config.beside import WallChoice

OF_COMPRESSION = ("displacement_m", "strain", "stress_Pa", "force_upper_N", "force_lower_N")


def wall_columns(names: Iterable[str]) -> list[str]:
    """Return the columns of forces and moments on walls, in their order.

    >>> wall_columns(["lid"])[:4]
    ['force_lid_x_N', 'force_lid_y_N', 'force_lid_z_N', 'moment_lid_x_Nm']
    """
    whats = (("force", "N"), ("moment", "Nm"))
    return [f"{what}_{wall}_{c}_{unit}" for wall in names for what, unit in whats for c in "xyz"]


def stage_columns(walls: Mapping[str, WallChoice]) -> dict[str, int]:
    """Return the columns that tell the stages of motions, and the number of the wall of each."""
    return {f"stage_{name}": k for k, (name, wall) in enumerate(walls.items()) if wall.staged}


def known_columns(walls: Mapping[str, WallChoice], compressed: bool) -> set[str]:
    """Return the columns that conditions may read: time, plates, forces and stages of walls, bonds."""
    plates = OF_COMPRESSION if compressed else ()
    return {"time_s", *plates, *wall_columns(walls), *stage_columns(walls), "bonds_intact", "bonds_broken"}

"""Tables: what :func:`clast.granular.analysis.analyse` finds, as CSV files in SI."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from clast.granular.analysis import Granular, Moment
from clast.granular.crack_maps import CrackMaps
from clast.granular.grading import grading
from clast.granular.profiles import Profile
from clast.results.curves import write

Columns = dict[str, NDArray[np.float64]]


def write_tables(found: Granular, modes: list[str], folder: Path) -> Path:
    """Write all tables into a folder, which is made, and return it.

    Parameters
    ----------
    found : Granular
    modes : list of str
        Names of the crack modes, as in ``Run.crack_modes``.
    folder : Path
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name, columns in tables(found, modes):
        write(folder / f"{name}.csv", columns)
    return folder


def tables(found: Granular, modes: list[str]) -> Iterator[tuple[str, Columns]]:
    """Yield name and columns of each table."""
    moments, cracks = found.moments, found.cracks
    yield "history", found.history
    yield "grading", _joined([_marked(moment, _grading(moment)) for moment in moments])
    yield "fragments", _fragments(moments[-1])
    yield "grains", _grains(found, moments[-1])
    yield "profile_height", _joined([_marked(moment, _profile(moment.height)) for moment in moments])
    shells = [_marked(moment, _profile(moment.radius)) for moment in moments if moment.radius is not None]
    if shells:
        yield "profile_radius", _joined(shells)
    yield "cracks", _cracks(cracks, modes)
    yield "cracks_height", _map(cracks, "height", cracks.height_edges, cracks.by_height)
    yield "cracks_radius", _map(cracks, "radius", cracks.radius_edges, cracks.by_radius)


def _marked(moment: Moment, columns: Columns) -> Columns:
    """Return columns with frame and strain of each row before them."""
    rows = len(next(iter(columns.values())))
    return {"frame": np.full(rows, float(moment.frame)), "strain": np.full(rows, moment.strain)} | columns


def _joined(parts: list[Columns]) -> Columns:
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def _grading(moment: Moment) -> Columns:
    size, alike = moment.pieces.envelope_diameter, np.ones(moment.pieces.count)
    by_number = grading(size, alike)
    return {
        "envelope_diameter_m": moment.grading.size,
        "fragments": np.round(by_number.share * moment.pieces.count),
        "mass_share": moment.grading.share,
        "mass_share_finer": moment.grading.finer,
        "number_share_finer": by_number.finer,
    }


def _fragments(moment: Moment) -> Columns:
    pieces = moment.pieces
    return {
        "grain": pieces.grain.astype(float),
        "primaries": pieces.primaries.astype(float),
        "mass_kg": pieces.mass,
        "diameter_m": pieces.diameter,
        "envelope_diameter_m": pieces.envelope_diameter,
    }


def _grains(found: Granular, moment: Moment) -> Columns:
    grains, hurt = found.grains, moment.damage
    return {
        "grain": np.arange(grains.count, dtype=float),
        "primaries": grains.primaries.astype(float),
        "mass_kg": grains.mass,
        "envelope_m3": grains.envelope,
        "porosity": grains.porosity,
        "bonds": hurt.bonds.astype(float),
        "broken": hurt.broken.astype(float),
        "damage": hurt.damage,
        "largest_share": hurt.largest,
        "state": hurt.state.astype(float),
        "coordination": moment.coordination.astype(float),
    }


def _profile(profile: Profile) -> Columns:
    return {
        "from_m": profile.edges[:-1],
        "to_m": profile.edges[1:],
        "solid": profile.solid,
        "envelope": profile.envelope,
        "coordination": profile.coordination,
    }


def _cracks(cracks: CrackMaps, modes: list[str]) -> Columns:
    by_mode = dict(zip(modes, cracks.by_mode.astype(float), strict=True))
    return {
        f"{cracks.over}_from": cracks.edges[:-1],
        f"{cracks.over}_to": cracks.edges[1:],
        "cracks": cracks.total.astype(float),
        "cumulative": np.cumsum(cracks.total).astype(float),
        "rate": cracks.rate,
        **{f"cracks_{mode}": number for mode, number in by_mode.items()},
    }


def _map(cracks: CrackMaps, place: str, bounds: NDArray[np.float64], counts: NDArray[np.int64]) -> Columns:
    """Return one row for each place and step."""
    places, steps = counts.shape
    return {
        f"{place}_from_m": np.repeat(bounds[:-1], steps),
        f"{place}_to_m": np.repeat(bounds[1:], steps),
        f"{cracks.over}_from": np.tile(cracks.edges[:-1], places),
        f"{cracks.over}_to": np.tile(cracks.edges[1:], places),
        "cracks": counts.ravel().astype(float),
    }

"""Tables of the grains of a run: grading, damage, crack maps and profiles as CSV files in a folder."""

from __future__ import annotations

from pathlib import Path

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.run import Run

FILE = "grains"


class GrainTableParams(Params):
    """Nothing to choose."""


def write_grain_tables(run: Run, params: GrainTableParams, path: Path) -> Written:
    """Write the folder of tables."""
    from clast.granular.analysis import analyse
    from clast.granular.tables import write_tables

    if run.grain.max(initial=-1) < 0:
        return Written(None, "the scene has no grains: none of its particles are packed or bonded together")
    return Written(write_tables(analyse(run), run.crack_modes, path))

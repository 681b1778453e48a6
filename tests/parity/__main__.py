"""Print how closely Clast follows MUSEN in the one- and two-sphere cases: ``python -m tests.parity``."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from tests.parity.columns import NAMES, columns, run
from tests.parity.musen import table


def line(name: str) -> str:
    """Run a case and return its worst column, with and without the first row, which in MUSEN holds no forces."""
    with TemporaryDirectory() as folder:
        ours = columns(name, run(name, Path(folder)))
    theirs = table(f"micro/{name}")
    peaks = {column: np.abs(values).max() for column, values in theirs.items()}
    away = {column: np.abs(ours[column] - theirs[column]) / peaks[column] for column in theirs if peaks[column] > 0.0}
    worst = max(away, key=lambda column: away[column][1:].max())
    return f"| {name} | {worst} | {away[worst][1:].max():.1e} | {max(each.max() for each in away.values()):.1e} |"


if __name__ == "__main__":
    print("| case | worst column | share of its peak | with the first row |\n|---|---|---|---|")
    for name in NAMES:
        print(line(name), flush=True)

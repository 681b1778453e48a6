"""Writer: a table of the bonds that hold, frame by frame."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from clast.parts.params import Params
from clast.parts.writer import Writer, Written
from clast.results.run import Run


class Survivors(Params):
    """CSV with time and number of intact bonds."""


def write(run: Run, params: Survivors, path: Path) -> Written:
    """Count the intact bonds of every frame."""
    frames = [run.frame(k) for k in range(run.n_frames)]
    rows = [f"{frame.time:.9g},{int(np.count_nonzero(frame.bond_intact))}" for frame in frames]
    path.write_text("\n".join(["time_s,bonds", *rows, ""]), encoding="utf-8")
    return Written(path)


PART = Writer("the bonds that hold, as CSV", Survivors, "survivors.csv", write)

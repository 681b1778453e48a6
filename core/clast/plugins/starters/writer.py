"""Starter: a table of how high particles are in every frame."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.parts.params import Params
from clast.parts.writer import Writer, Written
from clast.plugins.registry import Registry
from clast.results.run import Run

CLAST_API = 1


class Starter(Params):
    """CSV with the lowest and the highest centre of each frame."""

    digits: Annotated[int, Field(ge=1, le=17, description="Digits of the numbers")] = 6


def write(run: Run, params: Starter, path: Path) -> Written:
    """Read the run, write ``path``; tell why, where there is nothing to write."""
    if run.n_frames == 0:
        return Written(None, "the run has no frames")
    rows = ["time_s,lowest_m,highest_m"]
    for k in range(run.n_frames):
        frame = run.frame(k)
        z = frame.position[:, 2]
        rows.append(",".join(f"{x:.{params.digits}g}" for x in (frame.time, z.min(), z.max())))
    path.write_text("\n".join([*rows, ""]), encoding="utf-8")
    return Written(path)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the writer."""
    registry.writer("starter", Writer("how high particles are, as CSV", Starter, "starter.csv", write))

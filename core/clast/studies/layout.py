"""Layout: which file of a study lies where in its folder."""

from __future__ import annotations

from pathlib import Path

STUDY = "study.yaml"
RUNS = "runs.csv"
STATISTICS = "statistics.csv"
VERDICTS = "verdicts.csv"
ENSEMBLE = "ensemble.csv"
SOMETIMES = (VERDICTS, ENSEMBLE, "curves.png", "measures.png", "weibull.png")
"""What not every study leaves, and none may leave to the next."""

TABLE = "table.h5"
LIST = "tasks.txt"
STOP = "stop"
"""Its presence asks all runs to stop behind a checkpoint."""


def scene_of(folder: Path, name: str) -> Path:
    """Return the scene file of a run."""
    return folder / "scenes" / f"{name}.yaml"


def failure_of(folder: Path, name: str) -> Path:
    """Return the file that tells why a run failed when it was last tried."""
    return folder / "failed" / f"{name}.txt"


def run_of(folder: Path, name: str) -> Path:
    """Return the folder of a run."""
    return folder / "runs" / name

"""MUSEN's numbers, as they stand in tests/data/musen."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np

DATA = Path(__file__).parents[1] / "data" / "musen"
CASES: dict[str, dict[str, Any]] = json.loads((DATA / "micro" / "micro.json").read_text())["cases"]
"""Inputs and key results of the one- and two-sphere cases."""

Table = dict[str, np.ndarray]


def table(name: str) -> Table:
    """Read the columns of a CSV file."""
    with (DATA / f"{name}.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {column: np.array([float(row[column]) for row in rows]) for column in rows[0]}

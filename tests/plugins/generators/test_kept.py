"""A fill that cannot be kept: one sentence that says why and what helps, and nothing half-written."""

from __future__ import annotations

import resource
from pathlib import Path

import numpy as np
import pytest

from clast.errors import ConfigError
from clast.parts.generator import Packing
from clast_plugins.generators.filling import kept

KEYS = {"seed": 1, "density": {"glass": 1000.0}}


def packing(count: int) -> Packing:
    x = np.random.default_rng(1).random((count, 3))
    grain, fixed = np.arange(count), np.zeros(count, bool)
    return Packing(x, np.full(count, 1e-3), ["glass"] * count, 0.0 * x, 0.0 * x, fixed, grain)


def test_what_is_kept_is_read_again(tmp_path: Path) -> None:
    made = packing(20)
    kept.write(tmp_path / "fill.h5", made, KEYS)
    again = kept.read(tmp_path / "fill.h5", KEYS)
    assert again is not None
    assert again.position.tobytes() == made.position.tobytes()
    assert again.material == made.material


def test_a_full_disk_is_told_in_one_short_line(tmp_path: Path) -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, hard))
    try:
        with pytest.raises(ConfigError) as error:
            kept.write(tmp_path / "fill.h5", packing(10_000), KEYS)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    file = tmp_path / "fill.h5"
    assert str(error.value) == f"{file}: cannot be written (File too large); free some space, or name another file"
    assert not list(tmp_path.iterdir())


def test_a_folder_that_cannot_be_made_asks_for_no_space(tmp_path: Path) -> None:
    (tmp_path / "taken").touch()
    file = tmp_path / "taken" / "fills" / "fill.h5"
    with pytest.raises(ConfigError) as error:
        kept.make_room(file)
    assert str(error.value) == f"{file}: cannot be written (Not a directory); name another file"

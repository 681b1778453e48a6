from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from clast.results.run import Run, open_run
from tests.viz.synthetic_run import small_grain, three_grains, two_spheres, write_run


@pytest.fixture(scope="session")
def grain_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_run(tmp_path_factory.mktemp("runs") / "grain", small_grain())


@pytest.fixture
def grain(grain_folder: Path) -> Iterator[Run]:
    with open_run(grain_folder) as run:
        yield run


@pytest.fixture
def spheres(tmp_path: Path) -> Iterator[Run]:
    with open_run(write_run(tmp_path / "spheres", two_spheres())) as run:
        yield run


@pytest.fixture(scope="session")
def three_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_run(tmp_path_factory.mktemp("runs") / "three", three_grains())


@pytest.fixture
def three(three_folder: Path) -> Iterator[Run]:
    with open_run(three_folder) as run:
        yield run

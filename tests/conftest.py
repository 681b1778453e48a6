"""Settings of the whole suite, and a line at its end: how many step loops were compiled, the slowest part."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

# the same examples in every run: a failure is a change of the code, never of the dice
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")

compiled: list[int] = []
"""Step loops that were compiled by each process of the suite that has ended."""


def loops_compiled_here() -> int:
    """Count the step loops that this process compiled, not those it found on disk."""
    names = [name for name in sys.modules if name.startswith("clast_kernel_") and name.endswith(".step_loop")]
    return sum(sum(sys.modules[name].advance.stats.cache_misses.values()) for name in names)


@pytest.fixture(scope="session")
def bed_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder ``runs/bed`` of twelve grains that were crushed in a tube; to be read, not written."""
    from clast import load, run_scene

    scene = load(Path(__file__).parent / "core" / "granular" / "bed.yaml")
    return run_scene(scene, tmp_path_factory.mktemp("beds") / "runs" / "bed").folder


def pytest_sessionfinish(session: pytest.Session) -> None:
    told = getattr(session.config, "workeroutput", None)
    if told is not None:
        told["loops compiled"] = loops_compiled_here()


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    compiled.append(getattr(node, "workeroutput", {}).get("loops compiled", 0))


def pytest_terminal_summary(terminalreporter: Any) -> None:
    count = loops_compiled_here() + sum(compiled)
    terminalreporter.write_line(f"step loops compiled by the tests themselves, not by programs they start: {count}")

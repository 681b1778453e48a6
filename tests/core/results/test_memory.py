"""The peak of memory is this process's own."""

from __future__ import annotations

import subprocess
import sys

import numpy as np

from clast.results.memory import peak_memory

ASK = "from clast.results.memory import peak_memory; print(peak_memory())"


def test_the_peak_stays_when_memory_is_given_back() -> None:
    before = peak_memory()
    held = np.ones(40_000_000)
    during = peak_memory()
    del held
    assert during > 0.99 * before
    assert peak_memory() > 0.99 * during > 300.0  # the system counts pages roughly


def test_a_large_parent_does_not_count() -> None:
    held = np.ones(40_000_000)
    child = subprocess.run([sys.executable, "-c", ASK], capture_output=True, text=True, check=True)
    assert 1.0 < float(child.stdout) < 300.0 < held.nbytes / 1e6

"""What a reader must know of the machine."""

from __future__ import annotations

import os
import platform
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

from clast.bench.peer import VERSION


class Machine(NamedTuple):
    """Processor, cores, software, and how busy it was when the benchmark began (processes per core)."""

    processor: str
    cores: int
    software: str
    busy: float


def describe() -> Machine:
    """Look at this machine."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    packages = ", ".join(f"{name} {version(name)}" for name in ("clast", "numba", "llvmlite", "numpy"))
    software = (
        f"{platform.system()} {platform.release()}, Python {platform.python_version()}, {packages}, LAMMPS {VERSION}"
    )
    return Machine(_processor(), cores, software, os.getloadavg()[0] / cores)


def _processor() -> str:
    """Return the processor's name, and the widest vectors it has."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    told = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    flags = told.get("flags", "").split()
    vectors = next((name for name in ("avx512f", "avx2", "avx") if name in flags), "no AVX")
    place = f"family {told.get('cpu family', '?')}, model {told.get('model', '?')}"
    return f"{told.get('model name', platform.machine())} ({place}, {vectors})"

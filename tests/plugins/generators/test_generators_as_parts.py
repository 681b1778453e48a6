"""The generators are parts like anybody's: registered by name, and light until they pack."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib import import_module

import pytest

from clast.parts.generator import Generator
from clast.plugins.registry import Registry

NAMES = ("spherical_agglomerate", "flattened_agglomerate", "from_file", "explicit")


@pytest.mark.parametrize("name", NAMES)
def test_each_registers_under_the_name_of_its_file(name: str) -> None:
    registry = Registry()
    import_module(f"clast_plugins.generators.{name}").clast_register(registry)
    part = registry.get("generator", name).part
    assert isinstance(part, Generator)
    assert part.Params.model_json_schema()["properties"]


def test_validating_and_predicting_imports_neither_scipy_nor_numba() -> None:
    script = (
        "import sys\n"
        "from pathlib import Path\n"
        "from clast.parts.generator import Gaps\n"
        f"from clast_plugins.generators import {', '.join(NAMES)}\n"
        "part = spherical_agglomerate\n"
        "given = dict(material='glass', diameter='2 mm', primary_diameter='0.2 mm', porosity=0.5)\n"
        "part.predict(part.SphericalAgglomerate(**given), Path(), Gaps(0.0, 1e-4))\n"
        "print(sorted({'scipy', 'numba', 'pandas'} & set(sys.modules)))\n"
    )
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, env=_environment())
    assert ran.stdout.strip() == "[]"


def _environment() -> dict[str, str]:
    return os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}

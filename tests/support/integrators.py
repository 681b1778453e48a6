"""Integrators to try what holds for all with: the default always, the others in ``make test-all``."""

from __future__ import annotations

import pytest

INTEGRATORS = [
    "midstep",
    pytest.param("leapfrog", marks=pytest.mark.long),
    pytest.param("velocity_verlet", marks=pytest.mark.long),
]

"""Static answers are found where they exist, and asked for in vain where they do not."""

import numpy as np
import pytest

from clast.errors import RunError
from clast.verification import rest
from clast.verification.bench import Bench
from clast.verification.reading import velocity


def test_a_beam_under_a_load_comes_to_rest():
    simulation = Bench("beam_roll_up").start()
    rest.settle(simulation, 1e-4, 200)
    assert rest.residual(simulation).max() < 1e-4
    assert simulation.bonds_broken == 0


def test_what_nothing_holds_does_not_rest(monkeypatch):
    monkeypatch.setattr(rest, "MOST_LOOKS", 20)
    bench = Bench("beam_roll_up")
    simulation = bench.start({"particles.particles.0.fixed": False})
    with pytest.raises(RunError, match=r"does not come to rest: .* of its loads are left"):
        rest.settle(simulation, 1e-8, 200)
    assert np.abs(velocity(simulation)).max() > 0.0

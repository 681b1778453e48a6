"""Whatever two spheres are made of and however they meet: the answer is right, or the scene says why there is none."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.stability.entry import GARBAGE, Answer, Entry, Ran, run_entry
from tests.stability.measures import kinetic, momentum_error
from tests.stability.page import outcome
from tests.stability.scenes import pair
from tests.support.strategies import numbers


@settings(max_examples=25, deadline=None)
@given(
    speed=numbers(-3.0, 2.0).map(lambda power: 10.0**power),
    sizes=st.tuples(numbers(-5.0, -2.0), numbers(-5.0, -2.0)).map(
        lambda powers: (10.0 ** powers[0], 10.0 ** powers[1])
    ),
    stiffer=numbers(-2.0, 4.0).map(lambda power: 10.0**power),
    restitution=numbers(0.0, 1.0),
    friction=numbers(0.0, 10.0),
    spin=numbers(-1e5, 1e5),
    step=numbers(-9.0, -3.0).map(lambda power: 10.0**power),
)
def test_two_spheres_never_end_with_more_energy_or_other_momentum(
    speed: float,
    sizes: tuple[float, float],
    stiffer: float,
    restitution: float,
    friction: float,
    spin: float,
    step: float,
) -> None:
    changes = {
        "materials.second.young_modulus": 100e6 * stiffer,
        "contacts.pairs.default": {"restitution": restitution, "sliding_friction": friction},
        "particles.particles.0.spin": [0, spin, spin],
        "walls.floor.point": [0, 0, -10],
        "time.step": step,
        "time.end": {"steps": 2000},
    }

    def judge(ran: Ran) -> Answer:
        energy = kinetic(ran)
        return Answer("no energy gained", max(energy[-1] / energy[0] - 1.0, momentum_error(ran)), 0.05)

    verdict = run_entry(Entry("two spheres", lambda: pair(speed, sizes, changes=changes), judge))
    assert verdict.kind != GARBAGE, outcome(verdict)

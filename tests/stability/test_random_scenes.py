"""Whatever spheres and grains are made of and meet: the answer is right, or the scene says why there is none."""

from __future__ import annotations

from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from clast.config.scene import SceneConfig, build
from clast.config.yaml_loader import parse_document
from tests.scenes import CRUSH
from tests.stability.entry import ACCURATE, GARBAGE, Answer, Entry, Ran, run_entry
from tests.stability.matrix.steps import UNSTABLE, at_share
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


@settings(max_examples=12, deadline=None, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(
    speed=numbers(-3.0, 1.0).map(lambda power: 10.0**power),
    stiffness=numbers(6.0, 10.0).map(lambda power: 10.0**power),
    yield_strain=numbers(-4.0, -1.0).map(lambda power: 10.0**power),
    breakage_strain=numbers(-4.0, -1.0).map(lambda power: 10.0**power),
    restitution=numbers(0.0, 0.99),
    friction=numbers(0.01, 2.0),
    share=numbers(0.05, 1.0),
)
@example(  # contacts stiffen far beyond the soft bonds, and the step falls behind the limit
    speed=0.1, stiffness=1e6, yield_strain=0.1, breakage_strain=0.1, restitution=0.0, friction=1.0, share=0.5
)
def test_a_grain_between_plates_never_holds_more_than_it_was_given(
    speed: float,
    stiffness: float,
    yield_strain: float,
    breakage_strain: float,
    restitution: float,
    friction: float,
    share: float,
) -> None:
    grain = pressed(speed, stiffness, yield_strain, breakage_strain, restitution, friction)
    verdict = run_entry(Entry("a grain", lambda: at_share(grain.changed, share, {}), ledger_closes))
    assert verdict.kind != GARBAGE, outcome(verdict)


def test_a_soft_grain_that_may_outgrow_its_step_holds_no_more_than_it_was_given() -> None:
    """Contacts stiffen until the step is almost three times the limit, and dissipate what that gives."""
    grain = pressed(speed=0.1, stiffness=1e6, yield_strain=0.1, breakage_strain=0.1, restitution=0.0, friction=1.0)
    verdict = run_entry(Entry("a soft grain", lambda: at_share(grain.changed, 0.5, UNSTABLE), ledger_closes))
    assert verdict.kind == ACCURATE, outcome(verdict)


def pressed(
    speed: float, stiffness: float, yield_strain: float, breakage_strain: float, restitution: float, friction: float
) -> SceneConfig:
    """Return the small crush with other numbers."""
    changes = {
        "walls.upper.motion.velocity": [0, 0, -speed],
        "bonds.model.young_modulus": stiffness,
        "bonds.model.yield_stress": stiffness * yield_strain,
        "bonds.model.breakage_strain": breakage_strain,
        "contacts.pairs.default": {
            "restitution": restitution,
            "sliding_friction": friction,
            "rolling_friction": friction,
        },
        "time.end": {"steps": 2000},
        "output": {"samples": 100, "frames": 0, "writers": [], "ledger": True},
    }
    return build(parse_document(CRUSH)).changed(changes)


def ledger_closes(ran: Ran) -> Answer:
    """Judge what the ledger leaves, as a share of what came in."""
    curves = ran.curves
    given = abs(curves["energy_walls_J"][-1]) + curves["energy_start_J"][-1]
    return Answer("the energy ledger closes", abs(curves["energy_error_J"][-1]) / given, 0.05)

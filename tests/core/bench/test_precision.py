"""Problems converge, every installed scheme is tried, and what was measured can be told again without measuring."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from clast.bench import following, store
from clast.bench.following import Following
from clast.bench.machine import Machine
from clast.bench.precision.claim import cpu_for, gain, gains, rounded_up, sentence
from clast.bench.precision.problems import CHAIN, ELASTIC, IMPACT, PAIR, PROBLEMS
from clast.bench.precision.sections import SECTIONS, verdict
from clast.bench.precision.sweep import Point, Series, Swept, observed, relative, sweep
from clast.bench.precision.theory import fitted_order, oscillator_order
from clast.bench.section import Effort, Task
from clast.bench.store import Record
from clast.bench.suite import chosen
from clast.commands import bench as bench_command
from clast.errors import ConfigError
from clast.plugins.discovery import discover
from clast.simulation import Simulation

THIRD_PARTY = Path(__file__).with_name("third_party.py")
HERE = Machine("a processor", 2, "some software", 0.0)


def task(files=(), folder=Path()):
    return Task(Effort.QUICK, discover(files), tuple(files), None, "no peer here", folder)


def series(*points, way=None, floor=0.0, program="Clast"):
    return Series(program, way or {"integrator": "midstep"}, [Point(*each) for each in points], floor)


def swept():
    mine = series((10, 1e-2, 0.1), (20, 2.5e-3, 0.2), (40, 6.25e-4, 0.4))
    other = series((10, 1e-1, 0.1), (20, 5e-2, 0.2), (40, 2.5e-2, 0.4), way={"integrator": "leapfrog"})
    return Swept({"integrator": "midstep"}, 1, 1.0, 1000, [other, mine])


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda p: p.name)
def test_every_instant_falls_on_a_step(problem):
    assert problem.scene().name == problem.name
    for steps in (*problem.steps, problem.fine, problem.fine // 2):
        assert steps % problem.instants == 0
    assert problem.fine >= 4 * problem.steps[-1]


def test_a_plugins_integrator_is_tried_by_being_there():
    installed = {each["integrator"] for each in CHAIN.ways(task().registry.names)}
    assert {"midstep", "leapfrog", "velocity_verlet"} <= installed
    with_plugin = {each["integrator"] for each in CHAIN.ways(task([THIRD_PARTY]).registry.names)}
    assert with_plugin - installed == {"position_verlet"}


def test_a_plugins_integrator_is_measured_and_named_in_the_section(tmp_path):
    few = dataclasses.replace(CHAIN, steps=(160, 320, 640, 1280, 2560), fine=10240, copies=2)
    only = task([THIRD_PARTY], tmp_path)
    way = {"integrator": "position_verlet"}
    names = only.registry.names
    only.registry.names = lambda kind: ["position_verlet"] if kind == "integrator" else names(kind)
    (found,) = sweep(few, only)
    assert found.way == way
    assert found.problem == ""
    assert len(found.points) == 3  # a quick sweep leaves out the two finest
    assert found.expected == 1.0
    assert found.points[-1].error < found.points[0].error < 0.1
    section = next(each for each in SECTIONS if each.name == "chain")
    text = section.text(Swept(few.own, 2, few.end, few.fine, [found]), tmp_path / "img")
    assert "position_verlet" in text
    assert (tmp_path / "img" / "error_chain.png").stat().st_size > 10_000


@pytest.mark.long
def test_midstep_keeps_its_order_where_damping_takes_that_of_the_others():
    fine, errors = {}, {}
    for name in ("midstep", "velocity_verlet"):
        seen = {n: observed(CHAIN, task(), {"integrator": name}, n) for n in (320, 640, 20480)}
        fine[name] = seen.pop(20480)
        errors[name] = [relative(values, fine[name]) for values in seen.values()]
    assert relative(fine["velocity_verlet"], fine["midstep"]) < 2e-3
    assert errors["midstep"][0] / errors["midstep"][1] > 2.5
    assert errors["velocity_verlet"][0] / errors["velocity_verlet"][1] < 2.5


@pytest.mark.long
def test_impacts_are_over_at_the_end():
    early, late = (
        observed(dataclasses.replace(IMPACT), task(), {"integrator": "midstep"}, steps) for steps in (800, 3200)
    )
    assert (late[:, 2] > 0.0).all()
    assert relative(early, late) < 2e-3


@pytest.mark.long
@pytest.mark.parametrize("kinematics", ["total", "incremental"])
def test_the_bonded_pair_converges_quadratically_to_one_motion_with_every_integrator(kinematics):
    fine = observed(PAIR, task(), {"integrator": "midstep", "bond_kinematics": kinematics}, 20480)
    for integrator in ("midstep", "leapfrog", "velocity_verlet"):
        way = {"integrator": integrator, "bond_kinematics": kinematics}
        coarse, half, quarter = (relative(observed(PAIR, task(), way, n), fine) for n in (320, 640, 1280))
        assert coarse / half == pytest.approx(4.0, rel=0.1)
        assert half / quarter == pytest.approx(4.0, rel=0.1)


def test_orders_are_fitted_where_the_reference_can_tell():
    steps = [10, 20, 40, 80, 160]
    errors = [0.5, *(8.0 * n**-2.0 for n in steps[1:4]), 3e-5]
    assert fitted_order(steps, errors, floor=1e-5) == pytest.approx(2.0)
    assert fitted_order(steps, [0.5] * 5) is None


@pytest.mark.parametrize(("name", "order"), [("midstep", 2.0), ("leapfrog", 1.0), ("velocity_verlet", 1.0)])
def test_theory_knows_which_schemes_lag(name, order):
    stages = discover().get("integrator", name).part.stages
    assert oscillator_order(stages, 0.2) == order


def test_time_for_an_error_lies_on_the_line_between_runs():
    line = series((10, 1e-2, 0.1), (20, 1e-4, 1.0))
    assert cpu_for(line, 1e-3) == pytest.approx(np.sqrt(0.1))
    assert cpu_for(line, 1e-1) == 0.1
    assert cpu_for(line, 1e-5) is None


def test_the_claim_compares_where_the_slower_still_gets():
    found = gain(swept())
    assert (found.fast.label, found.slow.label, found.error) == ("midstep", "leapfrog", 0.03)
    assert sentence(found) == "At an error of 3 %, midstep needs 3.3 times less CPU time than leapfrog"
    assert rounded_up(2.5e-2) == pytest.approx(0.03)


def beside_lammps(*points):
    other = series(*points, way={}, program="LAMMPS")
    other.fit()
    mine = series((10, 1e-3, 0.1), (20, 2.5e-4, 0.2))
    return Swept(mine.way, 1, 1.0, 1000, [mine, other])


def test_what_is_asked_beside_lammps_is_decided_at_every_error_that_both_reach():
    found = beside_lammps((10, 4e-2, 0.5), (20, 2e-2, 1.0), (40, 1e-2, 2.0), (80, 5e-3, 4.0))
    assert [each.times for each in gains(found)] == pytest.approx([5.0, 10.0, 20.0, 40.0])
    assert verdict(found).startswith(" Over the errors that both reach, 4 % to 0.5 %, it is 5.0 to 40 times.")
    assert verdict(found).endswith("10 times; here met from an error of 2 % down.")
    slowly = beside_lammps((10, 4e-2, 0.1), (20, 2e-2, 0.2), (40, 1e-2, 0.4))
    assert verdict(slowly).endswith("here **missed**.")


def test_two_runs_beside_lammps_decide_nothing():
    assert "not decided here" in verdict(beside_lammps((10, 4e-2, 5.0), (20, 2e-2, 9.0)))


def test_the_coarsest_step_of_the_elastic_grain_is_the_largest_that_is_stable_to_the_end():
    coarsest = ELASTIC.steps[0]
    simulation = Simulation(ELASTIC.scene().changed(ELASTIC.changes({}, coarsest)), 1)
    simulation.advance_to(coarsest)
    assert coarsest - ELASTIC.instants < ELASTIC.end / simulation.stable_step() <= coarsest
    assert ELASTIC.steps == tuple(coarsest * 2**k for k in range(len(ELASTIC.steps)))


def test_errors_below_what_the_reference_knows_do_not_count():
    line = series((10, 1e-2, 0.1), (20, 1e-3, 0.2), (40, 1e-4, 0.4), floor=1e-4)
    assert cpu_for(line, 2e-4) is None


def test_the_page_is_written_again_from_what_was_kept(tmp_path):
    page = tmp_path / "benchmarks.md"
    section = next(each for each in SECTIONS if each.name == "chain")
    store.keep(bench_command.results(page), section, Record("chain", "clast bench", "quick", HERE, 60.0, swept()))
    bench_command.render(page)
    told = page.read_text()
    assert "midstep needs 3.3 times less CPU time than leapfrog" in told
    assert "a processor, 2 cores" in told
    first = store.find(bench_command.results(page), section)
    assert first.result == swept()


def test_a_failing_section_is_told_and_the_others_go_on(tmp_path):
    def fail(_):
        raise ValueError("no luck today")

    broken = dataclasses.replace(SECTIONS[0], measure=fail)
    fine = dataclasses.replace(SECTIONS[1], measure=lambda _: swept())
    page = tmp_path / "benchmarks.md"
    assert not bench_command.bench([broken, fine], Effort.QUICK, "none", (), "clast bench", page)
    told = page.read_text()
    assert "ValueError: no luck today" in told
    assert "midstep needs 3.3 times" in told


def test_the_share_of_following_the_stable_step_is_told_beside_its_target():
    told = [following.text(Following(80_000, 8, looks, 9.0), Path()) for looks in (0.045, 0.18)]
    assert "0.50 % of the run (target < 1 %: met)" in told[0]
    assert "2.00 % of the run (target < 1 %: **missed**)" in told[1]


def test_results_of_another_kind_are_refused(tmp_path):
    page = tmp_path / "benchmarks.md"
    bench_command.results(page).mkdir()
    (bench_command.results(page) / "chain.json").write_text("{}")
    with pytest.raises(ConfigError, match=r"chain\.json: .*measure again: clast bench --only chain"):
        bench_command.render(page)


def test_unknown_sections_are_refused():
    with pytest.raises(ConfigError, match="did you mean 'chain'"):
        chosen(["chian"])

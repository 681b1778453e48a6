"""The peer on problems that it can compute too: the bonded pair and the elastic grain."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from clast.bench import peer as lammps
from clast.bench.measure import BenchmarkError, run_child, say
from clast.bench.peer import Peer, data_text
from clast.bench.precision.problem import Problem
from clast.bench.precision.sweep import Point, Series, relative
from clast.bench.scenes import NUMBERS, Body
from clast.bench.section import Effort, Task
from clast.bench.throughput import PEER
from clast.building import build_scene
from clast.engine.state import Floats

ORDER = 2.0
FINER = 8
"""Steps of the peer's reference, as a multiple of its finest; with 4 an error of first order would be no more than
three times as large as what the reference is known to."""
NEVER = 1e12
"""Strength of a bond that does not break, in Pa."""

PAIR = """\
units si
atom_style bpm/sphere
newton on off
boundary f f f
comm_modify vel yes cutoff 1e-3
read_data {name}.data
special_bonds lj 0 1 1 coul 1 1 1
neighbor 1e-4 bin
neigh_modify delay 0 every 1 check yes
pair_style zero 3e-4
pair_coeff * *
bond_style bpm/rotational smooth no normalize yes
bond_coeff 1 {bond}
timestep {step:.17g}
fix move all nve/bpm/sphere
thermo 100000000
thermo_modify lost ignore lost/bond ignore
{look}
run {steps}
"""
LOOK_AT_CENTRES = """\
dump seen all custom {every} {name}.seen id x y z
dump_modify seen sort id format float %.17g"""
LOOK_AT_FORCE = """\
variable push equal abs(c_push)
fix seen all print {every} "$(v_push:%.17g)" file {name}.seen screen no title ''"""


class Run(NamedTuple):
    """What a run of the peer saw, (instants, ...), and the CPU s of its loop."""

    seen: Floats
    cpu_s: float


def sweep(problem: Problem, task: Task) -> Series:
    """Run the peer at every step, against its own finest steps."""
    assert task.peer is not None
    steps = problem.steps[:-2] if task.effort is Effort.QUICK else problem.steps
    compute = COMPUTED[problem.name]
    series = Series(PEER, {}, expected=min(ORDER if problem.damping_ratio == 0.0 else 1.0, problem.kinks))
    fine = compute(task.peer, problem, FINER * problem.steps[-1], 1, task.folder).seen
    series.floor = relative(compute(task.peer, problem, FINER // 2 * problem.steps[-1], 1, task.folder).seen, fine)
    for n in steps:
        try:
            alone = compute(task.peer, problem, n, 1, task.folder)
            many = alone if problem.copies == 1 else compute(task.peer, problem, n, problem.copies, task.folder)
            series.points.append(Point(n, relative(alone.seen, fine), many.cpu_s))
        except BenchmarkError as error:
            series.problem = f"{n} steps: {str(error).splitlines()[-1]}"
    series.fit()
    say(f"{problem.name}: {PEER}: error {series.points[-1].error:.1e} in {series.points[-1].cpu_s:.2f} CPU s")
    return series


def pair(peer: Peer, problem: Problem, steps: int, copies: int, folder: Path) -> Run:
    """Run bonded pairs; one alone is looked at, many are timed."""
    scene = build_scene(problem.scene(copies))
    body = Body("pair", scene.position, scene.ends, float(scene.diameter[0]))
    velocities = [
        f"{k + 1} " + " ".join(f"{each:.17g}" for each in (*v, *w))
        for k, (v, w) in enumerate(zip(scene.velocity, scene.spin, strict=True))
    ]
    (folder / "pair.data").write_text(data_text(body) + "\n".join(["", "Velocities", "", *velocities, ""]))
    every = steps // problem.instants
    look = "" if copies > 1 else LOOK_AT_CENTRES.format(every=every, name="pair")
    told = {"name": "pair", "bond": lammps.bond_text(body, NEVER), "step": problem.end / steps, "steps": steps}
    cpu = timed(peer, PAIR.format(look=look, **told), "pair", folder)
    if copies > 1:
        return Run(np.empty(0), cpu)
    seen = read_centres(folder / "pair.seen", len(scene.position))
    if len(seen) != problem.instants + 1:
        raise BenchmarkError(f"{PEER} lost the pair")
    return Run(seen, cpu)


def elastic(peer: Peer, problem: Problem, steps: int, copies: int, folder: Path) -> Run:
    """Press the grain; it is looked at and timed in the same run, as it is seldom looked at."""
    config = problem.scene()
    scene = build_scene(config)
    body = Body("elastic", scene.position, scene.ends, float(scene.diameter[0]))
    (folder / "elastic.data").write_text(data_text(body))
    walls = config.resolved()["walls"]
    look = LOOK_AT_FORCE.format(every=steps // problem.instants, name="elastic")
    text = lammps.INPUT[: lammps.INPUT.index("run ${")].format(
        name="elastic",
        reach=1.5 * body.lengths.max(),
        skin=NUMBERS.skin_per_diameter * body.diameter,
        contact=lammps.contact_text(),
        bond=lammps.bond_text(body),
        step=problem.end / steps,
        speed=-walls["upper"]["motion"]["velocity"][2],
        bottom=walls["lower"]["point"][2],
        top=walls["upper"]["point"][2],
    )
    cpu = timed(peer, f"{text}{look}\nrun {steps}\n", "elastic", folder)
    seen = np.loadtxt(folder / "elastic.seen", ndmin=1)[-problem.instants :]
    if len(seen) != problem.instants or not np.isfinite(seen).all():
        raise BenchmarkError(f"{PEER} lost the grain")
    return Run(seen, cpu)


COMPUTED: dict[str, Callable[[Peer, Problem, int, int, Path], Run]] = {"pair": pair, "elastic": elastic}
"""What the peer can compute, by the problem's name."""


def timed(peer: Peer, text: str, name: str, folder: Path) -> float:
    """Run an input and return the CPU s of its loop, as its log tells them."""
    (folder / f"{name}.lammps").write_text(text)
    log = folder / f"{name}.log"
    command = [str(peer.program), "-in", f"{name}.lammps", "-log", str(log), "-screen", "none"]
    run_child(command, folder, peer.environment())
    return loop_seconds(log.read_text())


def loop_seconds(log: str) -> float:
    r"""Return wall time of the loop times the share of a processor that it got.

    >>> loop_seconds("Loop time of 2.5 on 1 procs for 9 steps with 2 atoms\n98.0% CPU use with 1 MPI tasks")
    2.45
    """
    wall = re.search(r"Loop time of (\S+) on", log)
    share = re.search(r"([\d.]+)% CPU use", log)
    if wall is None:
        raise BenchmarkError(f"{PEER} did not finish: {log.strip().splitlines()[-1] if log.strip() else 'no log'}")
    return float(wall[1]) * (float(share[1]) / 100.0 if share else 1.0)


def read_centres(file: Path, particles: int) -> Floats:
    """Return the frames of a dump, (frames, particles, 3)."""
    rows = [line.split() for line in file.read_text().splitlines()]
    centres = [[float(each) for each in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()]
    return np.array(centres).reshape(-1, particles, 3)

"""Whole runs: what must hold whatever happens."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from clast.engine.ledger import Ledger
from clast.results import checkpoint
from clast.results.fragments import fragments
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.curves import Floats
from clast.verification.families.bonds import farthest, motion
from clast.verification.finding import Finding
from clast.verification.reading import follow, position, spin, velocity
from clast.verification.sketch import Line, Sketch

Integers = NDArray[np.int64]

LOOK = 50
"""Steps between two looks."""

ROUNDING = 1e-11
"""What rounding may change, as a share."""

CLOSURE = 1e-4
"""What the energy ledger may leave, as a share."""


def judge_momentum(bench: Bench) -> Findings:
    """Follow momentum and angular momentum through a collision in which much breaks."""
    simulation = bench.start()
    linear, angular = follow(simulation, momenta, LOOK)
    shares = []
    for name, total in (("momentum", linear), ("angular momentum", angular)):
        size = np.linalg.norm(total[0].sum(axis=0))
        shares.append(np.linalg.norm(total.sum(axis=1) - total[0].sum(axis=0), axis=1) / size)
        yield Finding(f"{name}: largest change, share", 0.0, float(shares[-1].max()), ROUNDING, True)
    time = 1e3 * simulation.dt * np.minimum(LOOK * np.arange(len(linear)), simulation.last_step)
    lines = [Line(f"one cube, {c}", time, 1e6 * linear[:, 0, a]) for a, c in enumerate("xyz")]
    lines += [Line(f"both, {c}", time[::10], 1e6 * linear[::10].sum(axis=1)[:, a], True) for a, c in enumerate("xyz")]
    broken = f"{simulation.bonds_broken} of {len(simulation.scene.ends)} bonds break"
    yield Sketch(f"two cubes that collide: {broken}", "time, ms", "momentum, mg m/s", tuple(lines))
    floor = 1e-17  # where nothing at all has changed
    changes = zip(("momentum", "angular momentum"), shares, strict=True)
    yield Sketch(
        "rounding",
        "time, ms",
        "change, share",
        tuple(Line(name, time[1:], np.maximum(share[1:], floor)) for name, share in changes),
        logarithmic=True,
    )


def momenta(simulation: Simulation) -> tuple[Floats, Floats]:
    """Return momentum and angular momentum of both cubes, (2, 3) each."""
    scene = simulation.scene
    x, v, w = position(simulation), velocity(simulation), spin(simulation)
    m, inertia = scene.mass[:, None], (0.4 * scene.mass * scene.radius**2)[:, None]
    halves = (2, len(m) // 2, 3)
    angular = m * np.cross(x, v) + inertia * w
    return (m * v).reshape(halves).sum(axis=1), angular.reshape(halves).sum(axis=1)


def judge_ledger(bench: Bench) -> Findings:
    """Book all energy through the collision; what is stored and what is dissipated make up what there was."""
    simulation = bench.start({"output.ledger": True})
    books = (
        follow(simulation, lambda at: np.array([*summed_up(at.ledger()).values()]), LOOK) / simulation.ledger().start
    )
    error = float(np.abs(books[:, -1]).max())
    yield Finding("energy missing or too much: largest share", 0.0, error, CLOSURE, True)
    time = 1e3 * simulation.dt * np.minimum(LOOK * np.arange(len(books)), simulation.last_step)
    names = [*summed_up(simulation.ledger())][:-1]
    lines = [Line(name, time, books[:, k]) for k, name in enumerate(names)]
    lines.append(Line("all", time[::10], books[::10, :-1].sum(axis=1), True))
    yield Sketch("where the energy stays", "time, ms", "share of the energy at the start", tuple(lines))


def summed_up(ledger: Ledger) -> dict[str, float]:
    """Return the terms of a ledger that a picture shows, in J, and last its error."""
    friction = ledger.sliding + ledger.rolling + ledger.contact_stiffening
    return {
        "kinetic": ledger.kinetic,
        "elastic": ledger.contact_elastic + ledger.bond_elastic,
        "broken bonds": ledger.broken + ledger.plastic + ledger.drops,
        "friction": friction,
        "dashpots": ledger.contact_viscous + ledger.bond_viscous,
        "error": ledger.error,
    }


def judge_neighbours(bench: Bench) -> Findings:
    """Run once more with other neighbour lists: by another search, and with more and less reach."""
    reference = motion(bench.run())
    searches = [name for name in bench.scene().registry.names("neighbour_search") if name != "auto"]
    variants = {name: {"neighbours": {"type": name}} for name in searches} | {
        "a short reach": {"neighbours": {"skin": "0.1 mm"}},
        "a long reach": {"neighbours": {"skin": "2 mm"}},
    }
    for name, changes in variants.items():
        simulation = bench.run(changes)
        difference = max(farthest(a, b) for a, b in zip(reference, motion(simulation), strict=True))
        yield Finding(f"{name}: difference of any position, velocity, spin", 0.0, difference, 0.0, True)


def judge_resume(bench: Bench) -> Findings:
    """Stop half-way, go on from the checkpoint in a new simulation, and compare with the run that was never stopped."""
    whole, stopped, resumed = bench.run(), bench.start(), bench.start()
    stopped.advance_to(stopped.last_step // 2)
    with TemporaryDirectory() as folder:
        checkpoint.save(Path(folder), stopped, {})
        checkpoint.load(Path(folder), resumed)
    resumed.advance_to(resumed.last_step)
    difference = max(farthest(a, b) for a, b in zip(motion(whole), motion(resumed), strict=True))
    yield Finding("resumed half-way: difference of any position, velocity, spin", 0.0, difference, 0.0, True)


def judge_threads(bench: Bench) -> Findings:
    """Share the steps among more and more threads."""
    reference = motion(bench.run(threads=1))
    for threads in (2, 3):
        difference = max(farthest(a, b) for a, b in zip(reference, motion(bench.run(threads=threads)), strict=True))
        yield Finding(f"{threads} threads: difference of any position, velocity, spin", 0.0, difference, 0.0, True)


def judge_fragments(bench: Bench) -> Findings:
    """Tell what hangs together after a collision, and walk from particle to particle along the bonds that hold."""
    simulation = bench.run()
    ends, holds = simulation.scene.ends, simulation.bond_loads()[:, 0] == 1.0
    got, expected = fragments(len(simulation.scene.mass), ends, holds), walked(len(simulation.scene.mass), ends[holds])
    yield Finding("fragments", float(expected.max() + 1), float(got.max() + 1), 0.0)
    yield Finding("particles in another fragment", 0.0, float(np.count_nonzero(got != expected)), 0.0, True)


def walked(count: int, ends: Integers) -> Integers:
    """Return the fragment number of each particle, found by walking along (m, 2) bonds."""
    reach: list[list[int]] = [[] for _ in range(count)]
    for a, b in ends.tolist():
        reach[a].append(b)
        reach[b].append(a)
    number = np.full(count, -1)
    for start in range(count):
        ahead, fragment = [start] if number[start] < 0 else [], number.max() + 1
        while ahead:
            here = ahead.pop()
            if number[here] < 0:
                number[here] = fragment
                ahead += reach[here]
    return number


FAMILY = Family(
    "whole_runs",
    "Whole runs",
    "Two free cubes of bonded spheres collide off-centre and spinning: bonds break, pieces touch, slide and roll. "
    "Momentum and angular momentum change by rounding only, and the energy that is stored and dissipated, each "
    "term booked by itself, makes up what there was. How neighbours are found, how many threads share the steps "
    "(those of a larger grain that hits a plate), and whether a run is stopped and resumed, changes not a bit.",
    (
        Case(
            "run_momentum",
            "momentum and angular momentum of what collides and breaks",
            "run_clusters",
            judge_momentum,
            "forces and torques come in pairs: Newton's third law",
        ),
        Case(
            "run_ledger",
            "the energy of what collides, rubs and breaks",
            "run_clusters",
            judge_ledger,
            "energy is conserved; no term is computed as the rest",
            (needs.losses,),
        ),
        Case(
            "run_neighbours",
            "any neighbour lists give the same run",
            "run_clusters",
            judge_neighbours,
            "the same bits: lists only tell which pairs may touch",
        ),
        Case(
            "run_resume",
            "a run that is stopped and resumed is the same run",
            "run_clusters",
            judge_resume,
            "the same bits",
        ),
        Case(
            "run_threads",
            "any number of threads gives the same run",
            "run_large",
            judge_threads,
            "the same bits",
        ),
        Case(
            "run_fragments",
            "what still hangs together",
            "run_clusters",
            judge_fragments,
            "the connected components of the graph of bonds, found by a walk; Clast's come from scipy.sparse.csgraph",
        ),
    ),
)

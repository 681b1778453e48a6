"""Damping of motion: how much of a swing it takes, and where it leaves what swung."""

from __future__ import annotations

from math import log, pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.asking import Asking
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.curves import Floats
from clast.verification.families.bonds import beam_of
from clast.verification.finding import Finding, worst
from clast.verification.reading import follow, orientation, position
from clast.verification.sketch import Line, Sketch

SWINGS = 6
"""Swings, each of half a period, that are compared."""

LOOKS = 5
"""Looks at the forces in each swing."""

SHARE, STATICS = 1e-3, 1e-5
"""Accuracy of what a swing keeps, with a thousand steps of a period, and of what is left at rest."""


def judge_local(bench: Bench) -> Findings:
    """Compare swing after swing, and the rest, with closed forms of a spring that is 1 - α and 1 + α times as stiff."""
    simulation = bench.start()
    scene, beam, config = simulation.scene, beam_of(simulation.scene), simulation.scene.config
    gravity: Any = config.body_forces[0].params
    weight = float(scene.mass[1]) * float(np.linalg.norm(gravity.acceleration))
    sag = weight / beam.axial
    _, half, kept = swing_of(simulation)
    places, turns = follow(simulation, lambda at: (position(at)[1, 2], twist(at)))
    time, offset = simulation.dt * np.arange(len(places)), places[0] - places - sag
    for name, swing in (("sagging", offset), ("twisting", turns)):
        sizes = np.abs(swing[turning(swing)])
        shares = (sizes[1 : SWINGS + 1] / sizes[:SWINGS]).tolist()
        yield worst((Finding("share of a swing that the next keeps", kept, x, SHARE) for x in shares), f"{name}: ")
    met = time[turning(offset)[SWINGS - 1]] / SWINGS
    yield Finding("sagging: time of a swing, s", half, float(met), SHARE)
    yield Finding("sagging: displacement at rest, m", sag, float(places[0] - places[-1]), STATICS)
    books = simulation.ledger()
    spun = 0.2 * float(scene.mass[3]) * float(scene.radius[3] * scene.spin[3, 2]) ** 2
    yield Finding("heat of the damping, J", weight * sag + spun, books.braked, SHARE)
    yield Finding("energy missing or too much, share", 0.0, books.closure, SHARE, True)
    swung = np.linspace(0.0, SWINGS, SWINGS + 1)
    turned = Line("closed form: where it turns", 1e3 * half * swung, -np.power(-kept, swung), dots=True)
    shown = slice(0, int((SWINGS + 0.5) * half / simulation.dt))
    lines = (Line("Clast", np.asarray(1e3 * time[shown]), np.asarray(offset[shown] / sag)), turned)
    yield Sketch("a sphere sags under its weight", "time, ms", "distance from rest, share of the sag", lines)


def judge_rest(bench: Bench) -> Findings:
    """See when the spheres count as at rest: once the last swing's forces are below the limit."""
    limit = 1e-3
    simulation = bench.start({"stop": [{"type": "at_rest", "limit": limit, "samples": LOOKS}]})
    alpha, half, kept = swing_of(simulation)
    simulation.run([Asking(simulation, round(half / LOOKS / simulation.dt))])
    swings = log(limit / (1.0 + alpha)) / log(kept)
    yield Finding("time at which it counts as at rest, s", swings * half, simulation.time, 0.1)
    yield Finding("ended by a condition", 1.0, float(simulation.ended is not None), 0.0)


def judge_fire(bench: Bench) -> Findings:
    """Compare where a hanging row comes to rest, and what was taken from it on the way, with statics."""
    simulation = bench.start()
    scene, k, config = simulation.scene, beam_of(simulation.scene).axial, simulation.scene.config
    gravity: Any = config.body_forces[0].params
    weights = scene.mass[1:] * float(np.linalg.norm(gravity.acceleration))
    sags = np.cumsum(np.cumsum(weights[::-1])[::-1] / k)
    before = position(simulation)[1:, 2]
    simulation.advance_to(simulation.last_step)
    met = before - position(simulation)[1:, 2]
    pairs = zip(sags.tolist(), met.tolist(), strict=True)
    yield worst(Finding("displacement at rest, m", sag, found, STATICS) for sag, found in pairs)
    books = simulation.ledger()
    yield Finding("heat of the damping, J", 0.5 * float(weights @ sags), books.braked, SHARE)
    yield Finding("energy missing or too much, share", 0.0, books.closure, SHARE, True)


def swing_of(simulation: Simulation) -> tuple[float, float, float]:
    """Return α, the time of a swing in s, and the share of it that the next keeps."""
    scene = simulation.scene
    assert scene.config.damping is not None
    damping: Any = scene.config.damping.params
    alpha = float(damping.factor)
    half = 0.5 * pi * sqrt(float(scene.mass[1]) / beam_of(scene).axial)
    return alpha, half * (1.0 / sqrt(1.0 - alpha) + 1.0 / sqrt(1.0 + alpha)), sqrt((1.0 - alpha) / (1.0 + alpha))


def twist(simulation: Simulation) -> float:
    """Return by which angle the second sphere is turned about its bond, in rad."""
    return 2.0 * float(np.arcsin(orientation(simulation)[3, 3]))


def turning(values: Floats) -> NDArray[np.intp]:
    """Return the places at which a swing turns back after its start."""
    grown = np.diff(values)
    return np.nonzero(grown[1:] * grown[:-1] < 0.0)[0] + 1


FAMILY = Family(
    "damping",
    "Damping of motion",
    "Local damping makes a spring 1 - α times as stiff on the way to rest and 1 + α times beyond it, so each swing "
    "keeps √((1 - α)/(1 + α)) of the one before. FIRE stops all particles together where forces would brake them. "
    "Where it ends no damping has a part in: what is left is static.",
    (
        Case(
            "damping_local",
            "swings under local damping, and the rest they come to",
            "damping_local",
            judge_local,
            "P. A. Cundall (1987), Distinct element models of rock and soil structure: an oscillator of the stiffness "
            "(1 - α) k on the way to rest and (1 + α) k away from it; at rest m g/k",
            (needs.cylinder,),
        ),
        Case(
            "damping_fire",
            "the rest to which FIRE brings a row that hangs",
            "damping_fire",
            judge_fire,
            "statics of springs in a row: bond n carries the weight of all below it; half the work of weight is stored",
            (needs.cylinder,),
        ),
        Case(
            "stop_at_rest",
            "when a run counts as at rest",
            "damping_local",
            judge_rest,
            "the swing of which (1 + α) √((1 - α)/(1 + α))^n falls below the limit; within a swing and a half",
            (needs.cylinder,),
        ),
    ),
)

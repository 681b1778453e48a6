"""Beams that consist of bonds: bent a little, bent far, rolled up, and vibrating."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.scene.scene import Scene
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.beam import Cantilever
from clast.verification.closed_forms.elastica import tip
from clast.verification.curves import Floats, frequency, order
from clast.verification.families.bonds import beam_of
from clast.verification.finding import Finding
from clast.verification.reading import follow, orientation, position
from clast.verification.rest import settle
from clast.verification.sketch import Line, Sketch

RESIDUAL = 1e-8
"""Share of its load that may be left on a sphere of a beam at rest."""

LOOK = 200
"""Steps between two looks at a beam that comes to rest."""

DISCRETE, SLENDER, REFINED, CLOSED, TONE = 1e-6, 1e-3, 2e-4, 1e-6, 1e-4
"""Accuracy: of the row of bonds against itself, of 20 bonds against the continuous beam, of the limit of many bonds,
of the circle as a share of the length, of the frequency."""


def chains(scene: Scene) -> list[Cantilever]:
    """Return the beams of a scene, one a grain."""
    first_bonds = [int(np.argmax(scene.grain[scene.ends[:, 0]] == g)) for g in range(int(scene.grain.max()) + 1)]
    counts = np.bincount(scene.grain[scene.ends[:, 0]])
    return [Cantilever(beam_of(scene, bond), int(n)) for bond, n in zip(first_bonds, counts, strict=True)]


def tips(scene: Scene) -> list[int]:
    """Return the last particle of every beam."""
    return [int(np.nonzero(scene.grain == g)[0][-1]) for g in range(int(scene.grain.max()) + 1)]


def at_rest(bench: Bench, changes: dict[str, Any] | None = None) -> Simulation:
    """Return the scene's beams at rest."""
    simulation = bench.start(changes)
    settle(simulation, RESIDUAL, LOOK)
    return simulation


def judge_small(bench: Bench) -> Findings:
    """Compare small deflections with those of the row of bonds, and see them near Timoshenko's beam."""
    simulation = at_rest(bench)
    scene, ends = simulation.scene, tips(simulation.scene)
    got = (position(simulation) - scene.position)[ends, 2]
    errors, beams = [], chains(scene)
    for beam, end, w in zip(beams, ends, got, strict=True):
        load = float(scene.force[end, 2])
        yield Finding(f"{beam.n} bonds: deflection of the tip, m", beam.deflection(load), float(w), DISCRETE)
        errors.append(1.0 - float(w) / beam.timoshenko(load))
    counts = np.array([beam.n for beam in beams], float)
    yield Finding("order in which Timoshenko's beam is reached", 2.0, order(counts, errors), 1e-3)
    line = Line("1/(4 n²)", counts, 0.25 / counts**2)
    dots = Line("Clast", counts, np.array(errors), dots=True)
    yield Sketch("a small load: against Timoshenko", "bonds", "error of the deflection", (line, dots), logarithmic=True)


def judge_timoshenko(bench: Bench) -> Findings:
    """Compare deflection and slope of beams that bend and shear along each bond with the continuous beam."""
    simulation = at_rest(bench)
    scene, ends = simulation.scene, tips(simulation.scene)
    deflections = (position(simulation) - scene.position)[ends, 2]
    slopes = 2.0 * np.arcsin(np.linalg.norm(orientation(simulation)[ends, 1:], axis=1))
    ratios, over_euler = [], []
    for beam, end, w, turned in zip(chains(scene), ends, deflections.tolist(), slopes.tolist(), strict=True):
        load, kappa = float(scene.force[end, 2]), beam.bond.cowper
        slender = beam.length / (2.0 * beam.bond.R)
        name = f"{beam.n} bonds, L/D = {slender:.3g}"
        yield Finding(f"{name}: deflection of the tip, m", beam.timoshenko(load, kappa), w, DISCRETE)
        yield Finding(f"{name}: slope of the tip, rad", beam.slope(load), turned, DISCRETE)
        ratios.append(slender)
        over_euler.append(w / beam.euler(load))
    yield Finding("slenderest: deflection over Euler and Bernoulli's", 1.0, over_euler[int(np.argmax(ratios))], SLENDER)
    beam = chains(scene)[0]
    fine = np.geomspace(min(ratios), max(ratios), 60)
    shear = 3.0 * beam.bond.E / (beam.bond.cowper * beam.bond.G) / 16.0
    line = Line("1 + 3 EI/(κGA L²)", fine, 1.0 + shear / fine**2)
    dots = Line("Clast", np.array(ratios), np.array(over_euler), dots=True)
    yield Sketch("Timoshenko's beam", "slenderness L/D", "deflection over Euler and Bernoulli's", (line, dots))


def judge_elastica(bench: Bench) -> Findings:
    """Compare large deflections with the elastica: of the beams as they are, and in the limit of many bonds."""
    simulation = at_rest(bench)
    scene, x = simulation.scene, position(simulation)
    coarse = at_rest(bench, thinned(scene))
    half = position(coarse)[tips(coarse.scene)]
    shapes = []
    for g, (beam, end) in enumerate(zip(chains(scene), tips(scene), strict=True)):
        load = float(scene.force[end, 2]) * beam.length**2 / beam.bending
        start = scene.position[scene.grain == g][0]
        fine, few = ((place - start)[[2, 0]] / beam.length for place in (x[end], half[g]))
        refined = fine + (fine - few) / 3.0  # errors fall with the square of the number of bonds
        for name, expected, got, limit in zip(("w/L", "x/L"), tip(load), fine, refined, strict=True):
            yield Finding(f"P L²/EI = {load:.3g}: {name} of {beam.n} bonds", expected, float(got), SLENDER)
            yield Finding(f"P L²/EI = {load:.3g}: {name} of ever more bonds", expected, float(limit), REFINED)
        shape = (x - start)[scene.grain == g] / beam.length
        shapes.append(Line(f"P L²/EI = {load:.3g}", shape[:, 0], shape[:, 2], dots=True))
    places = np.array([tip(load) for load in np.geomspace(0.05, 20.0, 60)])
    locus = Line("tips in closed form", places[:, 1], places[:, 0])
    yield Sketch("a large load", "x/L", "w/L", (locus, *shapes), round=True)


def thinned(scene: Scene) -> dict[str, Any]:
    """Return the change that leaves every second sphere of each beam, and half the bonds."""
    kept = np.concatenate([np.nonzero(scene.grain == g)[0][::2] for g in range(int(scene.grain.max()) + 1)])
    spheres = [
        {
            "position": scene.position[k].tolist(),
            "radius": 2.0 * float(scene.radius[k]),
            "force": scene.force[k].tolist(),
            "fixed": bool(scene.prescribed[k]),
        }
        for k in kept
    ]
    diameter = float(scene.diameter[0])
    bonds = [
        {"between": [k, k + 1], "diameter": diameter}
        for k in range(len(kept) - 1)
        if scene.grain[kept[k]] == scene.grain[kept[k + 1]]
    ]
    return {"particles.particles": spheres, "particles.bonds": bonds, "output.tracks.particles": []}


def judge_roll_up(bench: Bench) -> Findings:
    """See the beam closed to a regular polygon."""
    simulation = at_rest(bench)
    beam, x, q = chains(simulation.scene)[0], position(simulation), orientation(simulation)
    turns = np.degrees(2.0 * np.arccos(np.minimum(np.abs((q[1:] * q[:-1]).sum(axis=1)), 1.0)))
    expected = 360.0 / beam.n
    yield Finding("gap between both ends, share of the length", 0.0, apart(x[-1], x[0]) / beam.length, CLOSED, True)
    yield Finding("turn of the sphere that turns least, degrees", expected, float(turns.min()), DISCRETE)
    yield Finding("turn of the sphere that turns most, degrees", expected, float(turns.max()), DISCRETE)
    radius = 0.5 * beam.bond.L / np.sin(np.pi / beam.n)
    around = np.linalg.norm(x[:-1] - x[:-1].mean(axis=0), axis=1)
    yield Finding("radius, m", radius, float(around[np.argmax(np.abs(around - radius))]), DISCRETE)
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    centre, mm = x[:-1].mean(axis=0), 1e3
    circle = Line("circle", mm * (centre[0] + radius * np.cos(angle)), mm * (centre[2] + radius * np.sin(angle)))
    dots = Line("Clast", mm * x[:, 0], mm * x[:, 2], dots=True)
    yield Sketch("the end moment 2π EI/L", "x, mm", "z, mm", (circle, dots), round=True)


def apart(a: Floats, b: Floats) -> float:
    """Return the distance of two places in m."""
    return float(np.linalg.norm(a - b))


def judge_vibration(bench: Bench) -> Findings:
    """Compare the frequency of the first mode with the row's eigenvalue."""
    simulation = bench.start()
    scene, beam = simulation.scene, chains(simulation.scene)[0]
    m, r = float(scene.mass[-1]), float(scene.radius[-1])
    first = float(beam.bending_modes(m, 0.4 * m * r**2)[0][0])
    height = follow(simulation, lambda s: position(s)[-1, 2], LOOK)
    time = simulation.dt * np.minimum(LOOK * np.arange(len(height)), simulation.last_step)
    yield Finding("first bending frequency, rad/s", first, frequency(time, height), TONE)
    amplitude = float(scene.velocity[-1, 2]) / first
    fine = np.linspace(0.0, time[-1], 400)
    line = Line("A sin ωt", 1e3 * fine, 1e6 * amplitude * np.sin(first * fine))
    dots = Line("Clast", 1e3 * time[::20], 1e6 * height[::20], dots=True)
    yield Sketch("the first mode", "time, ms", "deflection of the tip, µm", (line, dots))


FAMILY = Family(
    "beams",
    "Beams",
    "Rows of bonds, held at one end. A row is a beam that bends and shears in the middle of each bond; what it does is "
    "known exactly, and nears the continuous beam with the square of the number of bonds. Beams at rest are found by "
    "letting them swing and stopping them where they are fastest, until no sphere has more than 1e-8 of the load left.",
    (
        Case(
            "beam_cantilever",
            "cantilevers under a small load",
            "beam_cantilever",
            judge_small,
            "P L³/(3 EI) (1 − 1/(4 n²)) + P L/(GA), the sum over n bonds",
            (needs.cylinder,),
        ),
        Case(
            "beam_timoshenko",
            "cantilevers of Timoshenko beams, thick and slender",
            "beam_timoshenko",
            judge_timoshenko,
            "P L³/(3 EI) + P L/(κGA) and P L²/(2 EI) for any number of bonds; κ: Cowper (1966), doi:10.1115/1.3625046",
            (needs.timoshenko_beam,),
        ),
        Case(
            "beam_elastica",
            "cantilevers under large loads",
            "beam_elastica",
            judge_elastica,
            "the elastica in elliptic integrals: Bisshopp and Drucker (1945), doi:10.1090/qam/13360",
            (needs.cylinder,),
        ),
        Case(
            "beam_roll_up",
            "a beam rolled up by a moment",
            "beam_roll_up",
            judge_roll_up,
            "the moment 2π EI/L closes a beam to a circle, and n bonds to a regular polygon",
            (needs.cylinder,),
        ),
        Case(
            "beam_vibration",
            "a cantilever in its first mode",
            "beam_vibration",
            judge_vibration,
            "the lowest eigenvalue of the row of bonds and rigid spheres",
            (needs.cylinder,),
        ),
    ),
)

"""Bonds whose strengths scatter: rows are as strong as their weakest bonds."""

from __future__ import annotations

from math import ceil
from typing import Any

import numpy as np

from clast.engine.tables import crack_rows
from clast.maths.distributions import weibull_deviation
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.curves import Floats
from clast.verification.families.bonds import beam_of, model_parameters
from clast.verification.finding import Finding
from clast.verification.reading import evaluation
from clast.verification.sketch import Line, Sketch

MODULUS = 5.0
SCATTER = [{"parameters": ["normal_strength"], "distribution": "weibull", "modulus": MODULUS}]
LENGTHS, ROWS = (1, 4, 16), 400
"""Bonds in a row, and rows of each length."""

ERRORS = 4.0
"""Standard errors by which a mean or a deviation of so many rows may be off."""


def judge_chain(bench: Bench) -> Findings:
    """Compare when rows tear with their weakest bonds, and how strong they are with Weibull's weakest link."""
    simulation = bench.run({**many_rows(bench), "bonds.scatter": SCATTER})
    scene, written = simulation.scene, model_parameters(simulation.scene).normal_strength
    rate = float(scene.velocity[1, 0] / scene.position[1, 0])
    to_step = written / (beam_of(scene).E * rate * simulation.dt)
    first, wrong = 0, 0
    lines: list[Line] = []
    for bonds in LENGTHS:
        own = slice(first, first + ROWS * bonds)
        first = own.stop
        factors, torn = (each[own].reshape(ROWS, bonds) for each in (scene.factors[0], steps_of_breaking(simulation)))
        expected = [ceil(float(each) * to_step - evaluation(simulation)) for each in factors.min(axis=1)]
        weakest = torn[np.arange(ROWS), factors.argmin(axis=1)]
        wrong += int(np.count_nonzero((weakest != expected) | (weakest != torn.min(axis=1))))
        strength = np.sort(torn.min(axis=1)) / to_step
        yield from weakest_link(bonds, strength)
        lines += weibull_plot(bonds, strength)
    yield Finding("rows that tear elsewhere, or in another step, than their weakest bond", 0.0, wrong, 0.0, True)
    yield Sketch("rows of 1, 4, 16 bonds", "strength, share of the mean", "−ln(share that holds)", tuple(lines), True)


def many_rows(bench: Bench) -> dict[str, Any]:
    """Return the change that lays rows of all lengths side by side, each as the one that is written."""
    written: Any = bench.scene().generators[0].params
    second = written.particles[1]
    gap, speed, r = second.position[0], second.velocity[0], second.radius
    spheres: list[dict[str, Any]] = []
    bonds: list[dict[str, Any]] = []
    for row, length in enumerate(np.repeat(LENGTHS, ROWS).tolist()):
        start = len(spheres)
        for k in range(length + 1):
            ends = {"fixed": True} if k == 0 else {"velocity": [k * speed, 0, 0], "prescribed": k == length}
            spheres.append({"position": [k * gap, 4.0 * r * row, 0], "radius": r, **ends})
        diameter = written.bonds[0].diameter
        bonds += [{"between": [start + k, start + k + 1], "diameter": diameter} for k in range(length)]
    return {"particles.particles": spheres, "particles.bonds": bonds}


def steps_of_breaking(simulation: Simulation) -> Floats:
    """Return the step in which each bond broke, (m,); infinity where it holds."""
    cracks, found = simulation.world.cracks, np.full(len(simulation.scene.ends), np.inf)
    rows = crack_rows(cracks)
    found[cracks.bond[rows]] = cracks.step[rows]
    return found


def weakest_link(bonds: int, strength: Floats) -> Findings:
    """Compare mean and deviation of strengths, (k,) as shares of a bond's mean, with those of n bonds in a row."""
    scale, deviation = bonds ** (-1.0 / MODULUS), weibull_deviation(MODULUS)
    of_mean, of_deviation = deviation / np.sqrt(len(strength)), 1.0 / np.sqrt(2.0 * len(strength))
    name = f"{bonds} bonds in a row" if bonds > 1 else "1 bond"
    yield Finding(f"{name}: mean strength, share of a bond's", scale, float(strength.mean()), ERRORS * of_mean)
    found = float(strength.std() / strength.mean())
    yield Finding(f"{name}: deviation of the strength, share of its mean", deviation, found, ERRORS * of_deviation)


def weibull_plot(bonds: int, strength: Floats) -> list[Line]:
    """Return the closed form and every tenth row, as straight lines on logarithmic axes."""
    from math import gamma

    x = np.geomspace(0.2, 1.6, 50)
    holds = (np.arange(len(strength)) + 0.5) / len(strength)
    line = Line(f"{bonds}: n (Γ(1 + 1/m) x)^m", x, bonds * (gamma(1.0 + 1.0 / MODULUS) * x) ** MODULUS)
    return [line, Line(f"{bonds}: Clast", strength[::10], -np.log1p(-holds[::10]), dots=True)]


FAMILY = Family(
    "scatter",
    "Bonds that scatter",
    "Rows of bonds whose strengths have Weibull's distribution with the modulus 5 and the mean that is written, drawn "
    "out evenly. A row tears where and when its weakest bond does, to the step, and rows of n bonds have Weibull's "
    "distribution again, with the same modulus and a strength that is n^(−1/m) of that of a single bond. Means and "
    "deviations of 400 rows are told within four standard errors.",
    (
        Case(
            "bond_scatter",
            "rows of bonds tear at the weakest",
            "bond_scatter",
            judge_chain,
            "strength n^(−1/m): W. Weibull (1951), doi:10.1115/1.4010337",
            (needs.bond_parameters("normal_strength"), needs.cylinder),
        ),
    ),
)

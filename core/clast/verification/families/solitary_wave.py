"""A solitary wave in a chain of Hertzian spheres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.solitary_wave import Wave, discrete_wave, long_wave
from clast.verification.curves import Floats, order, peak, top_of
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import between
from clast.verification.reading import follow, position, velocity
from clast.verification.sketch import Line, Sketch

STRIKERS = (0.01, 0.1, 1.0, 10.0)
"""Speeds of the first sphere in m/s."""

PER_BEAD = 50
"""Steps in which the wave goes on by one bead; a contact lasts about three times as long."""

FIRST, LAST = 30, 50
"""The wave is measured between these beads: far from the start, where it has become steady, and before the end."""

BEADS_TO_RUN = 56.0
ABOUT = 0.68
"""Speed of the beads in the wave, as a share of that of the first one; tells how long to run."""

SPEED_BOUND, OVERLAP_BOUND, EXPONENT_BOUND, STEADY_BOUND = 1e-4, 1e-3, 1e-5, 1e-5
LONG_SPEED_BOUND, LONG_OVERLAP_BOUND = 1e-2, 5e-2
"""Nesterenko's closed form takes the wave for long against a bead. It spans five, and that is the error of the closed
form: 0.8 % of the speed and 4.8 % of the overlap, whatever the program."""


@dataclass(frozen=True)
class Passage:
    """A wave as it passed.

    Attributes
    ----------
    time : array
        (s,) time of each step in s.
    speed : float
        Peak speed of bead ``LAST`` in m/s.
    overlap : array
        (s,) its overlap with the next one in m.
    rate : float
        Beads that it passed in a second.
    steady : float
        Peak speed of bead ``LAST`` as a share of that of bead ``FIRST``.
    """

    time: Floats
    speed: float
    overlap: Floats
    rate: float
    steady: float


def passage(bench: Bench, striker: float, stiffness: float, mass: float) -> Passage:
    """Run a chain whose first bead starts with a speed in m/s."""
    rate = discrete_wave().rate(ABOUT * striker, stiffness, mass)
    changes = {"particles.particles.0.velocity": [striker, 0.0, 0.0], "time.step": 1.0 / (PER_BEAD * rate)}
    simulation = bench.start({**changes, "time.end": {"time": BEADS_TO_RUN / rate}})
    x, v = follow(simulation, lambda each: (position(each)[:, 0], velocity(each)[:, 0]))
    (begin, first), (end, last) = (top_of(v[:, k]) for k in (FIRST, LAST))
    overlap = 2.0 * simulation.scene.radius[0] - (x[:, LAST + 1] - x[:, LAST])
    time = simulation.dt * np.arange(float(len(x)))
    return Passage(time, peak(v[:, LAST]), overlap, (LAST - FIRST) / (simulation.dt * (end - begin)), last / first)


def spring(simulation: Simulation) -> tuple[float, float]:
    """Return A = 4/3 E* √R* of the contacts in N m^(-3/2), and the mass of a bead in kg."""
    pair = between(simulation, 0, 1)
    return 4.0 / 3.0 * pair.modulus * float(np.sqrt(pair.radius)), 2.0 * pair.mass


def judge(bench: Bench) -> Findings:
    """Compare speed and height of waves of four sizes with those of the discrete chain and of Nesterenko."""
    stiffness, mass = spring(bench.start())
    passages = [passage(bench, striker, stiffness, mass) for striker in STRIKERS]

    def compared(wave: Wave, speed_bound: float, overlap_bound: float, what: str) -> Findings:
        yield worst(
            Finding(f"{what} at {p.speed:.2g} m/s: beads/s", wave.rate(p.speed, stiffness, mass), p.rate, speed_bound)
            for p in passages
        )
        yield worst(
            Finding(
                f"{what} at {p.speed:.2g} m/s: overlap, m",
                wave.overlap(p.rate, stiffness, mass),
                peak(p.overlap),
                overlap_bound,
            )
            for p in passages
        )

    yield from compared(discrete_wave(), SPEED_BOUND, OVERLAP_BOUND, "discrete chain")
    yield from compared(long_wave(), LONG_SPEED_BOUND, LONG_OVERLAP_BOUND, "Nesterenko")
    speeds, rates = (np.array([getattr(p, name) for p in passages]) for name in ("speed", "rate"))
    yield Finding("power of the bead speed in the wave speed", 0.2, -order(speeds, rates), EXPONENT_BOUND)
    yield worst(Finding("bead speed, 20 beads on / before", 1.0, p.steady, STEADY_BOUND) for p in passages)
    yield speed_sketch(speeds, rates, stiffness, mass)
    yield shape_sketch(passages[0], stiffness, mass)


def speed_sketch(speeds: Floats, rates: Floats, stiffness: float, mass: float) -> Sketch:
    """Show the speed of the wave against that of the beads."""
    line = np.array([discrete_wave().rate(speed, stiffness, mass) for speed in speeds])
    lines = (Line("discrete chain, ∝ v^(1/5)", speeds, line), Line("Clast", speeds, rates, dots=True))
    return Sketch("speed of the wave", "peak speed of a bead, m/s", "beads per second", lines, logarithmic=True)


def shape_sketch(passed: Passage, stiffness: float, mass: float) -> Sketch:
    """Show the overlap of two beads while the wave passes, without dimensions."""
    beads = passed.rate * (passed.time - passed.time[np.argmax(passed.overlap)])
    near = np.nonzero(np.abs(beads) < 3.0)[0][:: PER_BEAD // 8]
    size = (mass * passed.rate**2 / stiffness) ** 2
    exact, long = discrete_wave(), long_wave()
    inside = np.abs(exact.x) < 3.0
    lines = (
        Line("discrete chain", exact.x[inside], exact.phi[inside]),
        Line("Nesterenko", long.x, long.phi),
        Line("Clast", beads[near], np.maximum(passed.overlap[near] / size, 0.0), dots=True),
    )
    return Sketch("shape of the wave", "beads", "overlap / (m W²/A)²", lines)


TEXT = """A chain of equal steel spheres that just touch carries a wave that keeps its shape; linear sound does not
exist in it. The speed of the wave goes with the fifth root of the speed of the spheres in it. Nesterenko (1983) gives
it in closed form for waves that are long against a sphere. The real wave spans five spheres, so his speed is 0.8 %
too large at a given speed of the spheres, and his overlap 4.8 % at a given speed of the wave. The wave of the
discrete chain is the fixed point of a convolution (English and Pego 2005), which is computed apart from Clast to 5
digits and more; against that the accuracy of Clast can be told. The first sphere starts with 0.01 to 10 m/s, and the
wave is measured from sphere 30 to 50, with 50 steps per sphere."""

FAMILY = Family(
    "solitary_wave",
    "Solitary wave in a Hertz chain",
    TEXT,
    (
        Case(
            "solitary_wave",
            "a wave runs through 60 equal spheres",
            "solitary_wave",
            judge,
            "W ∝ v^(1/5): V. F. Nesterenko (1983), doi:10.1007/BF00905892; shape: J. M. English and R. L. Pego (2005), "
            "Proc. Amer. Math. Soc. 133, 1763",
            (needs.hertzian,),
        ),
    ),
)

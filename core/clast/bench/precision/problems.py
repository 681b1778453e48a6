"""The problems. To add one: put its scene into ``configs/benchmarks`` and describe it here."""

from __future__ import annotations

from clast.bench.precision import observe
from clast.bench.precision.problem import Problem

TSUJI_KINK = 1.25
"""Order that is left where damping sets in with the fourth root of the overlap."""

CHAIN = Problem(
    name="chain",
    title="A damped chain",
    text="A bead strikes a row of 23; a wave runs through 23 contacts that are damped (restitution 0.5).",
    quantity="velocities of all beads",
    observe=observe.velocities,
    steps=(160, 320, 640, 1280, 2560, 5120),
    fine=81920,
    instants=32,
    varies=("integrator",),
    copies=40,
    apart=0.02,
    damping_ratio=0.2,
    kinks=TSUJI_KINK,
)
IMPACT = Problem(
    name="impact",
    title="Oblique impacts with friction",
    text="Sixteen spheres strike a plate, 5 to 80 degrees off its normal, with damping and friction of 0.3.",
    quantity="velocities and spins after the impact",
    observe=observe.last_velocities,
    steps=(200, 400, 800, 1600, 3200, 6400),
    fine=102400,
    instants=1,
    varies=("integrator",),
    copies=30,
    apart=0.004,
    damping_ratio=0.2,
    kinks=TSUJI_KINK,
)
PAIR = Problem(
    name="pair",
    title="A spinning, bending bond",
    text="Two bonded spheres turn once about a tilted axis while their bond bends, shears and twists, undamped.",
    quantity="positions of both ends",
    observe=observe.positions,
    steps=(80, 160, 320, 640, 1280, 2560, 5120),
    fine=81920,
    instants=20,
    varies=("integrator", "bond_kinematics"),
    copies=200,
    apart=0.001,
)
ELASTIC = Problem(
    name="elastic",
    title="A grain pressed until just before its first bond breaks",
    text="A grain between two plates, Model 1, with damped contacts and friction; it is pressed at 1 m/s.",
    quantity="force on the moving plate",
    observe=observe.plate_force,
    steps=(925, 1850, 3700, 7400),  # from the largest step that is stable to the end, halved
    fine=59200,
    instants=25,
    varies=("integrator", "bond_kinematics"),
    damping_ratio=0.2,
    kinks=TSUJI_KINK,
)
PROBLEMS = (CHAIN, IMPACT, PAIR, ELASTIC)

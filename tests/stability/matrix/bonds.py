"""Bonds: damping, stiffness, spins, degenerate shapes, and thousands that break at once."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.config.scene import SceneConfig
from tests.stability.entry import ACCURATE, REFUSED, Answer, Entry, Group, Ran
from tests.stability.matrix.steps import shaken_block
from tests.stability.measures import angular_momentum, drift, energy, kinetic, momentum_error, worst
from tests.stability.scenes import block, bonded, particle

RULE = {"time.step": {"rule": "spectral", "factor": 0.2}}


def damped_pair(zeta: float) -> Entry:
    """Return two bonded spheres that part at 1 cm/s each; they stretch as a damped oscillator does."""

    def make() -> SceneConfig:
        made = [particle([s * 1.05e-3, 0, 0], 1e-3, [s * 0.01, 0, 0]) for s in (-1.0, 1.0)]
        changes = {
            "bonds.damping": zeta,
            "time.step": {"rule": "spectral", "factor": 0.02},
            "time.end": {"steps": 1000},
        }
        return bonded(made, [(0, 1)], changes)

    def judge(ran: Ran) -> Answer:
        scene = ran.simulation.scene
        k = 1e9 * 0.25 * np.pi * 1e-6 / 2.1e-3
        omega, t = np.sqrt(2.0 * k / scene.mass[0]), ran.curves["time_s"]
        rate = np.sqrt(complex(zeta**2 - 1.0)) * omega
        stretch = np.real(0.02 * np.exp(-zeta * omega * t) * (np.sinh(rate * t) / rate if rate else t))
        x = ran.particles["position"][:, :, 0]
        return Answer("a damped oscillator", worst((x[:, 1] - x[:, 0] - 2.1e-3 - stretch) / stretch.max()), 0.02)

    return Entry(f"ζ = {zeta:g}", make, judge)


def stiff_bonds(ratio: float) -> Entry:
    """Return a shaken block whose bonds are ``ratio`` times as stiff as its spheres."""
    changes = {"bonds.model.young_modulus": 1e9 * ratio}
    return Entry(f"{ratio:g}", lambda: shaken_block(changes), lambda ran: drift(ran, 0.01))


def spinning_cube(spin: float, damping: float = 0.0) -> Entry:
    """Return a cube of 27 spheres that spins about a tilted axis."""
    axis = spin * np.array([0.48, 0.6, 0.64])

    def make() -> SceneConfig:
        centres, bonds = block(3, 2.1e-3)
        made = [particle(x, 1e-3, np.cross(axis, x), axis) for x in centres]
        changes: dict[str, Any] = {"bonds.model.young_modulus": 100e9, "time.end": {"steps": 100_000}, **RULE}
        return bonded(made, bonds, changes)

    def judge(ran: Ran) -> Answer:
        L = angular_momentum(ran)
        turned = worst(np.linalg.norm(L - L[0], axis=1)) / float(np.linalg.norm(L[0]))
        grown = worst(energy(ran) / energy(ran)[0] - 1.0)
        return Answer("energy and angular momentum stay", max(turned, grown), 1e-3)

    return Entry(f"{spin:g} rad/s", make, judge, short=spin == 1e4)


def shape(
    name: str, expected: str, distance: float = 2.1e-3, offset: float = 0.0, more: dict[str, Any] | None = None
) -> Entry:
    """Return two spheres at a distance, one of which moves across the bond between them."""

    def make() -> SceneConfig:
        made = [particle([offset, 0, 0], 1e-3), particle([offset + distance, 0, 0], 1e-3, [0, 0.01, 0])]
        return bonded(made, [(0, 1)], {"contacts.start_overlap": 3.0, **(more or {})})

    return Entry(name, make, lambda ran: drift(ran, 0.01), expected, short=True)


def written(*bonds: tuple[int, int], length: float | None = None) -> dict[str, Any]:
    """Return bonds as a scene has them."""
    given = {} if length is None else {"length": length}
    return {"particles.bonds": [{"between": list(ends), "diameter": 1e-3, **given} for ends in bonds]}


def bursting(n: int) -> Entry:
    """Return a block whose bonds all break at once, because all of it expands."""

    def make() -> SceneConfig:
        centres, bonds = block(n, 2.1e-3)
        made = [particle(x, 1e-3, 1e3 * x) for x in centres]
        changes = {
            "bonds.model.normal_strength": 2e6,
            "time.end": {"steps": 400},
            "time.step": {"rule": "spectral", "factor": 0.005},
            "output.samples": 20,
        }
        return bonded(made, bonds, changes)

    def judge(ran: Ran) -> Answer:
        world = ran.simulation.world
        broken = ran.simulation.bonds_broken
        step = world.cracks.step[:broken]
        if broken < len(ran.simulation.scene.ends) or np.bincount(step).max() < 2000:
            return Answer("all bonds break, thousands in one step", np.inf, 0.05)
        kept, held = kinetic(ran), world.cracks.load[:broken, 2].sum()
        lost = np.array([(kept[0] - kept[-1]) / held - 1.0])
        return Answer(
            "motion loses what broken bonds held; momentum stays", max(worst(lost), momentum_error(ran)), 0.05
        )

    return Entry(f"{3 * n * n * (n - 1)} bonds", make, judge, short=True)


GROUPS = (
    Group(
        "damping",
        "Bond damping",
        "Two bonded spheres part at 1 cm/s each.",
        tuple(map(damped_pair, (0.0, 0.01, 0.1, 0.5, 1.0, 3.0, 10.0))),
    ),
    Group(
        "stiff_bonds",
        "Stiffness contrast of bonds and contacts",
        "The shaken block again: Young's modulus of the bonds over that of the spheres.",
        tuple(map(stiff_bonds, (1e-3, 1e-2, 0.1, 10.0, 1e3, 1e6))),
    ),
    Group(
        "spins",
        "Spinning grains",
        "27 bonded spheres spin about a tilted axis, 100 000 steps.",
        tuple(map(spinning_cube, (1e2, 1e3, 1e4))),
    ),
    Group(
        "shapes",
        "Degenerate bonds",
        "Bonds without length, twice between one pair, or far from their given length.",
        (
            shape("two centres in one place", REFUSED, 0.0),
            shape("two centres in one place, length given", REFUSED, 0.0, more=written((0, 1), length=1e-3)),
            shape("centres 1e-12 m apart, 1 km from the origin", REFUSED, 1e-12, 1e3, written((0, 1), length=1e-3)),
            shape("two bonds between one pair", REFUSED, more=written((0, 1), (1, 0))),
            shape("a particle bonded to itself", REFUSED, more=written((0, 0))),
            shape("twice as long as given", ACCURATE, more=written((0, 1), length=1.05e-3)),
            shape("half as long as given", ACCURATE, more=written((0, 1), length=4.2e-3)),
        ),
    ),
    Group(
        "burst",
        "Thousands of bonds break in one step",
        "A block expands evenly until its bonds break, all in the same few steps.",
        (bursting(12),),
    ),
)

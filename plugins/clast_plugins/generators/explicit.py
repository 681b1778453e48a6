"""Explicit: particles and bonds written in the scene itself."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator
from pydantic_core import InitErrorDetails

from clast import hookimpl
from clast.config.problems import problem, refuse
from clast.config.quantities import ForceVector, Length, MomentVector, Point, SpinVector, VelocityVector
from clast.parts.generator import BondList, Generator, Packing, Site
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.generators.grains import connected_grains

NOTHING = (0.0, 0.0, 0.0)


class ExplicitParticle(Params):
    """One particle; at rest unless a velocity or spin is given, free of loads unless a force or torque is."""

    position: Annotated[Point, Field(description="Centre")]
    radius: Annotated[Length, Field(gt=0, description="Radius")]
    material: Annotated[str | None, Field(description="Material, where it is not the common one")] = None
    velocity: Annotated[VelocityVector | None, Field(description="Start velocity")] = None
    spin: Annotated[SpinVector | None, Field(description="Start angular velocity")] = None
    force: Annotated[ForceVector | None, Field(description="Force that acts on it all the time")] = None
    torque: Annotated[MomentVector | None, Field(description="Torque that acts on it all the time")] = None
    prescribed: Annotated[bool, Field(description="Keeps its velocity and spin whatever pushes it")] = False
    fixed: Annotated[bool, Field(description="Stays where it is and does not turn")] = False

    @model_validator(mode="after")
    def _fixed_rests(self) -> ExplicitParticle:
        if self.fixed and (self.velocity not in (None, NOTHING) or self.spin not in (None, NOTHING)):
            raise ValueError(
                "'fixed: true' means no velocity and no spin, but one is given; "
                "take 'prescribed: true' for a particle that keeps them, or remove one of the two"
            )
        return self

    @model_validator(mode="after")
    def _loads_can_move_it(self) -> ExplicitParticle:
        if not (self.prescribed or self.fixed):
            return self
        for name in ("force", "torque"):
            if getattr(self, name) not in (None, NOTHING):
                held = "fixed" if self.fixed else "prescribed"
                raise ValueError(
                    f"'{held}: true' means that no load moves the particle, but a {name} is given; remove one of them"
                )
        return self


class ExplicitBond(Params):
    """One bond between two particles, which are named by their places in the list, from 0."""

    between: Annotated[tuple[int, int], Field(description="Places of the two particles in the list, from 0")]
    diameter: Annotated[Length, Field(gt=0, description="Diameter of the bond")]
    length: Annotated[Length | None, Field(gt=0, description="Initial length; by default the centres' distance")] = None


class Explicit(Params):
    """Particles and bonds one by one; what bonds connect forms a grain."""

    particles: Annotated[
        list[ExplicitParticle],
        Field(
            min_length=1,
            examples=[[{"position": [0, 0, 0], "radius": "1 mm"}, {"position": ["2.1 mm", 0, 0], "radius": "1 mm"}]],
            description="The particles",
        ),
    ]
    material: Annotated[str | None, Field(examples=["glass"], description="Material of particles that name none")] = (
        None
    )
    bonds: Annotated[tuple[ExplicitBond, ...], Field(description="The bonds")] = ()

    @model_validator(mode="after")
    def _consistent(self) -> Explicit:
        problems = [
            problem(("particles", k), "names no material; add 'material' to it, or one for all beside 'particles'")
            for k, particle in enumerate(self.particles)
            if particle.material is None and self.material is None
        ]
        problems += _bond_problems(self.particles, self.bonds)
        if problems:
            raise refuse(problems)
        return self


def _bond_problems(particles: Sequence[ExplicitParticle], bonds: Sequence[ExplicitBond]) -> Iterator[InitErrorDetails]:
    for k, bond in enumerate(bonds):
        missing = [end for end in bond.between if not 0 <= end < len(particles)]
        i, j = bond.between
        between = ("bonds", k, "between")
        if missing:
            last = len(particles) - 1
            yield problem(between, f"there is no particle {missing[0]}; the particles are counted from 0 to {last}")
        elif i != j and particles[i].position == particles[j].position:
            yield problem(
                ("bonds", k), f"particles {i} and {j} have one centre, so their bond has no direction; move one of them"
            )


def generate(params: Explicit, site: Site) -> Packing:
    """Put the written particles and bonds into arrays."""
    particles = params.particles
    bonds = _bond_list(params.bonds)
    return Packing(
        position=np.array([p.position for p in particles]),
        radius=np.array([p.radius for p in particles]),
        material=[p.material or params.material or "" for p in particles],
        velocity=np.array([p.velocity or NOTHING for p in particles]),
        spin=np.array([p.spin or NOTHING for p in particles]),
        prescribed=np.array([p.prescribed or p.fixed for p in particles]),
        force=np.array([p.force or NOTHING for p in particles]),
        torque=np.array([p.torque or NOTHING for p in particles]),
        grain=connected_grains(len(particles), bonds.ends),
        bonds=bonds if params.bonds else None,
        report={"particles": len(particles), "bonds_written": len(params.bonds)},
        origin=lambda k: ("particles", k),
    )


def _bond_list(bonds: Sequence[ExplicitBond]) -> BondList:
    return BondList(
        ends=np.array([bond.between for bond in bonds], np.int64).reshape(-1, 2),
        diameter=np.array([bond.diameter for bond in bonds], np.float64),
        length=np.array([math.nan if bond.length is None else bond.length for bond in bonds], np.float64),
        origin=lambda k: ("bonds", k, "between"),
    )


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer particles and bonds written in the scene."""
    registry.generator(
        "explicit",
        Generator(
            summary="particles and bonds written in the scene",
            Params=Explicit,
            generate=generate,
        ),
    )

"""Bonds, in blocks of lanes: all ends are gathered, all laws applied, all loads scattered."""

from __future__ import annotations

from clast.engine.compiler import inlined, routine
from clast.engine.state import Bonds, Cracks, Floats, Numbers, Particles
from clast.maths.vec3 import dot
from clast.parts.bond_model import RandomKey

from .ahead import LINE, ask_for
from .bond_dashpots import dashpot_heat
from .bond_events import let_go, log_crack, settle_events
from .bond_lane import bond_lane, gather, scatter
from .images import image_velocity
from .lanes import vector
from .layout import (
    BOND_F,
    BOND_VISCOUS,
    BOX_POWER,
    BROKEN,
    DROPS,
    FIRST,
    FLOWED,
    INDEX,
    INTACT,
    LANES,
    OVERLOAD,
    PLASTIC,
)
from .slots import BOND_BOOKS, BOND_EVENTS, BOND_FLOW, CHUNKED, LEDGER, STRETCHES, read_uniforms


@inlined
def ask_for_bond(bonds: Bonds, b: int, lane: int, particles: Particles) -> None:
    """Ask for a lane's share of a block of bonds, and for its second end; the first ends come in order."""
    slots = bonds.data.shape[1] // LANES
    for slot in range(0, slots, LINE):
        ask_for(bonds.data, (b * LANES + lane) * slots + slot)
    j = int(bonds.second[b, lane])
    ask_for(particles.pose, LINE * j)
    ask_for(particles.load, LINE * j)


@routine
def sweep_bonds(
    bonds: Bonds,
    chunk: int,
    particles: Particles,
    cracks: Cracks,
    numbers: Numbers,
    scratch: Floats,
    book: Floats,
    dt: float,
    step: int,
) -> None:
    """Add the loads of a chunk's bonds to its particles; break what fails; book what they dissipate."""
    uniforms = read_uniforms(numbers.bond_uniforms)
    for b in range(bonds.begin[chunk], bonds.begin[chunk + 1]):
        first, second, sides, data = bonds.first[b], bonds.second[b], bonds.sides[b], bonds.data[b]
        for lane in range(LANES):
            gather(particles, first[lane], second[lane], scratch, lane)
            if CHUNKED:
                ask_for_bond(bonds, min(b + 1, len(bonds.first) - 1), lane, particles)
        for lane in range(LANES):
            bond_lane(scratch, data, lane, uniforms, dt)
        for lane in range(LANES):
            share = data[INTACT * LANES + lane]
            if share == 0.0:
                continue
            i, j = first[lane], second[lane]
            own = not CHUNKED or sides[lane] & FIRST != 0  # what two chunks keep is told by one
            if LEDGER and BOND_FLOW and own:
                book[PLASTIC] += share * scratch[FLOWED * LANES + lane]
            if BOND_EVENTS and scratch[OVERLOAD * LANES + lane] > 1.0 and data[INDEX * LANES + lane] < 1.0:
                key = RandomKey(numbers.seed, bonds.number[b, lane])
                freed = settle_events(particles, i, j, scratch, data, lane, uniforms, key, dt)
                if LEDGER and own:
                    book[DROPS] += share * freed
            if data[INDEX * LANES + lane] >= 1.0 or share < 1.0:
                if share == 1.0 and own:
                    number = bonds.number[b, lane]
                    log_crack(cracks, chunk, particles, i, j, scratch, data, lane, uniforms, number, step)
                left = max(share - numbers.fade, 0.0)
                if LEDGER and own:
                    book[BROKEN] += (share - left) * let_go(particles, i, j, data, lane, uniforms, dt)
                share = left
                data[INTACT * LANES + lane] = share
            if BOND_BOOKS:
                heat = dashpot_heat(particles, i, j, scratch, data, lane, share, dt)
                book[BOND_VISCOUS] += heat if own else 0.0
            if share > 0.0:
                scatter(particles, i, j, sides[lane], scratch, lane, share)
                if STRETCHES and own:
                    force = vector(scratch, BOND_F, lane)
                    book[BOX_POWER] -= share * dot(force, image_velocity(particles, i, j))

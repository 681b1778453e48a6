"""Writes the ``slots`` module of one scene: bindings of its laws, and where their numbers lie."""

from __future__ import annotations

from itertools import accumulate

from clast.engine.blueprint import Blueprint, BondPlan
from clast.engine.kernels.layout import BOND_SLOTS
from clast.engine.records import construct, destruct, width
from clast.engine.slots_around import body_text, damping_text, walls_text
from clast.engine.slots_contacts import contacts_text
from clast.engine.slots_pieces import bind, bind_record, function

HEADER = '''"""What one scene plugs into the step loop. Written by the assembler; do not edit."""
from importlib import import_module

from clast.engine.compiler import inlined, of_part
from clast.maths.rotation import IDENTITY, spin_about, swing
from clast.maths.vec3 import ZERO, add, scale
from clast.parts.contact_law import NO_DRAG, ContactLoad, ContactLosses, Drag, overlap_before, stretch_before
from clast.parts.integrator import Stage
from clast.parts.rolling_resistance import Pressing, RollingLoad

from .layout import LANES

NOTHING = (0.0,)


@inlined
def nothing(*args):
    return None
'''


def slots_text(plan: Blueprint) -> str:
    """Return the source of the ``slots`` module for a blueprint."""
    parts = [
        HEADER,
        _flags(plan),
        _integrator(plan),
        _bonds(plan),
        contacts_text(plan),
        walls_text(plan),
        body_text(plan),
        damping_text(plan),
    ]
    return "\n\n".join(part.strip("\n") for part in parts) + "\n"


def bond_offsets(plan: BondPlan) -> dict[str, int]:
    """Return the first slot of each record in a bond's table, and their total under ``end``."""
    sizes = {
        "reference": width(plan.kinematics.Reference),
        "constants": sum(not shared for shared in plan.uniform),
        "damping": 4 if plan.damping else 0,
        "drag": 6 if plan.books else 0,
        "kinematic_state": width(plan.kinematics.State),
        "state": width(plan.model.State),
    }
    offsets, at = {}, BOND_SLOTS
    for name, size in sizes.items():
        offsets[name] = at
        at += size
    return offsets | {"end": at}


def _flags(plan: Blueprint) -> str:
    bonds, contacts = plan.bonds, plan.contacts
    values = {
        "CHUNKED": plan.chunked,
        "PERIODIC": plan.periodic,
        "STRETCHES": plan.stretches,
        "BONDS": bonds is not None,
        "BOND_ORIENTATION": plan.orientation,
        "BOND_VELOCITY": plan.bond_velocity,
        "BOND_DAMPING": bonds is not None and bonds.damping,
        "BOND_BOOKS": bonds is not None and bonds.books,
        "BOND_DRAG": bond_offsets(bonds)["drag"] if bonds is not None else 0,
        "BOND_EVENTS": bonds is not None and bonds.model.on_event is not None,
        "BOND_FLOW": bonds is not None and bonds.model.flow is not None,
        "BOND_LIMIT": bonds is not None and bonds.kinematics.beyond is not None,
        "TURNED_MODE": 0 if bonds is None else len(bonds.model.modes),
        "FADE": bonds is not None and bonds.fade,
        "CONTACTS": contacts is not None and contacts.between_particles,
        "BONDED_PAIRS_TOUCH": bonds is None or (contacts is not None and contacts.bonded_pairs),
        "ONE_MATERIAL": contacts is None or contacts.one_material,
        "ONE_SIZE": contacts is None or contacts.one_size,
        "RESTS": contacts is not None and contacts.rests,
        "WALLS": bool(plan.walls),
        "CURVED_WALLS": plan.curved_walls,
        "MANIFOLDS": plan.manifolds,
        "ANSWERING": plan.answering,
        "WALLS_TURN": plan.walls_turn,
        "TURNED_BY_MOMENTS": plan.turned_by_moments,
        "BODY_FORCES": any(force.acceleration is not None for force in plan.body_forces),
        "BODY_LOADS": plan.body_loads,
        "BRAKES": plan.damping is not None,
        "STEERS": plan.damping is not None and plan.damping.steering is not None,
        "APPLIED_LOADS": plan.applied_loads,
        "LEDGER": plan.ledger,
        "ROLLS": contacts is not None and contacts.features.rolling,
        "REMEMBERS": plan.remembered > 0,
        "CONTACT_LOSSES": plan.ledger and contacts is not None and contacts.law.losses is not None,
        "ORIENTATION": plan.orientation,
        "SPIN": plan.spin,
        "VELOCITY_FORCES": plan.velocity_forces,
        "YIELDS": contacts is not None and contacts.law.yields,
        "REACHES": contacts is not None and contacts.reaches,
        "TURNS": contacts is not None and contacts.turns(plan.ledger),
        "HISTORY": plan.history,
        "CONTACT_CONSTANTS": 0 if contacts is None else contacts.constants,
    }
    return "\n".join(f"{name} = {value!r}" for name, value in values.items())


def _integrator(plan: Blueprint) -> str:
    stages = plan.integrator.stages
    spans = [stages[k].drift_before + stages[k - 1].drift_after for k in range(len(stages))]
    drifts = [0.0, *accumulate(stage.drift_before + stage.drift_after for stage in stages)]
    forces_at = [drifts[k] + stage.drift_before for k, stage in enumerate(stages)]
    return "\n".join(
        [
            f"STAGES = {tuple(stages)!r}",
            f"SPANS = {tuple(spans)!r}",
            f"FORCES_AT = {tuple(forces_at)!r}",
            f"LAG = {plan.integrator.velocity_lag!r}",
        ]
    )


def _lane(slot: int) -> str:
    return f"data[{slot} * LANES + lane]"


def _reader(name: str, record: type | None, alias: str, first: int) -> str:
    if record is None:
        return function(name, "data, lane", "return None")
    values = [_lane(first + k) for k in range(width(record))]
    return function(name, "data, lane", f"return {construct(record, alias, values)}")


def _writer(name: str, record: type | None, first: int) -> str:
    numbers = [] if record is None else destruct(record, "record")
    return function(name, "data, lane, record", [f"{_lane(first + k)} = {text}" for k, text in enumerate(numbers)])


def _bonds(plan: Blueprint) -> str:
    if plan.bonds is None:
        names = ["measure", "end_loads", "load", "flow", "failure", "mode", "energy", "overload", "on_event", "beyond"]
        readers = ["uniforms", "reference", "constants", "damping", "kinematic_state", "bond_state"]
        lines = [f"bond_{name} = nothing" for name in names] + [f"read_{name} = nothing" for name in readers]
        return "\n".join([*lines, "write_kinematic_state = write_bond_state = nothing"])
    bonds, at = plan.bonds, bond_offsets(plan.bonds)
    model, kinematics = bonds.model, bonds.kinematics
    lines = [
        bind("bond_measure", kinematics.measure),
        bind("bond_end_loads", kinematics.end_loads),
        bind("bond_beyond", kinematics.beyond),
        *(bind(f"bond_{name}", getattr(model, name)) for name in ("load", "failure", "mode", "energy")),
        bind("bond_overload", model.overload),
        bind("bond_on_event", model.on_event),
        bind_record("Reference", kinematics.Reference),
        bind_record("KinematicState", kinematics.State),
        bind_record("BondConstants", model.Constants),
        bind_record("BondState", model.State),
        bind("bond_flow", model.flow)
        if model.flow
        else function("bond_flow", "strain, constants, state", "return state"),
        _reader("read_reference", kinematics.Reference, "Reference", at["reference"]),
        _reader("read_kinematic_state", kinematics.State, "KinematicState", at["kinematic_state"]),
        _writer("write_kinematic_state", kinematics.State, at["kinematic_state"]),
        _reader("read_bond_state", model.State, "BondState", at["state"]),
        _writer("write_bond_state", model.State, at["state"]),
        *_bond_constants(bonds, at["constants"]),
        function("read_damping", "data, lane", f"return ({', '.join(_lane(at['damping'] + k) for k in range(4))})"),
    ]
    return "\n".join(lines)


def _bond_constants(bonds: BondPlan, first: int) -> list[str]:
    values, shared, slot = [], 0, first
    for uniform in bonds.uniform:
        values.append(f"uniforms[{shared}]" if uniform else _lane(slot))
        shared, slot = shared + uniform, slot + (not uniform)
    reads = ", ".join(f"table[{k}]" for k in range(shared))
    record = construct(bonds.model.Constants, "BondConstants", values)
    return [
        function("read_uniforms", "table", f"return ({reads},)" if shared else "return NOTHING"),
        function("read_constants", "uniforms, data, lane", f"return {record}"),
    ]

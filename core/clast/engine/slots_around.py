"""The text of what surrounds the particles of a scene: walls, their motions, body forces, damping of motion."""

from __future__ import annotations

from clast.engine.blueprint import Blueprint
from clast.engine.long_records import construct_long
from clast.engine.records import construct, width
from clast.engine.slots_pieces import bind, bind_record, dispatch, function

SHAPE = "kind, row, lists = walls.shape_kind[w], walls.shape[w], walls.lists"
COURSE = [
    "kind, row, lists = walls.motion_kind[w], walls.course[w], walls.lists",
    "time = now - walls.begun[w]",
]

MOVES = ("velocity", "way", "answer", "start", "spin", "answer_spin", "start_spin", "inverse_mass")


def walls_text(plan: Blueprint) -> str:
    """Return what binds the shapes and motions of a scene's walls."""
    lines, near, places = [], [], []
    for k, wall in enumerate(plan.walls):
        lines += [bind(f"nearest_{k}", wall.nearest), bind_record(f"Shape{k}", wall.Shape)]
        shape = construct_long(wall.Shape, f"Shape{k}")
        near.append(f"nearest_{k}({shape}, x)")
        if wall.touches is not None:
            lines.append(bind(f"touches_{k}", wall.touches))
        places.append(f"touches_{k}({shape}, x, reach, found)" if wall.touches else "0")
    lines.append(dispatch("wall_nearest", "walls, w, x", near, "None", [SHAPE]))
    lines.append(dispatch("wall_touches", "walls, w, x, reach, found", places, "0", [SHAPE]))
    return "\n".join([*lines, *_motions(plan)])


def _motions(plan: Blueprint) -> list[str]:
    lines, begin, known, answers = [], [], [], []
    for k, motion in enumerate(plan.motions):
        lines += [bind(f"{name}_{k}", getattr(motion, name)) for name in MOVES]
        lines.append(bind_record(f"Course{k}", motion.Course))
        course = construct_long(motion.Course, f"Course{k}")
        start = f"start_{k}({course})" if motion.start else "ZERO"
        begin.append(f"velocity_{k}({course}, time)" if motion.velocity else start)
        mean = f"scale(1.0 / span, way_{k}({course}, time - 0.5 * span, time + 0.5 * span))"
        known.append(mean if motion.way else begin[k])
        answers.append(f"answer_{k}({course}, time, pressed)" if motion.answer else known[k])
    for branches in (begin, known, answers):
        branches.append("ZERO")  # walls without a motion stand still
    return [
        *lines,
        dispatch("wall_start", "walls, w, now", begin, "ZERO", COURSE),
        dispatch("wall_velocity", "walls, w, now, span", known, "ZERO", COURSE),
        dispatch("wall_answer", "walls, w, now, pressed", answers, "ZERO", [*COURSE, "span = pressed.span"]),
        *_spins(plan),
        dispatch("wall_inverse_mass", "walls, w, pushed", _inverse_masses(plan), "0.0", COURSE[:1]),
    ]


def _inverse_masses(plan: Blueprint) -> list[str]:
    told = []
    for k, motion in enumerate(plan.motions):
        course = construct_long(motion.Course, f"Course{k}")
        told.append(f"inverse_mass_{k}({course}, pushed)" if motion.inverse_mass else "0.0")
    return [*told, "0.0"]


def _spins(plan: Blueprint) -> list[str]:
    begin, known, answers = [], [], []
    for k, motion in enumerate(plan.motions):
        course = construct_long(motion.Course, f"Course{k}")
        known.append(f"spin_{k}({course}, time)" if motion.spin else "ZERO")
        begin.append(f"start_spin_{k}({course})" if motion.start_spin else known[k])
        answers.append(f"answer_spin_{k}({course}, time, turned)" if motion.answer_spin else known[k])
    for branches in (begin, known, answers):
        branches.append("ZERO")
    return [
        dispatch("wall_start_spin", "walls, w, now", begin, "ZERO", COURSE),
        dispatch("wall_spin", "walls, w, now", known, "ZERO", COURSE),
        dispatch("wall_answer_spin", "walls, w, now, turned", answers, "ZERO", COURSE),
    ]


def body_text(plan: Blueprint) -> str:
    """Return what binds the body forces of a scene."""
    lines, loads, total, at = [], ["force, torque = ZERO, ZERO"], "ZERO", 0
    for k, force in enumerate(plan.body_forces):
        values = [f"row[{at + n}]" for n in range(width(force.Numbers))]
        at += len(values)
        numbers = construct(force.Numbers, f"Numbers{k}", values)
        lines.append(bind_record(f"Numbers{k}", force.Numbers))
        if force.acceleration is not None:
            lines.append(bind(f"acceleration_{k}", force.acceleration))
            total = f"add({total}, acceleration_{k}({numbers}, x, v, time))"
        else:
            lines.append(bind(f"load_{k}", force.load))
            loads.append(f"more, turning = load_{k}({numbers}, x, v, w, radius, time)")
            loads.append("force, torque = add(force, more), add(torque, turning)")
    lines.append(function("body_acceleration", "row, x, v, time", f"return {total}"))
    lines.append(function("body_load", "row, x, v, w, radius, time", [*loads, "return force, torque"]))
    return "\n".join(lines)


def damping_text(plan: Blueprint) -> str:
    """Return what binds the damping of motion of a scene."""
    if plan.damping is None:
        return "braking = steering = nothing"
    values = [f"row[{n}]" for n in range(width(plan.damping.Numbers))]
    lines = [bind("brake", plan.damping.braking), bind_record("Brake", plan.damping.Numbers)]
    known = construct(plan.damping.Numbers, "Brake", values)
    if plan.damping.steering is None:
        braking = function("braking", "row, acceleration, velocity", f"return brake({known}, acceleration, velocity)")
        return "\n".join([*lines, "steering = nothing", braking])
    steering = function("steering", "row, together", f"return steer({known}, together)")
    return "\n".join([*lines, "braking = brake", bind("steer", plan.damping.steering), steering])

"""The text of what surrounds the particles of a scene: walls, their motions, body forces, damping of motion."""

from __future__ import annotations

from clast.engine.blueprint import Blueprint
from clast.engine.records import construct, width
from clast.engine.slots_pieces import bind, bind_record, dispatch, function


def walls_text(plan: Blueprint) -> str:
    """Return what binds the shapes and motions of a scene's walls."""
    lines, near = [], []
    for k, wall in enumerate(plan.walls):
        values = [f"row[{n}]" for n in range(width(wall.Shape))]
        lines += [bind(f"nearest_{k}", wall.nearest), bind_record(f"Shape{k}", wall.Shape)]
        near.append(f"nearest_{k}({construct(wall.Shape, f'Shape{k}', values)}, x)")
    lines.append(dispatch("wall_nearest", "kind, row, x", near, "None"))
    return "\n".join([*lines, *_motions(plan)])


def _motions(plan: Blueprint) -> list[str]:
    lines, known, answers = [], [], []
    for k, motion in enumerate(plan.motions):
        values = [f"row[{n}]" for n in range(width(motion.Course))]
        lines += [
            bind(f"velocity_{k}", motion.velocity),
            bind(f"answer_{k}", motion.answer),
            bind(f"start_{k}", motion.start),
            bind_record(f"Course{k}", motion.Course),
        ]
        course = construct(motion.Course, f"Course{k}", values)
        begin = f"start_{k}({course})" if motion.start else "ZERO"
        known.append(f"velocity_{k}({course}, time)" if motion.velocity else begin)
        answers.append(f"answer_{k}({course}, time, pressed)" if motion.answer else known[k])
    known.append("ZERO")  # walls without a motion stand still
    answers.append("ZERO")
    lines.append(dispatch("wall_velocity", "kind, row, time", known, "ZERO"))
    lines.append(dispatch("wall_answer", "kind, row, time, pressed", answers, "ZERO"))
    return lines


def body_text(plan: Blueprint) -> str:
    """Return what binds the body forces of a scene."""
    lines, total, at = [], "ZERO", 0
    for k, force in enumerate(plan.body_forces):
        values = [f"row[{at + n}]" for n in range(width(force.Numbers))]
        at += len(values)
        lines += [bind(f"acceleration_{k}", force.acceleration), bind_record(f"Numbers{k}", force.Numbers)]
        total = f"add({total}, acceleration_{k}({construct(force.Numbers, f'Numbers{k}', values)}, x, v, time))"
    lines.append(function("body_acceleration", "row, x, v, time", f"return {total}"))
    return "\n".join(lines)


def damping_text(plan: Blueprint) -> str:
    """Return what binds the damping of motion of a scene."""
    if plan.damping is None:
        return "braking = nothing"
    values = [f"row[{n}]" for n in range(width(plan.damping.Numbers))]
    lines = [bind("brake", plan.damping.braking), bind_record("Brake", plan.damping.Numbers)]
    text = f"return brake({construct(plan.damping.Numbers, 'Brake', values)}, acceleration, velocity)"
    return "\n".join([*lines, function("braking", "row, acceleration, velocity", text)])

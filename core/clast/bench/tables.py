"""Sections of the report: a table each, with the sentences that its numbers call for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from clast.bench.features import EVERYTHING, Cost, Shares, shares
from clast.bench.measure import Spread, number, spread
from clast.bench.startup import OUTPUT, FirstRun, Wait
from clast.bench.throughput import MODELS, PEER, Comparison, Readings

MAIN_MODEL = "micro_cracking"


class Goal(NamedTuple):
    """How many times the peer's rate is asked for, and aimed at."""

    least: float
    aim: float


GOALS = {"grain": Goal(7.0, 10.0), "array": Goal(6.0, 8.0)}


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a markdown table; all columns but the first are right-aligned."""
    lines = [list(head), ["---", *["---:"] * (len(head) - 1)], *map(list, rows)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def throughput(comparison: Comparison, costs: dict[str, Cost]) -> str:
    """Return the table of one body, beside the peer, with the verdict."""
    rows = [_row(f"Clast, {MODELS[m]}", r, comparison, m) for m, r in comparison.clast.items()]
    if comparison.peer is not None:
        rows.append(_row(f"{PEER}, `bpm/rotational`", comparison.peer, comparison, None))
    head = ["", "steps per CPU s", f"times {PEER}", "ns per bond and step", "peak memory, MB", "set-up, CPU s"]
    if comparison.body.name == "grain":  # the plates of the array hardly touch within its few steps
        head.append("plate, mN")
    return "\n\n".join([table(head, [row[: len(head)] for row in rows]), verdict(comparison, costs)])


def _row(name: str, readings: Readings, comparison: Comparison, model: str | None) -> list[str]:
    rate = spread(readings.rate)
    ratio = comparison.ratio(model) if model is not None else None
    return [
        name,
        str(rate),
        "" if ratio is None else str(ratio),
        number(1e9 / (rate.median * comparison.body.bonds)),
        number(max(readings.memory)),
        number(min(readings.set_up)),
        f"{1e3 * readings.force[-1]:.2f}",
    ]


def verdict(comparison: Comparison, costs: dict[str, Cost]) -> str:
    """Say whether the goal is reached, and where a step's time goes."""
    ratio, goal = comparison.ratio(MAIN_MODEL), GOALS[comparison.body.name]
    if ratio is None:
        return f"{comparison.problem} The rates of Clast stand alone."
    asked = f"asked are {goal.least:g} times the steps of {PEER}, aimed at {goal.aim:g} times"
    reached = f"Model 3 reaches {number(ratio.median)} times: {asked}."
    part = shares(costs) if costs else None
    if ratio.median >= goal.aim:
        return f"{reached} Both are met." + where(part)
    missed = "The aim is missed" if ratio.median >= goal.least else "**Both are missed**"
    way = f"; what stands in the way most is {part.largest}." if part is not None else "."
    return f"{reached} {missed}{way}{where(part)}"


def where(part: Shares | None) -> str:
    """Say where a step's time goes."""
    if part is None:
        return ""
    named = (("bonds", part.bonds), ("contacts and plates", part.contacts), ("moving the particles", part.motion))
    told = ", ".join(f"{name} {100.0 * value / part.step:.0f} %" for name, value in named)
    return f" Of a step's time, by leaving parts out: {told}."


def features(costs: dict[str, Cost], bonds: int) -> str:
    """Return the table of features, each step beside that of the whole scene."""
    whole = costs[EVERYTHING].step.median
    rows = []
    for name, cost in costs.items():
        step = cost.step
        microseconds = Spread(*(1e-3 * value for value in step))
        change = "" if name == EVERYTHING else f"{100.0 * (step.median - whole) / whole:+.0f} %"
        rows.append([cost.title, str(microseconds), number(step.median / bonds), change])
    return table(("", "µs per step", "ns per bond and step", "change"), rows)


def waits(found: Sequence[Wait], run: FirstRun) -> str:
    """Return the table of waiting times."""
    rows = [
        [w.what, f"`{w.command}`", str(w.wall), number(w.cpu.median), _target(w.wall.median, w.target)] for w in found
    ]
    first = run.first_step
    rows.append(["first start to the first step: compiles", "empty caches", number(first), "", _target(first, 30.0)])
    if not run.short:
        wall, cpu = run.child.wall, run.child.cpu
        rows.append(["first run, start to end", "what `make run` runs", number(wall), number(cpu), _target(wall, 60.0)])
    return table(("", "command", "wall s", "CPU s", "target"), rows)


def _target(value: float, limit: float) -> str:
    return f"< {limit:g} s: {'met' if value < limit else '**missed**'}"


def output(run: FirstRun) -> str:
    """Return what the run spent besides its steps, and its memory."""
    told = run.told
    loop = run.stepping
    rows = [[f"{number(told['steps'])} steps, neighbour lists included", number(loop), ""]]
    rows.append(["of it neighbour lists", number(run.lists), _percent(run.lists, loop)])
    spent = {title: told["spent_s"].get(name, 0.0) for name, title in OUTPUT.items()}
    rows += [[name, number(seconds), _percent(seconds, loop)] for name, seconds in spent.items()]
    share = 100.0 * run.output / loop
    met = "met" if share < 5.0 else "**missed**"
    sentence = f"Samples, frames and saving cost {number(share)} % of the steps (target < 5 %: {met})."
    return "\n\n".join([table(("", "CPU s", "of the steps"), rows), sentence, memory(run), writing(run)])


def writing(run: FirstRun) -> str:
    """Return what the writers need, each in a process of its own and all in one."""
    rows = [[name, number(w.wall), number(w.cpu), f"{w.memory:.0f}"] for name, w in run.writing.items()]
    text = "After the run, recording, files and pictures are written by another process; its start is counted."
    return text + "\n\n" + table(("writer", "wall s", "CPU s", "peak memory, MB"), rows)


def _percent(seconds: float, whole: float) -> str:
    return f"{100.0 * seconds / whole:.1f} %"


def memory(run: FirstRun) -> str:
    """Return the sentence about memory."""
    peaks = run.told["memory_MB"]
    last, end = peaks["last step"], peaks["end"]
    met = "met" if end < 500.0 else "**missed**"
    return (
        f"Peak memory of this run: {peaks['scene read']:.0f} MB once the scene is read (the interpreter and its "
        f"libraries), {peaks['first step']:.0f} MB at the first step (the compiler), {last:.0f} MB at the last step, "
        f"{end:.0f} MB at the very end (target < 500 MB: {met})."
    )


def crush_speed(run: FirstRun) -> str:
    """Return how the speed changes while the grain breaks."""
    rows = [
        [f"to {100.0 * row['strain']:.1f} %", number(row["steps_per_s"]), f"{row['lists']:.0f}"]
        for row in run.told["speed"]
    ]
    share = 100.0 * run.lists / run.stepping
    sentence = f"Making neighbour lists takes {number(share)} % of the whole loop."
    return table(("strain", "steps per CPU s", "lists made"), rows) + "\n\n" + sentence

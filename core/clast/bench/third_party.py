"""Section: a third party's law beside the same law of Clast's own."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from clast.bench.features import compile_all
from clast.bench.measure import Spread, say, spread, worker
from clast.bench.scenes import base_grain, scene, write_scene, write_tables
from clast.bench.section import Effort, Section, Task

MODEL, TWIN = "elastic_plastic", "third_party"
FIRST, STEPS, ROUNDS = 2000, 1000, 21
BOUNDS = 0.95, 1.05


@dataclass
class Twins:
    """CPU ns a step of a grain with Clast's own law and with the same law from a file, and their ratio by turns."""

    own: Spread
    twin: Spread
    ratio: Spread


def write_twin(own: Path, file: Path) -> None:
    """Write a plugin that registers the law of one of Clast's files under another name."""
    text = own.read_text(encoding="utf-8")
    head, register, tail = text.partition("def clast_register")
    named = tail.replace(f'"{MODEL}"', f'"{TWIN}"')
    file.write_text(f"{head}{register}{named}\n\nCLAST_API = 1\n", encoding="utf-8")


def measure(task: Task) -> Twins:
    """Advance both grains by turns in one process, on one thread."""
    say("a third party's law")
    folder = task.folder / "third_party"
    folder.mkdir()
    own = task.registry.get("bond_model", MODEL).file
    assert own is not None
    write_twin(own, folder / "law.py")
    body = base_grain()
    write_tables(body, folder)
    files = []
    for name in (MODEL, TWIN):
        data = scene(body, MODEL)
        data["bonds"]["model"]["type"] = name
        data["plugins"] = [str(folder / "law.py")] if name == TWIN else []
        files.append(write_scene(data, folder / f"{name}.yaml"))
    compile_all(files)
    rounds = 5 if task.effort is Effort.QUICK else ROUNDS
    _, times = worker("compare_scenes", FIRST, STEPS, rounds, *files)
    ratios = [twin / own for own, twin in zip(times[MODEL], times[TWIN], strict=True)]
    own_ns, twin_ns = (spread([1e9 * each for each in times[name]]) for name in (MODEL, TWIN))
    return Twins(own_ns, twin_ns, spread(ratios))


def text(found: Twins, pictures: Path) -> str:
    """Return the section."""
    low, high = BOUNDS
    met = "met" if low <= found.ratio.median <= high else "**missed**"
    told = (
        f"The law of `{MODEL}`, copied into a file of its own and named under `plugins`, runs the base grain in "
        f"{found.ratio.median:.3f} ({found.ratio.low:.3f} to {found.ratio.high:.3f}) times the CPU time of Clast's "
        f"own (target {low:g} to {high:g}: {met}): {found.twin} beside {found.own} ns a step, by turns in one process."
    )
    return f"### What it costs that a law is a third party's\n\n{told}"


SECTION = Section("third_party", "a third party's law beside Clast's own", Twins, measure, text)

"""The page that shows every case: what it should give, what it gives, and a picture of each family."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path

from clast.verification.case import Case, Family
from clast.verification.examine import FAILED, NOT_APPLICABLE, Outcome
from clast.verification.picture import draw
from clast.verification.table import HEADINGS, rows, total

PICTURES = "img"
"""Folder of the pictures, beside the page."""

INTRODUCTION = """# Verification

Scenes with known answers, run through the whole program, from the scene file to the last step. Everything on this
page was written by one command, `{command}`, with Clast {version}.

{total}.

`clast verify` runs the same and prints the tables, `clast verify NAME` one case; the exit code is 1 where one
fails. Your own part goes through the same cases by name: `clast verify --plugin my_law.py --contact-law my_law`
puts it in the place of Clast's own in every scene that has contacts. `--bond-model`, `--integrator` and `--set
KEY=VALUE` do likewise. A case whose closed form does not hold for a part says so and is left out. Bounds are what the
default integrator keeps; `leapfrog` and `velocity_verlet` exceed those of three damped impacts
([by how much, and why](theory.md#integrators)). The scenes are in `configs/verification`; each runs by itself, too.

An error is a share of the expected number, in per cent, or the difference itself, in the units of the quantity; its
bound is of the same kind. Times include compiling where the step loop was not yet known.
"""


def write_page(file: Path, examined: Sequence[tuple[Family, Outcome]], command: Sequence[str]) -> None:
    """Write the page and its pictures.

    Parameters
    ----------
    file : Path
        A Markdown file; pictures go into the folder ``img`` beside it.
    examined : sequence of (Family, Outcome)
        In the order of the suite.
    command : sequence of str
        What wrote the page, as typed.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    outcomes = [outcome for _, outcome in examined]
    told = {"command": shlex.join(command), "version": version("clast"), "total": total(outcomes)}
    parts = [INTRODUCTION.format(**told)]
    for family in dict.fromkeys(family for family, _ in examined):
        own = [outcome for its, outcome in examined if its is family]
        parts.append("\n".join(section(family, own, file.parent)))
    file.write_text("\n".join(parts), encoding="utf-8")


def section(family: Family, outcomes: Sequence[Outcome], folder: Path) -> Iterator[str]:
    """Return the lines of one family, and draw its picture."""
    yield f"## {family.title}\n\n{family.text}\n"
    sketches = [sketch for outcome in outcomes for sketch in outcome.sketches]
    if sketches:
        picture = f"{PICTURES}/verification_{family.name}.png"
        draw(sketches, folder / picture)
        yield f"![{family.title}]({picture})\n"
    for outcome in outcomes:
        yield described(outcome.case)
    yield ""
    yield line(HEADINGS)
    yield line(("---", "---", "---:", "---:", "---:", "---:", "---:"))
    for outcome in outcomes:
        for row in rows(outcome):
            yield line(marked(row.cells, row.verdict))
    yield ""


def described(case: Case) -> str:
    """Return one entry of the list of cases."""
    return f"- `{case.name}`: {case.title} (`{case.config}.yaml`). Expected: {case.expected}."


def marked(cells: Sequence[str], verdict: str) -> tuple[str, ...]:
    """Return the cells of a row, in bold where it failed, in italics where it does not apply."""
    mark = {FAILED: "**", NOT_APPLICABLE: "*"}.get(verdict, "")
    return tuple(f"{mark}{cell}{mark}" if cell else "" for cell in cells)


def line(cells: Sequence[str]) -> str:
    """Return one line of a Markdown table."""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"

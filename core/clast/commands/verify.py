"""``clast verify``: run cases with known answers and print one table."""

from __future__ import annotations

import json
import sys
from collections.abc import Collection, Sequence
from contextlib import nullcontext
from pathlib import Path

from rich.console import Console
from rich.table import Table

from clast.verification.bench import Bench
from clast.verification.case import Case
from clast.verification.examine import FAILED, NOT_APPLICABLE, PASSED, Outcome, examine
from clast.verification.replacement import Replacement
from clast.verification.suite import FAMILIES, chosen
from clast.verification.table import HEADINGS, plain, rows, total

COLOURS = {PASSED: "", FAILED: "red", NOT_APPLICABLE: "dim"}
NUMBERS = HEADINGS[2:]
WIDE = 200
"""Columns where no terminal tells how many it has."""


def verify(
    cases: Collection[str] = (),
    families: Collection[str] = (),
    replacement: Replacement | None = None,
    as_json: bool = False,
    page: Path | None = None,
) -> bool:
    """Run cases, print what they found, and tell whether none failed.

    Parameters
    ----------
    cases, families : collection of str
        Names; all cases, where there are none.
    replacement : Replacement or None
        What takes the place of Clast's own parts.
    as_json : bool
        Whether to print JSON instead of a table.
    page : Path or None
        Markdown file to write, with pictures beside it.

    Raises
    ------
    ConfigError
        A name is unknown, or the replacement does not fit a scene, or fits none of them.
    """
    which = chosen(cases, families)
    outcomes = examine_all([case for _, case in which], replacement or Replacement())
    if page is not None:
        from clast.verification.page import write_page

        write_page(page, [(family, outcome) for (family, _), outcome in zip(which, outcomes, strict=True)], typed())
    if as_json:
        print(json.dumps([plain(outcome) for outcome in outcomes], indent=2, ensure_ascii=False))
    else:
        print_table(outcomes)
    return all(outcome.verdict != FAILED for outcome in outcomes)


def typed() -> list[str]:
    """Return the command line, whatever the program's file is called."""
    return ["clast", *sys.argv[1:]]


def examine_all(cases: Sequence[Case], replacement: Replacement) -> list[Outcome]:
    """Run cases one after the other; a terminal shows which."""
    benches = {config: Bench(config, replacement) for config in dict.fromkeys(case.config for case in cases)}
    replacement.refuse_idle(bench.scene() for bench in benches.values())
    console = Console(stderr=True)
    outcomes = []
    with console.status("") if sys.stderr.isatty() else nullcontext() as status:
        for case in cases:
            if status is not None:
                status.update(f"{case.name}: {case.title}")
            outcomes.append(examine(case, benches[case.config]))
    return outcomes


def print_table(outcomes: Sequence[Outcome]) -> None:
    """Print one line a finding; to a terminal with colours, else plain."""
    table, console = new_table(HEADINGS), new_console()
    for outcome in outcomes:
        for row in rows(outcome):
            table.add_row(*row.cells, style=COLOURS[row.verdict])
        table.add_section()
    console.print(table)
    for outcome in outcomes:
        if outcome.verdict == FAILED:
            console.print(f"failed: {outcome.case.name}, {outcome.case.title}", style="red", highlight=False)
    console.print(total(outcomes), highlight=False)


def print_list() -> None:
    """Print all cases with their families and scenes."""
    table = new_table(("family", "case", "verifies", "scene"))
    for family in FAMILIES:
        for case in family.cases:
            table.add_row(family.name, case.name, case.title, f"{case.config}.yaml")
    new_console().print(table)


def new_console() -> Console:
    """Return a console for tables: as wide as the terminal, or as they need where there is none."""
    return Console(width=None if sys.stdout.isatty() else WIDE)


def new_table(headings: Sequence[str]) -> Table:
    """Return an empty table; numbers stand on the right."""
    table = Table(box=None, pad_edge=False)
    for heading in headings:
        table.add_column(heading, justify="right" if heading in NUMBERS else "left", max_width=60)
    return table

"""``clast reproduce``: run all studies of a publication, and write the page that tells what holds."""

from __future__ import annotations

import shutil
from collections.abc import Collection
from pathlib import Path

from clast.commands.sweep import sweep
from clast.reproduce.manuscript import Manuscript
from clast.reproduce.section import section, statements
from clast.results.whole_file import whole_file
from clast.studies.config import load_study
from clast.studies.executors import Maker
from clast.studies.outcome import StudyOutcome


def reproduce(
    manuscript: Manuscript, folder: Path, page: Path, maker: Maker | None, only: Collection[str] = ()
) -> dict[str, StudyOutcome]:
    """Run the studies of a manuscript that are not done yet, and write its page.

    Parameters
    ----------
    manuscript : Manuscript
    folder : Path
        Of the studies, one folder each.
    page : Path
        Markdown file; its figures lie beside it in ``img``.
    maker : Maker or None
        None only gathers what is there.
    only : collection of str
        Studies that are run; what the others have is gathered.

    Raises
    ------
    ClastError
        With a message for the user.
    """
    studies = {name: load_study(manuscript.file_of(name)) for name in manuscript.studies}
    chosen = manuscript.chosen(only)
    outcomes = {}
    for name, study in studies.items():
        if name in chosen:
            print(f"{name}: {study.description or manuscript.file_of(name)}", flush=True)
        outcomes[name] = sweep(study, folder / name, maker if name in chosen else None)
    write_page(manuscript, outcomes, page)
    return outcomes


def write_page(manuscript: Manuscript, outcomes: dict[str, StudyOutcome], page: Path) -> None:
    """Write the page and copy its figures."""
    sections = {}
    (page.parent / "img").mkdir(parents=True, exist_ok=True)
    for name, outcome in outcomes.items():
        drawn = outcome.folder / "curves.png"
        image = f"img/{manuscript.folder.resolve().name}_{name}.png" if drawn.exists() else None
        if image is not None:
            shutil.copyfile(drawn, page.parent / image)
        sections[name] = section(outcome, image)
    text = manuscript.filled(sections, statements(outcomes))
    with whole_file(page) as draft:
        draft.write_text(text, encoding="utf-8")

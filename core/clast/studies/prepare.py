"""Preparing a study: its folder, and the scene of every run in it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from clast.config.document import Document
from clast.config.yaml_loader import dump_yaml
from clast.errors import RefusedError
from clast.results.reading import read_yaml
from clast.results.whole_file import whole_file
from clast.studies import layout
from clast.studies.config import StudyConfig
from clast.studies.tasks import Task, tasks


def prepare(study: StudyConfig, folder: Path) -> list[Task]:
    """Write the scene of every run, and the list of all, into a study's folder.

    Raises
    ------
    ConfigError
        A value that the scene does not allow.
    RunError
        If the folder holds something else.
    """
    found = tasks(study)
    settle(folder, study.document, study.study, found)
    with whole_file(folder / layout.LIST) as draft:
        draft.write_text("".join(f"{name}\n" for name in dict.fromkeys(task.name for task in found)), encoding="utf-8")
    return found


def settle(folder: Path, document: Document, title: str, found: Sequence[Task], name: str = layout.STUDY) -> None:
    """Make the folder of some runs, with the file that asks for them and their scenes.

    Raises
    ------
    RunError
        If the folder holds something else.
    """
    if folder.is_dir() and any(folder.iterdir()) and not (folder / name).exists():
        raise RefusedError(f"{folder}: holds something else; choose another folder with -o")
    key = Path(name).stem
    before = read_yaml(folder / name).get(key, title)
    if before != title:
        raise RefusedError(f"{folder}: holds the {key} {before!r}; choose another folder for {title!r} with -o")
    (folder / "runs").mkdir(parents=True, exist_ok=True)
    (folder / "scenes").mkdir(exist_ok=True)
    with whole_file(folder / name) as draft:
        draft.write_text(dump_yaml({key: title, **document.data}), encoding="utf-8")
    for task in {task.name: task for task in found}.values():
        file = layout.scene_of(folder, task.name)
        if not file.exists():
            with whole_file(file) as draft:
                draft.write_text(task.scene, encoding="utf-8")

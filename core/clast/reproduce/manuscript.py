"""A manuscript: a page of Markdown in which marks stand for what studies will say.

``<!-- study: fig16 -->`` stands for the study file ``fig16.yaml`` beside the manuscript: its figure, its table and what
becomes of each of its statements. ``<!-- statements -->`` stands for all statements of all studies in one table.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from clast.errors import ConfigError
from clast.plugins.nearest import suggestion

FILE = "page.md"
STUDY = re.compile(r"^<!-- study: (\S+) -->$", re.MULTILINE)
STATEMENTS = "<!-- statements -->"


@dataclass(frozen=True)
class Manuscript:
    """The page of a reproduction.

    Attributes
    ----------
    folder : Path
        Where it and its studies lie.
    text : str
    """

    folder: Path
    text: str

    @property
    def studies(self) -> list[str]:
        """Names of its studies, in their order."""
        return STUDY.findall(self.text)

    def file_of(self, study: str) -> Path:
        """Return the study file of a name."""
        return self.folder / f"{study}.yaml"

    def chosen(self, only: Collection[str]) -> list[str]:
        """Return the names that are asked for; all, if none is.

        Raises
        ------
        ConfigError
            The page has no such study.
        """
        for name in only:
            if name not in self.studies:
                raise ConfigError(f"{self.folder / FILE}: has no study {name!r}; {suggestion(name, self.studies)}")
        return [name for name in self.studies if not only or name in only]

    def filled(self, sections: dict[str, str], statements: str) -> str:
        """Return the page with what the studies say in the place of its marks."""
        text = STUDY.sub(lambda found: sections[found[1]], self.text)
        return text.replace(STATEMENTS, statements)


def read_manuscript(name: str) -> Manuscript:
    """Read the manuscript of a reproduction: in a folder, or in ``configs/NAME``.

    Raises
    ------
    ConfigError
        There is none, or a study that it names is missing.
    """
    places = [Path(name), Path("configs") / name, Path(__file__).parents[3] / "configs" / name]
    for folder in places:
        if (folder / FILE).is_file():
            found = Manuscript(folder, (folder / FILE).read_text(encoding="utf-8"))
            missing = [study for study in found.studies if not found.file_of(study).is_file()]
            if missing:
                raise ConfigError(f"{folder / FILE}: names the study {missing[0]!r}, but there is no {missing[0]}.yaml")
            return found
    told = " or ".join(str(folder / FILE) for folder in places[:2])
    raise ConfigError(f"{name!r}: nothing to reproduce; looked for {told}")

"""A page as a browser reads it: what it holds, whether it is well-formed, and what it would load."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

VOID = {"meta", "img", "br", "link", "input", "hr", "line"}
LOADING = ("src", "href", "xlink:href", "data", "action", "poster", "srcset", "background")


class Page(HTMLParser):
    """Parses a page and refuses what is not closed in order."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.source = path.read_text(encoding="utf-8")
        self.open: list[str] = []
        self.tags: list[str] = []
        self.ids: list[str] = []
        self.loaded: list[str] = []
        self.texts: list[str] = []
        self.cells: list[list[str]] = []
        self.feed(self.source)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._note(tag, attrs)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._note(tag, attrs)

    def handle_endtag(self, tag: str) -> None:
        if tag in VOID:
            return
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] != "style":
            self.texts.append(data)
        if self.cells and self.open and "tr" in self.open and self.cells[-1]:
            self.cells[-1][-1] += data

    def _note(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        if tag == "tr":
            self.cells.append([])
        if tag in ("td", "th"):
            self.cells[-1].append("")
        names = [name for name, _ in attrs]
        assert len(set(names)) == len(names)
        assert not [name for name in names if name.startswith("on")]
        self.ids += [value or "" for name, value in attrs if name == "id"]
        self.loaded += [value or "" for name, value in attrs if name in LOADING]
        for name, value in attrs:
            if name == "style":
                self.loaded += re.findall(r"url\((.*?)\)", value or "")

    @property
    def text(self) -> str:
        """All that a reader sees, spaces folded."""
        return " ".join("".join(self.texts).split())

    @property
    def rows(self) -> dict[str, list[str]]:
        """Rows of all tables by their first cell, the first where several begin alike."""
        folded = [[" ".join(cell.split()) for cell in row] for row in self.cells if row]
        return {row[0]: row[1:] for row in reversed(folded)}

    @property
    def foreign(self) -> list[str]:
        """Addresses that lead out of the page and its folders."""
        own = ("#", "data:image/png;base64,")
        return [each for each in self.loaded if not each.startswith(own) and re.match(r"[a-z][a-z0-9+.-]*:|//", each)]

"""The index of the decisions: number and title of each."""

from __future__ import annotations

from sitebuild import DOCS


def decisions_page() -> str:
    """Return the page."""
    lines = ["# Decisions", "", "What could have been otherwise, and why it is as it is.", ""]
    for file in sorted((DOCS / "decisions").glob("*.md")):
        title = file.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")
        lines.append(f"- [{title}]({file.name})".replace(". ", "\\. ", 1))
    return "\n".join(lines) + "\n"

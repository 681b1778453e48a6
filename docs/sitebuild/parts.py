"""The pages of all parts that are registered, with an index."""

from __future__ import annotations

from collections.abc import Iterator

from clast.plugins.registered import Registered
from clast.plugins.registry import Registry
from sitebuild.curves import drawing
from sitebuild.docstring import plain
from sitebuild.part_page import Picture, part_page, table

FOLDER = "parts"


def part_files(registry: Registry) -> Iterator[tuple[str, str | bytes]]:
    """Yield place and content of every page of a part and of its picture, and of the index."""
    yield f"{FOLDER}/index.md", index_page(registry)
    for entry in registry:
        drawn = drawing(entry)
        picture = None if drawn is None else Picture(f"{entry.name}.svg" if drawn.svg else "", drawn.caption)
        yield page_uri(entry), part_page(entry, picture)
        if drawn is not None and drawn.svg:
            yield page_uri(entry).removesuffix("md") + "svg", drawn.svg


def page_uri(entry: Registered) -> str:
    """Return where the page of a part lies in the site."""
    return f"{FOLDER}/{entry.kind}/{entry.name}.md"


def index_page(registry: Registry) -> str:
    """Return the table of all parts, with the plugins that could not be loaded below."""
    rows = [
        [
            entry.kind.replace("_", " "),
            f"[{entry.name}]({page_uri(entry).removeprefix(f'{FOLDER}/')})",
            plain(entry.part.summary),
            plain(str(entry.source)),
        ]
        for entry in registry
    ]
    failures = [f"Not loaded: {plain(str(failure))}" for failure in registry.failures]
    sentence = "Everything physical is a part. `clast plugins` lists those of your installation, with yours among them."
    return "\n\n".join(["# Parts", sentence, table(["kind", "name", "one line", "from"], rows), *failures]) + "\n"

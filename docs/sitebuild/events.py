"""What happens when mkdocs builds the site: pages are added, and links that lead out of docs/ find their files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from clast.plugins.discovery import discover
from sitebuild import DOCS, ROOT
from sitebuild.api import api_pages
from sitebuild.decisions import decisions_page
from sitebuild.links import SCENES, linked_outside, place, relink
from sitebuild.offline import WORKER, keep_offline
from sitebuild.parts import part_files
from sitebuild.scenes import scene_files, scenes_page

_ROLE = re.compile(r":(?:class|func|meth|mod|attr):(?=<code>)")
_FROM_ROOT = ("README.md", "CHANGELOG.md", "LICENSE")

STYLE = "assets/stylesheets/clast.css"

made: dict[str, str | bytes] = {}
"""Pages and pictures by their place in the site, made anew for each build."""


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Make the pages, and put those of a folder where the navigation names it."""
    made.clear()
    made.update(generated())
    assert config.nav is not None
    config.nav = [_expanded(entry) for entry in config.nav]
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the generated pages, and the files outside docs/ that pages are about."""
    for uri, content in made.items():
        files.append(File.generated(config, uri, content=content))
    for file in outside_files():
        files.append(File.generated(config, place(file), abs_src_path=str(file)))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Point the links of a page that lies in the repository to where files are in the site."""
    source = page.file.abs_src_path
    return relink(markdown, Path(source)) if source is not None else markdown


def on_page_content(html: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Take out of docstrings what only Sphinx knows: roles, and the second colon before a block of code."""
    return _ROLE.sub("", html).replace("::</p>", ":</p>")


def on_post_build(config: MkDocsConfig) -> None:
    """Make sure that reading the site needs no network.

    Raises
    ------
    PluginError
        With the pages that would fetch something.
    """
    fetched = keep_offline(Path(config.site_dir))
    if fetched:
        raise PluginError("pages must not fetch from the net: " + "; ".join(fetched))


def generated() -> Iterator[tuple[str, str | bytes]]:
    """Yield place and content of every page and picture that is made while the site is built."""
    yield SCENES, scenes_page()
    yield WORKER, (DOCS / "sitebuild" / "worker.js").read_text(encoding="utf-8")
    yield STYLE, (DOCS / "sitebuild" / "style.css").read_text(encoding="utf-8")
    yield "decisions/index.md", decisions_page()
    yield from part_files(discover())
    yield from ((f"api/{name}.md", text) for name, text in api_pages())


def outside_files() -> list[Path]:
    """Return the files outside docs/ that belong to the site."""
    own = [ROOT / name for name in _FROM_ROOT]
    pages = [own[0], own[1], *DOCS.rglob("*.md")]
    return sorted({*own, *scene_files(), *linked_outside(pages)})


def _expanded(entry: Any) -> Any:
    """Return an entry of the navigation with folders, whose name ends with /, in the place of their pages."""
    if isinstance(entry, str):
        return _pages(entry) if entry.endswith("/") else entry
    if isinstance(entry, Mapping):
        return {title: _expanded(below) for title, below in entry.items()}
    return [_expanded(each) for each in entry]


def _pages(folder: str) -> list[Any]:
    """Return the navigation of a folder: its index first, then its pages, then the folders in it."""
    of_repository = (file.relative_to(DOCS).as_posix() for file in (DOCS / folder).glob("*.md"))
    uris = sorted({*(uri for uri in made if uri.startswith(folder) and uri.endswith(".md")), *of_repository})
    here = sorted((uri for uri in uris if "/" not in uri.removeprefix(folder)), key=lambda uri: "/index.md" not in uri)
    below = dict.fromkeys(uri.removeprefix(folder).split("/")[0] for uri in uris if uri not in here)
    return [*here, *({name.replace("_", " "): _pages(f"{folder}{name}/")} for name in below)]

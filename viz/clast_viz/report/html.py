"""The HTML file: a template filled so that nothing in it can break out of its place."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from clast.about import VERSION
from clast.results.whole_file import whole_file
from clast_viz.report.printable import printable


def write_page(page: Path, template: str, values: dict[str, Any]) -> None:
    """Fill a template and write it whole or not at all."""
    environment = Environment(
        loader=PackageLoader("clast_viz.report"),
        autoescape=True,
        finalize=_printable,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    text = environment.get_template(template).render(version=VERSION, **values)
    page.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(page) as draft:
        draft.write_text(text, encoding="utf-8")


def _printable(value: Any) -> Any:
    return printable(value) if isinstance(value, str) and not isinstance(value, Markup) else value

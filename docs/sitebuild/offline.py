"""The site needs no network: what the theme would fetch is replaced, and nothing else may be fetched."""

from __future__ import annotations

import os
import re
from pathlib import Path

SHIM = "https://unpkg.com/iframe-worker/shim"
WORKER = "assets/javascripts/worker.js"
_FETCHED = re.compile(r"<(?:script|link|img|iframe)\b[^>]*?\b(?:src|href)=\"?(https?://[^\s\">]+)")


def keep_offline(site: Path, canonical: str = "") -> list[str]:
    """Let every page of a built site search by the script at ``WORKER``; return what would still be fetched.

    Parameters
    ----------
    site : Path
        Folder of the built site.
    canonical : str
        Address under which the site is published, which pages may name.
    """
    fetched = []
    for page in sorted(site.rglob("*.html")):
        text = page.read_text(encoding="utf-8")
        own = text.replace(SHIM, os.path.relpath(site / WORKER, page.parent))
        if own != text:
            page.write_text(own, encoding="utf-8")
        addresses = (found for found in _FETCHED.findall(own) if not canonical or not found.startswith(canonical))
        fetched += [f"{page.relative_to(site)}: {address}" for address in addresses]
    return fetched

"""Figures as SVG that stands inside a page: scales with it, takes its text colour, and brings no address along."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable
from typing import Any
from xml.etree import ElementTree

from markupsafe import Markup

from clast_viz.figure import STYLE

SVG_STYLE = STYLE | {
    "svg.fonttype": "none",  # text stays text: it can be searched, and is a tenth as long
    "svg.hashsalt": "clast",
    "text.parse_math": False,  # a name may hold a dollar sign
}
NO_METADATA = dict.fromkeys(("Creator", "Date", "Format", "Type"))
FOLLOWING = {"#000000": "currentColor", "#e4e7eb": "var(--line)", "#ffffff": "var(--page)"}
"""Colours that follow the page, so that a chart can be read on a dark one."""


def inline_svg(draw: Callable[[], Any], title: str, prefix: str) -> Markup:
    """Draw a figure and return it as an ``svg`` element for an HTML page.

    Parameters
    ----------
    draw : callable
        Returns a matplotlib figure; called with the style of the charts set.
    title : str
        What the chart shows, for those who do not see it.
    prefix : str
        Unique in the page; put before every id of the chart.
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    text = io.StringIO()
    with mpl.rc_context(SVG_STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing", UserWarning)  # the reader's fonts draw the text
        figure = draw()
        FigureCanvasSVG(figure)
        figure.savefig(text, format="svg", transparent=True, metadata=NO_METADATA)
    return Markup(_for_html(ElementTree.fromstring(text.getvalue()), title, prefix))


def _for_html(svg: ElementTree.Element, title: str, prefix: str) -> str:
    for parent in list(svg.iter()):
        for child in list(parent):
            if child.tag.endswith("}style"):  # would hold for the whole page; style.css says the same of charts
                parent.remove(child)
    for element in svg.iter():
        element.tag = element.tag.rpartition("}")[2]
        element.attrib = {
            name.rpartition("}")[2]: _local(name, value, prefix) for name, value in element.attrib.items()
        }
    svg.attrib = {"viewBox": svg.attrib["viewBox"], "role": "img", "aria-label": title}
    return ElementTree.tostring(svg, encoding="unicode")


def _local(name: str, value: str, prefix: str) -> str:
    """Return the value of an attribute with ids made unique and colours that follow the page."""
    if name == "id":
        return f"{prefix}-{value}"
    if name.endswith("href"):
        return value.replace("#", f"#{prefix}-", 1)
    if name == "style":
        for colour, following in FOLLOWING.items():
            value = value.replace(colour, following)
    return value.replace("url(#", f"url(#{prefix}-")

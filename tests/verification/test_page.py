"""The page of all cases: written by one command, and not behind the suite."""

import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from clast.cli import main
from clast.verification.page import line, marked
from clast.verification.picture import draw_panel
from clast.verification.sketch import Line, Sketch
from clast.verification.suite import FAMILIES

DOCS = Path(__file__).parents[2] / "docs"
PNG = b"\x89PNG"


def test_a_page_holds_tables_and_a_picture_for_each_family(tmp_path):
    file = tmp_path / "new" / "page.md"
    result = CliRunner().invoke(main, ["verify", "chung_ooi_2", "--docs", str(file)])
    assert result.exit_code == 0
    page = file.read_text(encoding="utf-8")
    assert "1 cases: 1 passed" in page
    assert "| chung_ooi_2 | magnesium alloy: peak force, N | 7232.68 |" in page
    (picture,) = re.findall(r"!\[.*]\((.*)\)", page)
    assert (file.parent / picture).read_bytes().startswith(PNG)


def test_what_failed_is_set_in_bold_and_bars_are_kept_out_of_the_table():
    assert marked(("", "force |F|", "1"), "failed") == ("", "**force |F|**", "**1**")
    assert line(("a", "|F|")) == "| a | \\|F\\| |"


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_published_page_shows_every_case(family):
    """Where this fails, write the page anew: clast verify --docs docs/verification.md."""
    page = (DOCS / "verification.md").read_text(encoding="utf-8")
    assert f"## {family.title}\n" in page
    for case in family.cases:
        assert f"\n- `{case.name}`: " in page
        assert f"\n| {case.name} | " in page
    assert " failed" not in page.split("\n\n")[2]
    assert (DOCS / "img" / f"verification_{family.name}.png").read_bytes().startswith(PNG)


def test_no_legend_hides_what_a_panel_shows():
    figure = Figure(layout="constrained")
    FigureCanvasAgg(figure)
    axis = figure.subplots()
    x = np.linspace(0.0, 1.0, 5)
    draw_panel(axis, Sketch("title", "x", "y", tuple(Line(f"line {k}", x, k * x) for k in range(6))))
    figure.draw_without_rendering()
    assert not axis.get_legend().get_window_extent().overlaps(axis.get_window_extent())

"""The site: links find their files, pages stand where the navigation wants them, nothing is fetched from the net."""

import re

import clast
from sitebuild import DOCS, ROOT
from sitebuild.api import api_pages
from sitebuild.decisions import decisions_page
from sitebuild.doctests import fenced
from sitebuild.links import linked_outside, relink
from sitebuild.offline import SHIM, keep_offline
from sitebuild.scenes import scene_files, scenes_page


def test_links_out_of_the_documentation_lead_to_where_the_site_has_the_files():
    readme = "[a](docs/theory.md#walls) ![b](docs/img/fig05.png) [c](docs/decisions/) [d](LICENSE) [e](configs/)"
    moved = "[a](theory.md#walls) ![b](img/fig05.png) [c](decisions/index.md) [d](LICENSE) [e](configs/index.md)"
    assert relink(readme, ROOT / "README.md") == moved
    decision = "[a](../stability.md) [b](../../configs/crush_grain.yaml) [c](https://clast.org/x.md)"
    moved = "[a](../stability.md) [b](../configs/crush_grain.yaml) [c](https://clast.org/x.md)"
    assert relink(decision, DOCS / "decisions" / "0001-parts-are-plain-functions.md") == moved


def test_a_wrong_link_is_left_for_the_build_to_find():
    assert relink("[a](../no_such.yaml)", DOCS / "theory.md") == "[a](../no_such.yaml)"


def test_files_outside_the_documentation_that_pages_link_to_are_found():
    assert ROOT / "tests/data/musen/grain_a/README.md" in [*linked_outside([DOCS / "parity.md"])]


def test_every_scene_stands_on_the_page_of_the_scenes_with_a_sentence():
    rows = dict(re.findall(r"^\| \[.*?\]\((.*?)\) \| (.*) \|$", scenes_page(), re.MULTILINE))
    assert list(rows) == [file.relative_to(ROOT / "configs").as_posix() for file in scene_files()]
    assert rows["crush_grain.yaml"].startswith("Crush one porous glass grain")
    assert all(rows.values())


def test_every_decision_is_listed():
    files = {file.name for file in (DOCS / "decisions").glob("*.md")}
    assert set(re.findall(r"\]\((.*?)\)", decisions_page())) == files


def test_the_interface_is_documented_with_every_name_that_clast_exports_and_every_kind_of_part():
    pages = dict(api_pages())
    for name in clast.__all__:
        assert name in ("__version__", "hookimpl") or f".{name}\n" in pages["index"]
    for file in (ROOT / "core" / "clast" / "parts").glob("[a-z]*.py"):
        assert f"::: clast.parts.{file.stem}\n" in pages["parts"]


def test_doctests_become_code():
    assert fenced("Two.\n\n>>> 1 + 1\n2\n\nMore.") == "Two.\n\n```pycon\n>>> 1 + 1\n2\n```\n\nMore."


def test_a_page_that_would_fetch_something_is_named(tmp_path):
    (tmp_path / "api").mkdir()
    page = tmp_path / "api" / "index.html"
    page.write_text(
        f'<script src="{SHIM}"></script><link href="https://fonts.example/x.css"><a href="https://ok.example">'
    )
    assert keep_offline(tmp_path) == ["api/index.html: https://fonts.example/x.css"]
    assert '<script src="../assets/javascripts/worker.js">' in page.read_text()

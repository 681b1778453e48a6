"""Every part has a page that says what it computes and takes, and pictures that agree with closed forms."""

import re
from dataclasses import replace
from math import log10
from types import SimpleNamespace

import numpy as np
import pytest
import yaml

from clast import load
from clast.config.describe import parameters
from clast.config.examples import example
from clast.engine.records import fields
from clast.parts.params import Params
from clast.plugins.discovery import discover
from clast.testing.bonds import bond, stretched
from clast.verification.closed_forms.hertz import HertzImpact
from sitebuild import DOCS, ROOT
from sitebuild.curves import damping, drawing, rolling_resistance
from sitebuild.curves.bond_model import loading_cycle, sheared
from sitebuild.curves.contact_law import GLASS, MASS, SPEED, Law, R, impact, sideways
from sitebuild.curves.integrator import error
from sitebuild.docstring import sections
from sitebuild.part_page import STATES, Picture, part_page
from sitebuild.parts import index_page, page_uri

REGISTRY = discover()
THIRD_PARTY = discover([DOCS / "examples" / "my_law.py"])


class Bare(Params):
    """Parameters that state no example of what they need."""

    radius: float


def named(entry):
    return f"{entry.kind}.{entry.name}"


each_part = pytest.mark.parametrize("entry", list(THIRD_PARTY), ids=named)


@each_part
def test_a_page_says_what_the_part_computes(entry):
    page, told = part_page(entry, None), sections(entry.part.Params)
    assert page.startswith(f"# {entry.name}\n")
    assert "## Equation\n\n```text\n" in page or re.search(r"\w{3,}.*[.;:]", told[0].text)
    assert all(f"## {section.title}\n" in page for section in told[1:])


@each_part
def test_a_page_names_every_parameter_and_everything_the_part_remembers(entry):
    page = part_page(entry, None)
    for parameter in parameters(entry.part.Params):
        row = next(line for line in page.splitlines() if line.startswith(f"| `{parameter.name}` |"))
        assert len(re.findall(r"(?<!\\)\|", row)) == 6
    for slot in fields(getattr(entry.part, STATES.get(entry.kind, ""), None)):
        assert f"| `{slot.name}` |" in page


@each_part
def test_a_page_shows_yaml_that_names_the_part_and_the_file_it_is_in(entry):
    page = part_page(entry, None)
    (written,) = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
    assert f"type: {entry.name}" in written
    assert isinstance(yaml.safe_load(written), dict)
    assert f'??? note "{entry.file.name}"' in page


def test_every_part_of_clast_s_own_has_a_whole_scene():
    for entry in REGISTRY:
        if entry.source.origin == "clast" and entry.kind != "writer":
            linked = re.findall(r"\[(configs/[^]]*)\]\(\.\./\.\./\1\)", part_page(entry, None))
            assert linked, f"no ready scene uses the {entry.kind} {entry.name}"
            for scene in linked:
                assert (entry.kind, entry.name) in {(each.kind, each.name) for each in load(ROOT / scene).chosen}


def test_every_part_that_is_registered_is_listed_with_a_link_to_its_page():
    rows = index_page(THIRD_PARTY).splitlines()
    for entry in THIRD_PARTY:
        link = f"[{entry.name}]({page_uri(entry).removeprefix('parts/')})"
        assert sum(link in row for row in rows) == 1
    assert any("[softening](bond_model/softening.md)" in row for row in rows)


def test_a_picture_stands_on_the_page_or_a_sentence_in_its_place():
    entry = REGISTRY.get("wall", "plane")
    assert "![Response of the part](plane.svg)\n\nA plane." in part_page(entry, Picture("plane.svg", "A plane."))
    drawn = drawing(replace(entry, part=SimpleNamespace(summary="a wall", Params=Bare)))
    assert drawn.svg == b""
    assert "state no examples" in part_page(entry, Picture("", drawn.caption))


KINDS_DRAWN = ["bond_model", "contact_law", "damping", "integrator", "motion", "rolling_resistance", "wall"]


@pytest.mark.parametrize("kind", KINDS_DRAWN)
def test_every_part_of_clast_s_own_is_drawn(kind):
    for entry in REGISTRY:
        if entry.kind == kind and entry.source.origin == "clast":
            assert drawing(entry).svg.startswith(b"<?xml"), f"{entry.name}: {drawing(entry).caption}"


def test_a_picture_is_the_same_whenever_it_is_drawn():
    entry = REGISTRY.get("motion", "velocity_ramp")
    assert drawing(entry) == drawing(entry)
    assert drawing(REGISTRY.get("body_force", "gravity")) is None


def test_a_drawn_bond_breaks_at_its_strength_and_one_without_a_limit_holds():
    entry = REGISTRY.get("bond_model", "elastic")
    params = example(entry.part.Params)
    pulled = loading_cycle(bond(entry.part, params), stretched, 0.1)
    assert pulled.broken
    assert pulled.stress[-1] == pytest.approx(params.normal_strength, rel=0.01)
    slid = loading_cycle(bond(entry.part, params), sheared, 0.02)
    assert not slid.broken
    assert slid.stress.max() == pytest.approx(0.0204 * params.young_modulus / 2.4, rel=1e-9)


def test_a_drawn_impact_is_hertz_s_without_damping_and_keeps_the_restitution_with_it():
    entry = REGISTRY.get("contact_law", "hertz_mindlin")
    params = entry.part.Params()
    elastic = impact(Law(entry.part, params, GLASS._replace(restitution=1.0)))
    closed = HertzImpact(GLASS.young_modulus_i / (2.0 * (1.0 - GLASS.poisson_ratio_i**2)), R / 2, MASS / 2, SPEED)
    assert elastic.overlap.max() == pytest.approx(closed.peak_overlap, rel=1e-4)
    assert elastic.force.max() == pytest.approx(closed.peak_force, rel=1e-4)
    assert elastic.approach[-1] == pytest.approx(-SPEED, rel=1e-3)
    assert impact(Law(entry.part, params)).approach[-1] == pytest.approx(-GLASS.restitution * SPEED, rel=0.01)


def test_a_drawn_rolling_ends_at_the_limit_of_friction_and_the_constant_torque_is_there_at_once():
    limit = 0.05 * rolling_resistance.PRESSED.limit * 0.5 * rolling_resistance.RADIUS
    for name in ("constant_torque", "elastic_plastic"):
        part = REGISTRY.get("rolling_resistance", name).part
        angle, torque = rolling_resistance.rolled(part, part.Params())
        assert np.abs(torque).max() == pytest.approx(limit, rel=1e-9)
        early = torque[np.argmax(angle > 0.01)]
        assert (early == pytest.approx(limit, rel=1e-9)) == (name == "constant_torque")


def test_a_drawn_damping_only_takes():
    part = REGISTRY.get("damping", "local").part
    time, place = damping.let_go(part, part.Params())
    peaks = place[1:-1][(place[1:-1] > place[:-2]) & (place[1:-1] > place[2:])]
    assert (np.diff(peaks) < 0.0).all()
    assert abs(place[-1]) < 1e-3
    assert time[-1] == damping.PERIODS


def test_what_is_drawn_sideways_ends_at_coulomb_s_limit():
    entry = REGISTRY.get("contact_law", "hertz_mindlin")
    law = Law(entry.part, entry.part.Params(), GLASS._replace(restitution=1.0))
    overlap = 1e-7
    _, force = sideways(law, overlap)
    normal = law.force(overlap, (0.0, 0.0, 0.0), 1.0)[2]
    assert force.max() == pytest.approx(GLASS.sliding_friction * normal, rel=1e-9)
    assert force.min() == pytest.approx(-force.max(), rel=1e-9)


@pytest.mark.parametrize("name", REGISTRY.names("integrator"))
def test_drawn_errors_fall_at_least_with_the_order_of_the_integrator(name):
    scheme = REGISTRY.get("integrator", name).part
    slope = log10(error(scheme, 100, 0.0) / error(scheme, 1000, 0.0))
    assert slope > scheme.order - 0.05

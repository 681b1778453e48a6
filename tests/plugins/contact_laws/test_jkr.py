"""Necks: their radius solves the equations of Johnson, Kendall and Roberts; published numbers of pull and of work."""

from __future__ import annotations

from math import pi, sqrt

import pytest
from hypothesis import given

from clast.testing.contacts import GLASS
from clast.testing.draws import numbers
from clast_plugins.contact_laws.jkr import JKR, Constants, constants
from clast_plugins.contact_laws.neck import (
    contact_radius,
    cube_root,
    neck_energy,
    neck_force,
    neck_reach,
    pull_off_force,
)

exponents = numbers(-18.0, 18.0)
radii, works, depths = numbers(-6.0, -2.0), numbers(-3.0, 0.0), numbers(-9.0, 3.0)
"""Tens' exponents of R* in m, of w in J/m², and of the distance from the end of the neck as a share of the reach."""


def sticky(work: float) -> Constants:
    return constants(JKR(work_of_adhesion=work), GLASS)


@given(exponent=exponents)
def test_the_cube_root_is_exact_to_rounding_over_all_scales(exponent):
    x = 10.0**exponent
    assert cube_root(x) ** 3 == pytest.approx(x, rel=1e-14)


@given(radius=radii, work=works, depth=depths)
def test_the_radius_of_the_neck_has_the_overlap_it_was_made_from(radius, work, depth):
    R, c = 10.0**radius, sticky(10.0**work)
    reach = neck_reach(c, R)
    overlap = reach * (10.0**depth - 1.0)
    a = contact_radius(R, overlap, c)
    assert a * a / R - sqrt(2.0 * pi * c.w * a / c.E) == pytest.approx(overlap, rel=1e-12, abs=1e-12 * reach)
    force = 4.0 * c.E * a**3 / (3.0 * R) - sqrt(8.0 * pi * c.w * c.E * a**3)
    assert neck_force(R, overlap, c) == pytest.approx(force, rel=1e-12, abs=1e-12 * pull_off_force(R, c))


def test_a_contact_begins_and_ends_with_published_forces():
    """Thornton and Ning (1998): 8/9 of the largest pull at touch, 5/9 at the end, at 3/4 (π² w² R*/E*²)^(1/3)."""
    R, c = 1e-4, sticky(0.05)
    reach, largest = neck_reach(c, R), pull_off_force(R, c)
    assert reach == pytest.approx(0.75 * (pi**2 * c.w**2 * R / c.E**2) ** (1.0 / 3.0), rel=1e-13)
    assert neck_force(R, 0.0, c) == pytest.approx(-8.0 / 9.0 * largest, rel=1e-13)
    assert neck_force(R, -reach, c) == pytest.approx(-5.0 / 9.0 * largest, rel=1e-7)
    pulls = [-neck_force(R, reach * (k / 1000.0 - 1.0), c) for k in range(2000)]
    assert max(pulls) == pytest.approx(1.5 * pi * c.w * R, rel=1e-6)


def test_what_is_lost_as_a_contact_ends_is_the_published_work():
    """Thornton and Ning (1998): 7.09 (w⁵ R*⁴/E*²)^(1/3)."""
    R, c = 1e-4, sticky(0.05)
    unit = (c.w**5 * R**4 / c.E**2) ** (1.0 / 3.0)
    assert neck_energy(R, 0.0, c) == pytest.approx(0.0, abs=1e-14 * unit)
    assert neck_energy(R, -neck_reach(c, R), c) == pytest.approx(7.09 * unit, rel=1e-3)


def test_a_hard_push_leaves_hertz_and_a_pull_of_adhesion():
    """At loads far above the pull-off force the area is Hertz's, and stiffness and load with it."""
    R, c = 1e-4, sticky(1e-6)
    overlap = 1e-2 * R
    assert neck_force(R, overlap, c) == pytest.approx(4.0 / 3.0 * c.E * sqrt(R) * overlap**1.5, rel=1e-3)

"""What the summary says of a compression is what its curve says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from clast import Simulation, load
from clast.results.summary import hertz_modulus, peak_inside, poisson, secant_modulus
from tests.scenes import CRUSH, write

STRAIN = np.linspace(0.0, 0.1, 10_001)


def test_the_hertz_modulus_is_that_of_the_sphere_that_gives_the_same_force() -> None:
    E, nu, height = 564e6, 0.2, 2.16e-3
    force = 4.0 / 3.0 * E / (1.0 - nu**2) * np.sqrt(0.5 * height) * (0.5 * STRAIN * height) ** 1.5
    assert hertz_modulus(STRAIN, force, 0.02, height, nu) == pytest.approx(E, rel=2e-3)


def test_a_plate_that_does_not_touch_yet_has_no_hertz_modulus() -> None:
    assert hertz_modulus(STRAIN, np.maximum(STRAIN - 0.03, 0.0), 0.02, 1.0, 0.2) is None


def test_a_run_that_ends_before_the_strain_has_no_hertz_modulus() -> None:
    assert hertz_modulus(STRAIN, STRAIN, 0.2, 1.0, 0.2) is None


def test_the_secant_goes_from_the_first_20_to_the_first_80_percent_of_the_peak() -> None:
    stress = np.interp(STRAIN, [0.0, 0.02, 0.06, 0.08, 0.1], [0.0, 1e6, 4e6, 5e6, 0.0])
    assert secant_modulus(STRAIN, stress, int(np.argmax(stress))) == pytest.approx(3e6 / 0.04)


@pytest.mark.parametrize(("at_the_end", "inside"), [(0.79, True), (0.81, False)])
def test_a_peak_lies_inside_the_run_when_the_stress_falls_by_a_fifth_after_it(at_the_end: float, inside: bool) -> None:
    stress = np.interp(STRAIN, [0.0, 0.05, 0.1], [0.0, 1.0, at_the_end])
    assert peak_inside(stress, int(np.argmax(stress))) is inside


def test_the_modulus_takes_poisson_s_ratio_of_the_grain_whichever_material_comes_first(tmp_path: Path) -> None:
    glass, steel = CRUSH.splitlines()[3:5]
    swapped = CRUSH.replace(f"{glass}\n{steel}", f"{steel}\n{glass}")
    assert poisson(Simulation(load(write(tmp_path, swapped)))) == 0.2

"""The oedometer fill: what it promises of every fill, and what it refuses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from tests.scenes import write

from clast import load
from clast.building import build_scene, generated
from clast.config.scene import SceneConfig, from_mapping
from clast.errors import ClastError, ConfigError, PackingError
from clast.forecast import forecast
from clast.parts.generator import Packing
from clast.scene.concerns import concerns
from clast.scene.packing_report import overlaps

CONFIGS = Path(__file__).parents[3] / "configs"


def fraction(diameter: float, **more: Any) -> dict[str, Any]:
    template = {"type": "spherical_agglomerate", "material": "glass", "primaries": 12, "porosity": 0.62}
    return {"diameter": diameter, "templates": 2, "template": template | {"diameter": diameter}, **more}


def fill(fractions: dict[str, Any] | None = None, **changes: Any) -> SceneConfig:
    given = {"type": "oedometer_fill", "diameter": "9 mm", "seed": 1}
    given["fractions"] = fractions or {"small": fraction(2e-3, grains=6), "large": fraction(3e-3, grains=5)}
    return scene(given | changes)


def scene(particles: dict[str, Any]) -> SceneConfig:
    return from_mapping(
        {
            "materials": {"glass": {"density": 1000.0, "young_modulus": 1e8, "poisson_ratio": 0.2}},
            "particles": {key: value for key, value in particles.items() if value is not None},
            "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 0.5}}},
            "time": {"end": {"steps": 1}},
        }
    )


def packing(config: SceneConfig) -> Packing:
    return generated(config, config.generators[0])


def assert_sound(made: Packing, radius: float, height: float | None) -> None:
    """Nothing overlaps, nothing is outside, every grain hangs together as its template does."""
    x, r = made.position, made.radius
    allowed = 1e-4 * 2.0 * r.max()
    assert overlaps(x, r).largest <= allowed
    assert (np.hypot(x[:, 0], x[:, 1]) + r).max() <= radius + allowed
    assert (x[:, 2] - r).min() >= -allowed
    if height is not None:
        assert (x[:, 2] + r).max() <= height + allowed
    for k in range(made.grain.max() + 1):
        own = made.grain == k
        assert own.sum() == 12
        assert np.ptp(x[own], axis=0).max() < 3.6e-3


@settings(max_examples=8, phases=(Phase.explicit, Phase.generate))
@given(
    st.integers(1, 8), st.integers(1, 8), st.integers(0, 2**31), st.floats(0.05, 1.5), st.sampled_from([0.0, 0.1e-3])
)
def test_any_fill_keeps_all_grains_apart_and_inside(
    small: int, large: int, seed: int, friction: float, deviation: float
) -> None:
    fractions = {
        "small": fraction(2e-3, grains=small, deviation=deviation),
        "large": fraction(3e-3, grains=large, deviation=deviation),
    }
    made = packing(fill(fractions, seed=seed, friction=friction))
    assert made.grain.max() + 1 == small + large
    assert_sound(made, 4.5e-3, None)
    volume = 4.0 / 3.0 * np.pi * (made.radius**3).sum()
    assert made.report["mass_kg"] == pytest.approx(1000.0 * volume, rel=1e-12)


def test_grains_lie_at_rest_on_something() -> None:
    """Every grain has something below it: another grain, or the bottom."""
    made = packing(fill())
    x, r = made.position, made.radius
    gap = 0.15 * 2.0 * r.mean()
    for k in range(made.grain.max() + 1):
        own, other = made.grain == k, made.grain != k
        on_bottom = (x[own, 2] - r[own]).min() < gap
        way = x[own][:, None] - x[other][None]
        apart = np.sqrt((way**2).sum(axis=2)) - r[own][:, None] - r[other][None]
        assert on_bottom or ((apart < gap) & (way[:, :, 2] > 0.0)).any()


def test_the_same_seed_gives_the_same_bytes_and_another_seed_another_fill() -> None:
    first, again, other = (packing(fill(seed=seed)) for seed in (3, 3, 4))
    assert first.position.tobytes() == again.position.tobytes()
    assert first.position.tobytes() != other.position.tobytes()


def test_the_mass_is_met_exactly() -> None:
    mass = 0.036e-3
    made = packing(fill(mass=mass))
    assert made.report["mass_kg"] == pytest.approx(mass, rel=1e-12)
    assert 0.95 < float(made.report["size_factor"]) < 1.05


def test_the_bed_is_levelled_to_its_height() -> None:
    many = {"small": fraction(2e-3, grains=16), "large": fraction(3e-3, grains=14)}
    loose = float(packing(fill(many)).report["height_m"])
    assert_sound(packing(fill(many, height=0.94 * loose)), 4.5e-3, 0.94 * loose)


@pytest.mark.parametrize("seed", [4, 11])
def test_the_small_oedometer_fits_under_its_height_where_the_first_bed_poured_does_not(seed: int) -> None:
    made = packing(load(CONFIGS / "oedometer_small.yaml", [f"particles.seed={seed}"]))
    assert float(made.report["largest_overlap_m"]) <= 1e-4 * 2.0 * made.radius.min()
    assert float(made.report["height_m"]) < 8.4e-3 * (1.0 + 1e-4)
    assert made.report["times_poured"] == 2


def test_a_box_is_filled_too() -> None:
    made = packing(fill(diameter=None, width="8 mm", depth="6 mm"))
    x, r = made.position, made.radius
    assert (np.abs(x[:, 0]) + r).max() <= 4e-3 + 2e-4 * r.max()
    assert (np.abs(x[:, 1]) + r).max() <= 3e-3 + 2e-4 * r.max()


def test_the_base_moves_the_whole_fill() -> None:
    here, there = packing(fill()), packing(fill(base=["1 mm", 0, "2 mm"]))
    assert np.allclose(there.position - here.position, [1e-3, 0.0, 2e-3], atol=1e-15)


def test_what_is_predicted_is_what_comes() -> None:
    config = fill()
    told, built = forecast(config), build_scene(config)
    assert told.particles == len(built.radius) == 11 * 12


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"diameter": "3.1 mm"}, "the room must be at least 5 % wider than that"),
        ({"height": "2.1 mm"}, "do not fit under a height of 2.1 mm without overlaps, poured 4 times: "),
        ({"grains": 12}, "particles.grains: the fractions have 11 grains together, not 12"),
        ({"mass": "1 kg"}, "particles.mass: 11 grains of these sizes weigh"),
        ({"width": "3 mm"}, "either a 'diameter' is needed, for a tube, or 'width' and 'depth'"),
    ],
)
def test_fills_that_cannot_be_are_refused_with_their_key(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ClastError, match=sentence):
        packing(fill(**changes))


@pytest.mark.parametrize(
    ("changes", "error", "sentence"),
    [
        ({"porosity": 0.2}, ConfigError, r"particles.fractions.small.template.porosity: denser than any"),
        ({"porosity": 0.45}, PackingError, r"particles.fractions.small.template.porosity: too dense"),
        ({"material": "glas"}, ConfigError, r"particles.fractions.small.template.material: there is no material 'gla"),
        ({"colour": 3}, ConfigError, r"particles.fractions.small.template.colour: not a known key"),
    ],
)
def test_a_template_that_fails_is_named(changes: dict[str, Any], error: type[ClastError], sentence: str) -> None:
    small = fraction(2e-3, grains=3)
    small["template"] |= changes
    with pytest.raises(error, match=sentence):
        packing(fill({"small": small}))


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        ({"between": [-1e-3, 3e-3], "deviation": 1e-4}, "'between' must be two diameters above zero"),
        ({"between": [1e-3, 3e-3]}, "'between' bounds a distribution, so it needs a 'deviation'"),
        ({"grains": 3, "share": 0.5}, "only one of grains, share and prior can be given; given grains and share"),
        ({"deviation": 1e-3}, "diameters reach 3 deviations below the mean"),
        ({"between": [2.5e-3, 3e-3], "deviation": 1e-4}, "'between' must be two diameters above zero"),
    ],
)
def test_senseless_fractions_are_refused(more: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ConfigError, match=sentence):
        fill({"small": fraction(2e-3, **more)})


def test_a_template_of_another_size_is_refused() -> None:
    with pytest.raises(ConfigError, match=r"fractions.small.diameter: the template makes grains .* mm wide, not 3 mm"):
        packing(fill({"small": fraction(2e-3, grains=3) | {"diameter": 3e-3}}))


def test_a_template_with_more_than_primaries_is_refused() -> None:
    small = fraction(2e-3, grains=3)
    spheres = [{"position": [0, 0, 0], "radius": 1e-3, "fixed": True}]
    small["template"] = {"type": "explicit", "material": "glass", "particles": spheres}
    with pytest.raises(ConfigError, match=r"fractions.small.template: brings prescribed particles"):
        packing(fill({"small": small}))


def test_fractions_and_seeds_have_grains_of_their_own() -> None:
    """No packing comes twice: neither in two fractions with equal templates, nor with the next seed."""
    shapes = []
    for seed in (1, 2):
        made = packing(fill(seed=seed))
        for k in range(11):
            x = made.position[made.grain == k]
            r = made.radius[made.grain == k][0]
            shapes.append(np.sort(np.linalg.norm(x - x.mean(axis=0), axis=1) / r).round(6).tobytes())
    assert len(set(shapes)) == 2 * 2 * 2


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"mass": "1 kg"}, "particles.mass: 11 grains of these sizes weigh"),
        ({"height": "2 mm"}, r"particles.height: the grains would fill \d+% of the room"),
        ({"diameter": "2.5 mm"}, "a grain of 3 mm does not fit into a room 2.5 mm wide"),
    ],
)
def test_what_cannot_be_is_refused_without_packing(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ConfigError, match=sentence):
        forecast(fill(**changes))


def test_a_narrow_tube_takes_its_grains_one_above_the_other() -> None:
    made = packing(fill({"all": fraction(2e-3, grains=4)}, diameter="2.3 mm"))
    assert made.grain.max() == 3


def test_a_bed_below_the_height_asked_for_is_pointed_out() -> None:
    built = build_scene(fill(height="40 mm"))
    (told,) = built.report.values()
    assert str(told["height_not_reached"]).startswith("the bed ends 3")
    assert float(told["porosity_between"]) < 0.7
    low, *_ = concerns(built)
    assert low.startswith("scene: particles: the bed ends 3")
    assert "mm below the height asked for, so that a piston at this height meets nothing at first; lower" in low


def test_a_finished_fill_is_used_again_and_never_for_another(tmp_path: Path) -> None:
    text = """
materials: {glass: {density: 1000 kg/m3, young_modulus: 100 MPa, poisson_ratio: 0.2}}
particles:
  type: oedometer_fill
  diameter: 9 mm
  file: fills/kept.h5
  fractions:
    all:
      {diameter: 2 mm, grains: 5, templates: 1,
       template: {type: spherical_agglomerate, material: glass, diameter: 2 mm, primaries: 12, porosity: 0.62}}
contacts: {law: hertz_mindlin, pairs: {default: {restitution: 0.5}}}
time: {end: {steps: 1}}
"""
    config = load(write(tmp_path, text))
    first, kept = packing(config), tmp_path / "fills" / "kept.h5"
    stamp = kept.stat().st_mtime_ns
    again = packing(config)
    assert kept.stat().st_mtime_ns == stamp
    assert first.position.tobytes() == again.position.tobytes()
    assert (again.material, dict(again.report)) == (first.material, dict(first.report))
    packing(config.changed({"materials.steel": {"density": 1, "young_modulus": 1, "poisson_ratio": 0}}))
    with pytest.raises(ConfigError, match=r"particles.file: .*kept.h5 keeps a fill made with another friction, seed"):
        packing(config.changed({"particles.seed": 2, "particles.friction": 0.1}))
    kept.write_bytes(b"nonsense")
    with pytest.raises(ConfigError, match=r"kept.h5 is no finished fill"):
        packing(config)

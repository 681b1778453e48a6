"""Values changed from the command line."""

import pytest

from clast.errors import ConfigError


def _said(load, **options):
    with pytest.raises(ConfigError) as caught:
        load(**options)
    return str(caught.value)


def test_an_override_replaces_a_value_and_is_named_in_messages(load):
    assert (
        load(overrides=["particles.seed=3", "walls.upper.point.2=2 mm"]).walls["upper"].shape.params.point[2] == 0.002
    )
    said = _said(load, overrides=["walls.upper.point.2=2 MPa"])
    assert said.startswith("--set walls.upper.point.2=2 MPa: walls.upper.point.2: '2 MPa' is a stress")


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("wals.upper.material=glass", "wals: not a known key; did you mean 'walls'?"),
        ("time.sep=3", "time.sep: not a known key; did you mean 'step'?"),
        ("output.trakcs.particles=[0]", "output.trakcs: not a known key; did you mean 'tracks'?"),
        ("bonds.model.modulus.x=3", "bonds.model.modulus: not a known key; did you mean 'young_modulus'?"),
        ("bonds.colour=3", "bonds.colour: not a known key; known are between, damping, fade_steps, kinematics, model"),
        ("walls.uper.material=glass", "walls has no key 'uper'; did you mean 'upper'?"),
        ("walls.upper.point.7=1", "walls.upper.point has 3 entries, counted from 0; there is no entry 7"),
        (
            "contacts.law.type=hertz",
            "contacts.law is 'hertz', which has no keys to set; give it whole: contacts.law={type: hertz, ...}",
        ),
        ("time.step", "write it as key.path=value"),
        ("=3", "write it as key.path=value"),
        ("time..step=3", "write it as key.path=value"),
        ("time.step=[1", "the value is not valid YAML"),
    ],
)
def test_an_override_that_fits_nowhere_is_refused(load, override, said):
    assert f"--set {override}: {said}" in _said(load, overrides=[override])


def test_an_override_may_add_a_section_of_settings(load):
    assert load(overrides=["output.samples=10"]).output.samples == 10
    assert load(overrides=["output.tracks.particles=[0]"]).output.tracks.particles == (0,)


def test_a_key_that_an_added_section_lacks_is_told_with_the_override(load):
    bonds = "bonds:\n  between: {max_gap: 0.1 mm}\n  model: {type: elastic, young_modulus: 5 MPa}\n"
    with pytest.raises(ConfigError) as caught:
        load((bonds, ""), overrides=["bonds.damping=0.1"])
    assert str(caught.value).startswith("--set bonds.damping=0.1: bonds.model: this key is missing: Bond model")

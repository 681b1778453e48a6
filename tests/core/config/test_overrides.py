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
        ("wals.upper.material=glass", "the scene has no key 'wals'; did you mean 'walls'?"),
        ("walls.uper.material=glass", "walls has no key 'uper'; did you mean 'upper'?"),
        ("walls.upper.point.7=1", "walls.upper.point has 3 entries, counted from 0; there is no entry 7"),
        ("contacts.law.type=hertz", "contacts.law is 'hertz', which has no keys to set"),
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

"""Numbers with units."""

import re
from decimal import Decimal
from typing import Annotated

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import Field, TypeAdapter, ValidationError

from clast.config.quantities import (
    Angle,
    AngularVelocity,
    Density,
    Direction,
    Length,
    Number,
    Point,
    Unit,
    to_si,
)
from clast.config.units import unit_factor


@pytest.mark.parametrize(
    ("written", "unit", "si"),
    [
        ("0.25 mm", "m", 0.25e-3),
        ("564.26 MPa", "Pa", 564.26e6),
        ("10 mm/s", "m/s", 0.01),
        ("190 kg/m3", "kg/m3", 190.0),
        ("1.9 g/cm3", "kg/m3", 1900.0),
        ("9.81 m/s2", "m/s2", 9.81),
        ("9.81 m/s^2", "m/s2", 9.81),
        ("9.81 m/s²", "m/s2", 9.81),
        ("-3 µm", "m", -3e-6),
        ("5%", "1", 0.05),
        ("5e-7", "s", 5e-7),
        ("10 min", "s", 600.0),
        ("2 h", "s", 7200.0),
        ("1e3 N/mm2", "Pa", 1e9),
        ("2 N*m", "J", 2.0),
        (3, "m", 3.0),
        (np.float32(0.5), "m", 0.5),
    ],
)
def test_a_number_with_a_unit_becomes_si(written, unit, si):
    assert to_si(written, unit) == si


def test_prefixes_are_multiplied_exactly():
    assert to_si("50 um/s", "m/s") == 5e-05
    assert to_si("0.1 mm", "m") == 0.0001


@given(st.decimals(-1000, 1000, places=4), st.sampled_from(["nm", "um", "mm", "cm", "km"]))
def test_the_si_value_is_the_float_nearest_to_the_decimal(number, unit):
    assert to_si(f"{number} {unit}", "m") == float(Decimal(number) * unit_factor(unit)[0])


def test_degrees_and_revolutions_become_radians():
    assert TypeAdapter(Angle).validate_python("180 deg") == np.pi
    assert TypeAdapter(AngularVelocity).validate_python("60 rpm") == pytest.approx(2 * np.pi, rel=1e-15)


@pytest.mark.parametrize(
    ("written", "unit", "said"),
    [
        ("3 MPa", "m", "'3 MPa' is a stress; a length is needed, such as '0.25 mm', or a plain number in m"),
        ("3 deg", "1", "'3 deg' is an angle"),
        ("3 furlong", "m", "'furlong' is not a known unit"),
        ("3 m//s", "m/s", "is not a known unit"),
        ("three", "m", "does not begin with a number"),
        ("", "m", "does not begin with a number"),
        (True, "m", "True is not a number"),
        ([1], "m", "is not a number"),
        (None, "m", "is not a number"),
        (float("nan"), "m", "not a finite number"),
        ("1e999 m", "m", "not a finite number"),
        (10**400, "m", "not a finite number"),
    ],
)
def test_a_wrong_quantity_is_refused_in_plain_words(written, unit, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        to_si(written, unit)


def test_bounds_hold_for_the_si_value():
    bounded = TypeAdapter(Annotated[Length, Field(gt=0, lt=1)])
    assert bounded.validate_python("999 mm") == 0.999
    with pytest.raises(ValidationError):
        bounded.validate_python("1001 mm")
    with pytest.raises(ValidationError):
        bounded.validate_python("-1 mm")


def test_vectors_mix_numbers_and_texts():
    assert TypeAdapter(Point).validate_python([0, "1 mm", 2]) == (0.0, 0.001, 2.0)
    assert TypeAdapter(Point).validate_python(np.array([1.0, 2.0, 3.0])) == (1.0, 2.0, 3.0)


@pytest.mark.parametrize("wrong", [[0, 1], [0, 1, 2, 3], "x", 3, [0, 1, "2 s"]])
def test_a_wrong_vector_is_refused(wrong):
    with pytest.raises(ValidationError):
        TypeAdapter(Point).validate_python(wrong)


def test_a_direction_must_not_be_zero():
    assert TypeAdapter(Direction).validate_python([0, 0, -2]) == (0.0, 0.0, -2.0)
    with pytest.raises(ValidationError, match="no direction"):
        TypeAdapter(Direction).validate_python([0, 0, 0])


def test_the_json_schema_tells_the_unit_and_accepts_texts():
    schema = TypeAdapter(Density).json_schema()
    assert schema["x-unit"] == "kg/m3"
    assert schema["type"] == ["number", "string"]


def test_a_unit_that_does_not_exist_cannot_be_declared():
    with pytest.raises(ValueError, match="not a known unit"):
        Unit("smoot")


def test_numbers_accept_percent():
    assert TypeAdapter(Number).validate_python("5 %") == 0.05

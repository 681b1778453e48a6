"""YAML without its traps."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.config.yaml_loader import dump_yaml, parse_document, parse_value, read_document
from clast.errors import ConfigError


@pytest.mark.parametrize("written", ["5e-7", "5E-7", "0.5e-6", ".5e-6", "+5e-7", "5.e-7"])
def test_numbers_with_exponents_are_floats(written):
    assert parse_value(written) == 5e-7


@pytest.mark.parametrize("written", ["1e6", "1.0e6", "1.e+6", "1000000.0"])
def test_large_numbers_are_floats(written):
    assert parse_value(written) == 1e6
    assert isinstance(parse_value(written), float)


@pytest.mark.parametrize("written", ["on", "off", "yes", "no", "Yes", "NO", "y", "n", "1:30", "1_000", "2023-01-01"])
def test_words_stay_words(written):
    assert parse_value(written) == written


def test_a_leading_zero_does_not_make_a_number_octal():
    assert parse_value("010") == 10


def test_true_null_and_special_floats_are_what_they_say():
    assert parse_value("[true, false, null, ~, -.inf]") == [True, False, None, None, -math.inf]
    assert math.isnan(parse_value(".nan"))


def test_an_integer_of_thousands_of_digits_is_no_crash():
    assert parse_value("1" * 5000) == math.inf


def test_keys_that_look_like_truth_values_are_words():
    assert parse_document("on: 1\nno: 2").data == {"on": 1, "no": 2}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a: 1\nb: 2\na: 3\n", "s.yaml:3:1: a: said twice, first in line 1"),
        ("a:\n  b: 1\n  b: 1\n", "s.yaml:3:3: b: said twice"),
        ("a:\n\tb: 1\n", "s.yaml:2:1: a tab stands where YAML allows only spaces"),
        ("a: [1, 2\nb: 3\n", "not valid YAML"),
        ("a: 'x\n", "not valid YAML"),
        ("", "s.yaml: the file is empty"),
        ("# nothing\n", "s.yaml: the file is empty"),
        ("- 1\n- 2\n", "s.yaml:1:1: a mapping"),
        ("hello", "s.yaml:1:1: a mapping"),
        ("1: a\n", "s.yaml:1:1: the key '1' is not a text"),
        ("true: a\n", "the key 'true' is not a text"),
        ("[a]: b\n", "is not a text"),
        ("a: &x [*x]\n", "an alias that holds itself"),
        ("a: !!python/object/apply:os.getcwd []\n", "s.yaml:1:4: the tag"),
        ("a: 1\n---\nb: 2\n", "not valid YAML"),
        ("a: \x07\n", "s.yaml:1: the character '\\x07' is not allowed"),
        ("a: " + "[" * 500 + "]" * 500, "nested more than 100 levels deep"),
        ("a: " + "[" * 100_000, "nest"),  # by PyYAML itself from 6.0.4 on
    ],
)
def test_bad_yaml_is_refused_with_its_place(text, said):
    with pytest.raises(ConfigError) as caught:
        parse_document(text, name="s.yaml")
    assert said in str(caught.value)


def test_missing_folder_and_binary_files_are_refused(tmp_path):
    with pytest.raises(ConfigError, match="there is no such file"):
        read_document(tmp_path / "none.yaml")
    with pytest.raises(ConfigError, match="this is a folder"):
        read_document(tmp_path)
    (tmp_path / "latin.yaml").write_bytes(b"a: 1\nb: \xb5m\n")
    with pytest.raises(ConfigError, match=r"latin.yaml:2: byte 0xb5 is not UTF-8"):
        read_document(tmp_path / "latin.yaml")


def test_a_byte_order_mark_is_ignored(tmp_path):
    (tmp_path / "s.yaml").write_bytes(b"\xef\xbb\xbfa: 1\n")
    assert read_document(tmp_path / "s.yaml").data == {"a": 1}


def test_every_key_path_has_its_line_and_column():
    document = parse_document("a:\n  b: 1\n  c:\n    - {d: 2}\n    - e\n", name="s.yaml")
    assert document.line_and_column(("a",)) == (1, 1)
    assert document.line_and_column(("a", "b")) == (2, 3)
    assert document.line_and_column(("a", "c", 0, "d")) == (4, 8)
    assert document.line_and_column(("a", "c", 1)) == (5, 7)
    assert document.where(("a", "nowhere", "deep")) == "s.yaml:1:1"


def test_merged_keys_are_found_where_they_were_written():
    document = parse_document("a: &a\n  b: 1\nc:\n  <<: *a\n  d: 2\n")
    assert document.data["c"] == {"b": 1, "d": 2}
    assert document.line_and_column(("c", "b")) == (2, 3)


_PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(10**9), 10**9)
    | st.floats(allow_nan=False)
    | st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Cn", "Co"]), max_size=8)
    | st.sampled_from(["1e6", "on", "no", "010", "1:30", "~", "null", "5e-7", ".inf", "<<", "=", "-", "0x1F"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["a", "on", "1e6"]), inner, max_size=3),
    max_leaves=8,
)


@given(st.dictionaries(st.sampled_from(["key", "no", "010"]), _PLAIN, min_size=1))
def test_what_is_dumped_is_read_back(data):
    assert parse_document(dump_yaml(data)).data == data


@pytest.mark.parametrize("value", ["!!float abc", "!!int abc", "!!set {a}", "!!binary '@@'", "!mine 3"])
def test_tags_are_refused_with_their_place(value):
    with pytest.raises(ConfigError, match=r"scene:1:4: the tag '\S+' is not known here; write the value alone"):
        parse_document(f"a: {value}")
    with pytest.raises(ConfigError, match="is not known here; write the value alone"):
        parse_value(value)
    assert parse_document("a: !!str 3\nb: '4'\nc: !!int 5").data == {"a": "3", "b": "4", "c": 5}

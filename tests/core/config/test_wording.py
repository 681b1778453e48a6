"""Every message is in Clast's own words, whatever is wrong with whichever key of whichever part."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

import pytest
from pydantic import BaseModel, Field, ValidationError

from clast.config import sections
from clast.config.problems import explain
from clast.config.scene import SceneConfig
from clast.parts.params import Params
from clast.plugins.discovery import discover

PYDANTIC = re.compile(
    r"Input|\bshould\b(?! be left)|valid (\w+)\b|pars|instance of|Field required|Extra|something else"
)
WRONG = [
    None,
    True,
    "",
    "words",
    "3 furlongs",
    "1 m",
    -1,
    0,
    1.5,
    1e30,
    10**40,
    float("nan"),
    float("inf"),
    [],
    [1],
    [1, 2, 3, 4],
    ["a", None, {}],
    {},
    {"a": 1},
    {"type": 3},
    {"type": "nothing"},
    b"bytes",
    object,
]


def models() -> Iterator[type[Params]]:
    """Return everything that a user fills in."""
    yield SceneConfig
    yield from (each for each in vars(sections).values() if isinstance(each, type) and issubclass(each, Params))
    yield from (each.part.Params for each in discover())


def problems(model: type[BaseModel], given: Any) -> list[str]:
    """Return what is said when a model is made of something."""
    try:
        model.model_validate(given, context={"registry": discover()})
    except ValidationError as error:
        return [str(each["type"]) for each in explain(error, model)]
    return []


@pytest.mark.parametrize("model", list(dict.fromkeys(models())), ids=lambda model: model.__name__)
def test_no_message_is_pydantics_own(model: type[Params]) -> None:
    told = [text for wrong in WRONG for text in problems(model, wrong)]
    for key in model.model_fields:
        for wrong in WRONG:
            told += problems(model, {key: wrong})
            told += problems(model, {key: [wrong]})
            told += problems(model, {key: {"a": wrong}})
    assert [text for text in told if PYDANTIC.search(text)] == []


class Odd(Params):
    """Fields as a plugin's author may declare them."""

    whole: int = 1
    share: float = 1.0
    even: Annotated[int, Field(multiple_of=2)] = 2
    flag: bool = False
    word: Annotated[str, Field(min_length=2, max_length=4)] = "abc"
    code: Annotated[str, Field(pattern="^[a-z]+$")] = "abc"
    pair: tuple[int, int] = (1, 2)
    some: Annotated[list[float], Field(min_length=1, max_length=2)] = [1.0]  # noqa: RUF012
    names: set[str] = set()  # noqa: RUF012
    fixed: frozenset[int] = frozenset()
    file: Path = Path()
    kind: Literal["soft", "hard"] = "soft"
    low: Annotated[float, Field(gt=0, lt=1)] = 0.5
    high: Annotated[float, Field(ge=0, le=1)] = 0.5
    nothing: None = None
    table: dict[str, int] = {}  # noqa: RUF012
    either: int | None = None


@pytest.mark.parametrize(
    ("key", "given", "message"),
    [
        ("whole", "x", "a whole number is needed; given 'x'"),
        ("whole", 1.5, "a whole number is needed; given 1.5"),
        ("whole", [], "a whole number is needed; given []"),
        ("whole", "9" * 5000, "a whole number with fewer digits is needed; given '9999"),
        ("share", "x", "a number is needed; given 'x'"),
        ("share", [], "a number is needed; given []"),
        ("share", float("nan"), "a finite number is needed; given nan"),
        ("even", 3, "must be a multiple of 2; given 3"),
        ("flag", "perhaps", "true or false is needed; given 'perhaps'"),
        ("flag", [], "true or false is needed; given []"),
        ("word", 3, "a text is needed; given 3"),
        ("word", "a", "a text of at least 2 characters is needed; given 'a'"),
        ("word", "abcde", "a text of at most 4 characters is needed; given 'abcde'"),
        ("code", "A", "a text that matches ^[a-z]+$ is needed; given 'A'"),
        ("pair", 3, "a list is needed, such as [first, second]; given 3"),
        ("pair", [1], "this entry is missing; the list needs more than 1"),
        ("pair", [1, 2, 3], "must have 2 or fewer entries; given [1, 2, 3]"),
        ("some", 3, "a list is needed, such as [first, second]; given 3"),
        ("some", [], "must have 1 or more entries; given []"),
        ("some", [1, 2, 3], "must have 2 or fewer entries; given [1, 2, 3]"),
        ("names", 3, "a list is needed, such as [first, second]; given 3"),
        ("fixed", 3, "a list is needed, such as [first, second]; given 3"),
        ("file", 3, "the path of a file is needed; given 3"),
        ("kind", "sof", "'sof' is not allowed; did you mean 'soft'?"),
        ("low", 0, "must be greater than 0; given 0"),
        ("low", 2, "must be less than 1; given 2"),
        ("high", -1, "must be at least 0; given -1"),
        ("high", 1.5, "must be at most 1; given 1.5"),
        ("nothing", 3, "nothing may stand here; given 3"),
        ("table", 3, "a mapping 'key: value' is needed; given 3"),
        ("table", {3: 3}, "a text is needed; given 3"),
        ("either", "x", "a whole number is needed; given 'x'"),
        ("kinds", 3, "not a known key; did you mean 'kind'?"),
    ],
)
def test_what_a_plugins_fields_refuse_is_said_in_the_same_words(key: str, given: Any, message: str) -> None:
    told = problems(Odd, {key: given})
    assert len(told) == 1
    assert told[0].startswith(message)

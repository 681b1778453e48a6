"""Problems: what pydantic finds, said in the words of the scene file."""

from __future__ import annotations

import re
import typing
from collections.abc import Collection, Mapping, Sequence
from typing import Annotated, Any, Union

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from clast.config.document import Document, Problem
from clast.errors import KeyPath
from clast.plugins.nearest import nearest_name, suggestion

WRONG = "clast_wrong"
MISSING = "clast_missing"
"""The key is not there."""
UNKNOWN_PART = "clast_unknown_part"
"""No part has this name: what a plugin that could not be loaded may have brought."""
_WHOLE, _LIST = "a whole number is needed", "a list is needed, such as [first, second]"
_NEEDED = {
    "bool_parsing": "true or false is needed",
    "bool_type": "true or false is needed",
    "finite_number": "a finite number is needed",
    "float_parsing": "a number is needed",
    "float_type": "a number is needed",
    "frozen_set_type": _LIST,
    "greater_than": "must be greater than {gt}",
    "greater_than_equal": "must be at least {ge}",
    "int_from_float": _WHOLE,
    "int_parsing": _WHOLE,
    "int_parsing_size": "a whole number with fewer digits is needed",
    "int_type": _WHOLE,
    "less_than": "must be less than {lt}",
    "less_than_equal": "must be at most {le}",
    "list_type": _LIST,
    "multiple_of": "must be a multiple of {multiple_of}",
    "none_required": "nothing may stand here",
    "path_type": "the path of a file is needed",
    "set_type": _LIST,
    "string_pattern_mismatch": "a text that matches {pattern} is needed",
    "string_too_long": "a text of at most {max_length} characters is needed",
    "string_too_short": "a text of at least {min_length} characters is needed",
    "string_type": "a text is needed",
    "string_unicode": "a text is needed",
    "too_long": "must have {max_length} or fewer entries",
    "too_short": "must have {min_length} or more entries",
    "tuple_type": _LIST,
}
"""What is said where pydantic finds an error of a type, before what was given."""
_KINDS = (WRONG, MISSING, UNKNOWN_PART)


def problem(loc: KeyPath, text: str, given: Any = None, kind: str = WRONG) -> InitErrorDetails:
    """One finished message, for raising out of a validator with :func:`refuse`."""
    return {"type": PydanticCustomError(kind, "{text}", {"text": text}), "loc": loc, "input": given}


def refuse(problems: Sequence[InitErrorDetails]) -> ValidationError:
    """Error that carries the problems on to whoever validates the whole."""
    return ValidationError.from_exception_data("scene", list(problems))


def wrong(key: str, text: str) -> ValidationError:
    """Error to raise out of a validator of several keys that blames one of them: its line is the one that is told."""
    return refuse([problem((key,), text)])


def explain(error: ValidationError, model: type[BaseModel], also: Collection[str] = ()) -> list[InitErrorDetails]:
    """Put every error of a validation into plain words.

    Parameters
    ----------
    error : ValidationError
    model : type
        The model that was validated, for the names of its keys.
    also : collection of str
        Keys allowed beside the model's own.
    """
    details = []
    every = error.errors(include_url=False)
    for found in every:
        if found["type"] == "too_short" and any(_is_inside(each["loc"], found["loc"]) for each in every):
            continue  # its entries are wrong, not missing
        loc = tuple(step for step in found["loc"] if not _is_tag(step))
        text = _text(found, loc, model, also)
        kind = found["type"] if found["type"] in _KINDS else MISSING if found["type"] == "missing" else WRONG
        details.append(problem(loc, text, kind=kind))
    return details


def located(error: ValidationError, model: type[BaseModel], document: Document) -> list[Problem]:
    """Problems of a scene, each at a key path that exists in the document (or at a key that is missing)."""
    problems = []
    for details in explain(error, model):
        kind = details["type"]
        assert isinstance(kind, PydanticCustomError)
        path = details.get("loc", ())
        last = path[-1:] if kind.type == MISSING else ()
        path = path[: len(path) - len(last)]
        while path and not document.has(path):
            path = path[:-1]
        problems.append(Problem((*path, *last), str(kind), kind.type))
    return problems


def _is_inside(path: KeyPath, other: KeyPath) -> bool:
    return len(path) > len(other) and path[: len(other)] == other


def _is_tag(step: str | int) -> bool:
    """Tell what pydantic puts into paths beside keys: names of union branches, and a mark where a key is wrong."""
    return isinstance(step, str) and (step == "[key]" or (step.startswith("<") and step.endswith(">")))


def _text(found: ErrorDetails, loc: KeyPath, model: type[BaseModel], also: Collection[str]) -> str:
    context: Mapping[str, Any] = found.get("ctx", {})
    match found["type"]:
        case "extra_forbidden":
            known = fields_at(model, loc[:-1]) | (set(also) if len(loc) == 1 else set())
            return f"not a known key; {suggestion(str(loc[-1]), known)}"
        case "missing":
            return _missing_text(model, loc)
        case "value_error" | "assertion_error":
            return str(context["error"])
        case "literal_error" | "enum":
            return _choice_text(found["input"], str(context["expected"]))
        case "model_type" | "dict_type" | "model_attributes_type":
            return f"a mapping 'key: value' is needed; given {short(found['input'])}"
    if found["type"] in _KINDS:
        return found["msg"]
    needed = _NEEDED.get(found["type"], "something else is needed")
    return f"{needed.format_map(_Readable(context))}; given {short(found['input'])}"


class _Readable(dict[str, Any]):
    """Numbers as a user reads them."""

    def __getitem__(self, key: str) -> Any:
        value = super().__getitem__(key)
        return f"{value:g}" if isinstance(value, float) else value


def _missing_text(model: type[BaseModel], loc: KeyPath) -> str:
    if isinstance(loc[-1], int):
        return f"this entry is missing; the list needs more than {loc[-1]}"
    owner = model_at(model, loc[:-1])
    field = owner.model_fields.get(str(loc[-1])) if owner else None
    meaning = f": {field.description}" if field is not None and field.description else ""
    return f"this key is missing{meaning}"


def _choice_text(given: Any, expected: str) -> str:
    near = nearest_name(str(given), re.findall(r"'([^']*)'", expected))
    return f"{short(given)} is not allowed; " + (f"did you mean {near!r}?" if near else f"write {expected}")


def short(given: Any) -> str:
    """Return what was given as a message shows it."""
    text = "nothing" if given is None else repr(given)
    return text if len(text) <= 60 else f"{text[:57]}..."


def fields_at(model: type[BaseModel], path: KeyPath) -> set[str]:
    """Names of the fields of the model found at a path inside another one."""
    owner = model_at(model, path)
    return set(owner.model_fields) if owner else set()


def model_at(model: type[BaseModel], path: KeyPath) -> type[BaseModel] | None:
    """Model found at a path inside another one: through optional fields, lists, tuples and mappings."""
    kinds: list[Any] = [model]
    for step in path:
        kinds = [inner for kind in kinds for inner in _inside(kind, step)]
    models = [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, BaseModel)]
    return models[0] if models else None


def _inside(kind: Any, step: str | int) -> list[Any]:
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        field = kind.model_fields.get(str(step))
        return _branches(field.annotation) if field is not None else []
    arguments = [each for each in typing.get_args(kind) if each is not Ellipsis]
    return _branches(arguments[-1]) if arguments else []


def _branches(annotation: Any) -> list[Any]:
    origin = typing.get_origin(annotation)
    if origin is Annotated:
        return _branches(typing.get_args(annotation)[0])
    if origin is Union or str(origin) == "<class 'types.UnionType'>":
        return [branch for each in typing.get_args(annotation) for branch in _branches(each)]
    return [annotation]

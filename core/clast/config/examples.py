"""Examples of parameters: what checks, plots and documentation of a part take where a user would write numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

from pydantic import ValidationError

from clast.config.problems import explain
from clast.errors import PluginError
from clast.parts.params import Params

P = TypeVar("P", bound=Params)


def stated(model: type[Params]) -> dict[str, Any]:
    """Return the examples that fields state, as a user writes them, by the name of their field."""
    return {name: field.examples[0] for name, field in model.model_fields.items() if field.examples}


def example(model: type[P], changes: Mapping[str, Any] | None = None) -> P:
    """Return parameters made of ``changes``, of the examples that fields state, and of defaults, in this order.

    Parameters
    ----------
    model : type
        ``Params`` of a part; a field without a default states ``Field(examples=[...])``.
    changes : mapping, optional
        Values as a user writes them, by the name of their field.

    Raises
    ------
    PluginError
        A field has neither example nor default, or the values do not go together.

    Examples
    --------
    >>> from pydantic import Field, create_model
    >>> from clast.config.quantities import Stress
    >>> Spring = create_model("Spring", __base__=Params, modulus=(Stress, Field(examples=["100 MPa"])))
    >>> example(Spring).modulus, example(Spring, {"modulus": "2 GPa"}).modulus
    (100000000.0, 2000000000.0)
    """
    given = stated(model) | dict(changes or {})
    missing = [name for name, field in model.model_fields.items() if field.is_required() and name not in given]
    if missing:
        named = ", ".join(f"{model.__name__}.{name}" for name in missing)
        raise PluginError(
            f"there is no example to try it with: {named}; declare 'Field(examples=[...])', or give values to 'clast "
            f"plugins check' with --set PART.{missing[0]}=..."
        )
    try:
        return model.model_validate(given)
    except ValidationError as error:
        told = explain(error, model)[0]
        where = ".".join([model.__name__, *(str(each) for each in told.get("loc", ()))])
        raise PluginError(f"{where}: {told['type']}") from None

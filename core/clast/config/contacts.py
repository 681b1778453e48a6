"""Contacts in a scene file: their law, and how pairs of materials interact."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from clast.config.choice import Chosen, PartOf, default_part
from clast.config.problems import MISSING, WRONG, problem, refuse
from clast.config.quantities import Number
from clast.parts.params import Params


class PairSettings(Params):
    """How two materials interact in contact."""

    restitution: Annotated[
        Number,
        Field(ge=0, le=1, description="Coefficient of restitution; only laws with damping of their own have none"),
    ] = 1.0
    sliding_friction: Annotated[Number, Field(ge=0, description="Coefficient of sliding friction")] = 0.0
    rolling_friction: Annotated[Number, Field(ge=0, description="Coefficient of rolling friction")] = 0.0


class Contacts(Params):
    """Contact between particles, and between particles and walls."""

    law: Annotated[Chosen, PartOf("contact_law"), Field(description="Contact law")]
    rolling: Annotated[
        Chosen, PartOf("rolling_resistance"), Field(description="Rolling resistance, where pairs have rolling friction")
    ] = default_part("constant_torque")
    bonded_pairs: Annotated[bool, Field(description="Whether bonded particles also touch")] = True
    lever: Annotated[
        Literal["contact_point", "radius"],
        Field(
            description="Where contact forces act: at the contact point, which conserves angular momentum, "
            "or a radius away"
        ),
    ] = "contact_point"
    start_overlap: Annotated[
        Number, Field(ge=0, description="Largest overlap at the start, as a share of the smaller radius")
    ] = 0.05
    pairs: Annotated[
        dict[str, PairSettings],
        Field(description="Settings by pair of materials, 'glass-steel', and 'default' for the others"),
    ] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _restitution_is_given_where_the_law_asks_for_it(self) -> Contacts:
        own = getattr(self.law.part, "damping", None) is not None
        problems = [
            problem(
                ("pairs", name, "restitution"), restitution_text(self.law.name, own), kind=WRONG if own else MISSING
            )
            for name, pair in self.pairs.items()
            if (pair.restitution != 1.0 if own else "restitution" not in pair.model_fields_set)
        ]
        if problems:
            raise refuse(problems)
        return self

    def pair(self, first: str, second: str) -> PairSettings | None:
        """Find the settings of two materials in either order; None where not even ``default`` is given."""
        for name in (f"{first}-{second}", f"{second}-{first}", "default"):
            if name in self.pairs:
                return self.pairs[name]
        return None


def restitution_text(law: str, own_damping: bool) -> str:
    """Return what is said where a pair lacks a coefficient of restitution, or has one that its law has no use for."""
    if own_damping:
        return f"{law!r} damps by parameters of its own and has no coefficient of restitution; leave this key out"
    return "this key is missing: Coefficient of restitution"

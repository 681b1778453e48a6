"""Writes what one scene plugs into the contact sweeps: law and rolling resistance as one, and where numbers lie."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

from clast.engine.blueprint import Blueprint, ContactPlan
from clast.engine.records import construct, construct_from_fields, destruct, fields, width
from clast.engine.slots_pieces import bind, bind_record, function

NAMES = (
    "contact_load contact_energy contact_losses contact_reach read_contact_constants row_constants read_history "
    "write_history carry_history fresh_history load_history store_history no_losses"
)


class Record(NamedTuple):
    """A record of the law or of the rolling resistance: its type, the name it is known by, and whether it is stored."""

    type: type | None
    alias: str
    stored: bool = True

    @property
    def width(self) -> int:
        """How many numbers are stored."""
        return width(self.type) if self.stored else 0


def contacts_text(plan: Blueprint) -> str:
    """Return the source that binds the contact law of a blueprint, and its rolling resistance where it has one."""
    contacts = plan.contacts
    if contacts is None:
        return "CHOICES = None\n" + " = ".join(NAMES.split()) + " = nothing"
    law, rolling = contacts.law, contacts.rolling
    constants = [Record(law.Constants, "ContactConstants")]
    histories = [Record(law.History, "History", stored=contacts.remembers)]
    if rolling is None:
        laws = _law(contacts, "contact", "CHOICES", plan.ledger)
    else:
        constants.append(Record(rolling.Constants, "RollingConstants"))
        histories.append(Record(rolling.History, "RollingHistory"))
        laws = [
            *_law(contacts, "law", "LAW_CHOICES", plan.ledger),
            *_rolling(contacts, plan.ledger),
            *_joined(contacts),
        ]
        laws.append("" if plan.ledger and law.losses is not None else "contact_losses = nothing")
    records = [bind_record(each.alias, each.type) for each in (*constants, *histories)]
    # records that are compiled have no defaults: each has as many fields as its law gives it
    none = f"return ContactLosses(0.0, 0.0, 0.0, 0.0, NO_DRAG{', 0.0' if law.yields else ''})"
    return "\n".join([*laws, function("no_losses", "", none), *records, *_readers(constants), *_history(histories)])


def _law(contacts: ContactPlan, prefix: str, choices: str, ledger: bool) -> list[str]:
    return [
        bind(f"{choices}_TYPE", type(contacts.choices)),
        f"{choices} = {choices}_TYPE{tuple(contacts.choices)!r}",
        bind(f"{prefix}_load", contacts.law.load),
        bind(f"{prefix}_energy", contacts.law.energy),
        bind(f"{prefix}_losses", contacts.law.losses if ledger else None),
        bind(f"{prefix}_reach", contacts.law.reach),
    ]


def _rolling(contacts: ContactPlan, ledger: bool) -> list[str]:
    rolling = contacts.rolling
    assert rolling is not None
    return [
        bind("ROLLING_CHOICES_TYPE", type(contacts.rolling_choices)),
        f"CHOICES = (LAW_CHOICES, ROLLING_CHOICES_TYPE{tuple(contacts.rolling_choices)!r})",
        bind("rolling_load", rolling.load),
        bind("rolling_energy", rolling.energy),
        bind("rolling_losses", rolling.losses if ledger else None),
        bind("law_stiffness", contacts.law.stiffness if rolling.History is not None else None),
    ]


def _joined(contacts: ContactPlan) -> list[str]:
    """Return law and rolling resistance as one law, whose constants, history and choices are pairs."""
    assert contacts.rolling is not None
    stored = contacts.rolling.History is not None
    now = "law_stiffness(constants[0], touch.radius, touch.overlap)" if stored else "0.0"
    then = "stretch_before(touch)" if contacts.reaches else "overlap_before(touch)"
    before = f"law_stiffness(constants[0], touch.radius, {then})" if stored else "0.0"
    overlap = "touch.overlap" if contacts.reaches else "max(touch.overlap, 0.0)"
    stiff = f"law_stiffness(constants[0], touch.radius, {overlap})"
    wound = f" + rolling_energy(constants[1], history[1], touch.radius, {stiff})" if stored else ""
    plastic = ", lost.plastic" if contacts.law.yields else ""
    pressing = f"pressing = Pressing(load.limit, {now}, {before})"
    return [
        function(
            "contact_load",
            "touch, constants, history, dt, choices",
            [
                "load, kept = law_load(touch, constants[0], history[0], dt, choices[0])",
                pressing,
                "rolled, wound = rolling_load(touch, constants[1], history[1], pressing, dt, choices[1])",
                "torque_i, torque_j = add(load.torque_i, rolled.torque_i), add(load.torque_j, rolled.torque_j)",
                "return ContactLoad(load.force, torque_i, torque_j, load.limit), (kept, wound)",
            ],
        ),
        function(
            "contact_energy",
            "touch, constants, history, choices",
            f"return law_energy(touch, constants[0], history[0], choices[0]){wound}",
        ),
        function("contact_reach", "constants, radius", "return law_reach(constants[0], radius)"),
        function(
            "contact_losses",
            "touch, constants, before, load, after, dt, choices, drag",
            [
                "lost = law_losses(touch, constants[0], before[0], load, after[0], dt, choices[0], drag)",
                pressing,
                "rolled = RollingLoad(load.torque_i, load.torque_j)",
                "ways = (before[1], rolled, after[1])",
                "more = rolling_losses(touch, constants[1], *ways, pressing, dt, choices[1], drag.torque)",
                "rolling, stiffening = lost.rolling + more.rolling, lost.stiffening + more.stiffening",
                "kept = Drag(lost.drag.force, more.drag)",
                f"return ContactLosses(lost.viscous, lost.sliding, rolling, stiffening, kept{plastic})",
            ],
        ),
    ]


def _together(texts: list[str]) -> str:
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)},)"


def _built(records: list[Record], place: Callable[[int], str]) -> str:
    """Return the expression that builds the records, the next numbers each from the next place."""
    at, texts = 0, []
    for each in records:
        if each.type is None:
            texts.append("None")
            continue
        count = width(each.type)
        values = [place(at + k) for k in range(count)] if each.stored else ["0.0"] * count
        texts.append(construct(each.type, each.alias, values))
        at += each.width
    return _together(texts)


def _readers(constants: list[Record]) -> list[str]:
    return [
        function("read_contact_constants", "data, first, lane", f"return {_built(constants, in_lane)}"),
        function("row_constants", "row", f"return {_built(constants, lambda k: f'row[{k}]')}"),
    ]


def in_lane(k: int) -> str:
    """Return the expression of a lane's k-th number behind ``first``."""
    return f"data[(first + {k}) * LANES + lane]"


def _history(histories: list[Record]) -> list[str]:
    fresh = _together([_zeros(each) for each in histories])
    lines = [function("fresh_history", "", f"return {fresh}")]
    if not any(each.width for each in histories):
        return [
            *lines,
            function("read_history", "data, first, lane", f"return {fresh}"),
            "write_history = carry_history = load_history = store_history = nothing",
        ]
    numbers = list(_numbers(histories))
    in_row = [f"row[{3 + k}]" for k in range(len(numbers))]
    return [
        *lines,
        function("read_history", "data, first, lane", f"return {_built(histories, in_lane)}"),
        function(
            "write_history", "data, first, lane, record", [f"{in_lane(k)} = {text}" for k, text in enumerate(numbers)]
        ),
        function("carry_history", "record, old, new, angle", f"return {_together(list(_carried(histories)))}"),
        function("load_history", "row", f"return {_built(histories, lambda k: in_row[k])}"),
        function("store_history", "row, record", [f"{a} = {b}" for a, b in zip(in_row, numbers, strict=True)]),
    ]


def _zeros(record: Record) -> str:
    return "None" if record.type is None else construct(record.type, record.alias, ["0.0"] * width(record.type))


def _variables(histories: list[Record]) -> Iterator[tuple[Record, str]]:
    for k, each in enumerate(histories):
        yield each, "record" if len(histories) == 1 else f"record[{k}]"


def _numbers(histories: list[Record]) -> Iterator[str]:
    for each, variable in _variables(histories):
        if each.width and each.type is not None:
            yield from destruct(each.type, variable)


def _carried(histories: list[Record]) -> Iterator[str]:
    """Yield each record as the contact plane takes it along: vectors turn with it."""
    for each, variable in _variables(histories):
        if not each.width or each.type is None:
            yield variable
            continue
        texts = iter(
            f"spin_about(swing({variable}.{field.name}, old, new), new, angle)"
            if field.size == 3
            else f"{variable}.{field.name}"
            for field in fields(each.type)
        )
        yield construct_from_fields(each.type, each.alias, lambda _, texts=texts: next(texts))  # type: ignore[misc]

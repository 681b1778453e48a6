"""All sections, in the order of the page. To add one: write its file, and name it here."""

from __future__ import annotations

from collections.abc import Collection

from clast.bench import bed, beside, crush, following, search, sizes, third_party, waiting
from clast.bench.precision.sections import SECTIONS as PRECISION
from clast.bench.section import Section
from clast.errors import ConfigError
from clast.plugins.nearest import suggestion

ERROR_AGAINST_TIME: tuple[Section, ...] = (*PRECISION, crush.SECTION)
SECTIONS: tuple[Section, ...] = (
    *ERROR_AGAINST_TIME,
    beside.SECTION,
    sizes.SECTION,
    bed.SECTION,
    search.SECTION,
    waiting.SECTION,
    following.SECTION,
    third_party.SECTION,
)


def chosen(names: Collection[str]) -> list[Section]:
    """Return the sections of some names, all where none is named.

    Raises
    ------
    ConfigError
        No section has a name.
    """
    known = [section.name for section in SECTIONS]
    for name in names:
        if name not in known:
            raise ConfigError(f"no section of the benchmark is named {name!r}; {suggestion(name, known)}")
    return [section for section in SECTIONS if section.name in names or not names]

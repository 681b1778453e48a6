"""The matrix: every group of entries, in the order of the page."""

from __future__ import annotations

from tests.stability.entry import Group
from tests.stability.matrix import bonds, contacts, crushing, extremes, steps

GROUPS: tuple[Group, ...] = (*steps.GROUPS, *contacts.GROUPS, *bonds.GROUPS, *crushing.GROUPS, *extremes.GROUPS)

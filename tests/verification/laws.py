"""Plugin for the tests: Hertz–Mindlin once more under another name, and with mistakes of a size."""

from dataclasses import replace

from clast import hookimpl
from clast.plugins.discovery import discover

CLAST_API = 1
FAITHFUL = discover().get("contact_law", "hertz_mindlin").part


def too_stiff(params, pair):
    c = FAITHFUL.constants(params, pair)
    return c._replace(E=1.02 * c.E)


def underdamped(params, pair):
    c = FAITHFUL.constants(params, pair)
    return c._replace(c_n=0.98 * c.c_n)


@hookimpl
def clast_register(registry):
    registry.contact_law("faithful", FAITHFUL)
    registry.contact_law("too_stiff", replace(FAITHFUL, constants=too_stiff))
    registry.contact_law("underdamped", replace(FAITHFUL, constants=underdamped))

"""Plugin for the tests: laws of Clast once more under other names, and with mistakes of a size."""

from dataclasses import replace

from clast import hookimpl
from clast.parts.params import Params
from clast.plugins.discovery import discover
from clast_plugins.bond_models.beam import beam_stiffness
from clast_plugins.bond_models.elastic import energy as elastic_energy
from clast_plugins.contact_laws.hertz_mindlin import energy as hertz_energy

CLAST_API = 1
FAITHFUL = discover().get("contact_law", "hertz_mindlin").part


def too_stiff(params, pair):
    c = FAITHFUL.constants(params, pair)
    return c._replace(E=1.02 * c.E)


def underdamped(params, pair):
    c = FAITHFUL.constants(params, pair)
    return c._replace(c_n=0.98 * c.c_n)


BOND = discover().get("bond_model", "elastic").part


def soft_in_shear(params, bond):
    c = BOND.constants(params, bond)
    return c._replace(GA=0.98 * c.GA)


def stiff_in_bending(params, bond):
    c = BOND.constants(params, bond)
    return c._replace(EI=1.02 * c.EI)


def too_strong(params, bond):
    c = BOND.constants(params, bond)
    return c._replace(per_normal_strength=0.999 * c.per_normal_strength)


def too_rough(params, pair):
    c = FAITHFUL.constants(params, pair)
    return c._replace(mu=1.02 * c.mu)


def pushing(params, pair):
    """Return friction that pushes where it should hold."""
    c = FAITHFUL.constants(params, pair)
    return c._replace(mu=-c.mu)


def too_soft_sideways(params, pair):
    c = FAITHFUL.constants(params, pair)
    return c._replace(G=0.98 * c.G)


def too_little_energy(touch, c, history, chosen):
    return 0.98 * hertz_energy(touch, c, history, chosen)


def beyond_the_compiler(touch, c, history, chosen):
    return FAITHFUL.energy(touch, c, history, chosen)


def too_much_energy(strain, c, state):
    return 1.02 * elastic_energy(strain, c, state)


class Nameless(Params):
    """A bond that is told neither E nor ν."""

    k: float = 564.26e6


def nameless(params, bond):
    return BOND.constants(BOND.Params(young_modulus=params.k, poisson_ratio=0.25, normal_strength=1e9), bond)


def declares_too_much(params, bond):
    k = beam_stiffness(params.k, 0.25, bond)
    return k._replace(axial=1.02 * k.axial, bending=1.02 * k.bending)


def no_cylinder(params, bond):
    k = BOND.stiffness(params, bond)
    return k._replace(bending=2.0 * k.bending)


@hookimpl
def clast_register(registry):
    registry.contact_law("faithful", FAITHFUL)
    registry.contact_law("too_stiff", replace(FAITHFUL, constants=too_stiff))
    registry.contact_law("underdamped", replace(FAITHFUL, constants=underdamped))
    registry.bond_model("faithful_bond", BOND)
    without = replace(BOND, Params=Nameless, constants=nameless, stiffness=declares_too_much)
    registry.bond_model("declares_too_much", without)
    registry.bond_model("no_cylinder", replace(BOND, stiffness=no_cylinder))
    registry.bond_model("soft_in_shear", replace(BOND, constants=soft_in_shear))
    registry.bond_model("stiff_in_bending", replace(BOND, constants=stiff_in_bending))
    registry.bond_model("too_strong", replace(BOND, constants=too_strong))
    registry.contact_law("too_rough", replace(FAITHFUL, constants=too_rough))
    registry.contact_law("pushing", replace(FAITHFUL, constants=pushing))
    registry.contact_law("too_little_energy", replace(FAITHFUL, energy=too_little_energy))
    registry.contact_law("beyond_the_compiler", replace(FAITHFUL, energy=beyond_the_compiler))
    registry.contact_law("silent", replace(FAITHFUL, losses=None))
    registry.bond_model("too_much_energy", replace(BOND, energy=too_much_energy))
    registry.contact_law("too_soft_sideways", replace(FAITHFUL, constants=too_soft_sideways))

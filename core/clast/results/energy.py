"""What a run's energy ledger tells at the end: whether it closes, and whether the run was quasi-static."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.engine.ledger import Ledger
from clast.results.curves import ENERGY, energies
from clast.simulation import Simulation

MOST_KINETIC = 0.05
"""Kinetic energy as a share of the elastic energy up to which explicit simulations count as quasi-static; the handbooks
of explicit finite element programs say 5 to 10 %."""

MOST_INERTIAL = 1e-3
"""Inertial number up to which granular flows are quasi-static: da Cruz et al. (2005),
doi:10.1103/PhysRevE.72.021309."""

COLUMNS = tuple(ENERGY.format(name) for name in (*Ledger._fields, "error"))

Curves = dict[str, NDArray[np.float64]]


def columns(ledger: Ledger) -> dict[str, float]:
    """Return the columns of a ledger on the curves, in J, the error last."""
    return dict(zip(COLUMNS, (*ledger, ledger.error), strict=True))


def energy_results(simulation: Simulation, curves: Curves) -> dict[str, Any]:
    """Return the ledger at the end, how well it closes, and how quasi-static the run was; nothing without a ledger."""
    if not simulation.plan.ledger:
        return {}
    ledger = simulation.ledger()
    told: dict[str, Any] = {
        "at_the_end_J": ledger._asdict(),
        "error_J": ledger.error,
        "closure": ledger.closure,
        "incomplete": incomplete(simulation),
    }
    return {"energy": told | quasi_static(simulation, curves)}


def incomplete(simulation: Simulation) -> str | None:
    """Return the sentence that says what the ledger cannot know, None where it knows all."""
    contacts = simulation.plan.contacts
    if contacts is None or contacts.law.losses is not None:
        return None
    law = simulation.config.contacts
    name = law.law.name if law is not None else ""
    return f"the contact law {name!r} does not tell what it dissipates (it has no 'losses'), so the ledger cannot close"


def quasi_static(simulation: Simulation, curves: Curves) -> dict[str, Any]:
    """Return kinetic over elastic energy (the median before the peak stress), and the inertial number at the peak.

    The inertial number is I = ε̇ d √(ρ/P) with the strain rate, the mean diameter and density of the primaries (masses
    as scaled) and the stress on the plate.
    """
    stress = curves.get("stress_Pa")
    if stress is None or len(stress) < 3:
        return {}
    k = max(int(np.argmax(stress)), 2)
    energy = energies(curves)
    elastic = (energy["contact_elastic"] + energy["bond_elastic"])[1 : k + 1]
    known = elastic > 0.0
    ratio = float(np.median(energy["kinetic"][1 : k + 1][known] / elastic[known])) if known.any() else None
    rate = float((curves["strain"][k] - curves["strain"][0]) / (curves["time_s"][k] - curves["time_s"][0]))
    scene = simulation.scene
    density = float(scene.mass.sum() / (4.0 / 3.0 * np.pi * (scene.radius**3).sum()))
    pressure = float(stress[k])
    inertial = abs(rate) * 2.0 * float(scene.radius.mean()) * sqrt(density / pressure) if pressure > 0.0 else None
    calm = None if ratio is None or inertial is None else ratio < MOST_KINETIC and inertial < MOST_INERTIAL
    return {"kinetic_per_elastic_before_peak": ratio, "inertial_number_at_peak": inertial, "quasi_static": calm}


def sentence(energy: dict[str, Any]) -> str:
    """Return what the table at the end of a run says of its energies.

    >>> sentence({"closure": 2e-5, "incomplete": None, "quasi_static": True})
    'closes to 2.0e-05 of the work; quasi-static before the peak'
    """
    if energy["incomplete"]:
        return str(energy["incomplete"])
    calm = {True: "; quasi-static before the peak", False: "; not quasi-static before the peak"}
    return f"closes to {abs(energy['closure']):.1e} of the work{calm.get(energy.get('quasi_static'), '')}"  # type: ignore[arg-type]

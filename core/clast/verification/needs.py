"""What closed forms ask of a scene's parts; each function tells why a case would say nothing, or None."""

from __future__ import annotations

from collections.abc import Callable
from math import isclose

import numpy as np

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.parts.bond_model import BondGeometry
from clast.parts.contact_law import MaterialPair
from clast.verification.closed_forms.beam import Beam


def pair_of(scene: SceneConfig) -> MaterialPair:
    """Return the first material of a scene in contact with itself."""
    material = next(iter(scene.materials.values()))
    E, nu = material.young_modulus, material.poisson_ratio
    return MaterialPair(E, nu, E, nu, restitution=0.5, sliding_friction=0.3, rolling_friction=0.0)


def hertzian(scene: SceneConfig) -> str | None:
    """Ask for a contact law whose stiffness, as it declares it, grows with the root of the overlap."""
    assert scene.contacts is not None
    law = scene.contacts.law
    constants = law.part.constants(law.params, pair_of(scene))
    thin, thick = (law.part.stiffness(constants, 1e-3, overlap) for overlap in (1e-6, 4e-6))
    if thin > 0.0 and isclose(thick / thin, 2.0, rel_tol=1e-3):
        return None
    return f"the stiffness of {law.name!r} does not grow with the root of the overlap, as Hertz's does"


def linear(scene: SceneConfig) -> str | None:
    """Ask for a contact law whose stiffness, as it declares it, is the same at every overlap."""
    assert scene.contacts is not None
    law = scene.contacts.law
    constants = law.part.constants(law.params, pair_of(scene))
    thin, thick = (law.part.stiffness(constants, 1e-3, overlap) for overlap in (1e-6, 4e-6))
    return None if thin == thick else f"the stiffness of {law.name!r} changes with the overlap"


def law_parameters(*names: str) -> Callable[[SceneConfig], str | None]:
    """Ask for a contact law that has certain parameters: those that the closed form is made of."""

    def need(scene: SceneConfig) -> str | None:
        assert scene.contacts is not None
        return lacking(scene.contacts.law, names)

    return need


def lacking(chosen: Chosen, names: tuple[str, ...]) -> str | None:
    """Return which of some parameters a part does not have; None where it has all."""
    missing = [name for name in names if getattr(chosen.params, name, None) is None]
    return f"{chosen.name!r} has no {' and no '.join(missing)}" if missing else None


def sticks(scene: SceneConfig) -> str | None:
    """Ask for a contact law that remembers tangential displacements."""
    assert scene.contacts is not None
    law = scene.contacts.law
    if law.part.History is not None:
        return None
    return f"{law.name!r} remembers nothing of a contact, so it has no friction that can hold"


def holds_rolling(scene: SceneConfig) -> str | None:
    """Ask for a rolling resistance that remembers how far a contact has rolled."""
    assert scene.contacts is not None
    rolling = scene.contacts.rolling
    return None if rolling.part.History is not None else f"{rolling.name!r} has no spring that could hold what rests"


def losses(scene: SceneConfig) -> str | None:
    """Ask for a contact law that tells what it dissipates."""
    assert scene.contacts is not None
    law = scene.contacts.law
    if law.part.losses is not None:
        return None
    return f"{law.name!r} does not tell what it dissipates (it has no 'losses')"


def full_restitution(scene: SceneConfig) -> str | None:
    """Ask that damped contacts may pull, without which the coefficient of restitution is not reached exactly."""
    assert scene.contacts is not None
    if not getattr(scene.contacts.law.params, "tension_cutoff", False):
        return None
    return "with tension_cutoff the coefficient of restitution is larger than the one written"


def coulomb_on_elastic_force(scene: SceneConfig) -> str | None:
    """Ask that friction is limited by the elastic force, whose impulse is the whole normal impulse."""
    assert scene.contacts is not None
    limit = getattr(scene.contacts.law.params, "coulomb_limit", "elastic")
    if limit == "elastic":
        return None
    return f"with coulomb_limit {limit} a sliding impact takes another impulse than mu times the normal one"


def bond_parameters(*names: str) -> Callable[[SceneConfig], str | None]:
    """Ask for a bond model that has certain parameters: those that the closed form is made of."""

    def need(scene: SceneConfig) -> str | None:
        assert scene.bonds is not None
        return lacking(scene.bonds.model, names)

    return need


def elastic_constants(scene: SceneConfig) -> tuple[float, float]:
    """Return E in Pa and ν of the bonds: as their model is told, or else as the stiffnesses that it declares imply."""
    assert scene.bonds is not None
    params = scene.bonds.model.params
    E, nu = (getattr(params, name, None) for name in ("young_modulus", "poisson_ratio"))
    unit = Beam(E=1.0, nu=0.0, R=0.1, L=1.0)
    axial, shear, _, _ = declared(scene, unit)
    return E or axial / unit.axial, 0.5 * axial / shear - 1.0 if nu is None else nu


def declared(scene: SceneConfig, size: Beam) -> tuple[float, ...]:
    """Return the stiffnesses that the bond model declares for a bond of some size."""
    assert scene.bonds is not None
    model = scene.bonds.model
    L0 = np.array([size.L])
    found = model.part.stiffness(model.params, BondGeometry(L0, size.R, size.A, size.I))
    return tuple(float(np.ravel(each)[0]) for each in found)


def cylinder(scene: SceneConfig) -> str | None:
    """Ask for a bond model whose stiffnesses, as it declares them, are those of a cylinder of a material."""
    beam = Beam(*elastic_constants(scene), R=0.1, L=1.0)
    return _stiffnesses_of(scene, beam, beam.shear, "a cylinder")


def timoshenko_beam(scene: SceneConfig) -> str | None:
    """Ask for a bond model whose stiffnesses, as it declares them, are those of Timoshenko's beam of a material."""
    beam = Beam(*elastic_constants(scene), R=0.1, L=1.0)
    return _stiffnesses_of(scene, beam, beam.bent_and_sheared, "Timoshenko's beam")


def _stiffnesses_of(scene: SceneConfig, beam: Beam, shear: float, what: str) -> str | None:
    assert scene.bonds is not None
    expected = (beam.axial, shear, beam.torsion, beam.bending)
    if all(isclose(a, b, rel_tol=1e-9) for a, b in zip(declared(scene, beam), expected, strict=True)):
        return None
    return f"the stiffnesses that {scene.bonds.model.name!r} declares are not those of {what}"


def synchronous(scene: SceneConfig) -> str | None:
    """Ask for an integrator whose step is the same backwards: velocities belong to the time of the positions."""
    moves = [
        move
        for stage in scene.integrator.part.stages
        for move in (
            ("kick", stage.kick_before),
            ("drift", stage.drift_before),
            ("kick", stage.kick_after),
            ("drift", stage.drift_after),
        )
        if move[1] != 0.0
    ]
    if moves == moves[::-1]:
        return None
    return f"the velocities of {scene.integrator.name!r} belong to another time than its positions"

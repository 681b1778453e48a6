"""Every body force can be tried; drag is a dashpot to the ground in the stable step, compiled only where it acts."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np
import pytest

from clast.building import build_scene
from clast.config.scene import from_mapping
from clast.engine.slots_text import slots_text
from clast.errors import PluginError
from clast.maths.vec3 import ZERO, scale
from clast.parts.body_force import BodyForce
from clast.parts.params import Params
from clast.plugins.discovery import discover
from clast.scene.held import not_held
from clast.scene.plan import blueprint
from clast.stability.time_step import limits
from clast.testing.body_force import claims
from clast.testing.claim import try_claims
from clast.testing.kit import try_part
from clast_plugins.body_forces.viscous_drag import Numbers, load

SCENE = {
    "materials": {"glass": {"density": 2500, "young_modulus": "50 MPa", "poisson_ratio": 0.2}},
    "particles": {
        "type": "explicit",
        "material": "glass",
        "particles": [{"position": [0, 0, 0], "radius": "1 mm"}, {"position": [0, 0, "5 mm"], "radius": "2 mm"}],
    },
    "time": {"end": {"time": 1.0}},
}
CONTACTS = {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 0.5}}}
DRAG = {"type": "viscous_drag", "viscosity": 2.0}


@pytest.mark.parametrize("name", discover().names("body_force"))
@pytest.mark.parametrize("changes", [{}, {"fluid_density": 1000.0, "fluid_velocity": [1, 2, 0]}])
def test_it_keeps_to_what_holds_for_every_body_force(name, changes):
    entry = discover().get("body_force", name)
    outcomes = try_part(entry, changes if changes.keys() <= entry.part.Params.model_fields.keys() else {})
    assert [outcome for outcome in outcomes if not outcome.passed] == []


def test_drag_beyond_stokes_is_that_of_the_standard_curve():
    """C_D of Clift, Grace and Weber (1978) at Re = 1, 10, 100 and 10⁵: 27.2, 4.26, 1.09 (within 3 %) and 0.44."""
    for reynolds, told in ((1.0, 27.2), (10.0, 4.26), (100.0, 1.09), (1e5, 0.44)):
        fluid = Numbers(viscosity=2.0 / reynolds, density=1.0, velocity=(1.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0))
        force, _ = load(fluid, (0.0,) * 3, (0.0,) * 3, (0.0,) * 3, 1.0, 0.0)
        assert force[0] / (0.5 * pi) == pytest.approx(told, rel=0.03)


def test_drag_alone_limits_the_step_as_a_dashpot_to_the_ground():
    """Midstep keeps v' = -c/m v stable up to m/c; spins are dragged harder, c_r/I = 10/3 c/m, small ones most."""
    scene = build_scene(from_mapping({**SCENE, "body_forces": [DRAG]}))
    rate = 20.0 * pi * 2.0 * 1e-3 / scene.mass[0]
    assert limits(scene, blueprint(scene)).spectral == pytest.approx(1.0 / rate, rel=1e-6)
    free = build_scene(from_mapping(SCENE))
    assert limits(free, blueprint(free)).spectral == float("inf")


def test_mass_scaling_leaves_the_drag_and_lengthens_the_step():
    scaled = build_scene(
        from_mapping({**SCENE, "body_forces": [DRAG], "time": {"mass_scaling": 100, "end": {"time": 1.0}}})
    )
    once = build_scene(from_mapping({**SCENE, "body_forces": [DRAG]}))
    each = [limits(scene, blueprint(scene)).spectral for scene in (scaled, once)]
    assert each[0] == pytest.approx(100.0 * each[1], rel=1e-6)


def test_what_is_off_is_not_compiled():
    plain, dragged = (blueprint(build_scene(from_mapping({**SCENE, "body_forces": f}))) for f in ([], [DRAG]))
    assert "BODY_LOADS = False" in slots_text(plain)
    assert not plain.spin
    assert "BODY_LOADS = True" in slots_text(dragged)
    assert dragged.spin


def test_particles_that_a_flow_carries_away_are_told():
    walls = {"side": {"type": "plane", "material": "glass", "point": [0, 0, -1], "normal": [0, 0, 1]}}
    flow = {**DRAG, "fluid_velocity": [1, 0, 0]}
    scene = build_scene(from_mapping({**SCENE, "walls": walls, "contacts": CONTACTS, "body_forces": [flow]}))
    assert any("body_forces.0 (viscous_drag)" in text for text in not_held(scene))


def test_a_body_force_is_an_acceleration_or_a_load():
    with pytest.raises(PluginError, match="needs either 'acceleration' or 'load'"):
        BodyForce("nothing", Params, Numbers, lambda params, scaling: None)


class Brake(NamedTuple):
    """What a brake takes for a velocity, and what it tells of that, in N s/m."""

    taken: float
    told: float


@pytest.mark.parametrize(("spoiled", "claim"), [("taken", "scaled masses leave forces"), ("told", "its damping is")])
def test_a_load_that_follows_scaled_masses_breaks_a_claim(spoiled, claim):
    part = BodyForce(
        summary="a brake",
        Params=Params,
        Numbers=Brake,
        numbers=lambda params, mass_scaling: Brake(1.0, 1.0)._replace(**{spoiled: 1.0 / mass_scaling}),
        load=lambda known, x, v, w, radius, time: (scale(-known.taken, v), ZERO),
        damping=lambda known, radius, velocity: (np.full(len(radius), known.told), np.zeros(len(radius))),
    )
    tried = [each for each in claims(part, Params()) if not each.says.startswith("compiled")]
    assert [outcome.says[: len(claim)] for outcome in try_claims(tried) if not outcome.passed] == [claim]

"""A plugin's integrator: position Verlet without a predictor, as somebody else might bring it."""

from clast import hookimpl
from clast.parts.integrator import Integrator, Stage
from clast.parts.params import Params

CLAST_API = 1


@hookimpl
def clast_register(registry):
    registry.integrator(
        "position_verlet",
        Integrator(
            summary="position Verlet with velocities half a step old",
            Params=Params,
            stages=(Stage(0.0, 0.5, 0.0, 1.0, 0.5),),
            damping_factor=lambda zeta: 1.0 / (1.0 + zeta),
            order=2,
        ),
    )

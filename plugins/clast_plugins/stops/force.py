"""End at a force on a wall."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.problems import wrong
from clast.config.quantities import Direction, Force
from clast.maths.vec3 import norm
from clast.parts.params import Params
from clast.parts.stop import Curves, Stop
from clast.plugins.registry import Registry


class WallForce(Params):
    r"""Holds when the force of the particles on a wall is above or below a value: to load to a force, and to unload.

    Equation
    --------
    P ≥ ``above``,  or P ≤ ``below`` once P > ``below``

    Symbols
    -------
    P : length of the force on the wall in N; with a ``direction``, its component along it

    Limits
    ------
    It looks at samples, so the force may have gone beyond by what it changes from one sample to the next. A force falls
    ``below`` a value only from above it: until it has been there in this stage, the sample at which the stage began
    counted, the condition waits, as for a wall that nothing touches yet. A stage that begins below and stays there is
    never over.
    """

    wall: Annotated[str, Field(examples=["upper"], description="Name of the wall")]
    above: Annotated[Force | None, Field(examples=["10 N"], description="Force that must be reached from below")] = None
    below: Annotated[Force | None, Field(description="Force to which it must fall from above, instead")] = None
    direction: Annotated[
        Direction | None, Field(description="Direction along which the force counts; none: its length counts")
    ] = None

    @model_validator(mode="after")
    def _one_bound(self) -> WallForce:
        if (self.above is None) == (self.below is None):
            text = "exactly one of above and below is needed; given "
            raise wrong("below", f"{text}both") if self.above is not None else ValueError(f"{text}neither")
        bound = self.above if self.above is not None else self.below
        if self.direction is None and bound is not None and bound < 0.0:
            key = "above" if self.above is not None else "below"
            raise wrong(key, f"the length of a force is never {bound:g} N; give a direction for its sign")
        return self


def reads(params: WallForce) -> list[str]:
    """Return the columns of the force on the wall."""
    return [f"force_{params.wall}_{c}_N" for c in "xyz"]


def forces_on(params: WallForce, curves: Curves) -> NDArray[np.float64]:
    """Return the force that counts at every sample in N."""
    x, y, z = (curves[name] for name in reads(params))
    if params.direction is None:
        return np.asarray(np.sqrt(x * x + y * y + z * z))
    along = params.direction
    return np.asarray((along[0] * x + along[1] * y + along[2] * z) / norm(along))


def reached(params: WallForce, curves: Curves) -> str | None:
    """Tell that the force is reached."""
    forces = forces_on(params, curves)
    force = float(forces[-1])
    if params.above is not None:
        return f"the force on {params.wall} rose to {force:.4g} N" if force >= params.above else None
    assert params.below is not None
    fell = force <= params.below < float(forces.max())
    return f"the force on {params.wall} fell to {force:.4g} N" if fell else None


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the condition."""
    registry.stop(
        "force",
        Stop(summary="holds when the force on a wall passes a value", Params=WallForce, reached=reached, reads=reads),
    )

"""Sections of a scene file: one model each, with unit, bound and meaning of every key."""

from __future__ import annotations

from math import pi
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag, ValidationInfo, model_validator

from clast.config.choice import Chosen, PartOf, default_part, registry_of
from clast.config.problems import refuse
from clast.config.quantities import Area, Density, Length, Number, Stress, Time, Velocity
from clast.config.scatter import Scatter, scatter_problems
from clast.config.stages import Stages
from clast.parts.params import Params

BEYOND = 1e100
"""What no length in m or time in s of a scene reaches; its square can still be computed."""
DEFAULT_WRITERS = ("recording", "vtk", "figure", "picture")
LEDGER_WRITER = "energy"


class Material(Params):
    """What particles and walls are made of."""

    density: Annotated[Density, Field(gt=0, description="Mass per volume of a primary")]
    young_modulus: Annotated[Stress, Field(gt=0, description="Young's modulus E")]
    poisson_ratio: Annotated[Number, Field(gt=-1, lt=0.5, description="Poisson's ratio ν")]


class BondRange(Params):
    """Which pairs of particles are bonded."""

    max_gap: Annotated[
        Annotated[Length, Field(ge=0)] | None, Field(description="Largest gap between surfaces that is bonded")
    ] = None
    relative_gap: Annotated[
        Annotated[Number, Field(ge=0)] | None,
        Field(description="The same as a share of the smaller particle's diameter, instead of max_gap"),
    ] = None
    min_gap: Annotated[Length | None, Field(description="Smallest gap that is bonded; overlaps are negative gaps")] = (
        None
    )
    diameter: Annotated[
        Annotated[Length, Field(gt=0)] | None,
        Field(description="Diameter of the bonds; by default the smaller particle's"),
    ] = None
    materials: Annotated[
        tuple[str, ...] | None, Field(description="Materials whose particles are bonded; by default all")
    ] = None

    @model_validator(mode="after")
    def _range_is_not_empty(self) -> BondRange:
        if (self.max_gap is None) == (self.relative_gap is None):
            raise ValueError("give exactly one of 'max_gap' and 'relative_gap'")
        if self.min_gap is not None and self.max_gap is not None and self.min_gap > self.max_gap:
            raise ValueError(f"min_gap {self.min_gap:g} m is larger than max_gap {self.max_gap:g} m")
        return self


class Bonds(Params):
    """Solid bridges between particles."""

    between: Annotated[
        BondRange | None, Field(description="Bond near pairs; without it only the generators' own bonds")
    ] = None
    kinematics: Annotated[
        Chosen, PartOf("bond_kinematics"), Field(description="How a bond's deformation is measured")
    ] = default_part("total")
    model: Annotated[Chosen, PartOf("bond_model"), Field(description="Bond model")]
    scatter: Annotated[
        tuple[Scatter, ...] | None,
        Field(description="Parameters of the model that differ from bond to bond; by default none does"),
    ] = None
    damping: Annotated[Number, Field(ge=0, description="Damping ratio of bonds; 0 is none")] = 0.0
    fade_steps: Annotated[int, Field(ge=0, description="Steps over which a broken bond's load fades")] = 0

    @model_validator(mode="after")
    def _scatter_fits_the_model(self) -> Bonds:
        problems = list(scatter_problems(self.scatter or (), self.model))
        if problems:
            raise refuse(problems)
        return self


class WallSettings(Params):
    """What every wall has beside its shape."""

    material: Annotated[str, Field(description="Name of the wall's material")]
    motion: Annotated[
        Stages | None,
        Field(description="How the wall moves, or a list of motions, each until a condition; by default it rests"),
    ] = None


class Compression(Params):
    """How strain and stress are read off two plates."""

    upper: Annotated[str, Field(description="Name of the upper wall")]
    lower: Annotated[str, Field(description="Name of the lower wall")]
    height: Annotated[
        Length, Field(gt=0, description="Height that strain refers to; with a side, that between the plates")
    ]
    diameter: Annotated[
        Annotated[Length, Field(gt=0)] | None,
        Field(description="Diameter of the round section that stress refers to; with a side, that of its section"),
    ] = None
    area: Annotated[
        Annotated[Area, Field(gt=0)] | None,
        Field(description="Area of the section that stress refers to, instead of a diameter"),
    ] = None
    side: Annotated[
        tuple[str, ...],
        BeforeValidator(lambda given: (given,) if isinstance(given, str) else given),
        Field(
            description="Name of the wall around what is pressed, such as an oedometer's cylinder, or of all planes "
            "around it, such as the four of a box"
        ),
    ] = ()

    @model_validator(mode="after")
    def _has_one_section(self) -> Compression:
        if (self.diameter is None) == (self.area is None):
            raise ValueError("give exactly one of 'diameter' and 'area'")
        return self

    @property
    def section(self) -> float:
        """Area that stress refers to, in m²."""
        if self.area is not None:
            return self.area
        assert self.diameter is not None
        return 0.25 * pi * self.diameter**2


class NeighbourSettings(Params):
    """What every neighbour search has beside its own parameters."""

    skin: Annotated[
        Annotated[Literal["auto"], Tag("<auto>")] | Annotated[Length, Field(gt=0, lt=BEYOND), Tag("<length>")],
        Discriminator(lambda given: "<auto>" if given == "auto" else "<length>"),
        Field(description="Width by which lists reach beyond contact; 'auto' chooses it"),
    ] = "auto"


IMPACT_SPEED = 1.0
STEP_FACTORS = {"spectral": 0.8, "paper": 0.1}


class StepRule(Params):
    """Time step from a rule."""

    rule: Annotated[
        Literal["spectral", "paper"],
        Field(description="Limit that the step is taken from: the true one, or that of single bonds (Eqs. 14-17)"),
    ] = "spectral"
    factor: Annotated[
        Number, Field(gt=0, description="Share of the rule's limit; by default 0.8 for spectral, 0.1 for paper")
    ] = STEP_FACTORS["spectral"]
    impact_speed: Annotated[
        Velocity, Field(gt=0, description="Closing speed of impacts that spectral resolves with 20 steps")
    ] = IMPACT_SPEED

    @model_validator(mode="before")
    @classmethod
    def _factor_of_the_rule(cls, given: Any) -> Any:
        if isinstance(given, dict) and given.get("rule") in list(STEP_FACTORS):  # what cannot be hashed is no rule
            return {"factor": STEP_FACTORS[given["rule"]]} | given
        return given


class End(Params):
    """When a run ends: at a strain, a time or a number of steps."""

    strain: Annotated[
        Annotated[Number, Field(gt=0)] | None,
        Field(
            description="Strain to reach: of the compression, or of the side of a stretched box that is strained most"
        ),
    ] = None
    time: Annotated[Annotated[Time, Field(gt=0)] | None, Field(description="Simulated time to reach")] = None
    steps: Annotated[Annotated[int, Field(gt=0)] | None, Field(description="Steps to take")] = None

    @model_validator(mode="after")
    def _exactly_one(self) -> End:
        given = [name for name in ("strain", "time", "steps") if getattr(self, name) is not None]
        if len(given) != 1:
            found = " and ".join(given) or "none of them"
            raise ValueError(f"exactly one of strain, time and steps is needed; given {found}")
        return self


def _step_branch(given: Any) -> str:
    return "<rule>" if isinstance(given, dict | StepRule) else "<time>"


class TimeSettings(Params):
    """Time step, mass scaling and end of the run."""

    step: Annotated[
        Annotated[StepRule, Tag("<rule>")] | Annotated[Time, Field(gt=0), Tag("<time>")],
        Discriminator(_step_branch),
        Field(description="A fixed time step, or a rule"),
    ] = StepRule(rule="spectral")
    mass_scaling: Annotated[Number, Field(ge=1, description="Factor on all masses")] = 1.0
    selective_mass_scaling: Annotated[
        Annotated[Time, Field(gt=0, lt=BEYOND)] | None,
        Field(description="Stable step for which particles that do not allow it are made heavier, and only those"),
    ] = None
    end: Annotated[End, Field(description="When the run ends")]
    allow_unstable: Annotated[bool, Field(description="Allow a time step above the limit")] = False
    wall_time: Annotated[
        Annotated[Time, Field(gt=0)] | None,
        Field(description="Wall-clock time after which the run ends with a checkpoint, to be resumed"),
    ] = None


def _writers_or_default(given: Any, info: ValidationInfo) -> Any:
    if given is not None:
        return given
    known = registry_of(info).names("writer")
    wanted = [*DEFAULT_WRITERS, LEDGER_WRITER] if info.data.get("ledger") else DEFAULT_WRITERS
    return [name for name in wanted if name in known]


MOST_TRACKED = 8000
"""Numbers that fit beside a table of the results; frames hold everything."""


class Tracks(Params):
    """Particles and bonds that are followed closely: their full state at every sample."""

    particles: Annotated[
        tuple[int, ...], Field(max_length=MOST_TRACKED, description="Numbers of particles, from 0")
    ] = ()
    bonds: Annotated[tuple[int, ...], Field(max_length=MOST_TRACKED, description="Numbers of bonds, from 0")] = ()


class Output(Params):
    """What a run leaves behind."""

    samples: Annotated[int, Field(ge=2, description="Points on the curves")] = 500
    frames: Annotated[int, Field(ge=0, description="States kept of all particles and bonds")] = 100
    contacts: Annotated[
        Literal["auto", True, False, "all"],
        Field(
            description="Whether frames keep what touches and its forces, between grains and at walls, or all, inside "
            "grains too; 'auto' where there are several grains"
        ),
    ] = "auto"
    tracks: Annotated[Tracks, Field(description="Particles and bonds to follow at every sample")] = Tracks()
    force: Annotated[
        Literal["instantaneous", "mean"],
        Field(description="Wall force at the sample, or its mean since the sample before"),
    ] = "instantaneous"
    ledger: Annotated[
        bool, Field(description="Whether energies are booked: where the work that goes into the scene stays")
    ] = False
    writers: Annotated[
        tuple[Annotated[Chosen, PartOf("writer")], ...],
        BeforeValidator(_writers_or_default),
        Field(description="What is written when the run ends; by default all of Clast's own"),
    ] = default_part(None)
    checkpoint: Annotated[Time, Field(gt=0, description="Wall-clock time between checkpoints")] = 600.0


class ReferencePoint(Params):
    """A measured crushing point, drawn beside the curve."""

    label: Annotated[str, Field(description="What stands in the legend")]
    strain: Annotated[Number, Field(description="Strain at crushing")]
    stress: Annotated[Stress, Field(description="Stress at crushing")]
    strain_deviation: Annotated[Number, Field(ge=0, description="Scatter of the strain")] = 0.0
    stress_deviation: Annotated[Stress, Field(ge=0, description="Scatter of the stress")] = 0.0

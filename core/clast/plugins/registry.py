"""Registry: every part by kind and name, and where it came from."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Protocol

from clast.errors import PluginError
from clast.parts.params import Params
from clast.plugins.conflict import conflict
from clast.plugins.declaration import check_declaration
from clast.plugins.nearest import suggestion
from clast.plugins.registered import Failure, Registered, Source

if TYPE_CHECKING:
    from clast.parts.body_force import BodyForce
    from clast.parts.bond_kinematics import BondKinematics
    from clast.parts.bond_model import BondModel
    from clast.parts.contact_law import ContactLaw
    from clast.parts.damping import Damping
    from clast.parts.generator import Generator
    from clast.parts.integrator import Integrator
    from clast.parts.motion import Motion
    from clast.parts.neighbour_search import NeighbourSearch
    from clast.parts.rolling_resistance import RollingResistance
    from clast.parts.stop import Stop
    from clast.parts.wall import Wall
    from clast.parts.writer import Writer

KINDS = (
    "generator",
    "bond_model",
    "bond_kinematics",
    "contact_law",
    "rolling_resistance",
    "integrator",
    "damping",
    "neighbour_search",
    "wall",
    "motion",
    "body_force",
    "stop",
    "writer",
)


class NameTakenError(PluginError):
    """Two plugins bring a part of one kind under one name."""


class Part(Protocol):
    """What every part offers, whatever its kind."""

    @property
    def summary(self) -> str:
        """One line for ``clast plugins``."""

    @property
    def Params(self) -> type[Params]:
        """What the user writes for the part."""


class Registry:
    """All parts, by kind and name.

    A plugin gets the registry in ``clast_register`` and calls the method named after the kind of its part.
    Two parts of one kind under one name are an error, never a silent choice.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> registry = Registry()
    >>> registry.wall("plane", SimpleNamespace(summary="A plane.", Params=Params))
    >>> registry.names("wall")
    ['plane']
    >>> registry.get("wall", "plain")
    Traceback (most recent call last):
        ...
    clast.errors.PluginError: no wall is named 'plain'; did you mean 'plane'?
    """

    def __init__(self) -> None:
        self._parts: dict[tuple[str, str], Registered] = {}
        self._source = Source(plugin="python", origin="python")
        self.failures: list[Failure] = []
        self.blocked: list[Source] = []

    def generator(self, name: str, part: Generator) -> None:
        """Register a generator of particles."""
        self.add("generator", name, part)

    def bond_model(self, name: str, part: BondModel) -> None:
        """Register a bond model."""
        self.add("bond_model", name, part)

    def bond_kinematics(self, name: str, part: BondKinematics) -> None:
        """Register a bond kinematics."""
        self.add("bond_kinematics", name, part)

    def contact_law(self, name: str, part: ContactLaw) -> None:
        """Register a contact law."""
        self.add("contact_law", name, part)

    def rolling_resistance(self, name: str, part: RollingResistance) -> None:
        """Register a rolling resistance."""
        self.add("rolling_resistance", name, part)

    def integrator(self, name: str, part: Integrator) -> None:
        """Register a time integrator."""
        self.add("integrator", name, part)

    def damping(self, name: str, part: Damping) -> None:
        """Register a damping of motion."""
        self.add("damping", name, part)

    def neighbour_search(self, name: str, part: NeighbourSearch) -> None:
        """Register a neighbour search."""
        self.add("neighbour_search", name, part)

    def wall(self, name: str, part: Wall) -> None:
        """Register a wall shape."""
        self.add("wall", name, part)

    def motion(self, name: str, part: Motion) -> None:
        """Register a wall motion."""
        self.add("motion", name, part)

    def body_force(self, name: str, part: BodyForce) -> None:
        """Register a body force."""
        self.add("body_force", name, part)

    def stop(self, name: str, part: Stop) -> None:
        """Register a condition that ends a run."""
        self.add("stop", name, part)

    def writer(self, name: str, part: Writer) -> None:
        """Register a writer of results."""
        self.add("writer", name, part)

    def add(self, kind: str, name: str, part: Part) -> None:
        """Register a part of any kind.

        Raises
        ------
        PluginError
            The name is taken or badly spelt, or the part lacks ``summary`` or ``Params``.
        """
        if kind not in KINDS:
            raise PluginError(f"{kind!r} is not a kind of part; {suggestion(kind, KINDS)}")
        check_declaration(kind, name, part)
        taken = self._parts.get((kind, name))
        if taken is not None:
            raise NameTakenError(conflict(taken, self._source))
        self._parts[kind, name] = Registered(kind, name, part, self._source)

    def get(self, kind: str, name: str) -> Registered:
        """Look a part up.

        Raises
        ------
        PluginError
            There is none of that name; the message holds the nearest name and the plugins that failed.
        """
        found = self._parts.get((kind, name))
        if found is None:
            raise PluginError(self._missing(kind, name))
        return found

    def names(self, kind: str) -> list[str]:
        """Names of all parts of a kind, sorted."""
        return sorted(name for of_kind, name in self._parts if of_kind == kind)

    def __getattr__(self, name: str) -> Any:
        """Suggest the kind of part that a plugin may have meant."""
        raise AttributeError(f"{name!r} is not a kind of part; {suggestion(name, KINDS)}")

    def __iter__(self) -> Iterator[Registered]:
        """All parts, in the order of the kinds and then of the names."""
        return iter(sorted(self._parts.values(), key=lambda each: (KINDS.index(each.kind), each.name)))

    def copy(self) -> Registry:
        """Registry with the same parts; what is added to it leaves this one alone."""
        twin = Registry()
        twin._parts = dict(self._parts)
        twin.failures = list(self.failures)
        twin.blocked = list(self.blocked)
        return twin

    @contextmanager
    def registering(self, source: Source) -> Iterator[None]:
        """Parts added inside belong to ``source``; all of them are taken back when an error comes out."""
        before, parts = self._source, dict(self._parts)
        self._source = source
        try:
            yield
        except BaseException:
            self._parts = parts
            raise
        finally:
            self._source = before

    def _missing(self, kind: str, name: str) -> str:
        message = f"no {kind.replace('_', ' ')} is named {name!r}; {suggestion(name, self.names(kind))}"
        for failure in self.failures:
            message += f"\n  {failure}"
        if not self._parts and not self.failures:
            message += "; no plugin is installed, not even Clast's own: install it with 'pip install -e .'"
        return message

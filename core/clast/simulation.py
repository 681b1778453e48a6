"""A run on one page: build, advance to the next event, observe, until the end."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np

from clast.building import build_scene
from clast.config.scene import SceneConfig
from clast.ended import Ended
from clast.engine.assemble import Kernel, assemble
from clast.engine.crew import Crew
from clast.engine.kernels.layout import FIRST, INTACT, LEFT, STALE, START, STEP, X
from clast.engine.ledger import Ledger, read_ledger
from clast.engine.parts_used import parts_of
from clast.engine.runaways import runaways
from clast.engine.state import Floats, World
from clast.engine.tables import box_now, slot_view, take_out
from clast.engine.timeline import Span, Timeline
from clast.errors import RefusedError, RunError
from clast.maths.box import Box
from clast.scene.compression import Gauge
from clast.scene.neighbour_lists import NeighbourLists
from clast.scene.plan import blueprint
from clast.scene.rehearsal import try_laws
from clast.scene.scene import Scene
from clast.scene.start import check_start, outside_of
from clast.scene.world import build_world, relieve
from clast.soundness.suspects import foreign_laws
from clast.soundness.watch import Soundness
from clast.stability.step_keeper import StepKeeper
from clast.stability.time_step import Limits, choose_step, limits

BOND_COLUMNS = 8
LEAVING = 50
"""Steps after which particles that have left the domain are taken out, whenever neighbour lists are made."""


class Observer(Protocol):
    """Looks at a simulation now and then, and changes nothing."""

    def next_step(self, step: int) -> int | None:
        """Return the next step after ``step`` to look at, None for never again."""

    def observe(self, simulation: Simulation) -> None:
        """Look at the simulation, at the end of a step that was asked for."""


class Simulation:
    """One scene, running.

    Parameters
    ----------
    config : SceneConfig
    threads : int, optional
        How many may share the steps; as many as there are processors, if not given.
    compiling : callable, optional
        Called without arguments before kernels are compiled for the first time.

    Attributes
    ----------
    parts, scene : Parts, Scene
        Digests of the sources of all parts when this was made; what the generators made.
    limits : Limits
        Limits of the time step at the start.
    timeline : Timeline
        Which step is at what time.
    keeper : StepKeeper
        Takes smaller steps when contacts become stiffer.
    lists : NeighbourLists
        Makes neighbour lists anew when they go stale.
    crew : Crew
        The threads that share the steps; the results do not depend on their number.
    world : World
        State of everything; its neighbour lists are replaced when they go stale.
    gauge : Gauge
        Reads strain, stress and plate forces.
    last_step : int
        Step at which the scene ends, with the present time step.
    planned_steps : int
        The same with the first time step.
    removed : int
        How many particles have left the domain.
    ended : Ended or None
        Why the run ended early.
    soundness : Soundness
        Finds what the time step cannot follow.
    """

    def __init__(
        self, config: SceneConfig, threads: int | None = None, compiling: Callable[[], None] | None = None
    ) -> None:
        self.config = config
        self.parts = parts_of(config)
        self.gauge = Gauge(config)  # refuses what a packing cannot mend, before it takes its time
        self.scene: Scene = build_scene(config)
        check_start(self.scene)
        self.plan = blueprint(self.scene)
        self.limits: Limits = limits(self.scene, self.plan)
        self.timeline = Timeline([Span(0, 0.0, choose_step(self.scene, self.limits))])
        self.keeper = StepKeeper(self.scene, self.plan)
        self.keeper.above = self.dt / self.limits.stable
        self.last_step = self.planned_steps = self.gauge.last_step(self.dt)
        self.kernel: Kernel = assemble(self.plan, try_laws(self.scene, self.plan))
        if compiling is not None and self.kernel.fresh:
            compiling()
        self.soundness = Soundness(self.scene, self.plan, self.dt / self.limits.spectral, self.kernel.gaps)
        self.lists = NeighbourLists(self.scene, self.plan, self.kernel.near_walls)
        self.world: World = build_world(self.scene, self.plan, self.dt, 2.0 * self.lists.skin.most)
        self.crew = Crew(threads, self.world)
        self.removed = 0
        self.ended: Ended | None = None
        self.world = self.lists.made_anew(self.world, self.dt)
        if self.plan.contacts is not None and self.plan.contacts.rests:
            relieve(self.scene, self.world.pairs)
        if self.plan.ledger:
            self.world.ledger[-1, START] = self.ledger().stored
        too_coarse = self.soundness.complaint(self.world, self.dt)
        if too_coarse is not None:
            raise config.problem(("time", "step"), f"{self.dt:.4g} s: {too_coarse}; take a smaller step")

    @property
    def step(self) -> int:
        """Number of finished steps."""
        return int(self.world.clock[STEP])

    @property
    def time(self) -> float:
        """Simulated time in s."""
        return self.timeline.time_of(self.step)

    @property
    def dt(self) -> float:
        """Present time step in s."""
        return self.timeline.dt

    @property
    def box(self) -> Box:
        """The box that repeats itself, or holds the particles, as it is now."""
        return box_now(self.scene.box, self.world.particles)

    @property
    def bonds_broken(self) -> int:
        """Number of bonds that broke."""
        return int(self.world.cracks.filled.sum())

    @property
    def bonds_intact(self) -> int:
        """Number of bonds that hold."""
        bonds = self.world.bonds
        return int(np.count_nonzero((slot_view(bonds, INTACT) == 1.0) & ((bonds.sides & FIRST) != 0)))

    def run(self, observers: Sequence[Observer] = ()) -> None:
        """Advance to the end, stopping where observers want to look.

        Raises
        ------
        RunError
            If the run blows up; see :meth:`advance_to`.
        """
        while self.step < self.last_step:
            due = [observer.next_step(self.step) for observer in observers]
            stops = [self.last_step, self.keeper.next_look(self.step), *due]
            self.advance_to(min(step for step in stops if step is not None))
            for observer, step in zip(observers, due, strict=True):
                if step == self.step or (self.ended and observer.next_step(self.step - 1) == self.step):
                    observer.observe(self)

    def end_here(self, ended: Ended) -> None:
        """Make the present step the last."""
        self.ended, self.last_step = ended, self.step

    def advance_to(self, step: int) -> None:
        """Advance to a step, looking now and then whether the time step is still safe.

        Raises
        ------
        RunError
            If the time step cannot follow what happens, see :mod:`clast.soundness`, or a fixed step becomes too large.
        """
        open_ = self.config.boundaries.domain is not None and not self.scene.box.periodic.all()
        while True:
            look = self.keeper.next_look(self.step)
            leave = (self.step // LEAVING + 1) * LEAVING if open_ else None
            self._advance_to(min(each for each in (step, look, leave) if each is not None))
            if self.step == leave:
                self._remove_leavers()
            if self.step == look:
                self.change_step(self.keeper.look(self.world, self.dt, self.timeline.spans[0].dt))
            if self.step >= step:
                return

    def _advance_to(self, step: int) -> None:
        """Advance to a step, bringing neighbour lists up to date whenever they go stale."""
        while self.crew.advance(self.kernel.advance, self.world, step, self.step) == STALE:
            away = runaways(self.world.particles, self.world.chunks, self.world.stale)
            self._stop_for(self.soundness.complaint_of(away, self.world, self.dt))
            self.world, fresh = self.lists.brought_up_to_date(self.world, away, self.dt)
            look = self.soundness.complaint if fresh is self.world else self.soundness.contact_complaint
            self._stop_for(look(fresh, self.dt))

    def change_step(self, dt: float) -> None:
        """Take steps of another size in s from now on.

        Velocities that lag behind positions are brought to where the new step expects them.
        """
        if dt == self.dt:
            return
        lag = self.plan.integrator.velocity_lag
        if lag != 0.0:
            self.world.particles.twist[:] += lag * (dt - self.dt) * self.world.particles.acceleration
        self.timeline.change(self.step, dt)
        self.follow_timeline()

    def follow_timeline(self) -> None:
        """Tell the step loop what the timeline says, and count the steps to the end anew."""
        step, time, dt = self.timeline.spans[-1]
        before = self.timeline.spans[max(len(self.timeline.spans) - 2, 0)].dt
        late = self.plan.integrator.after_forces * (before - dt)
        numbers = self.world.numbers._replace(
            dt=dt, first_step=step, first_time=time, late=late, early=before - dt - late
        )
        self.world = self.world._replace(numbers=numbers)
        self.last_step = self.gauge.last_step(dt, step, time)

    def stable_step(self) -> float:
        """Return the largest stable step of the scene as it stands, in s; infinite where nothing holds or touches."""
        return self.keeper.limit(self.keeper.present(self.world))

    def bond_loads(self) -> Floats:
        """Return what every bond carries now, (m, 8); columns as in ``kernels.observe``."""
        output = np.zeros((len(self.scene.ends), BOND_COLUMNS))
        self.kernel.observe(self.world, output)
        return output

    def ledger(self) -> Ledger:
        """Return where all energy is now; losses are only known with ``output.ledger``."""
        found = np.zeros(10)
        self.kernel.energies(self.world, self.step > 0, found)
        return read_ledger(self.world, found)

    def note_start(self) -> None:
        """Note the energy at the start, with which :attr:`soundness` begins."""
        self.soundness.energy.note(self.ledger())

    def sound(self) -> bool:
        """Tell whether the numbers can be trusted now."""
        found = self.soundness.complaint(self.world, self.dt)
        return found is None and self.soundness.energy.complaint(self.ledger(), self.world) is None

    def trusted_ledger(self) -> Ledger:
        """Return where all energy is now, and let :attr:`soundness` compare it with what was there before.

        Raises
        ------
        RunError
            If the numbers cannot be trusted.
        """
        self._stop_for(self.soundness.complaint(self.world, self.dt))
        ledger = self.ledger()
        self._stop_for(self.soundness.energy.complaint(ledger, self.world))
        self.soundness.energy.note(ledger)
        return ledger

    def _stop_for(self, complaint: str | None) -> None:
        if complaint is None:
            return
        advice = (
            f"{complaint}. The step is {self.dt:.4g} s, the limit at the start {self.limits.stable:.4g} s: take a "
            "smaller time.step, let bodies meet more slowly, or look for overlapping or very stiff parts with 'clast "
            f"check --build'{foreign_laws(self.config)}"
        )
        if self.step == 0:
            raise RefusedError(f"the numbers of this scene cannot be trusted from its start on: {advice}")
        where = f"stopped at step {self.step} (t = {self.time:.4g} s)"
        raise RunError(f"{where}, where the numbers cannot be trusted any more: {advice}")

    def _remove_leavers(self) -> None:
        particles, bonds = self.world.particles, self.world.bonds
        leaving = outside_of(self.box, particles.pose[:, X : X + 3]) & (particles.present != 0)
        if not leaving.any():
            return
        before = self.ledger().stored if self.plan.ledger else 0.0
        self.removed += int(leaving.sum())
        take_out(particles, bonds, leaving)
        self.world = self.lists.made_anew(self.world, self.dt)
        if self.plan.ledger:
            self.world.ledger[-1, LEFT] += before - self.ledger().stored

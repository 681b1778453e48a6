"""Session: one run of a scene into a folder, from start or checkpoint to results, recording and pictures."""

from __future__ import annotations

import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from clast.config.scene import SceneConfig
from clast.config.yaml_loader import dump_yaml
from clast.ended import Ended
from clast.errors import PluginError, RefusedError, RunError
from clast.parts.writer import Written
from clast.results import checkpoint, curves, store, summary
from clast.results.frames import Frames
from clast.results.reading import CONFIG_FILE
from clast.results.run import open_run
from clast.results.run_folder import run_folder
from clast.results.samples import Samples
from clast.results.watch import GO_ON, RunInterruptedError, StopError, Watch, stoppable
from clast.results.whole_file import whole_file
from clast.simulation import Simulation
from clast.writing import launch


@dataclass(frozen=True)
class Outcome:
    """What a run left behind: its summary, and every file or the reason why there is none."""

    folder: Path
    summary: dict[str, Any]
    written: dict[str, Written] = field(default_factory=dict)


class Listener:
    """Hears how a session goes; this one says nothing."""

    def building(self) -> None:
        """Hear that generators start."""

    def compiling(self) -> None:
        """Hear that kernels are about to be compiled for the first time."""

    def started(self, simulation: Simulation) -> None:
        """Hear that the step loop starts."""

    def progress(self, simulation: Simulation, rate: float) -> None:
        """Hear that steps were taken, at a rate in steps per second."""

    def writing(self, name: str) -> None:
        """Hear that a writer starts."""


def run_scene(
    config: SceneConfig,
    folder: Path | str,
    resume: bool = False,
    listener: Listener | None = None,
    threads: int | None = None,
) -> Outcome:
    """Run a scene into a folder.

    Parameters
    ----------
    config : SceneConfig
    folder : Path
        Made when missing; must be new, empty, or hold a run that never reached its first checkpoint, unless ``resume``.
    resume : bool
        Go on from the folder's last good checkpoint.
    listener : Listener, optional
    threads : int, optional
        How many may share the steps; as many as there are processors, if not given. Results do not depend on it.

    Returns
    -------
    Outcome

    Raises
    ------
    RunInterruptedError
        After Ctrl-C or SIGTERM, or when ``time.wall_time`` is up, with a checkpoint written.
    RunError
        If the folder, the checkpoint or the run fails.
    """
    listener, folder, called = listener or Listener(), Path(folder), time.monotonic()
    session, goes_on = None, False
    try:
        with stoppable(), run_folder(folder, resume) as goes_on:
            if goes_on:
                checkpoint.refuse_other_scene(folder, config)
            listener.building()
            simulation = Simulation(config, threads, listener.compiling)
            session = _Session(simulation, folder, goes_on, listener)
            session.advance(called)
            return session.finish()
    except StopError as stop:  # before or after the step loop, which handles signals itself
        untouched = f"the checkpoint is as it was: {GO_ON}" if goes_on else "nothing was written yet"
        advice = GO_ON if session is not None else untouched
        raise RunInterruptedError(stop.number, advice) from None


def refuse_passed_end(simulation: Simulation) -> None:
    """Refuse to go on with a run that is beyond its end, as after the end was changed.

    Raises
    ------
    RunError
        If it is; with what ends it where it is.
    """
    if simulation.step > simulation.last_step:
        place = simulation.config.document.where(("time", "end"))
        raise RefusedError(
            f"{place}: time.end: the run is at step {simulation.step} already, and would end at step "
            f"{simulation.last_step}; to end it where it is, add --set 'time.end={{steps: {simulation.step}}}'"
        )


class _Session:
    """The step loop with its observers, and what follows it."""

    def __init__(self, simulation: Simulation, folder: Path, resume: bool, listener: Listener) -> None:
        self.simulation, self.folder, self.listener = simulation, folder, listener
        simulation.note_start()
        notes = checkpoint.load(folder, simulation) if resume else {}
        self.seconds_before = float(notes.get("seconds", 0.0))
        self.begun: float | None = None
        if not resume:
            store.begin(folder, simulation)
        self.store = store.Store(folder)
        self.samples = Samples(simulation, self.store)
        self.frames = Frames(simulation, self.store)
        if resume:
            self.store.cut(notes["lengths"])
            self.samples.every, self.frames.every = notes.get("every", (self.samples.every, self.frames.every))
            self.samples.previous_step = int(notes["previous_sample"])
            self.samples.stops.recall(self.store.curves())
            if notes.get("ended"):
                simulation.end_here(Ended(*notes["ended"]))
            refuse_passed_end(simulation)
        with whole_file(folder / CONFIG_FILE) as draft:
            draft.write_text(dump_yaml(simulation.config.resolved()), encoding="utf-8")

    @property
    def seconds(self) -> float:
        """Seconds spent in the step loop and its observers, by this session and those it goes on from."""
        return self.seconds_before + (time.perf_counter() - self.begun if self.begun is not None else 0.0)

    def advance(self, called: float) -> None:
        """Run to the end, or until the wall-clock time since the call is up."""
        simulation, listener = self.simulation, self.listener
        first = simulation.step
        interval, most = simulation.config.output.checkpoint, simulation.config.time.wall_time
        watch = Watch(listener.progress, self._save_what_is_sound, interval, most, called)
        with watch:
            try:
                simulation.advance_to(first)  # compiles
                if first == 0:
                    self._look()
                    self.save()
                listener.started(simulation)
                self.begun = time.perf_counter()
                simulation.run([self.samples, self.frames, watch])
                if self.samples.previous_step < simulation.step:  # resumed to end where it was
                    self._look()
                self.seconds_before, self.begun = self.seconds, None
                self.save()
            except BaseException as error:
                self._leave(asked=isinstance(error, RunInterruptedError))
                if isinstance(error, PluginError) and self.begun is not None:  # a law that fails amid a run
                    raise RunError(str(error)) from error
                raise
            self.store.close(complete=True)

    def _leave(self, asked: bool) -> None:
        """Close the results of a run that ends early, behind a checkpoint where it was asked to end."""
        try:
            if asked:
                self._save_what_is_sound()
        finally:
            with suppress(RunError):  # the one that ended the run is told
                self.store.keep_cracks(self.simulation)
                self.store.close(complete=False)

    def _look(self) -> None:
        self.samples.observe(self.simulation)
        if self.frames.every:
            self.frames.observe(self.simulation)

    def _save_what_is_sound(self) -> None:
        """Keep the last good checkpoint where the numbers cannot be trusted: the next sample will stop the run."""
        if self.simulation.sound():
            self.save()

    def save(self) -> None:
        """Write results and checkpoint to disk, in this order, so that the checkpoint never knows more."""
        self.store.keep_cracks(self.simulation)
        self.store.flush()
        notes = {
            "lengths": self.store.lengths(),
            "previous_sample": self.samples.previous_step,
            "every": [self.samples.every, self.frames.every],
            "seconds": self.seconds,
            "ended": self.simulation.ended,
        }
        checkpoint.save(self.folder, self.simulation, notes)

    def finish(self) -> Outcome:
        """Write curves and summary, and let every writer of the scene write."""
        written: dict[str, Written] = {}
        with open_run(self.folder) as run:
            path = curves.write(self.folder / curves.FILE, {k: np.asarray(v) for k, v in run.curves.items()})
            written["curves"] = Written(path)
            for what, tracks in run.tracks.items():
                columns = curves.flattened(tracks, run.tracked[what], what.rstrip("s"))
                file = self.folder / f"tracks_{what}.csv"
                written[f"tracks of {what}"] = Written(curves.write(file, {"time_s": run.curves["time_s"], **columns}))
            told = summary.summarise(self.simulation, run.curves, self.seconds)
            told |= summary.mass_scaling_results(self.simulation, run)
            written["summary"] = Written(summary.write(self.folder, told))
        writers = [chosen.name for chosen in self.simulation.config.output.writers]
        written |= launch.write(self.folder, writers, self.listener.writing)
        return Outcome(self.folder, told, {"results": Written(self.store.path), **written})

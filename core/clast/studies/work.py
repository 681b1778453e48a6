"""Work: one run of a study, as a worker does it, wherever it is: a scene file in, a run folder out."""

from __future__ import annotations

import signal
import time
from pathlib import Path
from typing import NamedTuple

from clast.config.scene import SceneConfig, load
from clast.errors import ClastError, DamagedError
from clast.results.watch import RunInterruptedError, StopError
from clast.session import Listener, run_scene
from clast.simulation import Simulation
from clast.studies.layout import STOP, run_of, scene_of

DONE, FAILED, STOPPED = "done", "failed", "stopped"
GO_ON = "the study was stopped; run it again to go on from here"


class Result(NamedTuple):
    """How a run ended: its name, one of done, failed and stopped, why, and how many seconds it took here."""

    name: str
    state: str
    reason: str
    seconds: float


class _Ear(Listener):
    """Stops a run behind a checkpoint as soon as the study's folder asks for it."""

    def __init__(self, folder: Path) -> None:
        self.stop = folder / STOP

    def progress(self, simulation: Simulation, rate: float) -> None:
        """Look whether the study was stopped."""
        if self.stop.exists():
            raise RunInterruptedError(signal.SIGTERM)


def is_done(folder: Path, name: str) -> bool:
    """Tell whether a run came to its end."""
    return (run_of(folder, name) / "summary.json").exists()


def perform(folder: str, name: str) -> Result:
    """Run one scene of a study, from its start or its last checkpoint; whatever goes wrong is told, not raised.

    Parameters
    ----------
    folder : str
        Of the study.
    name : str
        Of the run.
    """
    place, begun = run_of(Path(folder), name), time.monotonic()
    try:
        if (Path(folder) / STOP).exists():
            raise RunInterruptedError(signal.SIGTERM)
        if not is_done(Path(folder), name):
            _run(load(scene_of(Path(folder), name)), place, _Ear(Path(folder)))
        state, reason = DONE, ""
    except (KeyboardInterrupt, StopError):
        state, reason = STOPPED, GO_ON
    except RunInterruptedError:
        state, reason = STOPPED, GO_ON
    except ClastError as error:
        state, reason = FAILED, str(error)
    except Exception as error:  # one run that fails in an unforeseen way costs that run, not the study
        state, reason = FAILED, f"{type(error).__name__}: {error}"
    return Result(name, state, " ".join(reason.split()), time.monotonic() - begun)


def _run(scene: SceneConfig, place: Path, ear: Listener) -> None:
    """Run a scene, from its last checkpoint where there is one; a run whose files a kill has damaged starts anew."""
    try:
        run_scene(scene, place, (place / "results.h5").exists(), ear, threads=1)
    except DamagedError:
        place.replace(place.with_name(f"{place.name}.damaged-{time.time_ns()}"))
        run_scene(scene, place, False, ear, threads=1)

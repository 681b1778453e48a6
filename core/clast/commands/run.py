"""``clast run``: progress while it runs, then a short table and the paths of what it wrote."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from threading import Timer

from clast.commands.live_bar import LiveBar
from clast.config.scene import SceneConfig, load
from clast.engine.assemble import cache_folder, wanted_cache
from clast.errors import RunError
from clast.forecast import duration, run_seconds, time_concerns
from clast.forecast_results import size_concerns
from clast.results.in_words import summary_rows
from clast.scene.concerns import concerns
from clast.session import Listener, Outcome, run_scene
from clast.simulation import Simulation
from clast.soundness.swift_walls import swift_walls

PLAIN_EVERY = 5.0


def run(
    file: Path,
    output: Path | None = None,
    overrides: Iterable[str] = (),
    threads: int | None = None,
    resume: bool = False,
    plugins: Sequence[str | Path] = (),
) -> None:
    """Run a scene file and print what came out.

    Raises
    ------
    ClastError
        With a message for the user.
    """
    config = load(file, overrides, plugins)
    folder = output if output is not None else default_folder(config, resume)
    with console_listener(config) as listener:
        outcome = run_scene(config, folder, resume, listener, threads)
    print_outcome(outcome)
    failed = [name for name, written in outcome.written.items() if written.failed]
    if failed:
        raise RunError(
            f"{folder}: the results are complete, but what {' and '.join(failed)} should show was not written; the "
            f"reason stands above. Mend it and run `clast write {folder}`"
        )


def default_folder(config: SceneConfig, resume: bool) -> Path:
    """Return ``runs/NAME``, numbered when taken; the newest one to resume."""
    base = Path("runs")
    taken = [base / config.name]
    while taken[-1].exists():
        taken.append(base / f"{config.name}-{len(taken) + 1}")
    return taken[-2] if resume and len(taken) > 1 else taken[-1]


LONG_COMPILING = 120.0
SLOW_COMPILER = (
    f"still compiling after {LONG_COMPILING:.0f} s: other work on this machine makes it longer, and so does a law of "
    "your own with dictionaries, sorted() or lambdas, for very long; write it with numbers, tuples and loops"
)


class Lines(Listener):
    """Progress as plain lines, for logs and pipes."""

    def __init__(self) -> None:
        self.last = 0.0
        self.slow_compiler = Timer(LONG_COMPILING, self.say, [SLOW_COMPILER])
        self.slow_compiler.daemon = True

    def __enter__(self) -> Lines:
        """Start."""
        return self

    def __exit__(self, *reason: object) -> None:
        """End."""
        self.slow_compiler.cancel()

    def say(self, text: str) -> None:
        """Print one line at once."""
        print(text, flush=True)

    def building(self) -> None:
        """Tell that generators start."""
        self.say("building the scene")

    def compiling(self) -> None:
        """Tell that the user must wait once."""
        self.say(
            "compiling kernels for this kind of scene, once (about half a minute; Ctrl-C is heard when it is done)"
        )
        wanted, found = wanted_cache(), cache_folder()
        if found != wanted:
            self.say(f"{wanted} cannot be written, so they are kept in {found}; CLAST_CACHE names another folder")
        self.slow_compiler.start()

    def started(self, simulation: Simulation) -> None:
        """Tell the size of the run."""
        scene = simulation.scene
        left = simulation.last_step - simulation.step
        size = f"{counted(len(scene.radius), 'particle')}, {counted(len(scene.ends), 'bond')}"
        self.say(f"{size}, {left:,} steps of {simulation.dt:.3g} s")
        for line in (simulation.crew.told, simulation.keeper.warning, *concerns(scene)):
            if line:
                self.say(line)
        seconds = run_seconds(simulation.config, len(scene.radius), len(scene.ends), left)
        slow = time_concerns(simulation.config, left, seconds)
        smallest = float(simulation.scene.radius.min())
        swift = swift_walls(simulation.config, smallest, simulation.dt, simulation.last_step)
        for line in (*swift, *slow, *size_concerns(simulation.config, len(scene.radius), len(scene.ends))):
            self.say(line)
        self.last = time.monotonic()

    def progress(self, simulation: Simulation, rate: float) -> None:
        """Tell where the run is, now and then."""
        self.slow_compiler.cancel()
        if time.monotonic() - self.last >= PLAIN_EVERY:
            self.last = time.monotonic()
            self.say(" | ".join(status(simulation, rate)))

    def writing(self, name: str) -> None:
        """Tell which writer works."""
        self.say(f"writing {name}")


class Bar(LiveBar, Lines):
    """Progress as a live bar, for terminals."""

    def progress(self, simulation: Simulation, rate: float) -> None:
        """Move the bar."""
        self.slow_compiler.cancel()
        self.move("  ".join(status(simulation, rate)), simulation.step, simulation.last_step)

    def writing(self, name: str) -> None:
        """Tell which writer works."""
        self.move(f"writing {name}", 1, 1)


def console_listener(config: SceneConfig) -> Lines:
    """Return a bar for terminals, plain lines for everything else."""
    return Bar() if sys.stdout.isatty() else Lines()


def counted(count: int, noun: str) -> str:
    """Return a count with its noun.

    >>> counted(1, "particle"), counted(428, "particle")
    ('1 particle', '428 particles')
    """
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def status(simulation: Simulation, rate: float) -> list[str]:
    """Return what a user wants to see of a running simulation."""
    gauge, walls = simulation.gauge, simulation.world.walls
    parts = [f"t = {simulation.time:.3g} s"]
    if gauge.axis is not None:
        upper, _ = gauge.forces(walls.force)
        parts = [f"strain {gauge.strain(walls):6.2%}", f"stress {upper / gauge.area / 1e6:6.3f} MPa"]
    if len(simulation.scene.ends):
        parts.append(f"{simulation.bonds_broken} bonds broken")
    left = (simulation.last_step - simulation.step) / max(rate, 1e-9)
    return [*parts, f"{rate:,.0f} steps/s", f"{duration(left)} left"]


def print_outcome(outcome: Outcome) -> None:
    """Print the summary table and the path of every file, or why there is none."""
    from rich.console import Console
    from rich.table import Table

    console = Console()
    table = Table(show_header=False, box=None)
    for row in summary_rows(outcome.summary):
        table.add_row(*row)
    console.print(table)
    for name, written in outcome.written.items():
        text = str(written.path) if written.path is not None else f"no {name}: {written.skipped}"
        console.print(f"  {text}", highlight=False, soft_wrap=True)

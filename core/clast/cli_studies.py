"""Command line: the commands over many runs."""

from __future__ import annotations

from pathlib import Path

import click

change_option = click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Change one value.")
scene_option = click.option(
    "--set",
    "overrides",
    multiple=True,
    metavar="KEY=VALUE",
    help="Change one value of the scene all runs start from.",
)
AGAIN = "the same command goes on from here"
_workers = click.option("--workers", type=click.IntRange(min=1), show_default="one a processor", help="Runs at a time.")


@click.command()
@click.argument("file", metavar="STUDY", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Folder of the study; runs/NAME, if not given.")
@scene_option
@_workers
@click.option("--executor", type=click.Choice(["local", "dask"]), default="local", show_default=True)
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler, as tcp://head:8786; else one on this machine.")
@click.option("--prepare", "way", flag_value="prepare", help="Only write the scene of every run, for a job array.")
@click.option("--collect", "way", flag_value="collect", help="Only gather the runs that are there.")
@click.pass_context
def sweep(
    ctx: click.Context,
    /,
    file: Path,
    output: Path | None,
    overrides: tuple[str, ...],
    workers: int | None,
    executor: str,
    scheduler: str | None,
    way: str | None,
) -> None:
    """Run the study in STUDY: one scene with values varied, in parallel; what is done is not repeated."""
    from clast.commands import sweep as sweep_command
    from clast.results.watch import stoppable
    from clast.studies import executors
    from clast.studies.config import load_study
    from clast.studies.prepare import prepare

    if scheduler is not None and executor != "dask":
        raise click.UsageError("--scheduler belongs to --executor dask")
    study = load_study(file, overrides)
    folder = output or Path("runs") / study.study
    if way == "prepare":
        sweep_command.print_prepared(folder, prepare(study, folder))
        return
    if way == "collect":
        sweep_command.find_study(folder)
    maker = executors.local(workers) if executor == "local" else executors.dask(scheduler, workers)
    with stoppable(AGAIN):
        outcome = sweep_command.sweep(study, folder, None if way == "collect" else maker)
    sweep_command.print_outcome(outcome)
    if sweep_command.failures(outcome):
        ctx.exit(1)


@click.command()
@click.argument("name", metavar="NAME")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    default="reproduction.md",
    show_default=True,
    help="Page to write.",
)
@click.option("--runs", type=click.Path(path_type=Path), help="Folder of the studies; runs/NAME, if not given.")
@click.option("--only", multiple=True, metavar="STUDY", help="Run this study; gather what there is of the others.")
@_workers
@click.option("--collect", is_flag=True, help="Only gather the runs that are there.")
def reproduce(
    name: str, output: Path, runs: Path | None, only: tuple[str, ...], workers: int | None, collect: bool
) -> None:
    """Run all studies of the publication NAME (paper), or of a folder, and write a page of what holds."""
    from clast.commands import reproduce as reproduce_command
    from clast.reproduce.manuscript import read_manuscript
    from clast.results.watch import stoppable
    from clast.studies import executors

    manuscript = read_manuscript(name)
    maker = None if collect else executors.local(workers)
    with stoppable(AGAIN):
        folder = runs or Path("runs") / manuscript.folder.resolve().name
        reproduce_command.reproduce(manuscript, folder, output, maker, only)
    click.echo(f"wrote {output}")


@click.command()
@click.argument("file", metavar="TASK", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Folder of the runs; runs/NAME, if not given.")
@scene_option
@_workers
def calibrate(file: Path, output: Path | None, overrides: tuple[str, ...], workers: int | None) -> None:
    """Fit the parameters that TASK names to what was measured; what is done is not repeated."""
    from clast.calibration.config import load_calibration
    from clast.commands import calibrate as calibrate_command
    from clast.results.watch import stoppable
    from clast.studies import executors

    config = load_calibration(file, overrides)
    with stoppable(AGAIN):
        calibrate_command.calibrate(config, output or Path("runs") / config.calibration, executors.local(workers))


STUDY_COMMANDS = (sweep, calibrate, reproduce)

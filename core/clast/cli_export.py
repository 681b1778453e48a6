"""Command line: the command that exports runs."""

from __future__ import annotations

from pathlib import Path

import click

from clast.cli_plugins import plugin_option


@click.command()
@click.argument("folder", metavar="RUN", type=click.Path(path_type=Path))
@click.option("--to", "to", metavar="FORMAT", required=True, help="vtkhdf, rrd, csv, lammps, or that of a plugin.")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="PATH",
    help="The file, or the folder, which must be new or empty; in RUN/export, if not given.",
)
@click.option("--frames", default="all", show_default=True, help="'last', numbers as 0,5,-1, or a range as 0:100:10.")
@plugin_option
def export(folder: Path, to: str, output: Path | None, frames: str, files: tuple[Path, ...]) -> None:
    """Write RUN, the folder of a finished or stopped run, in another format with everything in it."""
    from clast.exporting import export_run
    from clast.results.watch import stoppable

    with stoppable():
        click.echo(export_run(folder, to, output, frames, files))

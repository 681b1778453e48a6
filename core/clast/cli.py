"""Command line: thin commands over what Python users call.

Everything heavy is imported inside the command that needs it, so that ``clast --help`` stays quick.
"""

from __future__ import annotations

import errno
import json
from pathlib import Path
from typing import Any

import click

from clast.cli_export import export
from clast.cli_plugins import plugin_option, plugins
from clast.cli_studies import STUDY_COMMANDS, change_option
from clast.errors import ClastError


class _Commands(click.Group):
    """Commands whose errors become one message and an exit code, unless they are mistakes of Clast's own."""

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; print what the user can help without a traceback."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt as stop:
            click.echo(str(stop) or "stopped by SIGINT", err=True)
            ctx.exit(getattr(stop, "exit_code", 130))
        except Exception as error:
            told = _told(error)
            if told is None:
                raise
            message, exit_code = told
            click.echo(message, err=True)
            ctx.exit(exit_code)


def _told(error: Exception) -> tuple[str, int] | None:
    """Message and exit code of an error that the user can help; None for a mistake of Clast's own."""
    if isinstance(error, ClastError):
        return str(error), error.exit_code
    if isinstance(error, click.ClickException | click.exceptions.Exit | click.Abort):
        return None  # click tells these itself
    from clast.plugins.blame import plugin_line

    place = plugin_line(error)
    if place is not None:
        return f"{place}: raised {type(error).__name__}: {error}", 2
    if isinstance(error, MemoryError):
        return "out of memory; 'clast check' tells how much a scene needs", 1
    if isinstance(error, OSError) and error.errno != errno.EPIPE:
        return f"{error.filename or 'reading or writing failed'}: {error.strerror or error}", 1
    return None


_file = click.argument("file", type=click.Path(path_type=Path))


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="clast")
def main() -> None:
    """Discrete elements for granules that break."""


@main.command()
@_file
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Folder of the run.")
@change_option
@click.option(
    "--threads",
    type=click.IntRange(min=1),
    show_default="one a processor",
    help="Threads that may share the steps of a large scene; results do not depend on them.",
)
@click.option("--resume", is_flag=True, help="Go on where the run in the folder stopped.")
@plugin_option
def run(
    file: Path,
    output: Path | None,
    overrides: tuple[str, ...],
    threads: int | None,
    resume: bool,
    files: tuple[Path, ...],
) -> None:
    """Run the scene in FILE."""
    from clast.commands import run as run_command

    run_command.run(file, output=output, overrides=overrides, threads=threads, resume=resume, plugins=files)


@main.command()
@_file
@change_option
@click.option("--build", is_flag=True, help="Pack the particles and tell the exact numbers.")
@plugin_option
def check(file: Path, overrides: tuple[str, ...], build: bool, files: tuple[Path, ...]) -> None:
    """Validate FILE and tell what running it will cost."""
    from clast.config.scene import load

    scene = load(file, overrides, files)
    if build:
        from clast.commands import build_report

        click.echo(build_report.report(scene))
        return
    from clast.forecast import forecast

    click.echo(f"{file}: valid\n{forecast(scene).text()}")


@main.command()
@plugin_option
def schema(files: tuple[Path, ...]) -> None:
    """Print the JSON Schema of scene files, for editors."""
    from clast.config.json_schema import scene_schema
    from clast.plugins.discovery import discover

    click.echo(json.dumps(scene_schema(discover(files)), indent=2, ensure_ascii=False))


@main.command()
@click.argument("folder", metavar="RUN", type=click.Path(path_type=Path))
@click.argument("names", metavar="[WRITER]...", nargs=-1)
@change_option
def write(folder: Path, names: tuple[str, ...], overrides: tuple[str, ...]) -> None:
    """Make the files of RUN, the folder of a run, anew; those of all its writers, or of the ones named."""
    from clast.commands import write as write_command

    write_command.write(folder, names, overrides)


@main.command()
@click.argument("folder", metavar="RUN", type=click.Path(path_type=Path))
def view(folder: Path) -> None:
    """Open the recording of RUN, the folder of a run."""
    from clast.commands import view as view_command
    from clast.results.watch import stoppable

    with stoppable():
        view_command.view(folder)


@main.command()
@click.argument("folders", metavar="RUN...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="The HTML file; by default report.html in the folder of RUN, for several in the working folder.",
)
def report(folders: tuple[Path, ...], output: Path | None) -> None:
    """Write one HTML page about RUN, the folder of a run, a sweep or a calibration; several runs stand side by side."""
    from clast.commands import report as report_command
    from clast.results.watch import stoppable

    with stoppable():
        report_command.report(folders, output)


@main.command()
@click.argument("cases", metavar="[CASE]...", nargs=-1)
@click.option("--family", "families", multiple=True, metavar="NAME", help="All cases of a family.")
@click.option("--list", "listed", is_flag=True, help="List all cases.")
@click.option("--contact-law", metavar="NAME", help="Put this contact law in the place of Clast's own.")
@click.option("--bond-model", metavar="NAME", help="Put this bond model there.")
@click.option("--integrator", metavar="NAME", help="Put this integrator there.")
@plugin_option
@change_option
@click.option("--json", "as_json", is_flag=True, help="Print JSON instead of a table.")
@click.option(
    "--docs",
    "page",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write a page with tables and pictures, too.",
)
@click.pass_context
def verify(
    ctx: click.Context,
    /,
    cases: tuple[str, ...],
    families: tuple[str, ...],
    listed: bool,
    files: tuple[Path, ...],
    overrides: tuple[str, ...],
    as_json: bool,
    page: Path | None,
    **parts: str | None,
) -> None:
    """Run scenes with known answers, all or each CASE, and compare; exit code 1 where one fails."""
    from clast.commands import verify as verify_command
    from clast.results.watch import stoppable
    from clast.verification.replacement import Replacement

    if listed:
        verify_command.print_list()
        return
    chosen_parts = {kind: name for kind, name in parts.items() if name is not None}
    replacement = Replacement(chosen_parts, files, overrides)
    with stoppable():
        passed = verify_command.verify(cases, families, replacement, as_json, page)
    if not passed:
        ctx.exit(1)


@main.command()
@click.option("-o", "--output", type=click.Path(path_type=Path), default="docs/benchmarks.md", show_default=True)
@click.option("--only", multiple=True, metavar="NAME[,NAME]", help="Measure these sections; keep the others' results.")
@click.option("--quick", "effort", flag_value="quick", help="Rough numbers in a few minutes.")
@click.option("--full", "effort", flag_value="full", help="All sizes and seeds: an hour or more.")
@click.option("--peer", type=click.Choice(["none", "lammps"]), default="none", help="Measure beside another program.")
@click.option("--render", is_flag=True, help="Write the page from stored results, without measuring.")
@click.option("--list", "listed", is_flag=True, help="List all sections.")
@plugin_option
@click.pass_context
def bench(
    ctx: click.Context,
    /,
    output: Path,
    only: tuple[str, ...],
    effort: str | None,
    peer: str,
    render: bool,
    listed: bool,
    files: tuple[Path, ...],
) -> None:
    """Measure speed, and error against run time; write one page with plots."""
    from clast.bench.section import Effort
    from clast.bench.suite import chosen
    from clast.commands import bench as bench_command
    from clast.results.watch import stoppable

    sections = chosen([name.strip() for names in only for name in names.split(",")])
    if listed:
        for section in sections:
            click.echo(f"{section.name:12} {section.title}")
    elif render:
        bench_command.render(output)
    else:
        asked = ["clast bench", *([f"--{effort}"] if effort else []), *([f"--peer {peer}"] if peer != "none" else [])]
        asked += [f"--only {','.join(only)}"] if only else []
        command = " ".join([*asked, *(f"--plugin {file}" for file in files)])
        with stoppable():
            complete = bench_command.bench(sections, Effort(effort or "usual"), peer, files, command, output)
        if not complete:
            ctx.exit(1)


for _command in (export, *STUDY_COMMANDS, plugins):
    main.add_command(_command)

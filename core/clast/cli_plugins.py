"""Command line: the commands about plugins and parts."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from clast.plugins.registry import KINDS

plugin_option = click.option(
    "--plugin", "files", multiple=True, type=click.Path(path_type=Path), help="A Python file with a plugin."
)
_as_json = click.option("--json", "as_json", is_flag=True, help="Print JSON.")


def _print_json(data: Any) -> None:
    click.echo(json.dumps(data, indent=2, ensure_ascii=False))


@click.group(invoke_without_command=True)
@plugin_option
@_as_json
@click.pass_context
def plugins(ctx: click.Context, files: tuple[Path, ...], as_json: bool) -> None:
    """List every part that is installed, and what became of every plugin."""
    from clast.config.describe import plugins_data, plugins_text
    from clast.plugins.discovery import listing

    ctx.obj = files
    if ctx.invoked_subcommand is None:
        registry = listing(files)
        _print_json(plugins_data(registry)) if as_json else click.echo(plugins_text(registry))


@plugins.command()
@click.argument("name")
@click.option("--plugin", "more", multiple=True, type=click.Path(path_type=Path), help="A Python file with a plugin.")
@_as_json
@click.pass_obj
def show(files: tuple[Path, ...], name: str, more: tuple[Path, ...], as_json: bool) -> None:
    """Show the parameters and the source of the part NAME."""
    from clast.config.describe import found_parts, part_data, part_text
    from clast.plugins.discovery import discover

    registry = discover((*files, *more))
    if as_json:
        _print_json([part_data(entry) for entry in found_parts(registry, name)])
    else:
        click.echo(part_text(registry, name))


@plugins.command()
@click.argument("kind", type=click.Choice(KINDS), metavar="KIND")
@click.argument("name")
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File to write; NAME.py, if not given.")
def new(kind: str, name: str, output: Path | None) -> None:
    """Write a part of KIND named NAME that works as it stands, to be changed.

    KIND is generator, bond_model, bond_kinematics, contact_law, rolling_resistance, integrator, damping,
    neighbour_search, wall, motion, body_force, stop or writer.
    """
    from clast.plugins.new import write_starter

    path = write_starter(kind, name, output or Path(f"{name}.py"))
    click.echo(f"wrote {path}; try it with 'clast plugins check {path}'")


@plugins.command()
@click.argument("what", metavar="FILE|NAME")
@click.option("--set", "changes", multiple=True, metavar="PART.KEY=VALUE", help="A parameter to try a part with.")
@click.option("--speed/--no-speed", default=True, show_default=True, help="Whether to measure what laws cost.")
@_as_json
@click.pass_context
def check(ctx: click.Context, what: str, changes: tuple[str, ...], speed: bool, as_json: bool) -> None:
    """Try the parts of a FILE, or of what is installed as NAME, on what holds for all parts of their kind."""
    from clast.commands import check_parts

    if not check_parts.check(what, changes, speed, as_json):
        ctx.exit(1)

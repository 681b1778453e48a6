"""Picture: a grain at its peak stress with its loaded bonds, or a bed of grains cut open, before and after."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.run import Run
from clast_viz.curves import peak_frame
from clast_viz.damage import shows_damage
from clast_viz.picture_bed import draw_bed
from clast_viz.picture_grain import draw_grain
from clast_viz.renderer import NO_RENDERER, RendererProbe, quiet_vtk

FILE = "picture.png"


class PictureParams(Params):
    """What the user can choose about the picture."""

    width: Annotated[int, Field(ge=100, le=8000, description="Width in pixels")] = 1600
    height: Annotated[int, Field(ge=100, le=8000, description="Height in pixels")] = 1200
    show: Annotated[
        Literal["auto", "load", "damage"],
        Field(
            description="'load': the frame before the peak stress with its bonds; 'damage': grains cut open at the "
            "start and the end, coloured by the share of their bonds that are broken; 'auto': damage where there are "
            "several bonded grains"
        ),
    ] = "auto"
    bonds: Annotated[bool, Field(description="With 'load', draw the bonds and shrink the particles")] = True


def meaning(run: Run) -> str:
    """Return what the picture of a run shows, unless its scene asked for the other kind."""
    if shows_damage(run):
        return "cut open, at the start and at the end; grains coloured by the share of their bonds that are broken"
    return "before the peak stress, bonds coloured by load"


def write_picture(run: Run, params: PictureParams, path: Path) -> Written:
    """Write ``picture.png``: the frame before the peak stress (the last one without a curve), or start and end."""
    if run.n_frames == 0:
        return Written(None, "the run has recorded no frame")
    probe = RendererProbe()
    import pyvista.plotting  # noqa: F401  a second of loading while the probe runs

    if not probe.can_render():
        return Written(None, NO_RENDERER)
    with quiet_vtk():
        _draw(run, params, path)
    return Written(path)


def _draw(run: Run, params: PictureParams, path: Path) -> None:
    import pyvista as pv

    damage = shows_damage(run) if params.show == "auto" else params.show == "damage"
    if damage:
        plotter = draw_bed(run, (params.width, params.height))
    else:
        plotter = pv.Plotter(off_screen=True, window_size=[params.width, params.height])
        draw_grain(plotter, run, run.frame(peak_frame(run)), params.height, bonds=params.bonds)
    plotter.set_background("white", all_renderers=True)
    plotter.screenshot(path)
    plotter.close()

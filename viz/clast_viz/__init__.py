"""What a run looks like: a recording, a VTK file, a figure and a picture.

The writers import rerun, VTK, pyvista and matplotlib when they write, so that loading this plugin is free.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from clast import hookimpl
from clast.parts.writer import Export, Writer
from clast_viz import csv_tables, energy, figure, grain_tables, lammps, picture, recording, vtk

if TYPE_CHECKING:
    from clast.plugins.registry import Registry

CLAST_API = 1


WRITERS = {
    "recording": Writer(
        summary="rerun recording: particles, bonds by load, damage, force chains, cracks, walls, curves over time",
        Params=recording.RecordingParams,
        file=recording.FILE,
        write=recording.write_recording,
        export=Export("rrd", {"bonds": "all", "contacts": "all", "frames": "all"}),
    ),
    "vtk": Writer(
        summary="VTKHDF for ParaView: particles, intact bonds and contacts over time",
        Params=vtk.VtkParams,
        file=vtk.FILE,
        write=vtk.write_vtk,
        export=Export("vtkhdf", {"bonds": "all", "frames": "all"}),
    ),
    "figure": Writer(
        summary="stress over strain with the measured crushing point, and the bonds broken",
        Params=figure.FigureParams,
        file=figure.FILE,
        write=figure.write_figure,
        needs_frames=False,
    ),
    "energy": Writer(
        summary="where the work that goes into a scene stays, over strain or time; needs output.ledger",
        Params=energy.EnergyParams,
        file=energy.FILE,
        write=energy.write_energy,
        needs_frames=False,
    ),
    "picture": Writer(
        summary="a grain at its peak stress, bonds coloured by load; or a bed cut open, grains coloured by damage",
        Params=picture.PictureParams,
        file=picture.FILE,
        write=picture.write_picture,
    ),
    "grains": Writer(
        summary="a folder of tables about a bed of grains: grading, damage, cracks in space and time, profiles",
        Params=grain_tables.GrainTableParams,
        file=grain_tables.FILE,
        write=grain_tables.write_grain_tables,
    ),
    "csv": Writer(
        summary="a folder of tables: particles, bonds and contacts of every frame, curves, cracks",
        Params=csv_tables.CsvParams,
        file=csv_tables.FILE,
        write=csv_tables.write_csv,
        needs_frames=False,
        export=Export("csv"),
    ),
    "lammps": Writer(
        summary="for LAMMPS and OVITO: a dump of all frames and a data file with the bonds of the last one",
        Params=lammps.LammpsParams,
        file=lammps.FILE,
        write=lammps.write_lammps,
        export=Export("lammps"),
    ),
}


@hookimpl
def clast_register(registry: Registry) -> None:
    """Register the writers."""
    for name, writer in WRITERS.items():
        registry.writer(name, writer)

"""Whether this machine can draw pictures without a screen."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_PROBE = """
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkRenderer
import vtkmodules.vtkRenderingOpenGL2
window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(8, 8)
window.AddRenderer(vtkRenderer())
window.Render()
"""

NO_RENDERER = (
    "this machine has no OpenGL renderer; install Mesa "
    "(Debian and Ubuntu: `apt install libegl1 libgl1-mesa-dri`, or `libosmesa6`), then `clast write RUN picture`"
)


class RendererProbe:
    """Tries to open an offscreen window, in a process of its own because VTK crashes where it cannot.

    It starts at once and is asked later, so that the caller can import pyvista meanwhile.
    """

    def __init__(self) -> None:
        nowhere = subprocess.DEVNULL
        self._process = subprocess.Popen([sys.executable, "-c", _PROBE], stdout=nowhere, stderr=nowhere)

    def can_render(self) -> bool:
        """Wait for the answer."""
        try:
            return self._process.wait(timeout=60.0) == 0
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            return False


@contextmanager
def quiet_vtk() -> Iterator[None]:
    """Keep VTK from reporting each renderer it tries before one works; errors still show."""
    from vtkmodules.vtkCommonCore import vtkLogger

    before = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    try:
        yield
    finally:
        vtkLogger.SetStderrVerbosity(before)

"""``clast view``: open the recording of a run in the rerun viewer."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

from clast.errors import RefusedError, RunError

RECORDING_FILE = "recording.rrd"


def view(folder: Path) -> None:
    """Open the viewer on the recording of ``folder`` and wait until it is closed.

    Raises
    ------
    RunError
        If there is no recording, no viewer, or no screen to show it on.
    """
    recording = _find_recording(Path(folder))
    if find_spec("rerun_cli") is None:
        raise RunError(f"the rerun viewer is not installed; `pip install rerun-sdk`, then `rerun {recording}`")
    if not _has_screen():
        raise RunError(_elsewhere("this machine has no screen", recording))
    # the viewer listens for data; it must not do so on the network
    command = [sys.executable, "-m", "rerun_cli", "--bind", "127.0.0.1", "--port", "auto", str(recording)]
    try:
        viewer = subprocess.run(command, check=False, env={"RUST_LOG": "error", **os.environ})
    except KeyboardInterrupt:
        return
    if viewer.returncode != 0:
        raise RunError(_elsewhere(f"the viewer ended with code {viewer.returncode}", recording))


def _find_recording(folder: Path) -> Path:
    recording = folder if folder.suffix == ".rrd" else folder / RECORDING_FILE
    if recording.is_file():
        return recording
    if not folder.is_dir():
        raise RefusedError(f"{folder}: there is no such run folder")
    advice = f"once the run has ended, `clast write {folder} recording` makes it"
    raise RefusedError(f"{folder}: holds no {RECORDING_FILE}; {advice}")


def _has_screen() -> bool:
    if sys.platform != "linux":
        return True
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"))


def _elsewhere(what: str, recording: Path) -> str:
    return (
        f"cannot show the recording: {what}; copy {recording} to a machine with a screen "
        f"and run `rerun {recording.name}` there"
    )

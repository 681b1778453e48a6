"""The program ``clast``, also ``python -m clast``: ends in good order when it is stopped, from its first moment on."""

from __future__ import annotations

import os
import signal
from types import FrameType
from typing import NoReturn


def main() -> None:
    """Run the command line."""
    for number in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(number) != signal.SIG_IGN:  # as under nohup
            signal.signal(number, _leave)
    from clast.cli import main as commands

    commands()


def _leave(number: int, frame: FrameType | None) -> NoReturn:
    """End at once; what has something to put in order takes over the signals, see ``clast.results.watch.stoppable``.

    An exception would be lost in some libraries that are just being imported, and told with a traceback by others.
    """
    os.write(2, f"stopped by {signal.Signals(number).name}\n".encode())
    os._exit(128 + number)


if __name__ == "__main__":
    main()

"""Starts a command from a process that is small itself, and tells what the command used.

Linux counts into a process's peak memory what its parent held when it was started; here that is ten megabytes.
``python -S launch.py REPORT COMMAND ...`` writes a line of JSON to REPORT and ends as the command did.
"""

from __future__ import annotations

import json
import os
import sys
import time


def main(report: str, command: list[str]) -> int:
    """Run the command, write what it used, and return its exit code."""
    launched, begun = time.time(), time.perf_counter()
    process = os.posix_spawnp(command[0], command, os.environ)
    _, status, used = os.wait4(process, 0)
    told = {
        "cpu": used.ru_utime + used.ru_stime,
        "wall": time.perf_counter() - begun,
        "memory": used.ru_maxrss / (1024.0 if sys.platform != "darwin" else 1024.0**2),
        "launched_at": launched,
    }
    with open(report, "w") as file:
        json.dump(told, file)
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))

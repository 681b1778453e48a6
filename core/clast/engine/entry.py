"""Entry points: each is compiled by one process at a time, and loaded from disk by all that wait."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

from clast.engine.law_errors import Laws, compiler_errors, law_errors


class Entry:
    """A compiled function as Python calls it; its first call compiles it, or waits for a process that does.

    Parameters
    ----------
    function : numba dispatcher
        Made by :func:`clast.engine.compiler.compiled`.
    lock : Path
        File that processes lock while they compile.
    laws : mapping
        Files of the laws that it calls, and what was heard of their functions.
    """

    def __init__(self, function: Any, lock: Path, laws: Laws | None = None) -> None:
        self.function, self.lock, self.laws, self.ready = function, lock, laws or {}, False

    def __call__(self, *arguments: Any) -> Any:
        """Call it.

        Raises
        ------
        PluginError
            If a law cannot be compiled, or raises something.
        """
        if not self.ready:
            with alone(self.lock), compiler_errors(self.laws):
                self.function.compile(tuple(self.function.typeof_pyval(each) for each in arguments))
            self.ready = True
        with law_errors(self.laws):
            return self.function(*arguments)

    @property
    def on_disk(self) -> bool:
        """Whether machine code of this function was kept by an earlier run."""
        name = f"{Path(self.function.py_func.__code__.co_filename).stem}.{self.function.__name__}-*.nbi"
        return any(Path(self.function.stats.cache_path).glob(name))


@contextmanager
def alone(lock: Path) -> Iterator[None]:
    """Wait until no other process is inside with the same lock file; do not wait where no file can be locked.

    The system frees the lock of a process that ends, however it ends.
    """
    with ExitStack() as stack:
        with suppress(ImportError, OSError):
            import fcntl

            fcntl.flock(stack.enter_context(lock.open("w")), fcntl.LOCK_EX)
        yield

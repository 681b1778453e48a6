"""Everything Clast tells a user when something cannot go on.

Each message says where, what was found, what is allowed and what to do. The command line prints it
without a traceback and ends with the error's ``exit_code``.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

KeyPath = tuple[str | int, ...]
"""Where something stands in a scene: keys, and numbers of list entries."""


class ClastError(Exception):
    """Base of all errors meant for the user.

    Parameters
    ----------
    message : str
    at : key path or None
        Key of the part that the message is about, ``("porosity",)`` or ``()`` for the part as a whole: whoever knows
        the scene file puts file, line and the whole key in front (:meth:`clast.config.scene.SceneConfig.placing`).
        None where the message itself begins with its place.
    """

    exit_code = 1

    def __init__(self, message: str, at: KeyPath | None = ()) -> None:
        super().__init__(message)
        self.at = at


class ConfigError(ClastError):
    """The input is wrong: a YAML file, an option, a data file, a plugin."""

    exit_code = 2


class PluginError(ConfigError):
    """A plugin cannot be loaded, or two plugins want the same name."""


class PackingError(ClastError):
    """A generator has tried and cannot reach what was asked of it."""


class RunError(ClastError):
    """A run cannot start or go on, or what came of it cannot be written."""


class RefusedError(RunError):
    """A run, its folder or its files are not what is asked for or needed: nothing is begun."""

    exit_code = 2


class DamagedError(RefusedError):
    """A file of a run is damaged, as a kill in the middle of a write may leave it; the run has to start anew."""


@contextmanager
def about(*keys: str | int) -> Iterator[None]:
    """Say that errors raised inside are about these keys of a part; see ``ClastError.at``.

    >>> try:
    ...     with about("particles"):
    ...         raise ConfigError("the file is empty")
    ... except ConfigError as error:
    ...     error.at
    ('particles',)
    """
    try:
        yield
    except ClastError as error:
        if error.at is not None:
            error.at = (*keys, *error.at)
        raise


def one_line(error: BaseException) -> str:
    """Text of an error in one line, behind its type where it is not one of Clast's own."""
    kind = "" if isinstance(error, PluginError) else f"{type(error).__name__}: "
    return " ".join(f"{kind}{error}".split())

"""Everything Clast tells a user when something cannot go on.

Each message says where, what was found, what is allowed and what to do. The command line prints it
without a traceback and ends with the error's ``exit_code``.
"""

from __future__ import annotations


class ClastError(Exception):
    """Base of all errors meant for the user."""

    exit_code = 1


class ConfigError(ClastError):
    """The input is wrong: a YAML file, an option, a data file, a plugin."""

    exit_code = 2


class PluginError(ConfigError):
    """A plugin cannot be loaded, or two plugins want the same name."""


class PackingError(ClastError):
    """A generator cannot reach what was asked of it."""


class RunError(ClastError):
    """A run cannot start, go on, or be resumed."""

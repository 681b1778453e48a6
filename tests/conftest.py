"""Settings of the whole suite."""

from hypothesis import settings

# the same examples in every run: a failure is a change of the code, never of the dice
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")

"""Algebra by one thread: of few numbers, more threads only wait for each other, and round as many machines differ."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module


@contextmanager
def one_thread() -> Iterator[None]:
    """Let one thread do all that libraries of linear algebra are asked for.

    A fit of a Gaussian process to a dozen points asks thousands of times for microseconds of work, while runs keep the
    processors busy.
    """
    from threadpoolctl import threadpool_limits

    import_module("sklearn.gaussian_process")  # with its libraries: only those that are there can be told
    with threadpool_limits(limits=1, user_api="blas"):
        yield

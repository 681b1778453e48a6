"""Executors: who does the runs of a study; any ``concurrent.futures.Executor`` will do."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor
from multiprocessing import get_context
from typing import NamedTuple

from clast.engine.crew import processors
from clast.errors import ConfigError, RunError


class Maker(NamedTuple):
    """How to get an executor, which is asked for again when its workers have died; and how many those are, if known."""

    make: Callable[[], Executor]
    workers: int | None


ALONE = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
WAIT = "60 s"
"""How long a scheduler may take to answer."""


class Workers:
    """Workers that live from the first run to the last, and are replaced when they die.

    Parameters
    ----------
    maker : Maker
    """

    def __init__(self, maker: Maker) -> None:
        self.maker = maker
        self.executor: Executor | None = None

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *reason: object) -> None:
        self.drop()

    def take(self) -> Executor:
        """Return the executor, made when there is none."""
        if self.executor is None:
            self.executor = self.maker.make()
        return self.executor

    def drop(self) -> None:
        """Send the workers home; what has not begun is forgotten."""
        executor, self.executor = self.executor, None
        if executor is not None:
            executor.shutdown(wait=True, cancel_futures=True)


def local(workers: int | None = None) -> Maker:
    """Return a maker of processes on this machine that live as long as the study: one a processor, if not given."""
    count = workers or processors()
    return Maker(lambda: ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=_begin), count)


def _begin() -> None:
    """Prepare a worker: one thread, Ctrl-C left to the process that leads, and an end when that is gone."""
    os.environ.update(ALONE)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_leave_with, args=(os.getppid(),), daemon=True).start()


def _leave_with(parent: int) -> None:
    """End this process when its parent has ended, however: the run goes on from its checkpoint another time."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)


def dask(scheduler: str | None, workers: int | None = None) -> Maker:
    """Return a maker of an executor on a Dask cluster: the one at an address, or a local one.

    Parameters
    ----------
    scheduler : str or None
        As ``tcp://head:8786``; None starts workers on this machine.
    workers : int or None
        How many of those.

    Raises
    ------
    ConfigError
        If ``distributed`` is not installed.
    """
    try:
        import distributed
    except ImportError:
        raise ConfigError("--executor dask needs the package 'distributed': pip install distributed") from None

    def make() -> Executor:
        try:
            if scheduler is not None:
                client = distributed.Client(scheduler, timeout=WAIT)
            else:
                cluster = distributed.LocalCluster(
                    n_workers=workers or processors(), threads_per_worker=1, dashboard_address=None
                )
                client = distributed.Client(cluster)
        except (OSError, TimeoutError, ValueError) as error:
            raise RunError(f"no Dask scheduler answers at {scheduler}: {error}") from error
        return _Dask(client, scheduler is None)

    return Maker(make, None if scheduler is not None else workers or processors())


class _Dask(Executor):
    """A Dask client as an executor that closes what it opened."""

    def __init__(self, client: object, own_cluster: bool) -> None:
        self.client, self.own_cluster = client, own_cluster
        self.executor = client.get_executor(pure=False, retries=0)  # type: ignore[attr-defined]

    def submit(self, *call: object, **named: object) -> object:  # type: ignore[override]
        """Hand a call to the cluster."""
        return self.executor.submit(*call, **named)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Close the connection, and the workers that were started for it."""
        self.client.close()  # type: ignore[attr-defined]
        if self.own_cluster:
            self.client.cluster.close()  # type: ignore[attr-defined]

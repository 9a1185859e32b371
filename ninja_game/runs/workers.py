"""Runs many jobs, in order, on threads, on processes or on a cluster; no job is lost with a worker that dies.

All three are `concurrent.futures` underneath or look like it: ``submit`` gives a future, results come in the order of
the jobs, and only enough jobs are in flight to keep the workers busy. So memory stays bounded, every result is taken
exactly once, and the results do not depend on the workers.
"""

from __future__ import annotations

import logging
import os
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from functools import partial
from itertools import islice
from multiprocessing import get_context, parent_process
from typing import Any, TypeAlias, TypeVar

from ninja_game.errors import NinjaGameError
from ninja_game.runtime import install_hint
from ninja_game.signals import signals_deferred

J = TypeVar("J")
R = TypeVar("R")

_AHEAD = 4  # jobs in flight for each worker: enough that none waits

_TRIES = 3  # times that a job may kill a process before it counts as lost; a cluster's scheduler counts by itself

WORKER_BYTES = 2 << 30  # memory of a worker process, on systems with such limits
JOB_SECONDS = 3600  # processor time of one job there

_PATIENCE = 30  # seconds to wait for a cluster's first worker


class ClusterError(NinjaGameError):
    """The cluster cannot be used: Dask distributed is missing, or nobody answers at the address."""


class WorkerLostError(NinjaGameError):
    """A job was lost with its worker again and again."""


class Local:
    """Threads or processes of this machine.

    ``count``: jobs that run at a time; ``lost``: raised when a worker died; ``tries``: most tries of a job.
    """

    lost: tuple[type[BaseException], ...] = (BrokenProcessPool, MemoryError)
    tries = _TRIES

    def __init__(self, count: int, *, processes: bool = False) -> None:
        self.count = count
        self._processes = processes
        self._executor = self._start()

    def _start(self) -> Executor:
        if not self._processes:
            return ThreadPoolExecutor(self.count)
        # Not fork: a child that inherits the locks of our threads may wait for ever. Its locks start a process too.
        with _safe_path():
            return ProcessPoolExecutor(self.count, get_context("spawn"), _begin_worker)

    def submit(self, function: Callable[[J], R], job: J) -> Any:
        """A future of ``function(job)``. This starts processes."""
        if self._processes:
            function = partial(_in_limits, function)
        with signals_deferred(), _safe_path():
            try:
                return self._executor.submit(function, job)
            except BrokenProcessPool:
                self.renew()
                return self._executor.submit(function, job)

    def renew(self) -> None:
        """Start new processes instead of a pool with a dead one."""
        self._executor.shutdown(wait=False)
        self._executor = self._start()

    def close(self) -> None:
        self._executor.shutdown(cancel_futures=True)

    def kill(self) -> None:
        """End processes at once, and do not wait for threads."""
        for process in list((getattr(self._executor, "_processes", None) or {}).values()):
            process.kill()
        self._executor.shutdown(wait=self._processes, cancel_futures=not self._processes)


@contextmanager
def _safe_path() -> Iterator[None]:
    """Processes started in the block import nothing from the current folder."""
    before = os.environ.get("PYTHONSAFEPATH")
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        yield
    finally:
        del os.environ["PYTHONSAFEPATH"]
        if before is not None:
            os.environ["PYTHONSAFEPATH"] = before


def _begin_worker() -> None:
    """Prepare a worker process.

    Ctrl-C goes to all processes of a terminal; one hit between two jobs would keep the pool from ending, so only the
    parent listens to it. When the parent is gone, the worker ends too.
    """
    _set_limit("RLIMIT_DATA", WORKER_BYTES)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, name="ninja-game parent", daemon=True).start()


def _in_limits(function: Callable[[J], R], job: J) -> R:
    """``function(job)`` in a worker process, which ends if that takes too long."""
    _set_limit("RLIMIT_CPU", int(time.process_time()) + JOB_SECONDS)
    return function(job)


def _set_limit(name: str, most: int) -> None:
    """Lower a limit of this process for good or for a job, if the system has it; the hard limit stays."""
    with suppress(ImportError, AttributeError, OSError, ValueError):
        import resource

        which = getattr(resource, name)
        resource.setrlimit(which, (most, resource.getrlimit(which)[1]))


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


class Cluster:
    """The workers of a Dask cluster; its scheduler runs again elsewhere what a lost worker had.

    ``address``: of the scheduler, such as tcp://host:8786. Raises ClusterError.
    """

    tries = 1

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client, KilledWorker
        except ImportError:
            raise ClusterError(f"a cluster needs Dask distributed; {install_hint('cluster')}") from None
        self.lost: tuple[type[BaseException], ...] = (KilledWorker,)
        # Its messages come as exceptions.
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        try:
            connect: Any = Client
            self._client = connect(address, timeout="10s", set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            raise ClusterError(f"no Dask scheduler at {address!r}: {error}") from None
        try:
            self._client.wait_for_workers(1, timeout=_PATIENCE)
        except OSError:
            self._client.close()
            raise ClusterError(f"the Dask scheduler at {address} has no workers") from None

    @property
    def count(self) -> int:
        """Jobs that run at a time, with the workers that are there now."""
        return max(1, sum(map(int, self._client.nthreads().values())))

    def submit(self, function: Callable[[J], R], job: J) -> Any:
        return self._client.submit(function, job, pure=False)

    def renew(self) -> None:
        """Do nothing: the scheduler knows the workers that are left."""

    def close(self) -> None:
        self._client.close()

    kill = close


Workers: TypeAlias = Local | Cluster


@contextmanager
def open_workers(count: int, *, processes: bool = False, cluster: str = "") -> Iterator[Workers]:
    """Workers for a while: of the cluster at this address, else ``count`` threads or processes."""
    pool: Workers = Cluster(cluster) if cluster else Local(count, processes=processes)
    try:
        yield pool
    except BaseException:
        pool.kill()
        raise
    pool.close()


def results_of(pool: Workers, function: Callable[[J], R], jobs: Iterable[J]) -> Iterator[tuple[J, R | WorkerLostError]]:
    """Every job with its result, in the jobs' order; WorkerLostError for one that kills every worker it meets."""
    flying: deque[tuple[J, Any]] = deque()
    waiting = iter(jobs)
    while True:
        for job in islice(waiting, max(0, _AHEAD * pool.count - len(flying))):
            flying.append((job, pool.submit(function, job)))
        if not flying:
            return
        job, future = flying.popleft()
        try:
            result = future.result()
        except pool.lost:
            # The cause is unknown: this job runs again alone, then all that were lost with it.
            result = _retry(pool, function, job)
            flying = deque((job, _kept(pool, function, job, future)) for job, future in flying)
        yield job, result


def _retry(pool: Workers, function: Callable[[J], R], job: J) -> R | WorkerLostError:
    for _ in range(pool.tries - 1):
        pool.renew()
        try:
            result: R = pool.submit(function, job).result()
        except pool.lost:
            continue
        return result
    pool.renew()
    limits = f"{WORKER_BYTES >> 30} GiB of memory and {JOB_SECONDS // 60} minutes"
    return WorkerLostError(f"the worker died again and again; it may take {limits}")


def _kept(pool: Workers, function: Callable[[J], R], job: J, future: Any) -> Any:
    """The job's future, or a new one if it was lost too."""
    lost = future.done() and not future.cancelled() and isinstance(future.exception(), pool.lost)
    return pool.submit(function, job) if lost else future

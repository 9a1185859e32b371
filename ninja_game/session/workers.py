"""Many independent jobs on all cores, in order, with a bounded number of them in flight."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from itertools import islice
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")

CHUNK = 32
"""Items a job: sending one costs more than a short run."""


def default_jobs() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def ordered_map(
    function: Callable[[T], R], items: Iterable[T], *, jobs: int = 1, processes: bool = False
) -> Iterator[R]:
    """``function`` of every item, in the items' order; few items enough for one job start no workers.

    ``processes``: workers are processes (for work that holds the interpreter's lock; function and items must be
    picklable), else threads. Memory stays bounded however many items there are.
    """
    rest = iter(items)
    first = list(islice(rest, CHUNK))
    if jobs <= 1 or len(first) < CHUNK:
        yield from map(function, first)
        yield from map(function, rest)
        return
    executor: Executor = ProcessPoolExecutor(jobs) if processes else ThreadPoolExecutor(jobs)
    with executor:
        flying: deque[Future[list[R]]] = deque([executor.submit(_all, function, first)])
        try:
            while chunk := list(islice(rest, CHUNK)):
                flying.append(executor.submit(_all, function, chunk))
                if len(flying) > 4 * jobs:
                    yield from flying.popleft().result()
            while flying:
                yield from flying.popleft().result()
        finally:
            for future in flying:
                future.cancel()


def _all(function: Callable[[T], R], chunk: list[T]) -> list[R]:
    return [function(item) for item in chunk]

"""Threads that share out a range of work, for compiled code that runs without the interpreter's lock.

Chunks are handed out one by one, so that a thread that wakes late, or has slow worlds, takes fewer of them. A call
costs some ten microseconds; `concurrent.futures` costs several times that.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from functools import cache
from queue import SimpleQueue
from threading import Thread
from typing import TypeAlias

Work: TypeAlias = Callable[[int, int], int]
"""Does items ``first`` … ``last`` - 1 and says how much that was."""

CHUNKS_PER_THREAD = 8


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Errand:
    """One call of ``Crew.share``: whoever is free takes the next chunk."""

    def __init__(self, work: Work, count: int, chunk: int) -> None:
        self.work = work
        self.count = count
        self.chunk = chunk
        # A built-in iterator hands out its next item under the interpreter's lock: to one thread only.
        self.starts: Iterator[int] = iter(range(0, count, chunk))
        self.done: SimpleQueue[tuple[int, int] | BaseException] = SimpleQueue()

    def run(self) -> None:
        """Take chunks until there are none left; report how many they were and the sum of what the work says."""
        chunks = total = 0
        try:
            for first in self.starts:
                total += self.work(first, min(first + self.chunk, self.count))
                chunks += 1
            self.done.put((chunks, total))
        except BaseException as error:  # noqa: BLE001 - raised again by the caller
            self.done.put(error)

    def total(self) -> int:
        """Wait until all chunks are done, not for threads that woke too late to take one."""
        total = chunks = 0
        while chunks * self.chunk < self.count:
            report = self.done.get()
            if isinstance(report, BaseException):
                raise report
            chunks += report[0]
            total += report[1]
        return total


class Crew:
    """A fixed number of threads, the caller's own among them."""

    def __init__(self, threads: int) -> None:
        if threads < 1:
            raise ValueError(f"threads is {threads}; expected at least 1")
        self.threads = threads
        self._queues: list[SimpleQueue[_Errand]] = [SimpleQueue() for _ in range(threads - 1)]
        for queue in self._queues:
            Thread(target=_serve, args=(queue,), name="ninja-game crew", daemon=True).start()

    def share(self, work: Work, count: int) -> int:
        """Do items 0 … ``count`` - 1 on all threads; the sum of what ``work`` says. Its first exception is raised."""
        chunk = -(-count // (self.threads * CHUNKS_PER_THREAD)) if self.threads > 1 else count
        if chunk >= count:
            return work(0, count)
        errand = _Errand(work, count, chunk)
        for queue in self._queues:
            queue.put(errand)
        errand.run()
        return errand.total()


def _serve(queue: SimpleQueue[_Errand]) -> None:
    """The life of a crew's thread."""
    while True:
        queue.get().run()


@cache
def crew(threads: int) -> Crew:
    """The crew of that size; all batches of a process share it."""
    return Crew(threads)

"""Threads that share a range of work, for compiled code that runs without the interpreter's lock.

A thread takes one chunk at a time, so a thread that wakes late or has slow worlds takes fewer. A call costs some ten
microseconds; `concurrent.futures` costs several times that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from operator import index
from queue import SimpleQueue
from threading import Thread
from typing import SupportsIndex, TypeAlias

from ninja_game.errors import ArgumentError
from ninja_game.runtime import cores

_Work: TypeAlias = Callable[[int, int], int]  # processes items first … last - 1 and returns the work done

CHUNKS_PER_THREAD = 8
SMALL_CHUNK = 2048  # least ticks of a chunk, unless a thread gets only one: a thread waits when it takes a chunk

HEAD_START = 128  # ticks that the caller runs while the others wake up

TOO_SMALL = 800  # ticks that are not worth waking another thread for: about 80 us


def chunks(count: int, ticks: int, threads: int) -> list[tuple[int, int]]:
    """Cut items 0 … ``count`` - 1, of ``ticks`` each, into ranges, in the order in which threads should take them."""
    small = -(-SMALL_CHUNK // max(ticks, 1))
    if threads == 1 or count * ticks < TOO_SMALL:
        return [(0, count)]
    if small * threads < count:
        size = max(-(-count // (threads * CHUNKS_PER_THREAD)), small)
        first_size = 0
    else:
        first_size = min(count, (count + HEAD_START // max(ticks, 1) * (threads - 1)) // threads)
        size = -(-(count - first_size) // (threads - 1)) or 1
    rest = [(first, min(first + size, count)) for first in range(first_size, count, size)]
    return [(0, first_size), *rest] if first_size else rest


def whole_number(name: str, number: object, least: int = 1, most: int = 2**63 - 1) -> int:
    """A number as a Python int. Raises ArgumentError for anything but a whole number of that range."""
    if isinstance(number, bool) or not isinstance(number, SupportsIndex) or not least <= index(number) <= most:
        expected = f"at least {least}" if most == 2**63 - 1 else f"{least} to {most}"
        raise ArgumentError(f"{name} is {number!r:.60}; expected a whole number, {expected}")
    return index(number)


def thread_count(threads: int | None) -> int:
    """The number of threads, by default one per core."""
    return cores() if threads is None else whole_number("threads", threads)


class _ParallelCall:
    """One call of ``ThreadPool.share``: a free thread takes the next range."""

    def __init__(self, work: _Work, ranges: list[tuple[int, int]]) -> None:
        self.work = work
        self.count = len(ranges)
        # A built-in iterator gives an item to one thread only: next() holds the interpreter's lock.
        self.ranges: Iterator[tuple[int, int]] = iter(ranges)
        self.done: SimpleQueue[tuple[int, int] | BaseException] = SimpleQueue()

    def run(self) -> None:
        """Take ranges until none is left; report their number and the sum of the results of the work."""
        ranges = total = 0
        try:
            for first, last in self.ranges:
                total += self.work(first, last)
                ranges += 1
            self.done.put((ranges, total))
        except BaseException as error:  # noqa: BLE001 - raised again by the caller
            self.done.put(error)

    def total(self) -> int:
        """Wait until all ranges are done, not for threads that woke too late to take one."""
        total = ranges = 0
        while ranges < self.count:
            report = self.done.get()
            if isinstance(report, BaseException):
                raise report
            ranges += report[0]
            total += report[1]
        return total


class ThreadPool:
    """A fixed number of threads, the caller's own among them."""

    def __init__(self, threads: int) -> None:
        self.threads = threads
        self._queues: list[SimpleQueue[_ParallelCall]] = [SimpleQueue() for _ in range(threads - 1)]
        for queue in self._queues:
            Thread(target=_serve, args=(queue,), name="ninja-game worker", daemon=True).start()

    def share(self, work: _Work, count: int, ticks: int = SMALL_CHUNK) -> int:
        """Do items 0 … ``count`` - 1, of ``ticks`` each, on all threads; gives the sum of the results of ``work``.

        Raises the first exception of ``work``.
        """
        ranges = chunks(count, ticks, self.threads) if self.threads > 1 else []
        if len(ranges) <= 1:
            return work(0, count)
        call = _ParallelCall(work, ranges)
        for queue in self._queues:
            queue.put(call)
        call.run()
        return call.total()


def _serve(queue: SimpleQueue[_ParallelCall]) -> None:
    """Worker loop: takes calls from its queue for as long as the process runs."""
    while True:
        queue.get().run()


@cache
def thread_pool(threads: int) -> ThreadPool:
    """The pool of that size; all batches of a process share it."""
    return ThreadPool(threads)

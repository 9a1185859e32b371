"""Traces of any number of recordings, on all cores, in order, in bounded memory."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import chain, islice
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from ninja_game.backend.memories import choose_memory
from ninja_game.batch.thread_pool import cores
from ninja_game.errors import NinjaGameError
from ninja_game.formats.recording import Recording
from ninja_game.runs.recording_reader import Unreadable, recordings_in
from ninja_game.runs.trace import trace_recording
from ninja_game.runs.trace_files import FiledTrace
from ninja_game.sim.level import Level
from ninja_game.verification.workers import WorkerLostError, in_order, workers

JOB = 32
"""Recordings a job: sending one costs more than a short run."""


class Traced(NamedTuple):
    """A trace, the file of its recording and the comment there."""

    file: str
    comment: str
    trace: FiledTrace


Job: TypeAlias = list[Recording | Unreadable]


def trace_all(
    paths: Iterable[Path],
    *,
    level: Level | None = None,
    record: int | None = None,
    jobs: int | None = None,
    memory: str = "auto",
    **options: Any,
) -> Iterator[Traced | Unreadable]:
    """A trace of every recording in files and folders, in order; what cannot be read is reported and stops nothing.

    ``level``: what recordings that do not hold their level are played on; ``record``: only this one of each file.
    ``jobs``: how many run at a time, by default one a core. ``memory`` and ``options`` as for ``trace_recording``.
    """
    found = recordings_in(paths, level)
    rest = (item for item in found if record is None or isinstance(item, Unreadable) or item.record == record)
    first = list(islice(rest, JOB))
    trace = partial(_trace, {"memory": memory, **options})
    if len(first) < JOB or jobs == 1:
        # Few recordings are done before a second worker has started.
        yield from map(trace, chain(first, rest))
        return
    # Compiled code leaves the interpreter's lock, plain code needs processes.
    processes = choose_memory(memory) == "plain" or bool(options.get("events"))
    with workers(jobs or cores(), processes=processes) as pool:
        for job, results in in_order(pool, partial(_trace_job, trace), chain([first], _batches(rest))):
            if isinstance(results, WorkerLostError):
                yield Unreadable(f"{len(job)} recordings: {results}")
            else:
                yield from results


def _batches(items: Iterator[Recording | Unreadable]) -> Iterator[Job]:
    while batch := list(islice(items, JOB)):
        yield batch


def _trace_job(trace: Callable[[Recording | Unreadable], Traced | Unreadable], job: Job) -> list[Traced | Unreadable]:
    return [trace(item) for item in job]


def _trace(options: dict[str, Any], recording: Recording | Unreadable) -> Traced | Unreadable:
    if isinstance(recording, Unreadable):
        return recording
    try:
        run = trace_recording(recording, **options)
    except NinjaGameError as error:
        return Unreadable(str(error))
    inputs = recording.replay.playback(len(run.ninja))
    trace = FiledTrace(recording.record, recording.name, run, recording.file, inputs)
    return Traced(recording.file, recording.comment, trace)

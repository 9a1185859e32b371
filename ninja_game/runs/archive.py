"""Archives: any number of recordings verified or traced, on all cores or a cluster, in order, in constant memory.

>>> from pathlib import Path
>>> from ninja_game.files.bundled import data_folder
>>> totals = Totals()
>>> for result in verify_all([data_folder("levels") / "certificates"], jobs=2):
...     totals.add(result)
>>> totals.failed, totals.unreadable
(0, 0)
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import partial
from hashlib import sha256
from itertools import chain, islice
from pathlib import Path
from typing import IO, Any, TypeAlias

from ninja_game.backend.memories import choose_memory
from ninja_game.budget import RUN_BUDGET
from ninja_game.errors import NinjaGameError
from ninja_game.files.bundled import bundled_levels, data_folder
from ninja_game.formats.load import NamedLevel, load_levels
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.pack import episodes_of
from ninja_game.formats.recording import Recording
from ninja_game.runs.chunks import (
    CheckpointLog,
    Chunk,
    Result,
    VerifyOptions,
    chunks_in,
    results_as_text,
    results_from_text,
    self_contained,
    verify_chunk,
)
from ninja_game.runs.recording_reader import Unreadable, recordings_in
from ninja_game.runs.trace import trace_recording
from ninja_game.runs.trace_files import FiledTrace
from ninja_game.runs.verify import with_demands
from ninja_game.runs.workers import ClusterError, WorkerLostError, Workers, open_workers, results_of
from ninja_game.runtime import cores
from ninja_game.sim.level import Level


class Lost(Unreadable):
    """A recording on which workers died: on another machine, or later, it may have a verdict."""


JOB_WEIGHT = 64  # files or records a job

_Job: TypeAlias = tuple[Chunk, ...]
Done: TypeAlias = Iterable[tuple[_Job, list[list[Result]] | WorkerLostError]]


def verify_all(
    paths: Iterable[Path],
    *,
    memory: str = "auto",
    jobs: int | None = None,
    processes: bool | None = None,
    cluster: str = "",
    resume: Path | None = None,
    levels: Sequence[NamedLevel] = (),
    episodes: Container[str] | None = None,
    strict: bool = False,
    chunks: Iterable[Chunk] = (),
    budget: int = RUN_BUDGET,
    record: int | None = None,
) -> Iterator[Result]:
    """A verdict on every recording in files and folders, then in ``chunks``, in order.

    What cannot be read is reported and stops nothing.

    ``jobs``: how many run at a time, by default as many as there are cores. ``processes``: on processes instead of
    threads; by default where the interpreter's lock would be in the way, on the plain memory. ``cluster``: address of a
    Dask scheduler whose workers do it instead. ``resume``: a checkpoint log; what it has is not run again.
    ``levels``: those that count, by default the game's own where it matters; a single one is also the level of
    recordings that do not hold theirs. ``episodes``: the keys of those that count, by default the game's own.
    ``strict``: what docs/verification.md demands must hold too. ``budget``: of each run (``ninja_game.budget``).
    ``record``: only this one of each file.

    Results never depend on who computed them, nor on workers that died meanwhile. Where only some levels count, runs on
    others are not simulated. Raises ClusterError, FormatError for a file that is not a checkpoint log, SelfTestError
    and MemoryUnavailableError where nothing can be judged, OSError.
    """
    counting = levels or [level for path in bundled_levels() for level in load_levels(path)]
    names = {level_digest(named.level): named.name or f"{named.file}:{named.record}" for named in counting}
    level = levels[0].level if len(levels) == 1 else None
    options = VerifyOptions(memory, level, frozenset(names) if levels or strict else None, budget)
    for result in _verify_all(chain(chunks_in(paths, record), chunks), options, jobs, processes, cluster, resume):
        if isinstance(result, Unreadable):
            yield result
        else:
            if episodes is None and result.episode:
                episodes = episodes_of(data_folder("levels"))
            yield with_demands(result, names, episodes or (), only_these=bool(levels), strict=strict)


def _verify_all(
    chunks: Iterable[Chunk],
    options: VerifyOptions,
    jobs: int | None,
    processes: bool | None,
    cluster: str,
    resume: Path | None,
) -> Iterator[Result]:
    if processes is None:
        processes = options.memory == "both" or choose_memory(options.memory) == "plain"
    with ExitStack() as stack:
        log = stack.enter_context(CheckpointLog(resume)) if resume else None
        if cluster or log is not None:  # an empty log counts as false
            chunks = (self_contained(chunk, options.level) for chunk in chunks)
        batches = batched(chunks, log, options.context())
        # Few recordings are done before a second worker has started.
        first = next(batches, ())
        second = next(batches, ())
        if not cluster and not second:
            yield from _record_results(zip([first], [_verify(options, first)], strict=True), log)
            return
        pool: Workers = stack.enter_context(open_workers(jobs or cores(), processes=processes, cluster=cluster))
        all_jobs = chain(filter(None, (first, second)), batches)
        try:
            verify, read = (_verify_as_text, results_from_text) if cluster else (_verify, lambda results, _: results)
            yield from _record_results(_isolate_failing(pool, partial(verify, options), all_jobs, read), log)
        except (CancelledError, ConnectionError) as error:
            if not cluster:
                raise
            hint = f"; --resume {resume} goes on where this stopped" if resume else ""
            raise ClusterError(f"the scheduler at {cluster} is gone ({type(error).__name__}){hint}") from None


def batched(chunks: Iterable[Chunk], log: CheckpointLog | None, context: str = "") -> Iterator[_Job]:
    """Chunks in jobs of some weight, neighbours together. Chunks in the checkpoint log weigh nothing."""
    batch: list[Chunk] = []
    weight = 0
    for chunk in chunks:
        batch.append(chunk if log is None else _with_log_key(chunk, log, context))
        weight += 0 if batch[-1].done else chunk.weight
        if weight >= JOB_WEIGHT or len(batch) >= 16 * JOB_WEIGHT:
            yield tuple(batch)
            batch, weight = [], 0
    if batch:
        yield tuple(batch)


def _with_log_key(chunk: Chunk, log: CheckpointLog, context: str) -> Chunk:
    """The chunk with its key in the checkpoint log; without its text if its results are there."""
    key = sha256(f"{context}{chunk.digest}".encode()).hexdigest()
    return Chunk(chunk.file, key=key, done=True) if key in log else replace(chunk, key=key)


def _verify(options: VerifyOptions, job: _Job) -> list[list[Result]]:
    return [[] if chunk.done else verify_chunk(chunk, options) for chunk in job]


def _verify_as_text(options: VerifyOptions, job: _Job) -> str:
    """Verdicts as JSON, for workers of a cluster: the answer is checked when it comes back."""
    return results_as_text(_verify(options, job))


def _isolate_failing(
    pool: Workers, function: Callable[[Any], Any], jobs: Iterator[_Job], read: Callable[[Any, _Job], list[list[Result]]]
) -> Done:
    """All jobs with their results; one that kills its workers is repeated chunk by chunk, to find the one chunk.

    ``read``: turns an answer into the results of a job.
    """
    for job, results in results_of(pool, function, jobs):
        if isinstance(results, WorkerLostError) and len(job) > 1:
            yield from _isolate_failing(pool, function, ((chunk,) for chunk in job), read)
        else:
            yield job, results if isinstance(results, WorkerLostError) else read(results, job)


def _record_results(done: Done, log: CheckpointLog | None) -> Iterator[Result]:
    """The results of all jobs, written to the checkpoint log as they come; earlier ones are read from it."""
    for job, answer in done:
        if isinstance(answer, WorkerLostError):
            yield from (Lost(f"{chunk.file}: {answer}") for chunk in job)
            continue
        for chunk, results in zip(job, answer, strict=True):
            if log is not None and chunk.done:
                yield from log[chunk.key]
                continue
            if log is not None:
                log.add(chunk.key, results)
            yield from results


@dataclass
class Totals:
    """Counts of results; failed ones are not kept."""

    recordings: int = 0  #: simulated recordings
    ticks: int = 0
    gold: int = 0
    failed: int = 0  #: runs that do not do what their file claims
    unreadable: int = 0
    outcomes: Counter[str] = field(default_factory=Counter)  #: number of runs, by outcome

    def add(self, result: Result) -> None:
        if isinstance(result, Unreadable):
            self.unreadable += 1
            return
        self.recordings += 1
        self.ticks += result.ticks
        self.gold += result.gold
        self.failed += not result.good
        self.outcomes[result.outcome] += 1

    def as_json(self) -> dict[str, Any]:
        return vars(self) | {"outcomes": dict(sorted(self.outcomes.items()))}


def write_report(results: Iterable[Result], out: IO[bytes]) -> Iterator[Result]:
    """Results, written to ``out`` as they pass: one JSON object with ``results`` and ``summary``.

    Nothing in it depends on time, machine or number of workers: equal recordings give equal reports.
    """
    totals = Totals()
    out.write(b'{"results": [')
    separator = b"\n"
    for result in results:
        totals.add(result)
        fields = {"unreadable": str(result)} if isinstance(result, Unreadable) else result.as_json()
        out.write(separator + json.dumps(fields).encode())
        separator = b",\n"
        yield result
    out.write(b'\n], "summary": ' + json.dumps(totals.as_json()).encode() + b"}\n")


TRACES = 32  # recordings per tracing job: sending one costs more than a short run


def trace_all(
    paths: Iterable[Path],
    *,
    level: Level | None = None,
    record: int | None = None,
    jobs: int | None = None,
    memory: str = "auto",
    **options: Any,
) -> Iterator[FiledTrace | Unreadable]:
    """A trace of every recording in files and folders, in order; what cannot be read is reported and stops nothing.

    ``level``: what recordings that do not hold their level are played on; ``record``: only this one of each file.
    ``jobs``: how many run at a time, by default one a core. ``memory`` and ``options`` as for ``trace_recording``.
    """
    recordings = recordings_in(paths, level)
    rest = (item for item in recordings if record is None or isinstance(item, Unreadable) or item.record == record)
    first = list(islice(rest, TRACES))
    options |= {"memory": memory}
    if len(first) < TRACES or jobs == 1:
        # Few recordings are done before a second worker has started.
        yield from map(partial(_trace, options), chain(first, rest))
        return
    # Compiled code leaves the interpreter's lock, plain code needs processes.
    processes = choose_memory(memory) == "plain"
    with open_workers(jobs or cores(), processes=processes) as pool:
        for job, results in results_of(
            pool, partial(_trace_job, options), chain([first], iter(lambda: list(islice(rest, TRACES)), []))
        ):
            if isinstance(results, WorkerLostError):
                yield Unreadable(f"{len(job)} recordings: {results}")
            else:
                yield from results


def _trace_job(options: dict[str, Any], job: list[Recording | Unreadable]) -> list[FiledTrace | Unreadable]:
    return [_trace(options, item) for item in job]


def _trace(options: dict[str, Any], recording: Recording | Unreadable) -> FiledTrace | Unreadable:
    if isinstance(recording, Unreadable):
        return recording
    try:
        run = trace_recording(recording, **options)
    except NinjaGameError as error:
        return Unreadable(str(error))
    inputs = recording.replay.playback(len(run.ninja))
    return FiledTrace(recording.record, recording.name, run, recording.file, inputs, recording.comment)

"""Verification at scale: any number of recordings, on all cores or a cluster, resumable, in constant memory.

>>> from pathlib import Path
>>> from ninja_game.files.resources import data_folder
>>> tally = Tally()
>>> for result in verify_all([data_folder("replays")], jobs=2):
...     tally.add(result)
>>> tally.failed, tally.unreadable
(0, 0)
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import IO, Any, TypeAlias

from ninja_game.batch.thread_pool import cores
from ninja_game.compile_cache import choose_memory, kernels
from ninja_game.runs.recording_reader import Unreadable
from ninja_game.verification.checkpoint_log import Journal
from ninja_game.verification.chunks import Piece, Result, pieces_in, self_contained, verify_piece
from ninja_game.verification.workers import ClusterError, WorkerLostError, Workers, in_order, workers

JOB_WEIGHT = 64
"""Files or records a job."""

Job: TypeAlias = tuple[Piece, ...]
Done: TypeAlias = Iterable[tuple[Job, list[list[Result]] | WorkerLostError]]


def verify_all(
    paths: Iterable[Path],
    *,
    memory: str = "auto",
    jobs: int | None = None,
    processes: bool | None = None,
    cluster: str = "",
    resume: Path | None = None,
) -> Iterator[Result]:
    """A verdict on every recording in files and folders, in order; what cannot be read is said and stops nothing.

    ``jobs``: how many run at a time, by default as many as there are cores. ``processes``: on processes instead of
    threads; by default where the interpreter's lock would be in the way, on the plain memory. ``cluster``: address of a
    Dask scheduler whose workers do it instead. ``resume``: a journal; what it has is not run again.

    Results never depend on who computed them, nor on workers that died meanwhile. Raises ClusterError, FormatError for
    a file that is no journal, OSError.
    """
    if processes is None:
        processes = memory == "both" or choose_memory(memory) == "plain"
    with ExitStack() as stack:
        journal = stack.enter_context(Journal(resume)) if resume else None
        pieces: Iterable[Piece] = pieces_in(paths)
        if cluster:
            pieces = map(self_contained, pieces)
        bundles = bundled(pieces, journal)
        # Few recordings are done before a second worker has started.
        first = next(bundles, ())
        second = next(bundles, ())
        if not cluster and not second:
            yield from _told(zip([first], [_verify(memory, first)], strict=True), journal)
            return
        crew: Workers = stack.enter_context(workers(jobs or cores(), processes=processes, cluster=cluster))
        if not processes and not cluster and choose_memory(memory) == "compiled":
            kernels()  # once, before several threads ask for it
        try:
            yield from _told(_narrowed(crew, partial(_verify, memory), _chain(first, second, bundles)), journal)
        except (CancelledError, ConnectionError) as error:
            if not cluster:
                raise
            hint = f"; --resume {resume} goes on where this stopped" if resume else ""
            raise ClusterError(f"the scheduler at {cluster} is gone ({type(error).__name__}){hint}") from None


def _chain(first: Job, second: Job, rest: Iterator[Job]) -> Iterator[Job]:
    """All jobs that have pieces."""
    yield from filter(None, (first, second))
    yield from rest


def bundled(pieces: Iterable[Piece], journal: Journal | None) -> Iterator[Job]:
    """Pieces in jobs of some weight, neighbours together. What a journal has counts as no work."""
    bundle: list[Piece] = []
    weight = 0
    for piece in pieces:
        done = journal is not None and piece.key in journal
        bundle.append(Piece(piece.file, piece.first, stamp=piece.stamp, done=piece.key) if done else piece)
        weight += 0 if done else piece.weight
        if weight >= JOB_WEIGHT or len(bundle) >= 16 * JOB_WEIGHT:
            yield tuple(bundle)
            bundle, weight = [], 0
    if bundle:
        yield tuple(bundle)


def _verify(memory: str, job: Job) -> list[list[Result]]:
    """Verdicts on every piece of a job that is not done yet."""
    return [[] if piece.done else verify_piece(piece, memory) for piece in job]


def _narrowed(crew: Workers, function: Callable[[Job], list[list[Result]]], jobs: Iterator[Job]) -> Done:
    """All jobs with their results; one that kills its workers is done again piece by piece, to find the one piece."""
    for job, found in in_order(crew, function, jobs):
        if isinstance(found, WorkerLostError) and len(job) > 1:
            yield from in_order(crew, function, ((piece,) for piece in job))
        else:
            yield job, found


def _told(done: Done, journal: Journal | None) -> Iterator[Result]:
    """The results of all jobs, noted in the journal as they are told; what that has already is taken from it."""
    for job, found in done:
        if isinstance(found, WorkerLostError):
            yield from (Unreadable(f"{piece.file}: {found}") for piece in job)
            continue
        for piece, results in zip(job, found, strict=True):
            if journal is not None and piece.done:
                yield from journal[piece.done]
                continue
            if journal is not None:
                journal.add(piece.key, results)
            yield from results


@dataclass
class Tally:
    """Results, counted; of what failed nothing is kept but the number."""

    recordings: int = 0
    ticks: int = 0
    gold: int = 0
    failed: int = 0
    unreadable: int = 0
    outcomes: Counter[str] = field(default_factory=Counter)

    def add(self, result: Result) -> None:
        """Count a result."""
        if isinstance(result, Unreadable):
            self.unreadable += 1
            return
        self.recordings += 1
        self.ticks += result.ticks
        self.gold += result.gold
        self.failed += not result.good
        self.outcomes[result.outcome] += 1

    def as_json(self) -> dict[str, Any]:
        """The counts for programs."""
        return vars(self) | {"outcomes": dict(sorted(self.outcomes.items()))}


def write_report(results: Iterable[Result], out: IO[bytes]) -> Iterator[Result]:
    """The same results, written to ``out`` as they pass: one JSON object with ``results`` and ``summary``.

    Nothing in it depends on time, machine or number of workers: equal recordings give equal reports.
    """
    tally = Tally()
    out.write(b'{"results": [')
    separator = b"\n"
    for result in results:
        tally.add(result)
        fields = {"unreadable": result.message} if isinstance(result, Unreadable) else result.as_json()
        out.write(separator + json.dumps(fields).encode())
        separator = b",\n"
        yield result
    out.write(b'\n], "summary": ' + json.dumps(tally.as_json()).encode() + b"}\n")

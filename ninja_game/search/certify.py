"""Certify levels: keep known runs that still pass, search for the others, write those that are better."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any

from ninja_game.errors import NinjaGameError
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.replay.text import Replay
from ninja_game.search.certificate import UnverifiedRunError, read_certificate, write_certificate
from ninja_game.search.solve import solve
from ninja_game.search.task import Progress, Task


@dataclass(frozen=True)
class Certified:
    """The result for one goal of a level: the best run, None without one, and its origin.

    ``gold``: pieces that the run had to collect. ``how``: "kept" (an earlier certificate), "found", "shortened" or "not
    found". ``progress``: the last state of the search, None without a search.
    """

    run: Replay | None
    gold: int
    how: str
    progress: Progress | None = None


@dataclass(frozen=True)
class CertifyOptions:
    """The goals to certify: the gold of each goal (-1: all), by its name.

    ``task``: arguments of ``Task`` for every level. ``improve``: also shorten the runs that are kept.
    """

    goals: Mapping[str, int]
    task: Mapping[str, Any]
    improve: bool = False


def certify_all(
    levels: Sequence[NamedLevel],
    files: Sequence[Mapping[str, Path]],
    wanted: CertifyOptions,
    *,
    jobs: int,
    report: Callable[[str, Progress], None],
) -> Iterator[dict[str, Certified] | NinjaGameError]:
    """Certify levels, ``jobs`` at a time. Gives per level, in order, the results by goal or the error.

    ``files``: per level, the files of the runs of its goals (empty: none); ``report`` gets a level's name.
    """
    stop = Event()
    threads = max(1, jobs // max(1, len(levels)))
    wanted = replace(wanted, task={**wanted.task, "jobs": threads})
    with ThreadPoolExecutor(jobs) as pool:
        waiting: list[Future[dict[str, Certified]]] = []
        try:
            for level, where in zip(levels, files, strict=True):
                shown = partial(report, Path(level.file).stem)
                waiting.append(pool.submit(_certify, level, where, wanted, shown, stop))
            for future in waiting:
                try:
                    yield future.result()
                except NinjaGameError as error:
                    yield error
        finally:
            stop.set()
            pool.shutdown(cancel_futures=True)


def _certify(
    level: NamedLevel,
    where: Mapping[str, Path],
    wanted: CertifyOptions,
    report: Callable[[Progress], None],
    stop: Event,
) -> dict[str, Certified]:
    """Certify the goals of a level in turn; a run that serves another goal better is used for that goal, too."""
    certified: dict[str, Certified] = {}
    amounts = {name: level.level.gold if gold < 0 else gold for name, gold in wanted.goals.items()}
    for name, gold in amounts.items():
        certified[name] = _certify_goal(level, where.get(name), gold, wanted, certified, report, stop)
    for name, other in [(name, other) for name in certified for other in certified if name != other]:
        run, best = certified[other].run, certified[name].run
        if run and run.gold >= amounts[name] and (not best or run.end_tick < best.end_tick):
            certified[name] = replace(certified[name], run=run, how="found")
            _write(level, where.get(name), run)
    return certified


def _certify_goal(
    level: NamedLevel,
    path: Path | None,
    gold: int,
    wanted: CertifyOptions,
    others: Mapping[str, Certified],
    report: Callable[[Progress], None],
    stop: Event,
) -> Certified:
    """The best run for a goal: the kept one, one found for another goal, or the result of a new search."""
    task = Task(level.level, gold=gold, **wanted.task)
    kept = read_certificate(level, path, body=task.body, gold=gold) if path else None
    run, of_this_level = kept or (None, False)
    if run and of_this_level and not wanted.improve:
        return Certified(run, gold, "kept")
    for other in others.values():
        if other.run and other.run.gold >= gold and (not run or other.run.end_tick < run.end_tick):
            _write(level, path, other.run)
            return Certified(other.run, gold, other.how)
    last: list[Progress] = []

    def remember(progress: Progress) -> None:
        last[:] = [progress]
        report(progress)

    def keep(better: Replay) -> None:
        if not (run and of_this_level and better.end_tick >= run.end_tick):
            _write(level, path, better)

    if run and of_this_level:
        task = replace(task, first=run.inputs, first_only=False)
    best = None
    # Keep a run that no keyboard can make as it is.
    with suppress(UnverifiedRunError):
        best = solve(task, report=remember, on_better=keep, stop=stop)
    if run and (not best or run.end_tick <= best.end_tick):
        if not of_this_level:
            _write(level, path, run)
        return Certified(run, gold, "kept", *last)
    how = "not found" if not best else "shortened" if run else "found"
    return Certified(best, gold, how, *last)


def _write(level: NamedLevel, path: Path | None, run: Replay) -> None:
    if path:
        write_certificate(level, path, run)

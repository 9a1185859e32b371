"""The course of `ninja-game improve`: lead a run to the exit, shorten it, simplify it; and the log of a long search."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from ninja_game.errors import ArgumentError, FileError, NinjaGameError
from ninja_game.files.reading import read_utf8
from ninja_game.files.writing import check_output, write_atomically
from ninja_game.formats.replay.text import Replay
from ninja_game.formats.run_time import time_text
from ninja_game.runs.compare import aligned
from ninja_game.runs.deaths import ending_text
from ninja_game.runs.run import run_level
from ninja_game.search.certificate import smooth_run, verified_run, without_idle_keys
from ninja_game.search.formula.methods import to_exit
from ninja_game.search.solve import solve
from ninja_game.search.task import Report, Task


class SearchLog:
    """The log of a long search: its finds with their seconds, a line each, over all its commands.

    ``starts``: their number; ``seconds_spent``: in all of them. Raises FileError for another file.
    """

    HEAD = "# seconds spent, and what improve found"

    def __init__(self, path: Path, keep: Sequence[Path]) -> None:
        check_output(path, keep=keep)
        if not path.exists():
            write_atomically(path, f"{self.HEAD}\n")
        head, *lines = read_utf8(path, 2**20).splitlines() or [""]
        matches = [re.match(r" *(\d{1,9}) s  ", line) for line in lines]
        if head != self.HEAD or None in matches:
            raise FileError("not the log of a search", str(path), hint="name another file")
        self._path, self._start = path, time.monotonic()
        self.starts = sum(line.endswith("begins") for line in lines)
        self.seconds_spent = max((int(match[1]) for match in matches if match), default=0)
        self.note("begins")

    def note(self, what: str) -> None:
        with self._path.open("a", encoding="utf-8") as out:
            out.write(f"{self.seconds_spent + time.monotonic() - self._start:8.0f} s  {what}\n")


class NoWayError(NinjaGameError):
    """No way to the exit was found from the end of a run."""


@dataclass(frozen=True)
class Improvement:
    """The shortened run. ``gain``: the ticks by which it is shorter than the first one that reached the exit.

    ``same_route``: no other runs were given, and it is always near that one.
    """

    run: Replay
    gain: int
    same_route: bool


def improve(
    task: Task,
    save: Callable[[Replay], None],
    *,
    report: Report | None = None,
    earlier: Sequence[bytes] = (),
    log: SearchLog | None = None,
    price: int | None = None,
) -> Improvement:
    """Shorten ``task.first``; a run that ends before the exit is first led there, in half of the time.

    ``save`` gets the first run to the exit, each better one, and at last the simplified one. ``earlier``: runs that the
    commands of ``log`` have found; it goes on from them, in the time that is left, with another seed. ``price``: as in
    ``simplified_run``. Raises NoWayError, and as ``solve`` does.
    """
    theirs, begun = task.others, list[int]()
    if log and earlier:
        left = max(0.1, task.seconds - log.seconds_spent)
        task = replace(task, others=(*earlier, *theirs), seconds=left, seed=task.seed + log.starts)
    played = run_level(task.level, task.first, body=task.body)
    if played.outcome != "exit":
        known = next(iter(earlier), None)
        first = known or _led_to_exit(task, played.ticks)
        if first is None:
            ends = ending_text(played.outcome, played.ticks - 1, played.death)
            raise NoWayError(f"{ends}; no way to the exit found from there")
        task = replace(task, first=first, others=theirs, seconds=task.seconds if known else task.seconds / 2)

    def keep(run: Replay) -> None:
        begun.append(run.end_tick)
        save(run)
        if log:
            log.note(time_text(run.end_tick))

    run = solve(task, report=report, on_better=keep)
    assert run is not None  # noqa: S101 - the first run is one
    if log:
        log.note("ended")
    run = simplified_run(task, run, price)
    save(run)
    return Improvement(run, begun[0] - run.end_tick, not theirs and _is_same_route(task, run))


def _led_to_exit(task: Task, ticks: int) -> bytes | None:
    """A run to the exit that begins like the task's, which ends after ``ticks``; else another's, or None."""
    begin, half = task.first[:ticks], task.seconds / 2
    way = to_exit(task.level, begin, half, body=task.body, seed=task.seed, threads=task.jobs)
    passing = (keys for keys in task.others if run_level(task.level, keys, body=task.body).outcome == "exit")
    return way or next(passing, None)


def simplified_run(task: Task, run: Replay, price: int | None) -> Replay:
    """The run without keys that do nothing, verified.

    ``price``: also with fewer key changes, at most this many ticks longer and with no less gold.
    """
    inputs = without_idle_keys(task.level, run.inputs, task.first, body=run.body)
    if price is not None:
        inputs = smooth_run(task.level, inputs, body=run.body, gold=run.gold, price=price)
    return verified_run(task.level, inputs, body=run.body, gold=run.gold)


def _is_same_route(task: Task, run: Replay) -> bool:
    """Whether a run is always near the given one, in the same order; False for runs too long to be compared."""
    before, after = (run_level(task.level, keys, body=task.body).positions for keys in (task.first, run.inputs))
    with suppress(ArgumentError):
        return bool((aligned(after, before) >= 0).all())
    return False

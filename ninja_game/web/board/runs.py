"""What a folder of runs comes to: the runs that count, and those that do not, with the reason."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from ninja_game.formats.replay.text import Replay
from ninja_game.player.catalogue import Entry
from ninja_game.runs.archive import verify_all
from ninja_game.runs.chunks import Chunk, Result
from ninja_game.runs.recording_reader import Unreadable
from ninja_game.runs.run import run_level
from ninja_game.runs.verify import Verdict
from ninja_game.web.board.collect import Sent, sent_below
from ninja_game.web.board.copies import Course, course_of, nearest
from ninja_game.web.board.players import Players, player_named
from ninja_game.web.pages.published import PublishedLevels

Key = tuple[str, int]
"""A run's file, as a path in the folder, and its record there."""

Dates = Callable[[Key, str], str]
"""When the board first took in a run, by its key and way: UTC as in 2026-01-31T12:00:00Z, "" where nobody knows."""

_LINE = re.compile(r"^(?=[0-9])")


@dataclass(frozen=True)
class Run:
    """A run that counts, as the simulation says: ``tick`` of the exit contact, ``gold``, ``score`` (ticks).

    ``file``: path in the folder, ``record`` in it; ``added``: as Dates say; ``way``: digest of the ninja's positions;
    ``remark``: what a reader should know.
    """

    file: str
    record: int
    player: str
    entry: Entry = field(repr=False)
    tick: int
    gold: int
    score: int
    added: str
    replay: Replay = field(repr=False)
    way: str = field(repr=False)
    remark: str = ""

    @property
    def key(self) -> Key:
        return self.file, self.record

    @property
    def day(self) -> str:
        """The date of ``added``."""
        return self.added.partition("T")[0]

    @property
    def medal(self) -> str:
        """Its medal, "" for none."""
        return self.entry.pars.medal(self.tick) if self.entry.pars else ""


@dataclass(frozen=True)
class Rejected:
    """A run, or a file, that does not count. ``kind``: "practice", "copy", "refused" or "unreadable".

    ``way``, ``added``: of a copy, as a run has them.
    """

    file: str
    record: int
    kind: str
    why: str
    player: str = ""
    level: str = ""
    way: str = ""
    added: str = ""


@dataclass(frozen=True)
class ValidatedRuns:
    """All of a folder: ``runs`` in the order in which they were added, ``rejected`` by file."""

    runs: tuple[Run, ...]
    rejected: tuple[Rejected, ...]


def judge(
    folder: Path, shown: PublishedLevels, *, dates: Dates | None = None, jobs: int | None = None
) -> ValidatedRuns:
    """Simulate every run below a folder again, on the levels that are shown. Raises OSError.

    ``dates``: those of the board's ledger; without it runs go by the names of their files.
    """
    found = list(sent_below(folder, {digest: entry.named.level for digest, entry in shown.entries.items()}))
    levels = [entry.named for entry in shown.entries.values()]
    results = verify_all((), chunks=[sent.chunk for sent in found], levels=levels, strict=True, jobs=jobs)
    runs: list[Run] = []
    rejected: list[Rejected] = []
    for sent, result in zip(found, results, strict=True):
        if isinstance(result, Verdict) and result.good:
            runs.append(_run(result, sent, shown.entries, dates))
        else:
            rejected.append(_rejected(sent.chunk, result, shown.entries))
    counted, copies = _without_copies(_of_players(sorted(runs, key=_first)))
    return ValidatedRuns(tuple(counted), tuple(sorted([*rejected, *copies], key=lambda each: (each.file, each.record))))


def _first(run: Run) -> tuple[str, Key]:
    """What runs are in order of: the first one owns what it does."""
    return run.added, run.key


def _run(verdict: Verdict, sent: Sent, entries: Mapping[str, Entry], dates: Dates | None) -> Run:
    """A run that counts. What is kept of its text are its inputs alone; all else is what the simulation says."""
    entry = entries[verdict.level_digest]
    replay = Replay(
        sent.inputs(verdict.ticks), verdict.end_tick, verdict.outcome, verdict.gold,
        name=entry.title, level_name=entry.title, level_author=entry.named.author, level=entry.named.level,
    )  # fmt: skip
    key, ended = (verdict.file, verdict.record), (verdict.end_tick, verdict.gold)
    added = dates(key, verdict.xy_sha256) if dates else ""
    return Run(*key, verdict.author, entry, *ended, verdict.score_ticks or 0, added, replay, verdict.xy_sha256)


def _of_players(runs: list[Run]) -> list[Run]:
    """The runs, each of the player that its author is."""
    players = Players()
    found = []
    for run in runs:
        player, remark = players.meet(run.player)
        found.append(replace(run, player=player, remark=remark, replay=replace(run.replay, author=player)))
    return found


def _rejected(chunk: Chunk, result: Result, entries: Mapping[str, Entry]) -> Rejected:
    """What does not count, and why."""
    if isinstance(result, Unreadable):
        return Rejected(chunk.file, chunk.first, "unreadable", _without_name(result.message, chunk.file))
    entry = entries.get(result.level_digest)
    kind = "practice" if result.practice else "refused"
    why = "; ".join(map(str, result.problems))
    return Rejected(chunk.file, result.record, kind, why, player_named(result.author), entry.title if entry else "")


def _without_name(message: str, name: str) -> str:
    """An error's message without the name of its file, which stands beside it.

    >>> _without_name("a.txt:3:1: not a header", "a.txt")
    'line 3:1: not a header'
    """
    for prefix in (f"{name}:", f"{name!a}:"):
        message = message.removeprefix(prefix)
    return _LINE.sub("line ", message.strip())


def _without_copies(runs: list[Run]) -> tuple[list[Run], list[Rejected]]:
    """The runs without those that do what an earlier one does; near copies of an earlier one are marked."""
    on_level: dict[str, list[Run]] = defaultdict(list)
    copies: list[Rejected] = []
    ways: dict[tuple[str, str], Run] = {}
    for run in runs:
        first = ways.setdefault((run.entry.digest, run.way), run)
        if first is run:
            on_level[run.entry.digest].append(run)
        else:
            stolen = first.player != run.player and first.added < run.added
            what = f"a copy of the run by {first.player} in" if stolen else "the same run as"
            why = f"{what} {first.file}"
            copies.append(Rejected(*run.key, "copy", why, run.player, run.entry.title, run.way, run.added))
    kept = [run for level in on_level.values() for run in _remarked(level)]
    return sorted(kept, key=_first), copies


def _remarked(runs: list[Run]) -> list[Run]:
    """The runs of a level, in order, with a remark on each that is near to earlier ones of others alone."""
    if len({run.player for run in runs}) == 1:
        return runs
    found: list[Run] = []
    earlier: list[tuple[Run, Course]] = []
    for run in runs:
        inputs = run.replay.playback(run.tick + 1)
        course = course_of(inputs, run_level(run.entry.named.level, inputs))
        if near := _near_to_another(run.player, course, earlier):
            other, how = near
            said = f"{how} the run by {other.player} in {other.file}"
            found.append(replace(run, remark="; ".join(filter(None, (said, run.remark)))))
        else:
            found.append(run)
        earlier.append((run, course))
    return found


def _near_to_another(player: str, course: Course, earlier: list[tuple[Run, Course]]) -> tuple[Run, str] | None:
    """The earlier run by another player that a run is near to, and how; None where the player's own were before it."""
    until = len(earlier)
    while True:
        others = [(index, its) for index, (run, its) in enumerate(earlier[:until]) if run.player != player]
        closest = nearest(course, [its for _, its in others])
        if closest is None:
            return None
        until = others[closest[0]][0]
        if nearest(course, [its for run, its in earlier[:until] if run.player == player]) is None:
            return earlier[until][0], closest[1]

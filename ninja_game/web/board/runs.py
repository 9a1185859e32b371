"""What a folder of runs comes to: the runs that count, and those that do not, with the reason."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.player.catalogue import Entry
from ninja_game.runs.recording_reader import Unreadable
from ninja_game.runs.verify import Verdict
from ninja_game.verification.chunks import Result
from ninja_game.verification.verify_many import verify_all
from ninja_game.web.board.collect import chunks_below, recordings_in_chunk
from ninja_game.web.board.dates import dates_of
from ninja_game.web.pages.exhibition import Exhibition

UNNAMED = "unnamed"
_LINE = re.compile(r"^(?=[0-9])")
ALIKE = 0.8
"""Share of a run's inputs that are, from the start, those of somebody else's: more is told."""


@dataclass(frozen=True)
class Run:
    """A run that counts, as the simulation says: ``tick`` of the exit contact, ``gold``, ``score`` (ticks).

    ``file``: path in the folder, ``record`` in it; ``added``: when, in seconds since 1970, 0 where nobody knows;
    ``way``: digest of the ninja's positions; ``remark``: what a reader should know.
    """

    file: str
    record: int
    player: str
    entry: Entry = field(repr=False)
    tick: int
    gold: int
    score: int
    added: int
    replay: Replay = field(repr=False)
    way: str = field(repr=False)
    remark: str = ""

    @property
    def key(self) -> tuple[str, int]:
        """Which one it is."""
        return self.file, self.record

    @property
    def medal(self) -> str:
        """Its medal, "" for none."""
        return self.entry.pars.medal(self.tick) if self.entry.pars else ""


@dataclass(frozen=True)
class Apart:
    """A run, or a file, that does not count. ``kind``: "practice", "copy", "refused" or "unreadable"."""

    file: str
    record: int
    kind: str
    why: str
    player: str = ""
    level: str = ""


@dataclass(frozen=True)
class Judged:
    """All of a folder: ``runs`` in the order in which they were added, ``apart`` by file."""

    runs: tuple[Run, ...]
    apart: tuple[Apart, ...]


def judge(folder: Path, shown: Exhibition, *, jobs: int | None = None) -> Judged:
    """Simulate every run below a folder again, on the levels that are shown. Raises OSError."""
    chunks = list(chunks_below(folder, {digest: entry.named.level for digest, entry in shown.entries.items()}))
    recordings = [(chunk.file, each) for chunk in chunks for each in recordings_in_chunk(chunk)]
    levels = [entry.named for entry in shown.entries.values()]
    results = verify_all((), chunks=chunks, levels=levels, strict=True, jobs=jobs)
    added = dates_of(folder, {chunk.file for chunk in chunks})
    found: list[Run] = []
    apart: list[Apart] = []
    for (name, recording), result in zip(recordings, results, strict=True):
        if isinstance(result, Verdict) and recording and result.good:
            found.append(_run(result, recording, shown.entries, added.get(name, 0)))
        else:
            apart.append(_apart(name, result, shown.entries))
    runs, copies = _without_copies(sorted(found, key=lambda run: (run.added, run.key)))
    return Judged(tuple(runs), tuple(sorted([*apart, *copies], key=lambda each: (each.file, each.record))))


def player_named(author: str) -> str:
    """Who an author is on the board: the name in one form, however it was typed.

    >>> player_named("  Ann "), player_named("")
    ('Ann', 'unnamed')
    """
    return " ".join(unicodedata.normalize("NFKC", author).split()) or UNNAMED


def _run(verdict: Verdict, recording: Recording, entries: Mapping[str, Entry], added: int) -> Run:
    """A run that counts. What is kept of its text are its inputs alone; all else is what the simulation says."""
    player, entry = player_named(verdict.author), entries[verdict.level_digest]
    replay = Replay(
        recording.playback(verdict.ticks), verdict.end_tick, verdict.outcome, verdict.gold,
        name=entry.title, author=player, level_name=entry.title, level_author=entry.named.author,
        level=recording.level,
    )  # fmt: skip
    score = verdict.score_ticks or 0
    key, ended = (verdict.file, verdict.record), (verdict.end_tick, verdict.gold)
    return Run(*key, player, entry, *ended, score, added, replay, verdict.xy_sha256)


def _apart(name: str, result: Result, entries: Mapping[str, Entry]) -> Apart:
    """What does not count, and why."""
    if isinstance(result, Unreadable):
        return Apart(name, 0, "unreadable", _without_name(result.message, name))
    entry = entries.get(result.level_digest)
    kind = "practice" if result.practice else "refused"
    why = "; ".join(result.problems)
    return Apart(name, result.record, kind, why, player_named(result.author), entry.title if entry else "")


def _without_name(message: str, name: str) -> str:
    """An error's message without the name of its file, which stands beside it.

    >>> _without_name("a.txt:3:1: not a header", "a.txt")
    'line 3:1: not a header'
    """
    for prefix in (f"{name}:", f"{name!a}:"):
        message = message.removeprefix(prefix)
    return _LINE.sub("line ", message.strip())


def _without_copies(runs: list[Run]) -> tuple[list[Run], list[Apart]]:
    """The runs without those that do what an earlier one does; one that goes most of an earlier one's way is marked."""
    kept: list[Run] = []
    copies: list[Apart] = []
    on_level: dict[str, list[Run]] = defaultdict(list)
    for run in runs:
        earlier = on_level[run.entry.digest]
        first = next((other for other in earlier if other.way == run.way), None)
        if first:
            what = "the same run as" if first.player == run.player else f"a copy of the run by {first.player} in"
            copies.append(Apart(*run.key, "copy", f"{what} {first.file}", run.player, run.entry.title))
            continue
        kept.append(_remarked(run, earlier))
        earlier.append(run)
    return kept, copies


def _remarked(run: Run, earlier: list[Run]) -> Run:
    """The run with a remark where most of its inputs are those of somebody else's run."""
    for other in earlier:
        if other.player != run.player:
            pairs = enumerate(zip(run.replay.inputs, other.replay.inputs, strict=False))
            same = next((tick for tick, (ours, theirs) in pairs if ours != theirs), min(run.tick, other.tick))
            if same >= ALIKE * run.tick:
                remark = f"its first {same} of {run.tick + 1} ticks have the inputs of the run by {other.player}"
                return replace(run, remark=remark)
    return run

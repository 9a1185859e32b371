"""What a folder of runs comes to: the runs that count, and those that do not, with the reason."""

from __future__ import annotations

import re
from collections import defaultdict, deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from hashlib import sha256
from heapq import nsmallest
from itertools import chain, groupby, pairwise
from pathlib import Path
from typing import Any, NamedTuple, get_type_hints

import numpy as np

from ninja_game.budget import RUN_BUDGET, tick_cost
from ninja_game.errors import NinjaGameError
from ninja_game.formats.lines import MOST_NAME
from ninja_game.formats.replay.made import names_of_text, parse_made
from ninja_game.formats.replay.text import INPUTS_AFTER, Replay
from ninja_game.levels.findings import RunProblem, in_run
from ninja_game.player.catalogue import Entry
from ninja_game.runs.archive import Lost, verify_all
from ninja_game.runs.chunks import Chunk, Result
from ninja_game.runs.recording_reader import Unreadable
from ninja_game.runs.run import run_level
from ninja_game.runs.verify import NOT_RUN, Verdict
from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.web.board.collect import RunFolder, Sent, SentFile
from ninja_game.web.board.copies import Course, Courses, course_of
from ninja_game.web.board.players import Players, folded
from ninja_game.web.pages.gallery import PublishedLevels, path_data, shared_text
from ninja_game.web.pages.memo import Memo, digest_of, program

Key = tuple[str, int]
"""A run's file, as a path in the folder, and its record there."""

Dates = Callable[[Key, str], str]
"""When the board first took in a run, by its key and way: UTC as in 2026-01-31T12:00:00Z, "" where nobody knows."""

Rows = dict[tuple[str, Any], dict[str, Any]]

PLAYED, ASSISTED = "played", "assisted"
"""The two ladders; a run of which nobody says how it was made is on the first one."""

MOST_COMPARED = 1000
"""Earlier runs of a level that a new one is compared with: the fastest, which are worth a copy."""

KINDS = {
    "practice": ("of practice", "Practice runs"), "copy": ("copied", "Copies of runs"),
    "refused": ("refused", "Runs that do not count"), "unreadable": ("unreadable", "Files that are not runs"),
}  # fmt: skip
"""Why a run does not count: in a line of a report, and on a page."""

OWN = "own"
"""What a level of an episode is that its player has sent before."""

_LINE = re.compile(r"^(?=[0-9])")


@dataclass(frozen=True)
class Judged:
    """What a recording of a file comes to, as plain values that can be remembered.

    ``kind``: "" for a run that counts, else as in Rejected, with ``why``; ``level``: its digest; ``way``: digest of the
    ninja's positions; ``presses``: keys pressed, ``jumps`` of them; the rest: as of Verdict.
    """

    record: int
    kind: str
    why: str = ""
    author: str = ""
    level: str = ""
    tick: int = -1
    gold: int = 0
    score: int = 0
    way: str = ""
    presses: int = 0
    jumps: int = 0
    made: str = ""
    assisted: bool | None = None
    co_authors: str = ""
    episode: str = ""


_TYPES = tuple(get_type_hints(Judged).values())


class JudgedFile(NamedTuple):
    """A file of the folder. ``sent``: what is simulated of it now; ``rows``: what it comes to."""

    name: str
    digest: str
    stamp: list[int]
    sent: list[Sent]
    rows: list[Judged]


class Ledger(NamedTuple):
    """What a board knew before: ``runs`` and what was ``rejected`` by file and record.

    ``withdrawn``: by level and way the runs that counted once, and are not there now or do not count.
    """

    runs: Rows
    rejected: Rows
    withdrawn: Rows

    @property
    def owners(self) -> Rows:
        """By level and way the row of who did it first; it may have ``near`` and ``confirmed``, as a run has."""
        return self.withdrawn | {(row["level"], row["way"]): row for row in self.runs.values()}


NO_LEDGER = Ledger({}, {}, {})


@dataclass(frozen=True, kw_only=True)
class Run(Judged):
    """A run that counts, as the simulation says: ``tick`` of the exit contact, ``gold``, ``score`` (ticks).

    ``file``: path in the folder, ``record`` in it; ``added``: as Dates say; ``remark``: what a reader should know;
    ``near``: whose it nearly is, in words, where nobody has ``confirmed`` it: it leads no table; ``again``: it was
    withdrawn, and is the first of its moment; ``digest``: of its file.
    """

    file: str
    player: str
    entry: Entry = field(repr=False)
    added: str
    digest: str = field(repr=False)
    folder: RunFolder = field(repr=False, compare=False)
    remark: str = ""
    near: str = ""
    confirmed: bool = False
    again: bool = False

    @cached_property
    def key(self) -> Key:
        return self.file, self.record

    @property
    def day(self) -> str:
        """The date of ``added``."""
        return self.added.partition("T")[0]

    @property
    def moment(self) -> str:
        """The date of ``added`` with the time of day."""
        return self.added and f"{self.added[:16].replace('T', ' ')} UTC"

    @property
    def ladder(self) -> str:
        """Where it is ranked."""
        return ASSISTED if self.assisted else PLAYED

    @cached_property
    def medal(self) -> str:
        """Its medal, "" for none."""
        return self.entry.pars.medal(self.tick) if self.entry.pars else ""

    @property
    def inputs(self) -> bytes:
        """Its inputs, read again. Raises FileError where the file was changed since."""
        return self.folder.inputs(self.file, self.record, self.digest, self.tick + 1)

    @property
    def path(self) -> str:
        """Its path over the level, as ``path_data``."""
        drawn = self.folder.drawn.get(self.key)
        return drawn or path_data(run_level(self.entry.named.level, self.inputs).positions)

    @property
    def replay(self) -> Replay:
        """Its ``inputs``, and what the simulation says."""
        named = self.entry.named
        return Replay(
            self.inputs, self.tick, "exit", self.gold, name=self.entry.title, author=self.player,
            level_name=self.entry.title, level_author=named.author, level=named.level, made=parse_made(self.made),
            co_authors=names_of_text(self.co_authors),
        )  # fmt: skip


@dataclass(frozen=True)
class Rejected:
    """A run, or a file, that does not count. ``kind``: one of KINDS.

    ``way``, ``added``: of a copy, as a run has them; ``first``: the run that it copies.
    """

    file: str
    record: int
    kind: str
    why: str
    player: str = ""
    level: str = ""
    way: str = ""
    added: str = ""
    first: Key | None = None


@dataclass(frozen=True)
class ValidatedRuns:
    """All of a folder: ``runs`` in the order in which they were added, ``rejected`` by file.

    ``again``: levels of episodes that do what an earlier run by the same player does, of kind OWN: neither of the two;
    ``episodes``: by key the runs of whole episodes, each a run for each of its levels; ``alike``: by player who was
    there before and has a name that looks like theirs.
    """

    runs: tuple[Run, ...]
    rejected: tuple[Rejected, ...]
    again: tuple[Rejected, ...] = ()
    alike: Mapping[str, str] = field(default_factory=dict)
    episodes: Mapping[str, list[list[Run]]] = field(default_factory=dict)


def judge(
    folder: Path, shown: PublishedLevels, *, dates: Dates | None = None, jobs: int | None = None,
    memo: Memo | None = None, ledger: Ledger = NO_LEDGER,
) -> ValidatedRuns:  # fmt: skip
    """Simulate every run below a folder again, on the levels that are shown. Raises OSError.

    ``dates``: those of the board's ``ledger``; without it runs go by the names of their files. ``memo``: what was found
    out before, of the same files, levels and rules; it is not simulated again.
    """
    memo = memo or Memo()
    sent = RunFolder(folder, {digest: entry.named.level for digest, entry in shown.entries.items()})
    runs: list[Run] = []
    rejected: list[Rejected] = []
    players, owners = Players(), ledger.owners
    for file in _Judging(sent, shown, memo).files(jobs):
        for row in file.rows:
            entry = shown.entries.get(row.level)
            if row.kind or entry is None:
                title = entry.title if entry else ""
                rejected.append(Rejected(file.name, row.record, row.kind, row.why, row.author, title))
                continue
            added = dates((file.name, row.record), row.way) if dates else ""
            runs.append(_run(file, row, entry, sent, added))
    known = {(run.level, run.way, run.added) for run in runs}
    for number, run in enumerate(runs):
        # A run that was withdrawn, or comes in another file, is still its player's.
        owner = owners.get(way := (run.level, run.way))
        if owner and (*way, owner["added"]) not in known and folded(owner["player"]) == folded(run.player):
            runs[number] = replace(run, added=owner["added"], again=True)
    told = _of_players(sorted(runs, key=_first), players)
    counted, copies = _without_copies(told, memo, owners)
    counted = [_with_row(run, owners.get((run.level, run.way), {})) for run in counted]
    named = [
        each if each.kind == "unreadable" else replace(each, player=players.meet(each.player)[0]) for each in rejected
    ]
    others = sorted([*named, *copies], key=lambda each: (each.file, each.record))
    refused, again = (tuple(each for each in others if (each.kind == OWN) is own) for own in (False, True))
    return ValidatedRuns(tuple(counted), refused, again, players.alike, _episodes(told, counted, shown))


def _episodes(runs: list[Run], counted: list[Run], shown: PublishedLevels) -> dict[str, list[list[Run]]]:
    """By key the runs of whole episodes: every level's counts, or does what another run by the same player does."""
    lengths = {each.key: len(each.levels) for each in shown.levels.episodes.values()}
    ways = {(run.player, run.level, run.way): run for run in counted}
    files: dict[tuple[str, str], list[Run]] = defaultdict(list)
    for run in sorted(runs, key=lambda each: each.key):
        if run.episode and (own := ways.get((run.player, run.level, run.way))):
            files[run.episode, run.file].append(own)
    found: dict[str, list[list[Run]]] = defaultdict(list)
    for (key, _), whole in files.items():
        if len(whole) == lengths[key] and len({run.player for run in whole}) == 1:
            found[key].append(whole)
    return found


class _Judging:
    """Judges the files of a folder; what the memo knows of them is not simulated again."""

    def __init__(self, folder: RunFolder, shown: PublishedLevels, memo: Memo) -> None:
        self._folder, self._shown, self._memo = folder, shown, memo
        self._episodes = {each.key: each.levels for each in shown.levels.episodes.values()}
        # Twice as long as a run can be that is in time.
        longest = [
            2 * (LIFETIME + GOLD_BONUS * sum(each.all_gold for each in row)) * tick_cost(entry.named.level)
            for row in [*self._episodes.values(), *([each] for each in shown.entries.values())]
            for entry in row
        ]
        self._budget = min(RUN_BUDGET, max(longest, default=RUN_BUDGET))
        self._context = digest_of([program(), self._budget, sorted(shown.entries), sorted(self._episodes)])
        self._waiting: deque[JudgedFile] = deque()

    def files(self, jobs: int | None) -> Iterator[JudgedFile]:
        """All files, in order, simulated where the memo does not know them."""
        levels, results = [entry.named for entry in self._shown.entries.values()], list[Result]()
        for result in verify_all(
            (), chunks=self._chunks(), levels=levels, episodes=self._episodes, strict=True, jobs=jobs,
            budget=self._budget,
        ):  # fmt: skip
            while not self._waiting[0].sent:
                yield self._waiting.popleft()
            file = self._waiting[0]
            results.append(result)
            if len(results) == len(file.sent):
                file.rows.extend(self._row(file, *each) for each in zip(file.sent, results, strict=True))
                if not any(isinstance(each, Lost) for each in results):
                    self._memo.note(
                        file.name,
                        [self._context, file.stamp, file.digest, [[*vars(row).values()] for row in file.rows]],
                    )
                results.clear()
                yield self._waiting.popleft()
        yield from self._waiting

    def _chunks(self) -> Iterator[Chunk]:
        """What is to be simulated; the files, those that the memo knows too, wait for their turn."""
        for name, why in self._folder.files():
            self._waiting.append(file := self._file(name, why))
            yield from (each.chunk for each in file.sent)

    def _file(self, name: str, why: str) -> JudgedFile:
        """A file as the memo knows it, else with what is sent in it. ``why``: it is left out."""
        # The stamp comes first: a file that is changed after it is read again the next time.
        stamp = [] if why else self._folder.stamp(name)
        noted = self._memo.recall(name)
        context, seen, digest, rows = noted if isinstance(noted, list) and len(noted) == 4 else ("", [], "", [])
        known = _known(rows, self._shown) if context == self._context else []
        if known and stamp and stamp == seen:
            return JudgedFile(name, digest, stamp, [], known)
        file = SentFile(name, problem=why) if why else self._folder.file(name)
        if known and digest == file.digest:
            self._memo.note(name, [context, stamp, digest, rows])
            return JudgedFile(name, digest, stamp, [], known)
        return JudgedFile(name, file.digest, stamp, self._folder.recordings(file), [])

    def _row(self, file: JudgedFile, sent: Sent, result: Result) -> Judged:
        """What is kept of a recording; one that cannot be written as pages have it is unreadable."""
        row = _row(sent, result, self._folder)
        entry = self._shown.entries.get(row.level)
        if entry and not row.kind:
            try:
                # Its inputs were read from a text, and can be written into one.
                shared_text(replace(_run(file, row, entry, self._folder).replay, inputs=b""), entry.named.level)
            except (NinjaGameError, ValueError) as error:
                return Judged(row.record, "unreadable", str(error))
        return row


def _known(noted: Any, shown: PublishedLevels) -> list[Judged]:
    """The recordings of a file as a memo has them; none where that is not what was noted there."""
    with suppress(TypeError, ValueError):
        rows = [Judged(*row) for row in noted]
        for row in rows:
            known = row.kind in KINDS if row.kind else row.level in shown.entries
            if not known or not all(map(isinstance, vars(row).values(), _TYPES)):
                return []
            parse_made(row.made)
        return rows
    return []


def _run(file: JudgedFile, row: Judged, entry: Entry, folder: RunFolder, added: str = "") -> Run:
    return Run(
        **vars(row), file=file.name, player=row.author, entry=entry, added=added, digest=file.digest, folder=folder
    )


def _first(run: Run) -> tuple[str, bool, bool, Key]:
    """What runs are in order of: the first one owns what it does. A level of an episode comes after single runs."""
    return run.added, not run.again, bool(run.episode), run.key


def _with_row(run: Run, row: Mapping[str, Any]) -> Run:
    """A run with what only its row of the ledger tells: it is confirmed, or near to one that may be gone."""
    if row.get("confirmed") is True:
        return replace(run, near="", confirmed=True)
    if not run.near and (near := row.get("near")):
        return replace(run, near=near, remark="; ".join(filter(None, (f"{near} (found earlier)", run.remark))))
    return run


def _row(sent: Sent, result: Result, folder: RunFolder) -> Judged:
    """What is kept of a recording."""
    if not isinstance(result, Unreadable) and not sent.replay and not result.made:
        # A record of N names who made the level, and nobody who played; one of ours says how it was made, too.
        place = result.file + f", record {result.record}" * (result.record > 0)
        result = replace(result, author=f"unknown ({place[-MOST_NAME // 2 :]})")
    if isinstance(result, Unreadable):
        why = _without_name(result.message, sent.chunk.file).partition("; --budget")[0]  # which a board has not
        return Judged(sent.chunk.first, "unreadable", why)
    problems = [_worded(each, result, sent) for each in result.problems]
    if sent.claimed >= 0 and result.outcome != NOT_RUN:
        other = in_run("other-end", tick=result.ticks - 1, outcome=result.outcome, claimed=sent.claimed)
        problems = [str(other) if result.end_tick != sent.claimed else INPUTS_AFTER]
    if problems:
        why = "; ".join(problems)
        kind = "practice" if result.practice else "refused"
        return Judged(result.record, kind, why, result.author, result.level_digest)
    inputs = folder.known[result.file, result.record] = sent.inputs(result.ticks)
    pressed = [new & ~old & KEYS_DOWN for old, new in pairwise(b"\0" + inputs)]
    jumps = sum(bool(keys & JUMP_HELD) for keys in pressed)
    return Judged(
        result.record, "", "", result.author, result.level_digest, result.end_tick, result.gold,
        result.score_ticks or 0, result.xy_sha256, sum(map(int.bit_count, pressed)), jumps,
        result.made, result.assisted, result.co_authors, result.episode,
    )  # fmt: skip


def _worded(problem: RunProblem, result: Verdict, sent: Sent) -> str:
    """A problem in the words of people who send runs."""
    if problem.code == "not-strict" and result.practice and str(problem).startswith("practice"):
        return f"it was {result.made}: runs with such help do not count"
    if problem.code == "other-level" and sent.replay and sent.replay.level_name:
        name, digest = sent.replay.level_name, result.level_digest[:16]
        return f"{name!r} is not one of the levels that count; its level_digest begins with {digest}"
    return str(problem)


def _of_players(runs: list[Run], players: Players) -> list[Run]:
    """The runs, each of the player that its author is."""
    found = []
    for run in runs:
        player, remark = players.meet(run.player)
        same = player == run.player and not remark
        found.append(run if same else replace(run, player=player, remark=remark))
    return found


def _without_name(message: str, name: str) -> str:
    """An error's message without the name of its file, which stands beside it.

    >>> _without_name("a.txt:3:1: not a header", "a.txt")
    'line 3:1: not a header'
    """
    for prefix in (f"{name}:", f"{name!a}:"):
        message = message.removeprefix(prefix)
    return _LINE.sub("line ", message.strip())


def _without_copies(runs: list[Run], memo: Memo, owners: Rows) -> tuple[list[Run], list[Rejected]]:
    """The runs without those that do what an earlier one does, and those; near copies of an earlier one are marked.

    ``owners``: as of Ledger.
    """
    on_level: dict[str, list[Run]] = defaultdict(list)
    copies: list[Rejected] = []
    ways: dict[tuple[str, str], Run] = {}
    for run in runs:
        way = run.level, run.way
        owner = owners.get(way)
        if owner and way not in ways and owner["added"] < run.added:
            why = f"a copy of an earlier run by {owner['player']}, which was withdrawn or does not count any more"
            copies.append(Rejected(*run.key, "copy", why, run.player, run.entry.title, run.way, run.added))
            continue
        first = ways.setdefault(way, run)
        if first is run:
            on_level[run.level].append(run)
        else:
            stolen = first.player != run.player and first.added < run.added
            what = f"a copy of the run by {first.player} in" if stolen else "the same run as"
            why, kind = f"{what} {first.file}", OWN if run.episode and first.player == run.player else "copy"
            copies.append(Rejected(*run.key, kind, why, run.player, run.entry.title, run.way, run.added, first.key))
    kept = [run for level in on_level.values() for run in _remarked(level, memo, owners)]
    return sorted(kept, key=_first), copies


def _remarked(runs: list[Run], memo: Memo, owners: Rows) -> Iterator[Run]:
    """The runs of a level, in order, with a remark on each that is near to earlier ones of others alone.

    One that is near as its row says, and to none before it, waits until the others of its moment are compared: what it
    is near to may have come back since, in a file with a later name.
    """
    if len({run.player for run in runs}) == 1:
        yield from runs
        return
    compared = _Compared(runs[0].level, memo)
    for _, moment in groupby(runs, key=lambda run: run.added):
        waiting: list[Run] = []
        for run, waits in chain(((run, True) for run in moment), ((run, False) for run in waiting)):
            said = compared.near(run)
            if waits and not said and owners.get((run.level, run.way), {}).get("near"):
                waiting.append(run)
                continue
            compared.add(run)
            yield replace(run, remark="; ".join(filter(None, (said, run.remark))), near=said) if said else run


class _Compared:
    """The runs of a level that were compared so far. What is near to them is remembered, and not compared again."""

    def __init__(self, level: str, memo: Memo) -> None:
        self._memo = memo
        self._key = digest_of([program(), level])
        self._runs: list[Run] = []
        self._courses, self._known = Courses(MOST_COMPARED), 0
        self._last: tuple[Key, Course] | None = None

    def _key_of(self, run: Run) -> str:
        """A remark depends on the run, on all earlier runs of the level, and on nothing else."""
        return sha256(f"{self._key} {run.digest} {run.record} {run.player}".encode("utf-8", "replace")).hexdigest()

    def add(self, run: Run) -> None:
        self._key = self._key_of(run)
        self._runs.append(run)

    def near(self, run: Run) -> str:
        """Whose a run nearly is, of those before, in words; "" for that of no other player."""
        said = self._memo.recall(key := self._key_of(run))
        if not isinstance(said, str):
            before = range(self._known, len(self._runs))
            for number in sorted(nsmallest(MOST_COMPARED, before, key=lambda each: self._runs[each].tick)):
                self._courses.add(number, self._runs[number].tick, partial(self._course, self._runs[number]))
            self._known = len(self._runs)
            course = self._course(run, new=True)
            near = _near_to_another(run.player, course, self._courses, [each.player for each in self._runs])
            said = f"{near[1]} the run by {self._runs[near[0]].player} in {self._runs[near[0]].file}" if near else ""
            self._memo.note(key, said)
        return said

    def _course(self, run: Run, *, new: bool = False) -> Course:
        """What tells whether a run is near to others. ``new``: its page is made, and shows its path."""
        if self._last is None or self._last[0] != run.key:
            inputs = run.inputs
            found = run_level(run.entry.named.level, inputs)
            if new:
                run.folder.drawn[run.key] = path_data(found.positions)
            self._last = run.key, course_of(inputs, found)
        return self._last[1]


def _near_to_another(player: str, course: Course, earlier: Courses, players: Sequence[str]) -> tuple[int, str] | None:
    """Which run by another player a run is nearest to, and how, of those before the player's own first near one.

    ``players``: of the earlier runs.
    """
    numbers = earlier.numbers
    own = np.array([players[number] == player for number in numbers.tolist()], bool)
    near, until = earlier.near(course), len(players)
    for _ in range(2):  # inputs are aligned only where nothing else is near
        until = min(near(own & (numbers < until))[0], default=until)
    others, said = near(~own & (numbers < until))
    return (others[0], said) if others else None

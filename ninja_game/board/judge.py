"""Judges a folder of runs: simulates all, finds copies, tells players apart."""

from __future__ import annotations

import re
from collections import Counter, defaultdict, deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import compress, count, pairwise, starmap
from pathlib import Path
from typing import Any, NamedTuple, get_type_hints

from ninja_game.board.collect import RunFolder, Submission, SubmittedFile
from ninja_game.board.copies import without_copies
from ninja_game.board.memo import Memo, program, values_digest
from ninja_game.board.players import UNNAMED, Players, folded
from ninja_game.board.runs import (
    ASSISTED,
    NO_LEDGER,
    OWN,
    PLAYED,
    REJECTED_KINDS,
    UNKNOWN_PLAYER,
    Dates,
    Judged,
    Ledger,
    RejectedRun,
    Run,
    RunRows,
    ValidatedRuns,
)
from ninja_game.budget import RUN_BUDGET, tick_cost
from ninja_game.errors import NinjaGameError
from ninja_game.formats.lines import MAX_NAME
from ninja_game.formats.n14.demo import parse_demo
from ninja_game.formats.replay.provenance import parse_provenance
from ninja_game.formats.replay.text import INPUTS_AFTER, shared_text
from ninja_game.levels.episodes import Entry
from ninja_game.levels.findings import RunProblem, run_problem
from ninja_game.levels.published import PublishedLevels
from ninja_game.runs.archive import Lost, verify_all
from ninja_game.runs.chunks import Chunk, Result
from ninja_game.runs.recording_reader import Unreadable
from ninja_game.runs.verify import NOT_RUN, Verdict, not_strict
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, KEYS_DOWN, MOVES, fit_demo, with_press_bits
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME

_LINE = re.compile(r"^(?=[0-9])")

ADVICE = "a key is pressed in the tick in which it goes down, and in no other"

_STRICT_TEXTS = {
    "body": "the {body} body does not count here",
    "outcome": "only runs that reach the exit count",
    "in_time": "it takes longer than the level gives",
}
"""The message to the sender of a run that breaks a demand, by field of STRICT."""

_TYPES = tuple(get_type_hints(Judged).values())


class JudgedFile(NamedTuple):
    """A file of the folder."""

    name: str
    digest: str
    stamp: list[int]
    submissions: list[Submission]  #: the runs to simulate now
    rows: list[Judged]  #: the file's results


class Keeping(NamedTuple):
    """How a board is kept: what its keeper has recorded, and decides now."""

    ledger: Ledger = NO_LEDGER
    dates: Dates | None = None  #: ``added`` of a Run, by the ledger; without it runs go by the names of their files
    taken: Dates | None = None  #: ``taken`` of a Run, by the ledger
    #: Writes decisions on these runs, of these files, into the ledger
    decide: Callable[[Sequence[Run], Collection[str]], object] | None = None
    confirm: Collection[str] = ()  #: files whose runs wait no longer
    unknown: str = PLAYED  #: as in BoardRules, unless the keeper has decided


def judge(
    folder: Path,
    shown: PublishedLevels,
    keeping: Keeping = Keeping(),  # noqa: B008 - it is frozen
    *,
    jobs: int | None = None,
    memo: Memo | None = None,
) -> ValidatedRuns:
    """Simulate every run below a folder again, on the board's levels. Raises OSError.

    ``memo``: results of earlier commands on the same files, levels and rules; they save simulations.
    """
    memo, players = memo or Memo(), Players()
    ledger = keeping.ledger
    judging = _Judging(RunFolder(folder, {key: entry.named.level for key, entry in shown.entries.items()}), shown, memo)
    valid, invalid = _parted(judging.run(file, row) for file in judging.files(jobs) for row in file.rows)
    dated = [_dated(run, keeping.dates, keeping.taken) for run in valid]
    if keeping.decide:
        keeping.decide(dated, {run.file for run in dated} | {item.file for item in invalid})
    owners = ledger.owners
    possible, impossible = _parted(_possible(run, ledger, keeping.unknown) for run in dated)
    in_order = sorted(_with_first_dates(possible, owners), key=lambda run: run.order)
    credited, moderated = _parted(run.decided_by(ledger.decision(run)) for run in _of_players(in_order, players))
    unique, copies = without_copies(credited, memo, owners)
    recorded = [_with_row(run, ledger, owners.get((run.level, run.way), {})) for run in unique]
    counted = tuple(_with_untrusted_marks(recorded, ledger, keeping.confirm))
    named = (_named(item, players) for item in invalid + impossible)
    others = sorted([*named, *moderated, *copies], key=lambda item: (item.file, item.record))
    rejected, repeated = (tuple(item for item in others if (item.kind == OWN) is own) for own in (False, True))
    return ValidatedRuns(counted, rejected, repeated, players.alike, _episodes(credited, counted, shown))


def _parted(items: Iterable[Run | RejectedRun]) -> tuple[list[Run], list[RejectedRun]]:
    """The runs that count so far, and those that do not."""
    items = [*items]
    return [run for run in items if isinstance(run, Run)], [item for item in items if isinstance(item, RejectedRun)]


def _dated(run: Run, dates: Dates | None, taken: Dates | None) -> Run:
    """The run with its dates in the ledger."""
    added, later = (of_run(run.key, run.way) if of_run else "" for of_run in (dates, taken))
    return replace(run, added=added, taken=later)


def _possible(run: Run, ledger: Ledger, unknown: str) -> Run | RejectedRun:
    """The run, on the ladder ``unknown`` if it does not say how it was made and nobody has decided.

    It is rejected if no keyboard can do it, unless it is on the assisted ladder.
    """
    decision = ledger.decision(run)
    if not decision and run.assisted is None and unknown == ASSISTED:
        return replace(run, kind="", assisted=True)
    return run if not run.kind or (decision and decision.what != PLAYED) else run.rejected(run.kind, run.why)


def _with_first_dates(runs: Sequence[Run], owners: RunRows) -> Iterator[Run]:
    """The runs with their first dates: a run that was withdrawn, or is in another file now, keeps its player's date."""
    ways = {(run.level, run.way, run.added) for run in runs}
    for run in runs:
        owner = owners.get(way := (run.level, run.way))
        if owner and (*way, owner["added"]) not in ways and folded(owner["player"]) == folded(run.player):
            yield replace(run, added=owner["added"], taken=owner.get("taken", ""), again=True)
        else:
            yield run


def _of_players(runs: Iterable[Run], players: Players) -> Iterator[Run]:
    """The runs, each assigned to its author's player."""
    for run in runs:
        player, mark = players.meet(run.player)
        yield replace(run.marked(mark), player=player)


def _named(item: RejectedRun, players: Players) -> RejectedRun:
    """A run that does not count, assigned to its author's player if it has one."""
    return item if item.kind == "unreadable" else replace(item, player=players.meet(item.player)[0])


def _episodes(runs: list[Run], counted: Sequence[Run], shown: PublishedLevels) -> dict[str, list[list[Run]]]:
    """The runs of whole episodes by key: every level's run counts, or repeats another run by the same player."""
    lengths = {episode.key: len(episode.levels) for episode in shown.levels.episodes.values()}
    ways = {(run.player, run.level, run.way): run for run in counted}
    files: dict[tuple[str, str], list[Run]] = defaultdict(list)
    for run in sorted(runs, key=lambda run: run.key):
        if run.episode and (own := ways.get((run.player, run.level, run.way))):
            files[run.episode, run.file].append(own)
    whole: dict[str, list[list[Run]]] = defaultdict(list)
    for (key, _), levels in files.items():
        if len(levels) == lengths[key] and len({run.player for run in levels}) == 1:
            whole[key].append(levels)
    return whole


class _Judging:
    """Judges the files of a folder, except those in the memo."""

    def __init__(self, folder: RunFolder, shown: PublishedLevels, memo: Memo) -> None:
        self._folder, self._shown, self._memo = folder, shown, memo
        self._episodes = {episode.key: episode.levels for episode in shown.levels.episodes.values()}
        # Twice as long as a run within the time can be.
        longest = []
        for levels in [*self._episodes.values(), *([entry] for entry in shown.entries.values())]:
            ticks = 2 * (LIFETIME + GOLD_BONUS * sum(entry.all_gold for entry in levels))
            longest += [ticks * tick_cost(entry.named.level) for entry in levels]
        self._budget = min(RUN_BUDGET, max(longest, default=RUN_BUDGET))
        self._context = values_digest([program(), self._budget, sorted(shown.entries), sorted(self._episodes)])
        self._waiting: deque[JudgedFile] = deque()

    def files(self, jobs: int | None) -> Iterator[JudgedFile]:
        """All files, in order, simulated unless the memo knows them."""
        levels, results = [entry.named for entry in self._shown.entries.values()], list[Result]()
        for result in verify_all(
            (),
            chunks=self._chunks(),
            levels=levels,
            episodes=self._episodes,
            strict=True,
            jobs=jobs,
            budget=self._budget,
        ):
            while not self._waiting[0].submissions:
                yield self._waiting.popleft()
            file = self._waiting[0]
            results.append(result)
            if len(results) == len(file.submissions):
                file.rows.extend(starmap(partial(self._row, file), zip(file.submissions, results, strict=True)))
                if not any(isinstance(judged, Lost) for judged in results):
                    self._note(file.name, file.stamp, file.digest, [*map(vars, file.rows)])
                results.clear()
                yield self._waiting.popleft()
        yield from self._waiting

    def _chunks(self) -> Iterator[Chunk]:
        """The chunks to simulate; the files, those in the memo too, wait in order."""
        for name, why in self._folder.files():
            self._waiting.append(file := self._file(name, why))
            yield from (submission.chunk for submission in file.submissions)

    def _file(self, name: str, why: str) -> JudgedFile:
        """A file of the memo, else with the runs in it. ``why``: the reason if it is left out."""
        # The stamp is taken first: a file that is changed after it is read again the next time.
        stamp = [] if why else self._folder.stamp(name)
        entry = self._memo.recall(name)
        entry = entry if isinstance(entry, dict) and entry.get("context") == self._context else {}
        digest, rows = str(entry.get("digest")), entry.get("rows", [])
        results = _known(rows, self._shown)
        if results and stamp and stamp == entry.get("stamp"):
            return JudgedFile(name, digest, stamp, [], results)
        file = SubmittedFile(name, problem=why) if why else self._folder.file(name)
        if results and digest == file.digest:
            self._note(name, stamp, digest, rows)
            return JudgedFile(name, digest, stamp, [], results)
        return JudgedFile(name, file.digest, stamp, self._folder.recordings(file), [])

    def _note(self, name: str, stamp: list[int], digest: str, rows: list[dict[str, Any]]) -> None:
        self._memo.note(name, {"context": self._context, "stamp": stamp, "digest": digest, "rows": rows})

    def _row(self, file: JudgedFile, submission: Submission, result: Result) -> Judged:
        """The row of a recording; it is unreadable if pages cannot hold it."""
        row = _row(submission, result, self._folder)
        entry = self._shown.entries.get(row.level)
        if entry and row.way:
            try:
                # Its inputs were read from a text, and can be written into one.
                shared_text(replace(self._run(file, row, entry).replay, inputs=b""), entry.named.level)
            except (NinjaGameError, ValueError) as error:
                return Judged(record=row.record, kind="unreadable", why=str(error))
        return row

    def run(self, file: JudgedFile, row: Judged) -> Run | RejectedRun:
        """The run of a row, without a date; rejected if it does not count, whatever the keeper decides."""
        entry = self._shown.entries.get(row.level)
        if entry and (row.way or not row.kind):
            return self._run(file, row, entry)
        return RejectedRun(file.name, row.record, row.kind, row.why, row.author, entry.title if entry else "")

    def _run(self, file: JudgedFile, row: Judged, entry: Entry) -> Run:
        values = vars(row) | {"file": file.name, "digest": file.digest, "player": row.author, "folder": self._folder}
        return Run(**values, marks=(row.mark,) if row.mark else (), entry=entry, added="")


def _known(rows: Any, shown: PublishedLevels) -> list[Judged]:
    """The recordings of a file in the memo, from their fields; none if a row is invalid."""
    with suppress(TypeError, ValueError):
        recordings = [Judged(**row) for row in rows]
        for row in recordings:
            is_valid = row.kind in REJECTED_KINDS if row.kind else row.level in shown.entries
            if not is_valid or not all(map(isinstance, vars(row).values(), _TYPES)):
                return []
            parse_provenance(row.made)
        return recordings
    return []


def _with_row(run: Run, ledger: Ledger, owner: Mapping[str, Any]) -> Run:
    """A run with the ledger's facts about it: whether it is confirmed, and the run that it nearly copies.

    ``owner``: the row of the player who was first; if several were first together, the row of its own file counts.
    """
    own = ledger.runs.get(run.key, {})
    row = own if own.get("way") == run.way else owner
    if row.get("confirmed") is True:
        return run.now_confirmed
    if not run.near and not run.derived and (near := row.get("near")):
        return replace(run.marked(f"{near} (found earlier)"), near=near)
    return run


def _with_untrusted_marks(runs: Sequence[Run], ledger: Ledger, confirm: Collection[str]) -> Iterator[Run]:
    """The runs with a mark on those from another folder than their player's own, until one from there is confirmed.

    A folder is a player's own if most of its runs are by that player. A marked run waits, unless the ledger has it
    without a mark or it is of its player's first moment.
    """
    first: dict[str, str] = {}
    for run in runs:
        first[run.player] = min(run.moved_in, first.get(run.player, run.moved_in))

    def is_questioned(run: Run) -> bool:
        row = ledger.runs.get(run.key, {})
        return bool(row.get("untrusted")) if row.get("way") == run.way else run.moved_in > first[run.player]

    settled = [run for run in runs if run.confirmed or not is_questioned(run)]
    sizes = Counter(run.sender for run in settled)
    numbers = Counter((run.sender, run.player) for run in settled).most_common()
    homes = {player: sender for (sender, player), number in reversed(numbers) if sender and 2 * number > sizes[sender]}
    trusted = {(run.sender, run.player) for run in runs if run.confirmed or run.file in confirm}
    for run in runs:
        home = homes.get(run.player, run.sender)
        if run.file in confirm and (run.near or home != run.sender):
            yield run.now_confirmed
        elif home != run.sender and (run.sender, run.player) not in trusted:
            why = f"the other runs by {run.player} are from {home}/"
            yield replace(run.marked(why), untrusted=why if is_questioned(run) else "")
        else:
            yield run


def _row(submission: Submission, result: Result, folder: RunFolder) -> Judged:
    if isinstance(result, Unreadable):
        why = _without_name(result.message, submission.chunk.file)
        return Judged(record=submission.chunk.first, kind="unreadable", why=why)
    if folded(result.author) == UNNAMED or (not submission.replay and not result.made):
        # A record of N names the level's author, not the player; a replay of ours also says how it was made.
        place = result.file + (f", record {result.record}" if result.record > 0 and not result.episode else "")
        result = replace(result, author=f"{UNKNOWN_PLAYER}{place[-MAX_NAME // 2 :]})")
    no_keyboard = not_strict(result, "possible_by_keyboard")
    mark = _impossible(result, submission) if no_keyboard in result.problems else ""
    body = not_strict(result, "body")  # all else that is wrong follows from it
    wrong = [body] if body in result.problems else result.problems
    problems = [_problem_text(problem, result, submission) for problem in wrong if problem != no_keyboard]
    if submission.claimed >= 0 and result.outcome != NOT_RUN:
        other = run_problem("other-end", tick=result.ticks - 1, outcome=result.outcome, claimed=submission.claimed)
        problems = [str(other) if result.end_tick != submission.claimed else INPUTS_AFTER]
    if problems:
        why = "; ".join([*problems, mark, ADVICE] if mark else problems)
        kind = "practice" if result.practice else "refused"
        return Judged(record=result.record, kind=kind, why=why, author=result.author, level=result.level_digest)
    inputs = folder.known[result.file, result.record] = submission.inputs(result.ticks)
    pressed = [new & ~old & KEYS_DOWN for old, new in pairwise(b"\0" + inputs)]
    jumps = sum(bool(keys & JUMP_HELD) for keys in pressed)
    # What a tool made needs no keyboard: it is marked. Whether another one was made so is the keeper's decision.
    kind, why = ("refused", f"{mark}; {ADVICE}") if mark and not result.assisted else ("", "")
    return Judged(
        record=result.record, kind=kind, why=why, author=result.author, level=result.level_digest,
        tick=result.end_tick, gold=result.gold, score=result.score_ticks or 0, way=result.xy_sha256,
        presses=sum(map(int.bit_count, pressed)), jumps=jumps, made=result.made, assisted=result.assisted,
        co_authors=result.co_authors, episode=result.episode, mark=mark,
    )  # fmt: skip


def _problem_text(problem: RunProblem, result: Verdict, submission: Submission) -> str:
    """A problem in words for the sender of a run."""
    if result.practice and problem == not_strict(result, "practice"):
        return f"it was {result.made}: runs with such help do not count"
    if problem == not_strict(result, "complete"):
        replay = submission.replay
        demo = (
            fit_demo(replay.inputs, replay.demo_length or 0) if replay else parse_demo(submission.chunk.records[0].demo)
        )
        frames = f"it claims {demo.end} frames and holds {demo.end - demo.missing}"
        return (
            f"the demo is cut off: {frames}; `ninja-game convert FILE OUT --to replay` makes a run that claims no more"
        )
    if problem.code == "other-level" and submission.replay and submission.replay.level_name:
        name, digest = submission.replay.level_name, result.level_digest[:16]
        return f"{name!r} is not one of the levels that count; its level_digest begins with {digest}"
    worded = (words for field, words in _STRICT_TEXTS.items() if problem == not_strict(result, field))
    return next((words.format(body=result.body) for words in worded), str(problem))


def _impossible(result: Verdict, submission: Submission) -> str:
    """A remark about the first keys in a run that no keyboard can press."""
    inputs = submission.inputs(result.ticks)
    odd = (keys != possible for keys, possible in zip(inputs, with_press_bits(inputs), strict=True))
    tick = next(compress(count(), odd))
    down = ", ".join(name for name, key in MOVES if inputs[tick] & key) or "no key"
    pressed = "is pressed once more while it is down" if inputs[tick] & JUMP_HELD else "is pressed without going down"
    what = pressed if inputs[tick] & JUMP_PRESSED else "is down and was never pressed"
    return f"no keyboard can do that: in tick {tick} ({down} down) the jump key {what}"


def _without_name(message: str, name: str) -> str:
    """An error's message without the name of its file, which is shown beside it.

    >>> _without_name("a.txt:3:1: not a header", "a.txt")
    'line 3:1: not a header'
    """
    for prefix in (f"{name}:", f"{name!a}:"):
        message = message.removeprefix(prefix)
    return _LINE.sub("line ", message.strip())

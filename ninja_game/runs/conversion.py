"""Levels and recordings as texts of other formats, and what those formats cannot hold."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ninja_game.budget import RUN_BUDGET
from ninja_game.errors import ReplayError
from ninja_game.formats.ascii.legend import legend_text
from ninja_game.formats.ascii.reader import is_ascii_level
from ninja_game.formats.ascii.writer import RULER
from ninja_game.formats.n14.level_file import LevelRecord, read_level_file, write_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.named_level import NamedLevel, format_of, parse_levels
from ninja_game.formats.recording import Recording, holds_recordings, parse_replays, record_of
from ninja_game.formats.replay.notations import write_celeste, write_libtas
from ninja_game.formats.replay.text import Replay, write_episode, write_replay
from ninja_game.runs.recording_reader import named_errors
from ninja_game.runs.run import record_replay
from ninja_game.runs.verify import verify_recording
from ninja_game.sim.level import Level
from ninja_game.sim.rules import RULES_VERSION

_COMMENT = re.compile(r"(?![^;]*:)[^|;]*;.*")  # a line with a comment in an ASCII level, outside of header and picture


def replay_texts(recordings: Iterable[Recording], budget: int = RUN_BUDGET) -> Iterator[str]:
    """Each recording as our replay text with its level inside, run for its result.

    Raises LevelError for a level that cannot be played, BudgetError for a run that exceeds its ``budget``.
    """
    return (write_replay(recorded_again(recording, budget)) for recording in recordings)


def recorded_again(recording: Recording, budget: int = RUN_BUDGET) -> Replay:
    """A recording as a replay of today with its level; names, markers, how it was made stay. Raises as above.

    One without a name gets the name of its level. The only name in a record of N is the author of its level: the player
    stays unknown.

    If its claims are no longer true, its text or its level was edited, and it is marked as edited.
    """
    old, level, inputs = recording.replay, recording.level, recording.inputs
    name = old.name or old.level_name or recording.name
    with named_errors(recording):
        new = record_replay(level, inputs, body=recording.body, name=name, author=recording.player, budget=budget)
    markers = tuple(marker for marker in old.markers if marker.tick <= len(new.inputs))
    claimed, now = ((run.outcome, run.final_tick, run.gold, run.digest or new.digest) for run in (old, new))
    return replace(
        new,
        level_name=old.level_name,
        level_author=recording.level_author,
        markers=markers,
        co_authors=old.co_authors,
        made=old.made if old.unclaimed or claimed == now else old.made.edited(1),
    )


def episode_text(recordings: Sequence[Recording], budget: int = RUN_BUDGET) -> str:
    """Recordings, in the order of their levels, as the text of an episode: run again, with the time carried on.

    Raises ReplayError for runs that are not an episode, and as ``replay_texts`` does.
    """
    text = write_episode([recorded_again(recording, budget) for recording in recordings])
    for recording, written in zip(recordings, parse_replays(text), strict=True):
        if problem := next(iter(verify_recording(written, budget=budget).problems), None):
            raise ReplayError(str(problem), recording.file, recording.line, hint=problem.hint)
    return text


def input_texts(recordings: Iterable[Recording], form: str) -> Iterator[str]:
    """All inputs of each recording, not run: as a replay without claims ("inputs"), or in another tool's notation.

    ``form``: "inputs", "celeste" or "libtas". Raises ReplayError for what the tools' notations cannot hold.
    """
    for recording in recordings:
        replay = _without_claims(recording)
        keys = replay.inputs if replay.demo_length is None else recording.inputs
        try:
            if form == "celeste":
                yield write_celeste(keys, replay.markers)
            else:
                yield write_libtas(keys) if form == "libtas" else write_replay(replay)
        except ReplayError as error:
            raise replace(error, file=recording.file, line=recording.line) from None


def by_player(recording: Recording, player: str) -> Recording:
    """The recording as this player's, where it does not say whose it is; a record of N becomes a replay of ours."""
    if recording.player or not player:
        return recording
    named = replace(recording.replay, author=player, name=recording.name, level_author=recording.level_author)
    return replace(recording, replay=named, form="replay")


def on_level(recording: Recording, level: Level | None = None) -> Recording:
    """The inputs of a recording on a level, by default on its own level in its present state.

    The same recording if this is the level that it was made on, else one without claims.
    """
    moved = replace(recording, level=level or recording.level)
    digest, now = level_digest(recording.level), level_digest(moved.level)
    recorded = recording.replay.level_digest or digest
    if now == digest == recorded:
        return recording
    return replace(moved, replay=replace(_without_claims(moved), made=recording.replay.made.edited(1)))


def _without_claims(recording: Recording) -> Replay:
    """The replay of a recording with its level inside and without its claims."""
    claimless = replace(
        recording.replay,
        author=recording.player,
        level_author=recording.level_author,
        outcome="",
        gold=0,
        digest="",
        waypoints=(),
        rules=RULES_VERSION,
    )
    return replace(claimless, level=recording.level, level_digest="", level_path="", level_record=0)


def level_file_text(texts: Iterable[tuple[str, str]], level: Level | None = None) -> str:
    """All levels and recordings in texts as one level file of N; ``level``: the level of recordings without one.

    ``texts``: names of files and their contents.

    Raises LevelError, ReplayError or DemoError for an unreadable text, or one that such a file cannot hold.
    """
    return write_level_file(record for file, text in texts for record in _records(text, file, level))


def _records(text: str, file: str, level: Level | None) -> Iterator[LevelRecord]:
    if format_of(text) == "file":
        level_text = write_level_string(level, exact=True) if level else ""
        return (replace(record, level=record.level or level_text) for record in read_level_file(text, file=file))
    if holds_recordings(text):
        return map(record_of, parse_replays(text, file=file, level=level))
    return (
        LevelRecord(named.name, named.author, named.comment, write_level_string(named.level, exact=True))
        for named in parse_levels(text, file=file)
    )


def left_out(form: str, records: Sequence[NamedLevel | Recording], texts: Sequence[str]) -> list[str]:
    """Sentences about contents of texts that a form, as ``convert --to`` names them, cannot hold."""
    lost = []
    if form in ("ascii", "string") and any(map(holds_recordings, texts)):
        lost.append("the recordings (--to replay or --to file keeps them)")
    if form == "string" and any(named.author or named.comment for named in records):
        lost.append("names, authors and comments of levels")
    if form != "ascii" and any(isinstance(named, NamedLevel) and (named.teaches or named.says) for named in records):
        lost.append("what levels teach and say")
    if form in ("celeste", "libtas"):
        lost.append("levels, names, authors and how runs were made")
    if form in ("replay", "inputs", "episode") and any(recording.comment for recording in records):
        lost.append("comments of recordings")
    if any(map(_own_comments, filter(is_ascii_level, texts))):
        lost.append("comment lines")
    if form in ("string", "file") and any(isinstance(named, NamedLevel) and _rounded(named.level) for named in records):
        lost.append("the last bit of some numbers, which N cannot read")
    return lost


def _own_comments(text: str) -> bool:
    """Whether somebody wrote comments into an ASCII level, besides those that we write."""
    ours = {line.strip() for line in (RULER + legend_text()).splitlines()}
    return any(_COMMENT.fullmatch(line) and line.strip() not in ours for line in text.splitlines())


def _rounded(level: Level) -> bool:
    """Whether writing a level as an in-game string changes it."""
    return level_digest(parse_level_string(write_level_string(level, exact=True))) != level_digest(level)

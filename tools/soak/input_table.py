"""The entry points that can be tried in one process: functions from bytes, with all that is done before play."""

import json
import re
import sqlite3
from collections.abc import Callable, Iterable
from contextlib import closing, suppress
from dataclasses import replace
from datetime import UTC, datetime
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np
import pygame

from ninja_game.board.report import read_board
from ninja_game.editor import files as editor_files
from ninja_game.editor.draft import Draft
from ninja_game.editor.files import draft_of_text
from ninja_game.errors import DAMAGED, NinjaGameError
from ninja_game.files.reading import read_utf8
from ninja_game.files.shown_text import file_stem, shown_text
from ninja_game.files.user_folder import RECORDS
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.ascii.writer import same_spec, write_ascii_level
from ninja_game.formats.links import (
    is_link,
    read_link,
    recordings_in_links as watched_recordings,
    watched_names,
    write_link,
)
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.level_file import read_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.named_level import parse_levels
from ninja_game.formats.numbers import format_exact, parse_flash_number
from ninja_game.formats.pack.index import parse_index
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import parse_pars
from ninja_game.formats.recording import Recording, parse_replays, record_of
from ninja_game.formats.replay.notations import write_celeste, write_libtas
from ninja_game.formats.replay.text import parse_replay, write_replay
from ninja_game.levels.lint import level_warnings
from ninja_game.player.backup import read_backup
from ninja_game.player.player_data import PlayerData
from ninja_game.player.settings import read_settings, write_changes
from ninja_game.player.store import Store
from ninja_game.runs.chunks import (
    CheckpointLog,
    Chunk,
    VerifyOptions,
    chunks_in,
    results_as_text,
    results_from_text,
    self_contained,
    verify_chunk,
)
from ninja_game.runs.recording_reader import recordings_in, recordings_of, records_of
from ninja_game.runs.trace import RunTrace, first_difference, trace_digests, trace_level, trace_rows
from ninja_game.runs.trace_files import FiledTrace, read_csv, read_traces
from ninja_game.search.formula.language import parse_truth
from ninja_game.search.formula.names import FACTS, SPAN_NAMES
from ninja_game.tas import journal
from ninja_game.tas.files import branches_path, inputs_of_text, open_run, replay_of_track, runs_of_level
from ninja_game.tas.session import TasSession
from ninja_game.tas.timeline import parse_watch
from ninja_game.ui.lettering import StrokeFont
from ninja_game.ui.text_entry import EditedText
from tests.support.samples import WALK, replay_of_walk
from tools.soak.mutators import as_text

LEVEL = parse_level_string(WALK)
MAX_RUN_TICKS, MAX_TICKS = 100, 20_000
"""Ticks of a run that is simulated here, and of all of a file; what runs cost is the business of their budgets."""

_FILE = re.compile(r"^--- ([\w-][\w.-]{0,80})\n", re.MULTILINE)


class EntryPoint(NamedTuple):
    """What is tried. ``read``: takes bytes and an empty folder for the files that it wants. ``share``: of the tries."""

    read: Callable[[bytes, Path], object]
    share: int = 20


def _of_text(read: Callable[[str], object]) -> EntryPoint:
    """An entry point for a text."""
    return EntryPoint(lambda data, _: read(as_text(data)))


def _of_file(read: Callable[[Path], object], name: str = "file", share: int = 20) -> EntryPoint:
    """An entry point for a file of such a name."""

    def look(data: bytes, folder: Path) -> object:
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(data)
        return read(path)

    return EntryPoint(look, share)


def _of_files(read: Callable[[Path], object]) -> EntryPoint:
    """An entry point for a text file with others beside it: what stands behind lines ``--- name`` are their texts."""

    def look(data: bytes, folder: Path) -> object:
        first, *others = _FILE.split(as_text(data))
        for name, text in [("file.txt", first), *zip(others[::2], others[1::2], strict=True)]:
            (folder / name).write_bytes(text.encode("utf-8", "surrogatepass"))
        return read(folder / "file.txt")

    return EntryPoint(look)


@cache
def known_run() -> RunTrace:
    """The run that the traces hold."""
    return trace_level(LEVEL, bytes([2] * 6), memory="plain", events=True)


@cache
def empty_database() -> bytes:
    """The records of a new player."""
    with TemporaryDirectory() as place:
        Store(Path(place) / RECORDS).connection.close()
        return (Path(place) / RECORDS).read_bytes()


# --- what is done with what was read: all that a program does with it before it is played ---


def _same(what: str, first: object, second: object) -> None:
    if first != second:
        raise AssertionError(f"{what} changes when it is written and read")


def _level_string(text: str) -> None:
    level = parse_level_string(text)
    level_digest(level)
    if len(text) % 8 == 0:
        level_warnings(level)
    again = parse_ascii_level(write_ascii_level(level)).level
    _same("a level", again.tiles, level.tiles)
    if len(again.objects) != len(level.objects) or not all(map(same_spec, again.objects, level.objects)):
        raise AssertionError("objects change when they are written as an ASCII level")
    exact = parse_level_string(write_level_string(level, exact=True))
    _same("an exact string", (level_digest(exact), len(exact.objects)), (level_digest(level), len(level.objects)))


def _demo(text: str) -> None:
    demo = parse_demo(text)
    _same("a demo", parse_demo(write_demo(demo)).playback(1000), demo.playback(1000))


def _ascii(text: str) -> None:
    read = parse_ascii_level(text)
    again = parse_ascii_level(write_ascii_level(read.level, name=read.name, author=read.author, comment=read.comment))
    for part in ("name", "author"):
        _same(f"the {part} of an ASCII level", getattr(again, part), getattr(read, part))
    _same("an ASCII level", level_digest(again.level), level_digest(read.level))


def _replay(text: str) -> None:
    written = write_replay(parse_replay(text))
    _same("a replay", write_replay(parse_replay(written)), written)


def _recordings(text: str) -> None:
    list(recordings_of(records_of(text), ""))
    for recording in parse_replays(text):
        record_of(recording)


def _archive(path: Path) -> None:
    for named in load_levels(path)[:5]:
        level_warnings(named.level)
    load_replays(path)


def _verified(path: Path) -> None:
    """Short runs, as `verify` and the page judge them."""
    # One unreadable record hides no long run in the others.
    if sum(each.ticks for each in recordings_in([path]) if isinstance(each, Recording)) <= MAX_TICKS:
        for chunk in map(self_contained, chunks_in([path])):
            results = verify_chunk(chunk, VerifyOptions("plain"))
            _same("results", results_from_text(results_as_text([results]), [chunk]), [results])


def _run(path: Path) -> None:
    """A run as the TAS editor opens it: beside the runs of its file, and in all notations that can say it."""
    opened = open_run(path, level=LEVEL)
    runs_of_level(path, replace(opened.recording, file=""))
    if len(opened.track) <= MAX_RUN_TICKS:
        if len(opened.track):
            write_replay(replay_of_track(opened.recording, opened.track))
        notations: list[Callable[[bytes], str]] = [partial(write_celeste, markers=opened.track.markers), write_libtas]
        for write in notations:
            with suppress(NinjaGameError):
                write(opened.track.inputs)


def _traces(found: Iterable[FiledTrace]) -> None:
    for trace in found:
        first_difference(known_run(), trace.run)
        trace_digests(trace.run)
        list(trace_rows(trace.run))


def _pack(pack: Pack) -> None:
    _ = pack.pars
    for name in [level.file for levels in pack.episodes.values() for level in levels]:
        if certificate := pack.certificate(name, "exit"):
            parse_replays(pack.files.text(certificate))


def _link(text: str) -> None:
    watched_names(text)
    kind = read_link(text).kind
    link = text if is_link(text) else f"#{text.partition('#')[2]}"
    _pack(Pack(Path(link))) if kind == "pack" else load_replays(link) if kind == "replay" else load_levels(link)


def _settings(path: Path) -> None:
    before, _ = read_settings(path)
    after = before.changed(volume=(before.volume + 10) % 100)
    write_changes(before, after, path)
    _same("a setting", read_settings(path)[0].volume, after.volume)


def _log(path: Path) -> None:
    with CheckpointLog(path) as log:
        for key in list(log._places):  # noqa: SLF001 - the verification asks for those that it knows
            log[key]


def _goal(text: str) -> None:
    parsed = parse_truth(text, SPAN_NAMES, FACTS)
    with np.errstate(all="ignore"):
        view = {name: lambda *places: np.zeros(3) + sum(places) for name in SPAN_NAMES}
        parsed.value(view), parsed.margin(view)


def _name(text: str) -> None:
    shown = shown_text(text)
    if not shown.isprintable() or len(shown) > 2100 or len(file_stem(text).encode()) > 200:
        raise AssertionError("a name that cannot be shown")
    pygame.font.init()
    StrokeFont(12, bold=False).render(shown, "white")
    edited = EditedText(text[:40], 60)
    edited.put(text)
    edited.select_word(len(text) // 2)


def _journal(path: Path) -> None:
    journal.read_journal(path)
    for found in journal.lost_runs(path.parent.parent):
        if len(found.opened.track) <= MAX_RUN_TICKS and all(len(take) <= MAX_RUN_TICKS for take in found.tracks):
            TasSession(found.opened, path.parent.parent, memory="plain").recover(found)


def _branches(data: bytes, folder: Path) -> None:
    path = folder / "kept.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    branches_path(path).write_bytes(data)
    open_run(path)


def _backup(data: bytes, folder: Path) -> None:
    player = PlayerData(folder / "player")
    try:
        read_backup(player, data)
    finally:
        player.close()


def _player_looks(folder: Path) -> None:
    """All that the menus ask of the records; then something is kept, which must be there at the next start."""
    data = PlayerData(folder)
    for saved in [*data.records.replays(), *data.records.level_bests().values()]:
        data.records.replay(saved.id)
    data.records.episode_best("x")
    _ = (
        data.progress.columns,
        data.statistics.deaths(),
        data.statistics.played(),
        data.columns_complete,
        data.marks.all(),
    )
    data.progress.level_passed((0, 0), legitimate=True)
    kept = data.records.keep_replay(parse_replay(replay_of_walk()))
    data.close()
    data = PlayerData(folder)
    there = data.records.replay(kept)
    data.close()
    if there is None:
        raise AssertionError("a kept replay is gone")


def _database(data: bytes, folder: Path) -> None:
    (folder / RECORDS).write_bytes(data)
    _player_looks(folder)


def _rows(data: bytes, folder: Path) -> None:
    """Rows that anybody can put into a sound database: ``{table: [row, …]}``."""
    try:
        tables = {str(name): list(found) for name, found in dict(json.loads(data)).items()}
    except (ValueError, TypeError, RecursionError):
        return
    (folder / RECORDS).write_bytes(empty_database())
    with closing(sqlite3.connect(folder / RECORDS)) as db:
        db.execute("PRAGMA foreign_keys = OFF")
        for table, found in tables.items():
            for row in found:
                if re.fullmatch("[a-z_]+", table) and isinstance(row, list):
                    with suppress(sqlite3.Error, OverflowError, ValueError):
                        db.execute(f"INSERT INTO {table} VALUES ({', '.join('?' * len(row))})", [*map(_cell, row)])
        db.commit()
    _player_looks(folder)


def _cell(value: object) -> object:
    return value.encode("utf-8", "replace") if isinstance(value, str) and value.startswith("\0") else value


ENTRY_POINTS: dict[str, EntryPoint] = {
    "level string": _of_text(_level_string),
    "level file": _of_text(read_level_file),
    "ascii level": _of_text(_ascii),
    "demo": _of_text(_demo),
    "replay": _of_text(_replay),
    "any levels": _of_text(parse_levels),
    "any recordings": _of_text(_recordings),
    "archive": _of_file(_archive),
    "verified": _of_file(_verified, share=6),
    "run with includes": _of_files(_run),
    "clipboard inputs": _of_text(lambda text: inputs_of_text(text, "clipboard")),
    "clipboard level": _of_text(lambda text: draft_of_text(text, Draft(LEVEL))),
    "number": _of_text(lambda text: format_exact(parse_flash_number(text[:60]))),
    "name": _of_text(_name),
    "goal": _of_text(_goal),
    "watched formula": _of_text(parse_watch),
    "trace csv": _of_text(lambda text: _traces(read_csv(text.splitlines(keepends=True)))),
    "trace file": _of_file(lambda path: _traces(read_traces(path))),
    "link": _of_text(_link),
    "level in a link": _of_text(lambda text: load_levels(write_link("level", [text]))),
    "replay in a link": _of_text(lambda text: load_replays(write_link("replay", [text]))),
    "watched run": _of_text(lambda text: watched_recordings([text])),
    "pack in a link": _of_text(lambda text: _pack(Pack(Path(write_link("pack", [text]))))),
    "pack index": _of_file(lambda path: parse_index(read_utf8(path), file=path.name)),
    "pars": _of_file(lambda path: parse_pars(read_utf8(path), file=path.name)),
    "pack zip": _of_file(lambda path: _pack(Pack(path)), "pack.zip"),
    "settings": _of_file(_settings),
    "checkpoint log": _of_file(_log),
    "cluster message": _of_text(lambda text: results_from_text(text, [Chunk("a.txt", named=False)] * 2)),
    "board": _of_file(lambda path: read_board(path, datetime(2026, 1, 1, tzinfo=UTC))),
    "journal": _of_file(_journal, "tas/odd.jsonl", 6),
    "branches": EntryPoint(_branches),
    "autosave": _of_file(lambda path: list(editor_files.lost_drafts(path.parent.parent)), "editing/odd.json"),
    "backup": EntryPoint(_backup, 2),
    "database": EntryPoint(_database, 1),
    "database rows": EntryPoint(_rows, 1),
}
"""By name."""

OTHER_ERRORS: dict[str, tuple[type[Exception], ...]] = {"journal": DAMAGED, "backup": (sqlite3.Error, OSError)}


def errors_of(name: str) -> tuple[type[Exception], ...]:
    """What an entry point may raise: our own errors, and what its own callers catch besides."""
    return NinjaGameError, *OTHER_ERRORS.get(name, ())

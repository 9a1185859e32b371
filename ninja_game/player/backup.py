"""All data of a player as one file, and back: a zip that the game in a window and the one in a page exchange.

Importing merges: only a better best replaces one, progress only moves forward, of two counts the larger stays, and no
file of the player's is overwritten. So a backup may be imported twice. It is untrusted: all of it is checked first, and
imported whole or not at all.
"""

from __future__ import annotations

import io
import json
import re
import sqlite3
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, closing, suppress
from dataclasses import replace
from functools import cache, partial
from itertools import count
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from ninja_game.budget import PAGE_BUDGET
from ninja_game.errors import DAMAGED, FileError, NinjaGameError
from ninja_game.files.reading import SUFFIXES, files_in, read_bytes
from ninja_game.files.shown_text import MAX_SHOWN, name_key, name_problem, shown_text
from ninja_game.files.tree import Tree
from ninja_game.files.untrusted import open_zip, unpacked
from ninja_game.files.user_folder import EDITING, EXPORTS, LEVELS, RECORDS, REPLAYS, SETTINGS, STAMPS, quarantine
from ninja_game.files.writing import write_atomically
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.formats.run_time import level_score
from ninja_game.player.player_data import PlayerData
from ninja_game.player.progress import WITH_HELP, is_place
from ninja_game.player.records import Records
from ninja_game.player.schema import SCHEMA, SCHEMA_VERSION, OtherVersionError, bound_queries
from ninja_game.player.settings import read_settings
from ninja_game.player.store import Store
from ninja_game.runs.deaths import KILLERS
from ninja_game.runs.verify import verify_recording
from ninja_game.sim.level import BODIES

MAX_FILES = 4096
MAX_BACKUP_BYTES = 256 * 2**20  # size of all files, unpacked

MAX_REPLAYS = 5_000  # rows of the table of replays
MAX_TABLE_ROWS = 100_000  # rows of any other table

BRANCHES = ".branches.json"  # suffix of a file beside a run: its branches in the TAS editor

FOLDERS = {
    LEVELS: (*SUFFIXES, ".zip"),
    REPLAYS: (*SUFFIXES, BRANCHES),
    EXPORTS: (*SUFFIXES, ".gif", ".png", ".webm"),
    EDITING: (".json",),
    STAMPS: SUFFIXES,
}
"""The files of the player's folder in a backup besides settings and records: only with these suffixes, since systems
act on some others by themselves, such as a ``desktop.ini``.
"""

MAX_LEVELS_BYTES = 16 * 2**20  # bytes of all levels of the replays: each is read, and its replay run again
MAX_DRAFT_BYTES = 2**20  # bytes of a level under edit
MAX_LEVEL_BYTES = 2**20  # bytes of the level of a replay
MAX_REPLAY_TICKS = 10_000_000  # ticks of all replays, which are run again
_FEW_TICKS = 200_000  # fewer ticks run on the plain memory, sooner than kernels are ready

_SCHEMA = "SELECT type, name, tbl_name, sql FROM sqlite_master WHERE sql IS NOT NULL"

_COUNT_LIMIT = 2**53
_DIGEST = re.compile("[0-9a-f]{64}")

_COUNTS = (
    ("played", ("level",), ("attempts", "passes", "deaths", "ticks", "gold"), "max"),
    ("death", ("killer",), ("times",), "max"),
    ("level_mark", ("level", "body"), ("most_gold",), "max"),
    ("level_mark", ("level", "body"), ("fastest",), "min"),
)
"""Tables whose rows are merged by number: keys, columns, and which of two numbers stays."""


def write_backup(player: PlayerData, path: Path) -> list[str]:
    """Write all data of a player into a zip. Messages: skipped files, and a warning if it is too large to import.

    Raises FileError, OSError, sqlite3.Error.
    """
    player.store.flush()
    messages = []
    with TemporaryDirectory() as scratch:
        copy = Path(scratch) / RECORDS
        with closing(sqlite3.connect(copy)) as target:
            player.store.connection.backup(target)
        packed = io.BytesIO()
        with ZipFile(packed, "w", ZIP_DEFLATED) as archive:
            archive.writestr(ZipInfo(RECORDS), copy.read_bytes(), ZIP_DEFLATED)
            for name in _own_files(player.folder):
                content = read_bytes(player.folder / name)
                if problem := _problem(name, len(content)):
                    messages.append(_left_out(name, problem))
                elif player.folder / name != path:
                    archive.writestr(ZipInfo(name), content, ZIP_DEFLATED)
        try:
            _unpacked(packed.getvalue())
            _open_records(copy).connection.close()
        except ValueError as error:
            messages.append(f"too large to be taken in: {error}; keep a copy of {player.folder} instead")
    write_atomically(path, packed.getvalue())
    return messages


def _own_files(folder: Path) -> Iterator[str]:
    yield from (name for name in files_in(folder) if name == SETTINGS)
    for part in FOLDERS:
        yield from (f"{part}/{name}" for name in files_in(folder / part))


def _problem(name: str, size: int = 0) -> str:
    """Why a file of this name, relative to the player's folder, is skipped; '' if it is not."""
    folder, _, file = name.rpartition("/")
    if name in {SETTINGS, RECORDS}:
        return ""
    if folder == EDITING and size > MAX_DRAFT_BYTES:
        return "no level under edit"
    if not file.lower().endswith(FOLDERS.get(folder, ())) or file.startswith("."):
        return "no file of a player's"
    return name_problem(file)


def _left_out(name: str, problem: str) -> str:
    return f"left out: {shown_text(name)}: {problem}"


def read_backup(player: PlayerData, data: bytes) -> list[str]:
    """Import a backup; the result in words. The settings count from the next start on.

    Raises FileError for an invalid or too large backup; OSError, sqlite3.Error. Then nothing has changed.
    """
    with TemporaryDirectory() as scratch:
        path = Path(scratch) / RECORDS
        try:
            files, left_out = _unpacked(data)
            path.write_bytes(files.pop(RECORDS))
            store = _open_records(path)
        except ValueError as error:
            raise FileError("this is not a backup of a player's data", found=shown_text(str(error))) from None
        with closing(store.connection):
            replays, taken = _merge_all(player, store, files)
        if SETTINGS in taken:
            (settings := path.with_name(SETTINGS)).write_bytes(files[SETTINGS])
            site = read_settings(settings)[0].site
            left_out += [f"links lead to {site or 'no page'} now"] if site != player.settings.site else []
    return [f"{replays} new replays in the records", f"{len(taken)} new files", *taken, *left_out, *store.messages]


def _unpacked(data: bytes) -> tuple[dict[str, bytes], list[str]]:
    """The files of a backup for a player's folder, by name, and the names of others. Raises ValueError."""
    files, left_out = {}, []
    archive = open_zip(io.BytesIO(data), most_files=MAX_FILES, most_bytes=MAX_BACKUP_BYTES)
    for entry in archive.infolist():
        name = entry.filename
        if not (problem := _problem(name, entry.file_size)):
            content = unpacked(archive, entry)
            files[name] = _without_path(content) if name.startswith(f"{EDITING}/") else content
        elif not name.endswith("/"):
            left_out.append(_left_out(name, problem))
    if RECORDS not in files:
        raise ValueError(f"no {RECORDS} in a zip")
    return files, left_out


def _without_path(autosave: bytes) -> bytes:
    """The text of a level under edit without the path of its file, which means nothing on another machine."""
    level = ""
    with suppress(*DAMAGED):
        level = str(json.loads(autosave)["level"])
    return json.dumps({"path": "", "digest": "", "level": level}, indent=1).encode()


def _open_records(path: Path) -> Store:
    """The records of a backup. Raises ValueError if they are too large, or contain code such as a trigger."""
    try:
        with closing(sqlite3.connect(path)) as db, bound_queries(db):
            ((version,),) = db.execute("PRAGMA user_version")
            if version != SCHEMA_VERSION:
                raise ValueError(f"records {OtherVersionError(version)}")
            there = set(db.execute(_SCHEMA))
            # SQLite would run a foreign trigger, check, default or index when the records are opened.
            if other := there ^ _our_schema():
                raise ValueError("the {} {} is not ours".format(*min(other)))
            # Pages listed several times would be counted for hours, in one instruction.
            ((state,),) = db.execute("PRAGMA quick_check(1)")
            if state != "ok":
                raise ValueError(f"damaged records: {state}")
            for name in SCHEMA.keys() & {name for _, name, *_ in there}:
                ((rows,),) = db.execute(f"SELECT count(*) FROM {name}")
                if rows > (most := MAX_REPLAYS if name == "replay" else MAX_TABLE_ROWS):
                    raise ValueError(f"{rows:,} rows in the table {name}, of which at most {most:,} are accepted")
            level = "length(CAST(level_text AS BLOB))"
            lengths = f"coalesce(max({level}), 0), total({level}), total(length(inputs))"
            ((longest, levels, ticks),) = db.execute(f"SELECT {lengths} FROM replay")
            if longest > MAX_LEVEL_BYTES:
                raise ValueError(f"a level of {longest:,} bytes, of which at most {MAX_LEVEL_BYTES:,} are accepted")
            if levels > MAX_LEVELS_BYTES:
                raise ValueError(f"levels of {levels:,.0f} bytes, of which at most {MAX_LEVELS_BYTES:,} are accepted")
            if ticks > MAX_REPLAY_TICKS:
                raise ValueError(f"replays of {ticks:,.0f} ticks, of which at most {MAX_REPLAY_TICKS:,} are accepted")
        store = Store(path)
    except sqlite3.Error as error:
        raise ValueError(str(error)) from None
    if store.messages:
        store.connection.close()
        raise ValueError(" ".join(store.messages))
    return store


@cache
def _our_schema() -> set[tuple[str, ...]]:
    with closing(sqlite3.connect(":memory:")) as db:
        for statement in SCHEMA.values():
            db.execute(statement)
        return set(db.execute(_SCHEMA))


def _merge_all(player: PlayerData, store: Store, files: dict[str, bytes]) -> tuple[int, list[str]]:
    """Import records and files; the number of new replays, and the new files."""
    opened = cache(lambda folder: TargetFolder(player.folder / folder))
    with ExitStack() as undo:
        with player.store.change() as db:
            replays = _merge(player, store, db)
            paths = map(PurePosixPath, sorted(files, key=lambda name: name.endswith(BRANCHES)))
            taken = [str(path) for path in paths if opened(path.parent).add(path, files, undo)]
        undo.pop_all()
    return replays, taken


class TargetFolder:
    """A folder of the player's that gets imported files, beside others of their names."""

    def __init__(self, path: Path) -> None:
        self._tree = Tree(path)
        self._names = {name_key(name): name for name in self._tree.names()}
        self._content = cache(self._read)

    def _read(self, name: str) -> bytes:
        """The content of a file; for an unreadable one a byte that equals no file of ours."""
        with suppress(FileError, OSError):
            content = read_bytes(self._tree.root / name, MAX_BACKUP_BYTES)
            return _without_path(content) if self._tree.root.name == EDITING else content
        return b"\0"

    def add(self, name: PurePosixPath, files: Mapping[str, bytes], undo: ExitStack) -> bool:
        """Write one of the files unless it exists; whether it was written. ``undo``: receives its inverse."""
        content = files[str(name)]
        if name.name.endswith(BRANCHES):
            # They belong to a run of the same backup, which may have another name here.
            run = name.with_name(name.name.removesuffix(BRANCHES))
            if self._content(self._names.get(name_key(run.name), "")) != files.get(str(run), b""):
                return False
        for number in count(1):
            new = name.with_stem(f"{name.stem}-{number}").name if number > 1 else name.name
            present = self._names.get(name_key(new))
            if present is None:
                break
            if self._content(present) == content:
                return False
            if new == SETTINGS:
                aside = quarantine(self._tree.root / new, "before")
                undo.callback(aside.replace, self._tree.root / new)
                break
        undo.callback(self._tree.remove, new)
        self._tree.write(new, content)
        self._names[name_key(new)] = new
        return True


def _merge(player: PlayerData, store: Store, db: sqlite3.Connection) -> int:
    """Merge other records into the player's, within a transaction; the number of new replays."""
    theirs = Records(store)
    before = _count(db)
    ticks = store.connection.execute("SELECT total(length(inputs)) FROM replay").fetchone()[0]
    # A replay may be kept, a best and one of an episode: it is run once.
    replay_of = cache(partial(_replay, theirs, memory="plain" if ticks < _FEW_TICKS else "auto"))
    for row in store.rows("SELECT id FROM replay WHERE kept", (), (int,)):
        if replay := replay_of(row[0]):
            player.records.keep_replay(replay)
    for body in BODIES:
        for best in theirs.level_bests(body).values():
            if replay := replay_of(best.id):
                player.records.level_passed(replay)
    _merge_episodes(player.records, theirs, replay_of)
    for table, keys, columns, chosen in _COUNTS:
        _merge_numbers(db, store, table, keys, columns, chosen)
    _merge_progress(db, store)
    return _count(db) - before


def _replay(theirs: Records, number: int, memory: str) -> Replay | None:
    """A replay of other records; None if its claims are false, or it could not be written as a text."""
    replay = theirs.replay(number)
    try:
        if replay and replay.level and replay.level_digest == level_digest(replay.level):
            level = replay.level
            (recording,) = parse_replays(write_replay(replace(replay, level=None)), level=level)
            if not (problems := verify_recording(recording, memory, budget=PAGE_BUDGET).problems):
                return replace(replay, name=replay.name[:MAX_SHOWN], author=replay.author[:MAX_SHOWN])
            theirs.store.report(f"A replay in the records does not do what it says ({problems[0]}).")
    except NinjaGameError as error:
        theirs.store.report(f"A replay in the records is damaged ({error}).")
    return None


def _is_valid(column: str, value: str | int) -> bool:
    if isinstance(value, int):
        return 0 <= value < _COUNT_LIMIT
    words = {"killer": KILLERS, "body": (*BODIES, WITH_HELP)}.get(column)
    return value in words if words else _DIGEST.fullmatch(value) is not None


def _count(db: sqlite3.Connection) -> int:
    number: int = db.execute("SELECT count(*) FROM replay").fetchone()[0]
    return number


def _merge_episodes(mine: Records, theirs: Records, replay_of: Callable[[int], Replay | None]) -> None:
    rows = theirs.store.rows("SELECT episode, body, score FROM episode_best", (), (str, str, int))
    for episode, body, score in rows:
        best = theirs.episode_best(episode, body)
        replays = [replay_of(number) for number in best.replays] if best else []
        whole = [replay for replay in replays if replay is not None]
        possible = sum(level_score(replay.gold, replay.final_tick) for replay in whole)
        if whole and len(whole) == len(replays) and _is_valid("episode", episode) and 0 <= score <= possible:
            mine.episode_passed(episode, score, whole)


def _merge_numbers(
    db: sqlite3.Connection, store: Store, table: str, keys: tuple[str, ...], columns: tuple[str, ...], chosen: str
) -> None:
    names = [name for _, name, *_ in store.connection.execute(f"PRAGMA table_info({table})")]
    kinds = [str if name in {"level", "body", "killer"} else int for name in names]
    rows = store.rows(f"SELECT {', '.join(names)} FROM {table}", (), kinds)
    joined = ", ".join(f"{name} = {chosen}({table}.{name}, excluded.{name})" for name in columns)
    db.executemany(
        f"INSERT INTO {table} ({', '.join(names)}) VALUES ({', '.join('?' * len(names))}) "
        f"ON CONFLICT ({', '.join(keys)}) DO UPDATE SET {joined}",
        [row for row in rows if all(map(_is_valid, names, row))],
    )


def _merge_progress(db: sqlite3.Connection, store: Store) -> None:
    """The farther of two places, for progress with and without help."""
    query = "SELECT pack, grid_column, reached_episode, reached_level, beaten_episode, beaten_level FROM progress"
    mine = {row[:2]: row[2:] for row in db.execute(query)}
    for row in store.rows(query, (), (str, *[int] * 5)):
        if row[0] != shown_text(row[0]) or not (is_place(row[2:4], row[1]) and is_place(row[4:], row[1])):
            continue
        here = mine.get(row[:2], row[2:])
        merged = max(row[2:4], here[:2]) + max(row[4:], here[2:])
        db.execute("REPLACE INTO progress VALUES (?, ?, ?, ?, ?, ?)", (*row[:2], *merged))

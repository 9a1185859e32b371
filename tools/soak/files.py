"""Feed mutated files to what reads them by path: settings, logs, traces, packs, recordings and rows of records.

    python3 tools/dev.py tool soak.files [--count 1000000] [--seed 1]

Exit code 0: only errors of ours, each file read within two seconds; 1: something else, printed with its seed.
"""

from __future__ import annotations

import argparse
import random
import sqlite3
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

from ninja_game.files.reading import read_utf8
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.pack.index import parse_index
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import parse_replay
from ninja_game.levels.warnings import level_warnings
from ninja_game.player.player_data import PlayerData
from ninja_game.player.records import SavedReplay
from ninja_game.player.settings_file import read_settings, write_changes
from ninja_game.runs.trace import first_difference, rows, trace_digests
from ninja_game.runs.trace_files import read_traces
from ninja_game.verification.checkpoint_log import CheckpointLog
from tests.support.samples import replay_of_walk
from tools.soak.odd_files import known_run, odd_file, sound_files
from tools.soak.odd_texts import Trial

CELLS: tuple[object, ...] = (
    None,
    -1,
    10**18,
    1.5,
    float("inf"),
    "",
    "\0",
    "\x1b[2J",
    "x" * 5000,
    b"",
    b"\xff\0",
    "exit",
    10,
)
"""What damaged rows hold."""


def read_log(path: Path) -> None:
    """Every chunk of a checkpoint log."""
    with CheckpointLog(path) as log:
        for key in list(log._places):  # noqa: SLF001 - the verification asks for those that it knows
            log[key]


def change_settings(path: Path) -> None:
    """Read, change one, read again: the change must be there."""
    before, _ = read_settings(path)
    after = before.changed(volume=(before.volume + 10) % 100)
    write_changes(before, after, path)
    again, _ = read_settings(path)
    if again.volume != after.volume:
        raise AssertionError("a changed setting is not there")


def read_archive(path: Path) -> None:
    """A file of levels and of recordings, as `info` reads it; warnings of the first levels, each takes its time."""
    for level in load_levels(path)[:5]:
        level_warnings(level.level)
    load_replays(path)


def compare_traces(path: Path) -> None:
    """Every trace of a file, its rows and digests, and its first difference from the run that was there."""
    for trace in read_traces(path):
        first_difference(known_run(), trace.run)
        trace_digests(trace.run)
        list(rows(trace.run))


def read_pack(path: Path) -> None:
    """A zipped pack: its episodes, and its certificates as texts."""
    pack = Pack(path)
    for name in [level.file for levels in pack.episodes.values() for level in levels]:
        if certificate := pack.certificate(name, "exit"):
            parse_replays(pack.files.text(certificate))


READERS: dict[str, Callable[[Path], object]] = {
    "settings": change_settings,
    "checkpoint log": read_log,
    "trace.csv": compare_traces,
    "trace.npz": compare_traces,
    "pack.toml": lambda path: parse_index(read_utf8(path), file=path.name),
    "pack.zip": read_pack,
    "archive": read_archive,
    "replay": load_replays,
}


def read_rows(folder: Path, rng: random.Random) -> None:
    """The records of a player, some of whose cells hold anything, as the menus read them; and a save."""
    data = PlayerData(folder)
    db = data.store.connection
    db.execute("PRAGMA foreign_keys = OFF")
    for table in (
        "replay",
        "level_best",
        "level_mark",
        "episode_best",
        "episode_replay",
        "progress",
        "death",
        "played",
        "fact",
    ):
        columns = [row[1] for row in db.execute(f"PRAGMA table_info({table})")]
        for _ in range(rng.randrange(3)):
            values = [rng.choice(CELLS) if rng.random() < 0.5 else rng.randrange(12) for _ in columns]
            marks = ", ".join("?" * len(columns))
            with suppress(sqlite3.IntegrityError):
                db.execute(f"INSERT INTO {table} VALUES ({marks})", values)
    data.close()
    data = PlayerData(folder)
    for saved in [*data.records.replays(), *data.records.level_bests().values()]:
        assert isinstance(saved, SavedReplay)
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
    data.close()


def read_database(folder: Path, rng: random.Random) -> None:
    """A player's folder whose database is damaged: it is opened, and what is kept then is there at the next start."""
    data = PlayerData(folder)
    data.records.keep_replay(parse_replay(replay_of_walk()))
    data.close()
    path = folder / "records.sqlite"
    whole = bytearray(path.read_bytes())
    for _ in range(rng.choice((1, 5, 200))):
        whole[rng.randrange(rng.choice((100, len(whole))))] = rng.randrange(256)
    path.write_bytes(whole[: rng.choice((len(whole), len(whole), rng.randrange(len(whole))))])
    data = PlayerData(folder)
    data.records.replays()
    kept = data.records.keep_replay(parse_replay(replay_of_walk()))
    data.close()
    data = PlayerData(folder)
    if data.records.replay(kept) is None or kept not in [replay.id for replay in data.records.replays()]:
        raise AssertionError("a kept replay is gone")
    data.close()


def look(name: str, text: str, rng: random.Random, folder: Path) -> None:
    """Read one odd file."""
    if name in HOMES:
        with tempfile.TemporaryDirectory(dir=folder) as home:
            HOMES[name](Path(home), rng)
        return
    text = odd_file(text, rng)
    path = folder / ("file.zip" if name == "pack.zip" else "file")
    path.write_bytes(text.encode("latin-1" if all(ord(char) < 256 for char in text) else "utf-8", "surrogatepass"))
    try:
        READERS[name](path)
    finally:
        for left in folder.glob("file*"):
            left.unlink()


HOMES = {"rows": read_rows, "database": read_database}
"""Readers of a whole folder of a player's; they take their time."""


def main() -> int:
    """Read odd files, print what was found and a summary."""
    parser = argparse.ArgumentParser(description="Feed mutated files to what reads them by path.")
    parser.add_argument("--count", type=int, default=10_000, help="how many files (default 10000)")
    parser.add_argument("--seed", type=int, default=1, help="of the first file (default 1)")
    options = parser.parse_args()
    trial = Trial()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        texts = sound_files(folder) | dict.fromkeys(HOMES, "")
        names = [*list(READERS) * 20, *HOMES]
        for seed in range(options.seed, options.seed + options.count):
            name = names[seed % len(names)]
            trial.read(name, f"seed {seed}", partial(look, name, texts[name], random.Random(seed), folder))
            if trial.wrong >= 20:
                break
    return trial.summary()


if __name__ == "__main__":
    sys.exit(main())

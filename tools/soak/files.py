"""Feed mutated files to what reads them by path: settings, logs, traces, packs, recordings and rows of records.

    python3 tools/dev.py tool soak.files [--count 1000000] [--seed 1]

Exit code 0: only errors of ours, each file read within two seconds; 1: something else, printed with its seed.
"""

from __future__ import annotations

import argparse
import io
import random
import sqlite3
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache, partial
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile

import numpy as np

from ninja_game.files.reading import read_utf8
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.pack.index import parse_index
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import parse_replay
from ninja_game.levels.warnings import level_warnings
from ninja_game.player.player_data import PlayerData
from ninja_game.player.records import SavedReplay
from ninja_game.player.settings import Settings
from ninja_game.player.settings_file import read_settings, write_changes
from ninja_game.runs.run_trace import RunTrace, trace_level
from ninja_game.runs.trace import first_difference, rows, trace_digests
from ninja_game.runs.trace_files import FiledTrace, read_traces, write_csv, write_npz
from ninja_game.verification.checkpoint_log import CheckpointLog
from ninja_game.verification.verify_many import verify_all
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records
from tools import ROOT
from tools.soak.odd_texts import Trial, odd

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

KINDS = ("<f8", ">f8", "|S0", "<U0", "<U9", "|u1", "<i4", "<i8", "|O", "<M8[s]", [("x", "<f8"), ("s", "<i4")])
SHAPES = ((), (0,), (1,), (2,), (6,), (6, 2), (2, 6), (10**7,), (10**6, 10), (2**62,), (2**40, 2**40), (-1,))
"""What headers of damaged arrays claim."""


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


@cache
def known_run() -> RunTrace:
    """The run that the traces hold."""
    return trace_level(parse_level_string(WALK), bytes([2] * 6), memory="plain", events=True)


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


def odd_zip(text: str, rng: random.Random) -> str:
    """A sound zip with odd files: mutated ones, or arrays with headers that claim another kind and shape."""
    out = io.BytesIO()
    with ZipFile(io.BytesIO(text.encode("latin-1"))) as source, ZipFile(out, "w") as target:
        odd_ones = rng.sample(source.namelist(), 2)
        for info in source.infolist():
            data = source.read(info)
            if info.filename not in odd_ones:
                pass
            elif not info.filename.endswith(".npy") or rng.random() < 0.4:
                inside = data.decode("latin-1")
                data = odd(inside, inside, rng).encode("latin-1", "replace")
            else:
                header = io.BytesIO()
                about = {"descr": rng.choice(KINDS), "fortran_order": False, "shape": rng.choice(SHAPES)}
                np.lib.format.write_array_header_1_0(header, about)
                data = header.getvalue() + rng.choice((b"", data[128:], rng.randbytes(120)))
            target.writestr(info.filename, data, rng.choice((ZIP_STORED, ZIP_DEFLATED)))
    return out.getvalue().decode("latin-1")


def seeds(folder: Path) -> dict[str, str]:
    """A sound file for each reader; bytes as the characters of the same numbers."""
    write_changes(Settings(), Settings().changed(volume=10), folder / "settings")
    write_records(folder / "archive", ("a", WALK, running(WALK_END)), ("b", WALK, running(9)))
    (folder / "run.replay.txt").write_text(replay_of_walk())
    places = [folder / "archive", folder / "run.replay.txt"]
    list(verify_all(places, memory="plain", jobs=1, processes=False, resume=folder / "checkpoint log"))
    traces = [FiledTrace(k, "walk", known_run(), "a.txt", bytes([2] * 6)) for k in range(2)]
    with (folder / "trace.csv").open("w") as text:
        write_csv(traces, text)
    with (folder / "trace.npz").open("wb") as file:
        write_npz(traces, file)
    (folder / "level").write_text(WALK)
    (folder / "replay").write_text(replay_of_walk(level=None, level_path="level"))
    (folder / "pack.toml").write_bytes((ROOT / "levels" / "pack.toml").read_bytes())
    with ZipFile(folder / "pack.zip", "w") as packed:
        packed.write(folder / "pack.toml", "pack.toml")
        packed.writestr("00-0-walk.txt", WALK)
        packed.writestr("certificates/00-0-walk.exit.replay.txt", replay_of_walk())
    return {name: (folder / name).read_bytes().decode("latin-1") for name in READERS}


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
    text = odd_zip(text, rng) if text.startswith("PK") and rng.random() < 0.7 else odd(text, text, rng)
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
        texts = seeds(folder) | dict.fromkeys(HOMES, "")
        names = [*list(READERS) * 20, *HOMES]
        for seed in range(options.seed, options.seed + options.count):
            name = names[seed % len(names)]
            trial.read(name, f"seed {seed}", partial(look, name, texts[name], random.Random(seed), folder))
            if trial.wrong >= 20:
                break
    return trial.summary()


if __name__ == "__main__":
    sys.exit(main())

"""Feed mutated files to what reads them by path: settings, logs, traces, packs, recordings and rows of records.

    python3 tools/dev.py tool soak.files [--count 1000000] [--seed 1]

Exit code 0: only errors of ours, each file read within a second; 1: something else, printed with its seed.
"""

from __future__ import annotations

import argparse
import random
import resource
import sqlite3
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from zipfile import ZipFile

from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import read_utf8
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.pack.index import parse_index
from ninja_game.formats.pack.pack import Pack
from ninja_game.levels.warnings import level_warnings
from ninja_game.player.player_data import PlayerData
from ninja_game.player.records import SavedReplay
from ninja_game.player.settings import Settings
from ninja_game.player.settings_file import read_settings, write_changes
from ninja_game.runs.run import trace_level
from ninja_game.runs.trace_files import FiledTrace, read_traces, write_csv, write_npz
from ninja_game.verification.checkpoint_log import CheckpointLog
from ninja_game.verification.verify_many import verify_all
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records
from tools import ROOT
from tools.soak.formats import MOST, SLOW_S, mutated, rebuilt

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


def read_pack(path: Path) -> None:
    """A file of levels and of recordings, as `info` reads it; warnings of the first levels, each takes its time."""
    for level in load_levels(path)[:5]:
        level_warnings(level.level)
    load_replays(path)


READERS: dict[str, Callable[[Path], object]] = {
    "settings": change_settings,
    "checkpoint log": read_log,
    "trace.csv": lambda path: list(read_traces(path)),
    "trace.npz": lambda path: list(read_traces(path)),
    "pack.toml": lambda path: parse_index(read_utf8(path), file=path.name),
    "pack.zip": lambda path: Pack(path).episodes,
    "pack": read_pack,
}


def seeds(folder: Path) -> dict[str, str]:
    """A sound file for each reader; bytes as the characters of the same numbers."""
    level = parse_level_string(WALK)
    write_changes(Settings(), Settings().changed(volume=10), folder / "settings")
    write_records(folder / "pack", ("a", WALK, running(WALK_END)), ("b", WALK, running(9)))
    (folder / "run.replay.txt").write_text(replay_of_walk())
    places = [folder / "pack", folder / "run.replay.txt"]
    list(verify_all(places, memory="plain", jobs=1, processes=False, resume=folder / "checkpoint log"))
    traces = [FiledTrace(k, "walk", trace_level(level, bytes([2] * 6), memory="plain")) for k in range(2)]
    with (folder / "trace.csv").open("w") as text:
        write_csv(traces, text)
    with (folder / "trace.npz").open("wb") as file:
        write_npz(traces, file)
    (folder / "pack.toml").write_bytes((ROOT / "levels" / "pack.toml").read_bytes())
    with ZipFile(folder / "pack.zip", "w") as packed:
        packed.write(folder / "pack.toml", "pack.toml")
        packed.writestr("00-0-walk.txt", WALK)
    return {name: (folder / name).read_bytes().decode("latin-1") for name in READERS}


def read_rows(folder: Path, rng: random.Random) -> None:
    """The records of a player, some of whose cells hold anything, as the menus read them; and a save."""
    data = PlayerData(folder)
    db = data.store.connection
    db.execute("PRAGMA foreign_keys = OFF")
    for table in ("replay", "level_best", "episode_best", "episode_replay", "progress", "death", "played", "fact"):
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
    _ = data.progress.columns, data.statistics.deaths(), data.statistics.played(), data.columns_complete
    data.progress.level_passed((0, 0), legitimate=True)
    data.close()


def look(name: str, text: str, rng: random.Random, folder: Path) -> None:
    """Read one mutated file."""
    if name == "rows":
        with tempfile.TemporaryDirectory(dir=folder) as home:
            read_rows(Path(home), rng)
        return
    text = rebuilt(text, text, rng)[:MOST] if rng.random() < 0.5 else mutated(text, rng)
    path = folder / "file"
    path.write_bytes(text.encode("latin-1" if all(ord(char) < 256 for char in text) else "utf-8", "surrogatepass"))
    READERS[name](path)


def main() -> int:
    """Read mutated files, print what was found and a summary."""
    parser = argparse.ArgumentParser(description="Feed mutated files to what reads them by path.")
    parser.add_argument("--count", type=int, default=10_000, help="how many files (default 10000)")
    parser.add_argument("--seed", type=int, default=1, help="of the first file (default 1)")
    options = parser.parse_args()
    outcomes: Counter[str] = Counter()
    wrong = 0
    longest = 0.0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        texts = seeds(folder) | {"rows": ""}
        names = list(READERS) * 20 + ["rows"]
        for seed in range(options.seed, options.seed + options.count):
            name = names[seed % len(names)]
            started = time.perf_counter()
            try:
                look(name, texts[name], random.Random(seed), folder)
                outcomes[f"{name}: read"] += 1
            except NinjaGameError as error:
                outcomes[f"{name}: refused"] += len(str(error)) > 0
            except Exception:  # noqa: BLE001 - foreign errors are what is searched
                print(f"{name}, seed {seed}: a foreign error\n{traceback.format_exc()}", flush=True)
                wrong += 1
            taken = time.perf_counter() - started
            longest = max(longest, taken)
            if taken > SLOW_S:
                print(f"{name}, seed {seed}: {taken:.1f} s", flush=True)
                wrong += 1
            for left in folder.glob("file.*"):
                left.unlink()
            if wrong >= 20:
                break
    for outcome, times in sorted(outcomes.items()):
        print(f"{times:8d}  {outcome}")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory {peak:.0f} MiB, the slowest {longest:.2f} s, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

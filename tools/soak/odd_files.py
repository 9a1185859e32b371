"""Sound files of each kind, and what odd files are made of them."""

from __future__ import annotations

import io
import random
from functools import cache
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile

import numpy as np

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.player.settings import Settings
from ninja_game.player.settings_file import write_changes
from ninja_game.runs.run_trace import RunTrace, trace_level
from ninja_game.runs.trace_files import FiledTrace, write_csv, write_npz
from ninja_game.verification.verify_many import verify_all
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records
from tools import ROOT
from tools.soak.odd_texts import odd

NAMES = ("settings", "checkpoint log", "trace.csv", "trace.npz", "pack.toml", "pack.zip", "archive", "replay")

KINDS = ("<f8", ">f8", "|S0", "<U0", "<U9", "|u1", "<i4", "<i8", "|O", "<M8[s]", [("x", "<f8"), ("s", "<i4")])
SHAPES = ((), (0,), (1,), (2,), (6,), (6, 2), (2, 6), (10**7,), (10**6, 10), (2**62,), (2**40, 2**40), (-1,))
"""What headers of damaged arrays claim."""


@cache
def known_run() -> RunTrace:
    """The run that the traces hold."""
    return trace_level(parse_level_string(WALK), bytes([2] * 6), memory="plain", events=True)


def sound_files(folder: Path) -> dict[str, str]:
    """A sound file for each of ``NAMES``; bytes as the characters of the same numbers."""
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
    return {name: (folder / name).read_bytes().decode("latin-1") for name in NAMES}


def odd_file(text: str, rng: random.Random) -> str:
    """A file with something wrong in it; in a zip mostly in the files that it holds."""
    return odd_zip(text, rng) if text.startswith("PK") and rng.random() < 0.7 else odd(text, text, rng)


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

"""The thousand generated levels that come with the game, made by tools/generated_levels.py: nobody waits for them.

>>> first = read_packed_levels(difficulty=3)[0]
>>> first.seed, first.wanted, len(first.inputs) > 0
(2, 3, True)
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import FileError
from ninja_game.files.bundled import data_folder
from ninja_game.files.reading import read_bytes
from ninja_game.formats.n14.level_string import parse_level_string, write_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.formats.replay.notations import write_inputs
from ninja_game.sim.level import Level

AUTHOR = "ninja-game generate"  # who made the levels
PACKED = "generated.tsv.xz"  # an asset of the game; a line per level, as PackedLevel.line writes it
FROZEN = "bench.tsv.xz"
"""The levels of an earlier generator, from which those of the benchmark are made. They never change."""
MAX_PACKED_BYTES = 8 * 2**20  # the largest size of the file, and of its text when unpacked
MAX_MEMORY = 64 * 2**20  # bytes that unpacking may take


def named_level(name: str, level: Level, seed: int | str, difficulty: int, measured: float) -> NamedLevel:
    """Give a generated level the name and other texts of its file."""
    return NamedLevel(name, AUTHOR, f"seed {seed}, difficulty {difficulty}: measured {measured:.1f}", level, "")


class PackedLevel(NamedTuple):
    """A generated level. ``wanted``: the difficulty asked for, 1 to 10; ``difficulty``: the measured one.

    ``inputs``: of a run that passes it, one byte per tick. `ninja-game generate --seed SEED --difficulty WANTED` makes
    it again, as long as generator and solver have not changed.
    """

    seed: int
    wanted: int
    name: str
    difficulty: float
    level: Level
    inputs: bytes

    @property
    def named(self) -> NamedLevel:
        return named_level(self.name, self.level, self.seed, self.wanted, self.difficulty)

    @property
    def line(self) -> str:
        runs = " ".join(" ".join(write_inputs(self.inputs)).split())
        level = write_level_string(self.level, exact=True)
        return f"{self.seed}\t{self.wanted}\t{self.name}\t{self.difficulty}\t{level}\t{runs}"


def read_line(line: str) -> PackedLevel:
    """Read the level of a line. Raises FileError for a broken line, and the errors of its parts."""
    fields = line.split("\t")
    if len(fields) != 6:
        raise FileError("a line of the generated levels is broken", PACKED, found=f"{len(fields)} fields", expected="6")
    seed, wanted, name, difficulty, level, runs = fields
    inputs = read_inputs([(1, runs)]).keys
    return PackedLevel(int(seed), int(wanted), name, float(difficulty), parse_level_string(level), inputs)


def read_packed_levels(difficulty: int | None = None) -> list[PackedLevel]:
    """Read the generated levels that come with the game, by seed: those of a ``difficulty``, 1 to 10, or all.

    Raises FileError if they are missing, as in a page.
    """
    lines = _lines(data_folder("assets") / PACKED)
    return [read_line(line) for line in lines if difficulty is None or line.split("\t")[1] == str(difficulty)]


def frozen_level(place: int) -> PackedLevel:
    """Read one level of ``FROZEN``, by its place from 0 on, without the others. Raises FileError if it is missing."""
    return read_line(_lines(data_folder("assets") / FROZEN)[place])


@cache
def _lines(path: Path) -> tuple[str, ...]:
    import lzma  # not in every Python, and not in a page

    reader = lzma.LZMADecompressor(memlimit=MAX_MEMORY)
    try:
        text = reader.decompress(read_bytes(path, MAX_PACKED_BYTES), MAX_PACKED_BYTES).decode("utf-8")
    except (OSError, lzma.LZMAError, UnicodeDecodeError) as error:
        raise FileError("the generated levels of the game cannot be read", str(path)) from error
    if not reader.eof:
        raise FileError("the generated levels of the game cannot be read: they end too early", str(path))
    return tuple(text.splitlines())


def pack(lines: list[str]) -> bytes:
    """Pack lines into the bytes of the file; the same lines give the same bytes."""
    import lzma

    return lzma.compress("".join(f"{line}\n" for line in lines).encode("utf-8"), preset=6)

"""Unlimited levels: 100,000 for training and 1,000 for tests, each made from its number in microseconds.

A level is a variation of one of a thousand levels of an earlier generator (``generator/packed.py``): mirrored, with
less gold and fewer hazards, and, except in the hard ones, with a shorter task, for which start, switch and exit are put
on the way of the known run. That run, shortened in the same way, passes every level: it was played to test this. Of the
first ``BENCH_TRIES`` variations of a number ``BENCH_TABLE`` has the one with which it passed (tools/bench_levels.py).

>>> level = bench_level("test", 0)
>>> level.grade, level.name, len(level.inputs) <= 120
('easy', 'bench-test-0', True)
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache, lru_cache
from hashlib import sha256
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import open_worlds
from ninja_game.editor.motion import SYMMETRIES
from ninja_game.editor.specs import carried
from ninja_game.errors import ArgumentError
from ninja_game.files.bundled import data_folder
from ninja_game.files.reading import read_bytes
from ninja_game.generator.packed import FROZEN, MAX_PACKED_BYTES, frozen_level
from ninja_game.learn.levels.source import LevelSource, draws
from ninja_game.sim.inputs import KEY_LEFT, KEY_RIGHT, KEYS_DOWN, with_press_bit
from ninja_game.sim.kinds import EXIT, GOLD, KIND_OF, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec
from ninja_game.sim.states import SKIDDING

COUNTS = {"train": 100_000, "test": 1_000}
VAL = range(99_000, 100_000)
"""Numbers of `train` for the choice of settings; training uses the other numbers (docs/ninjabench.md)."""
BENCH_GRADES = {"easy": (30, 88), "medium": (89, 208), "hard": None}
"""Least and most ticks of the part of the known run that is the task; hard levels have the whole run."""
DELAY = 16
"""A run with another start begins at rest: it holds one key up to this many ticks longer, its last key this many."""
_AWAY = 36.0  # least px between a new start and the old one
_KEPT = {"easy": 0.0, "medium": 0.3, "hard": 0.6}  # least share of hazards that is kept, by grade
BASES = 1000  # number of levels that are varied
LARGEST = 306  # number of a level with the most objects
BENCH_TRIES = 32
"""The last variation only removes gold, is not mirrored and has the run's own start, so that the run passes it."""
BENCH_TABLE = "bench.bin"  # an asset of the game: the variation of each level, one byte each, `train` before `test`


class BenchLevel(NamedTuple):
    """A level of the benchmark. ``inputs``: a run that passes it, one byte per tick, to the exit or some ticks more."""

    name: str
    grade: str
    level: Level
    inputs: bytes


class _BaseLevel(NamedTuple):
    """A level to be varied. ``places``: of the ninja after each tick of the run, px.

    ``starts``: ticks of the run after which another may begin, the slowest first: the ninja stands far from the start.
    """

    level: Level
    inputs: bytes
    places: NDArray[np.float64]
    starts: NDArray[np.intp]


def bench_level(split: str, number: int, attempt: int | None = None) -> BenchLevel:
    """Make the level of a number of "train" or "test"; ``attempt``: another variation, which perhaps no run passes.

    Raises ArgumentError for another number or split, FileError if the assets of the game are missing.
    """
    if split not in COUNTS or not 0 <= number < COUNTS[split]:
        raise ArgumentError(f"found level {number!r:.30} of {split!r:.30}; expected one of {COUNTS}, counted from 0")
    place = number if split == "train" else COUNTS["train"] + number
    attempt = _table()[place] if attempt is None else attempt
    grade = list(BENCH_GRADES)[number % len(BENCH_GRADES)]
    drawn = draws(np.full(256, place * BENCH_TRIES + attempt, np.uint64), np.arange(256, dtype=np.uint64)) / 2.0**64
    sure = attempt == BENCH_TRIES - 1
    bases = _bases(split)
    base = _base(bases[number // len(BENCH_GRADES) % len(bases)], bool(drawn[0] < 0.5 and not sure))
    gold, killers = drawn[1], _KEPT[grade] + (1.0 - _KEPT[grade]) * drawn[2]
    span = BENCH_GRADES[grade]
    ticks = len(base.inputs)
    first, last = 0, ticks
    moved: dict[int, tuple[float, ...]] = {}
    if span is not None:
        last = min(ticks, span[1] if sure else int(span[0] + drawn[3] * (span[1] + 1 - span[0])))
        starts = base.starts[base.starts <= ticks - last]
        if len(starts) and not sure:
            # Choose among the slowest moments.
            first = int(starts[int(drawn[4] * max(8, len(starts) / 4)) % len(starts)])
        last += first
        switch = first + int((0.3 + 0.5 * drawn[5]) * (last - first))
        moved[EXIT] = (*_place(base, last), *_place(base, switch))
    if first:
        moved[NINJA] = _place(base, first)
    objects = []
    for spec, chance in zip(base.level.objects, np.resize(drawn[8:], len(base.level.objects)).tolist(), strict=True):
        kills = KIND_OF[spec.kind].killer != ""
        if chance < (gold if spec.kind == GOLD else killers if kills and not sure else 1.0):
            objects.append(ObjectSpec(spec.kind, moved[spec.kind]) if spec.kind in moved else spec)
    keys = base.inputs[first:last]
    if first:
        held, delay = int(drawn[6] * 8), int(drawn[7] * DELAY)
        more, longer = (bytes([keys[k] & KEYS_DOWN]) for k in (held, -1))
        keys = keys[:held] + more * delay + keys[held:] + longer * DELAY
        keys = bytes([with_press_bit(keys[0], 0)]) + keys[1:]
    return BenchLevel(f"bench-{split}-{number}", grade, Level(base.level.tiles, tuple(objects)), keys)


def _place(base: _BaseLevel, tick: int) -> tuple[float, float]:
    """The place of the ninja after ``tick`` ticks, whole px."""
    x, y = base.places[tick - 1].round().tolist()
    return x, y


@cache
def _bases(split: str) -> list[int]:
    """Numbers of the levels to vary: one in ten, the same number of every difficulty, is reserved for the test."""
    return [number for number in range(BASES) if (number // 10 % 10 == 7) == (split == "test")]


@cache
def _table() -> bytes:
    return read_bytes(data_folder("assets") / BENCH_TABLE, sum(COUNTS.values()))


_SIDES = KEY_LEFT | KEY_RIGHT
_SIDES_SWAPPED = bytes(keys ^ _SIDES if keys & _SIDES not in (0, _SIDES) else keys for keys in range(256))


@lru_cache(maxsize=2 * BASES)
def _base(number: int, mirrored: bool) -> _BaseLevel:
    """A level that comes with the game, or its mirror image, with a run that passes it."""
    if not mirrored:
        packed = frozen_level(number)
        record = open_worlds("auto", packed.level, box=False).run(packed.inputs)
        places = np.frombuffer(record.places, np.float64).reshape(-1, 2)
        speeds = np.abs(np.diff(places, axis=0, prepend=places[:1])).sum(1)
        stands = np.frombuffer(record.states, np.uint8) <= SKIDDING
        is_apart = np.abs(places - places[0]).sum(1) >= _AWAY
        order = np.argsort(speeds, kind="stable")
        return _BaseLevel(packed.level, packed.inputs[: len(places)], places, order[(stands & is_apart)[order]] + 1)
    base = _base(number, mirrored=False)
    (mirror,) = SYMMETRIES["left-right"]
    columns = np.reshape(base.level.tiles, (COLUMNS, ROWS))[::-1]
    tiles = tuple(mirror.tile(tile) for tile in columns.ravel().tolist())
    level = Level(tiles, tuple(carried(spec, mirror) for spec in base.level.objects))
    places = base.places * (-1.0, 1.0) + (mirror.dx, 0.0)
    return _BaseLevel(level, base.inputs.translate(_SIDES_SWAPPED), places, base.starts)


class _Levels(Sequence[Level]):
    """The levels of a split by their numbers, each made when it is read."""

    def __init__(self, split: str, numbers: range) -> None:
        self.split, self.numbers = split, numbers

    def __len__(self) -> int:
        return len(self.numbers)

    def __getitem__(self, place: int) -> Level:  # type: ignore[override]
        return bench_level(self.split, self.numbers[place]).level

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Levels) and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]


class BenchSource(LevelSource):
    """Levels of "train" or "test" by their numbers, made on demand."""

    def __init__(self, split: str, numbers: range) -> None:
        self.levels: _Levels = _Levels(split, numbers)
        self.names = [f"bench-{split}-{number}" for number in numbers]
        self.largest = _base(LARGEST, mirrored=False).level

    @property
    def digest(self) -> str:
        """Sha256 (hex) of the data that determine the levels."""
        assets = [read_bytes(data_folder("assets") / name, MAX_PACKED_BYTES) for name in (FROZEN, BENCH_TABLE)]
        return sha256(f"{self.levels.split} {self.levels.numbers}".encode() + b"".join(assets)).hexdigest()


def bench_source(text: str) -> BenchSource:
    """Read the part after "bench:" of a source's name: "train", "test:easy", "train:17", "train:easy:0-98999", "val".

    Raises ArgumentError for anything else, FileError if the assets of the game are missing.
    """
    match = re.fullmatch(rf"(\w+)(?::({'|'.join(BENCH_GRADES)}))?(?::([0-9]{{1,6}})(?:-([0-9]{{1,6}}))?)?", text)
    split, grade, first, last = match.groups() if match else (text.partition(":")[0], None, None, None)
    all_of = numbers = VAL if split == "val" else range(COUNTS.get(split, 0))
    numbers = numbers[int(first) : int(last or first) + 1] if first else numbers
    if grade:
        numbers = numbers[(list(BENCH_GRADES).index(grade) - numbers.start) % len(BENCH_GRADES) :: len(BENCH_GRADES)]
    if not match or not numbers or int(last or first or 0) >= len(all_of):
        expected = f"with grade {', '.join(BENCH_GRADES)}, or numbers 0 to {len(all_of or VAL) - 1}, or both"
        raise ArgumentError(
            f"found 'bench:{text:.60}'; expected 'bench:train', 'bench:val' or 'bench:test', {expected}"
        )
    return BenchSource("train" if split == "val" else split, numbers)

"""Honest pairs of runs, and edited ones, that the board should tell apart: the table of docs/board.md is of these.

Honest: pairs of runs of the reference on one level, one by a person and one made with tools. Edited: certificates of
ours, in which changes are made at random places, one after the other, each kept only if the run still passes.
"""

import random
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations, islice

from ninja_game.board.copies import Course, Courses, course_of
from ninja_game.formats.n14.demo import parse_demo
from ninja_game.formats.recording import Recording
from ninja_game.runs.run import RunResult, run_level
from ninja_game.sim.inputs import KEYS_DOWN, with_press_bits
from tests.support.reference import RunRow, positions, recordings

COUNTS = (1, 2, 5, 10, 20, 50, 100, 200)
MAX_TRIES = 1500
MAX_BLOCK = 60


def near_ones(course: Course, earlier: Sequence[Course]) -> list[int]:
    """Which earlier courses share enough of this one; the nearest first."""
    courses = Courses(len(earlier))
    for number, other in enumerate(earlier):
        courses.add(number, 0, partial(replace, other))
    return courses.near(course)(courses.numbers >= 0).numbers


def every_nth(found: list, count: int) -> list:  # type: ignore[type-arg]
    """So many of them, at equal distances."""
    count = min(count, len(found))
    return [found[index * len(found) // count] for index in range(count)]


def honest_pairs(count: int) -> tuple[list[tuple[RunRow, RunRow]], int]:
    """Pairs of a person's run and another source's; and how many more of all are equal in every position."""
    on_level: dict[str, list[RunRow]] = defaultdict(list)
    for run in recordings():
        on_level[run.data].append(run)
    pairs = [pair for runs in on_level.values() for pair in combinations(runs, 2)]
    mixed = [(one, other) for one, other in pairs if (one.source == "rta") != (other.source == "rta")]
    different = [(one, other) for one, other in mixed if one.sha256_xy != other.sha256_xy]
    return every_nth(different, count), len(mixed) - len(different)


def course_of_row(row: RunRow) -> Course:
    """The course of a run of the reference; its positions are known."""
    places = positions()[row.offset : row.offset + 16 * row.ticks]
    run = RunResult(row.outcome, row.gold, places, bytes(row.ticks))
    return course_of(parse_demo(row.demo).playback(row.ticks), run)


def change_key(keys: bytearray, rng: random.Random) -> None:
    """Other keys in a tick."""
    tick = rng.randrange(len(keys))
    keys[tick] = rng.choice([each for each in range(KEYS_DOWN + 1) if each != keys[tick]])


def shift_ticks(keys: bytearray, rng: random.Random) -> None:
    """A tick more, or one less."""
    tick = rng.randrange(len(keys))
    if rng.random() < 0.5:
        keys.insert(tick, keys[tick])
    else:
        del keys[tick]


def change_block(keys: bytearray, rng: random.Random) -> None:
    """Other keys in up to MAX_BLOCK ticks in a row."""
    first, ticks = rng.randrange(len(keys)), rng.randrange(1, MAX_BLOCK)
    keys[first : first + ticks] = bytes([rng.randrange(KEYS_DOWN + 1)]) * len(keys[first : first + ticks])


EDITS: dict[str, Callable[[bytearray, random.Random], None]] = {
    "keys changed in a tick": change_key,
    "ticks added or left out": shift_ticks,
    "spans of ticks changed": change_block,
}


def surviving(recording: Recording, edit: Callable[[bytearray], None]) -> Iterator[tuple[bytes, RunResult]]:
    """Inputs and result of a run after each edit that still passes, one after the other."""
    keys = bytearray(each & KEYS_DOWN for each in recording.inputs)
    for _ in range(MAX_TRIES):
        tried = keys.copy()
        edit(tried)
        inputs = with_press_bits(bytes(tried) + bytes(MAX_BLOCK))
        run = run_level(recording.level, inputs)
        if run.outcome == "exit":
            keys = tried
            yield inputs[: run.ticks], run


def edited(recording: Recording, kind: str) -> Iterator[tuple[int, bytes, RunResult]]:
    """A run after each of COUNTS changes, as far as it gets: how many, inputs, the result."""
    rng = random.Random(f"{recording.name} {kind}")
    runs = surviving(recording, lambda keys: EDITS[kind](keys, rng))
    for done, (inputs, run) in enumerate(islice(runs, COUNTS[-1]), 1):
        if done in COUNTS:
            yield done, inputs, run


def noticed(recording: Recording, kind: str) -> Iterator[tuple[int, bool]]:
    """For each of COUNTS changes whether the board notices: a copy, or near enough for a remark."""
    inputs = recording.inputs
    run = run_level(recording.level, inputs)
    first = course_of(inputs[: run.ticks], run)
    for count, changed, result in edited(recording, kind):
        yield count, result.places == run.places or near_ones(course_of(changed, result), [first]) != []

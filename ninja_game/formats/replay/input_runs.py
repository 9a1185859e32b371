"""Inputs as readable runs, ``R*30 RJ*10 .*5``: the notation of our replay texts (`docs/replay-format.md`)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise, product
from typing import NamedTuple

from ninja_game.sim.inputs import ALL_KEYS, JUMP_PRESSED, KEYS_DOWN, check_inputs, with_press_bits

_WIDTH = 100

KEY_NAMES = (".", "L", "R", "LR", "J", "LJ", "RJ", "LRJ")
"""The word of each sum of keys that are down."""


_WORDS = {
    (keys, usual): KEY_NAMES[keys & KEYS_DOWN] + ("" if keys == usual else "!" if keys & JUMP_PRESSED else "-")
    for keys, usual in product(range(ALL_KEYS + 1), repeat=2)
}
"""The word of a tick by its input, marked where that is not what its keys alone make, the second number."""


class Marker(NamedTuple):
    """A name for a tick of a run."""

    tick: int
    name: str


_MARKER_NAME = re.compile(r"[\w.-]{1,100}")


def is_marker_name(name: str) -> bool:
    """Whether a marker can have this name."""
    return _MARKER_NAME.fullmatch(name) is not None


def write_inputs(inputs: bytes, markers: Sequence[Marker] = ()) -> list[str]:
    """The inputs as lines of runs, a new line for each marker. Raises DemoError for a byte above 15.

    >>> write_inputs(bytes([2, 2, 2, 14, 6, 6, 0]), [Marker(3, "corner")])
    ['R*3', '#corner RJ*3 .']
    """
    check_inputs(inputs)
    ticks = [_WORDS[pair] for pair in zip(inputs, with_press_bits(inputs), strict=True)]
    lines: list[str] = []
    parts = [Marker(0, ""), *sorted(markers), Marker(len(inputs), "")]
    for (start, name), (end, _) in pairwise(parts):
        lines.append(f"#{name}" if name else "")
        for run in _runs(ticks[start:end]):
            if len(lines[-1]) + 1 + len(run) <= _WIDTH:
                lines[-1] += " " * bool(lines[-1]) + run
            else:
                lines.append(run)
    return [line for line in lines if line]


def _runs(ticks: Sequence[str]) -> Iterator[str]:
    """Equal ticks that follow one another as one word."""
    for text, group in groupby(ticks):
        count = sum(1 for _ in group)
        yield f"{text}*{count}" if count > 1 else text

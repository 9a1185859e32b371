"""Inputs as readable runs, ``R*30 RJ*10 .*5``: the notation of our replay texts (`docs/replay-format.md`)."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import groupby

from ninja_game.errors import ReplayError
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, KEYS_DOWN, MAX_TICKS, check_inputs, pressed

_WIDTH = 100
_RUN = re.compile(r"(\.|L?R?J?)([!-]?)(?:\*([1-9][0-9]{0,6}))?")
_WORD = re.compile(r"[^ \t]+")

_KEYS = (".", "L", "R", "LR", "J", "LJ", "RJ", "LRJ")
_KEY_BITS = {text: keys for keys, text in enumerate(_KEYS)}


def write_inputs(inputs: bytes) -> list[str]:
    """The inputs as lines of runs. Raises DemoError for a byte above 15.

    >>> write_inputs(bytes([2, 2, 2, 14, 6, 6, 0]))
    ['R*3 RJ*3 .']
    """
    check_inputs(inputs)
    runs = []
    for text, group in groupby(_ticks_as_text(inputs)):
        count = sum(1 for _ in group)
        runs.append(f"{text}*{count}" if count > 1 else text)
    lines: list[str] = []
    for run in runs:
        if lines and len(lines[-1]) + 1 + len(run) <= _WIDTH:
            lines[-1] += " " + run
        else:
            lines.append(run)
    return lines


def _ticks_as_text(inputs: bytes) -> Iterable[str]:
    """Keys of every tick, marked where the trigger is not what the keys say."""
    held_before = 0
    for keys in inputs:
        mark = "" if keys == pressed(keys, held_before) else "!" if keys & JUMP_PRESSED else "-"
        yield _KEYS[keys & KEYS_DOWN] + mark
        held_before = keys & JUMP_HELD


def read_inputs(lines: Iterable[tuple[int, str]], *, file: str = "") -> bytes:
    """The inputs that numbered lines of runs describe, one byte a tick.

    Raises ReplayError with line and column for anything but runs, and for more than a million ticks.
    """
    inputs = bytearray()
    for number, line in lines:
        for word in _WORD.finditer(line):
            match = _RUN.fullmatch(word[0])
            if match is None or not match[1]:
                raise _bad_run(word[0], file, number, word.start() + 1)
            count = int(match[3] or 1)
            if len(inputs) + count > MAX_TICKS:
                raise ReplayError(
                    "the replay is too long",
                    file,
                    number,
                    word.start() + 1,
                    found=f"{len(inputs) + count} ticks",
                    expected=f"at most {MAX_TICKS}",
                )
            _append(inputs, _KEY_BITS[match[1]], match[2], count)
    return bytes(inputs)


def _append(inputs: bytearray, keys: int, mark: str, count: int) -> None:
    """Add a run; unmarked, the jump triggers where it is held and was not before."""
    if mark == "!":
        keys |= JUMP_PRESSED
    held_before = inputs[-1] & JUMP_HELD if inputs else 0
    inputs.append(keys if mark else pressed(keys, held_before))
    inputs.extend(bytes([keys]) * (count - 1))


def _bad_run(text: str, file: str, line: int, column: int) -> ReplayError:
    """The error for a word that is no run, with the likeliest way to mend it."""
    keys, star, count = text.partition("*")
    if star and not re.fullmatch("[1-9][0-9]{0,6}", count):
        hint = "a count is a whole number from 1"
    elif star and not keys:
        hint = "a count stands next to its keys, without a blank: R*33"
    elif set(keys.upper()) <= set("LRJ!-."):
        hint = f"write {_in_order(keys.upper())}{star}{count}"
    else:
        hint = "L left, R right, J jump, . no key"
    return ReplayError("not an input run", file, line, column, repr(text[:30]), "keys and a count, such as R*30", hint)


def _in_order(keys: str) -> str:
    """The same keys as the notation has them: L, R, J, each once, then the mark."""
    mark = "!" if "!" in keys else "-" if "-" in keys else ""
    return ("".join(key for key in "LRJ" if key in keys) or ".") + mark

"""Inputs in the notations of tools for tool-assisted runs: CelesteTAS and libTAS (`docs/replay-format.md`)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby

from ninja_game.errors import ReplayError
from ninja_game.formats.lines import Line, numbered_lines
from ninja_game.formats.replay.input_runs import KEY_NAMES, Marker
from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN, press_jumps

KEYSYMS = {"ff51": "L", "ff53": "R", "ffe1": "J", "ffe2": "J", "7a": "J", "20": "J"}
"""Keys by their X11 numbers: the arrows; the shift keys, Z and space jump. The first of each is written."""

_FRAMES = re.compile(r"\s*([1-9][0-9]{0,6})((?:,[A-Za-z0-9.]+)*),?\s*")
_REPEAT = re.compile(r"\s*repeat[ ,]+([1-9][0-9]{0,6})\s*", re.IGNORECASE)
_READ = re.compile(r"\s*read[ ,]+([^,]+)", re.IGNORECASE)
_SKIPPED = re.compile(r"\s*(#\s.*|#|#{2,}.*|\*\*\*.*)?")


def is_tas_text(text: str) -> bool:
    """Whether a text may be of one of these notations."""
    for _, line in numbered_lines(text):
        if not _SKIPPED.fullmatch(line) and not line.startswith("#"):
            return line.startswith("|") or any(form.fullmatch(line) for form in (_FRAMES, _REPEAT, _READ))
    return False


def in_our_notation(text: str, file: str = "") -> Iterator[Line]:
    """The same lines in the notation of our replays, with their numbers.

    Raises ReplayError for keys and commands that a run of the ninja has no use for.
    """
    counts: list[str] = []
    for number, line in numbered_lines(text):
        if line.startswith("|"):
            yield number, _libtas_word(line, file, number)
        elif found := _FRAMES.fullmatch(line):
            yield number, f"{_word(found[2].upper().split(',')[1:], found[2], file, number)}*{found[1]}"
        elif found := _REPEAT.fullmatch(line):
            counts.append(found[1])
            yield number, "("
        elif line.strip().lower() == "endrepeat":
            yield number, f")*{counts.pop()}" if counts else ")"
        elif found := _READ.fullmatch(line):
            yield number, f"include {found[1].rstrip()}"
        elif line.lstrip().startswith("#"):
            yield number, "" if _SKIPPED.fullmatch(line) else line.strip().replace(" ", "-")
        elif not _SKIPPED.fullmatch(line):
            expected = "frames and keys, such as 30,R,J; Repeat 4, EndRepeat, Read,FILE, #label"
            raise ReplayError("not a line of inputs", file, number, 1, repr(line[:40]), expected)


def write_celeste(inputs: bytes, markers: Sequence[Marker] = ()) -> str:
    """Inputs in the notation of CelesteTAS, a tick a frame. Raises ReplayError for a jump that no keyboard can make."""
    _check_keyboard(inputs)
    names = {marker.tick: marker.name for marker in markers}
    lines = []
    for part, ticks in groupby(enumerate(inputs), lambda tick: (_part(names, tick[0]), tick[1] & KEYS_DOWN)):
        found = list(ticks)
        if found[0][0] in names:
            lines.append(f"#{names[found[0][0]]}")
        lines.append(",".join([f"{len(found):>4}", *KEY_NAMES[part[1]].strip(".")]))
    return "".join(f"{line}\n" for line in lines)


def write_libtas(inputs: bytes) -> str:
    """Inputs as libTAS notes them, a line a tick. Raises ReplayError for a jump that no keyboard can make."""
    _check_keyboard(inputs)
    numbers = {letter: keysym for keysym, letter in reversed(KEYSYMS.items())}
    return "".join(f"|K{':'.join(numbers[letter] for letter in _letters(keys))}|\n" for keys in inputs)


def _letters(keys: int) -> str:
    return KEY_NAMES[keys & KEYS_DOWN].strip(".")


def _part(names: dict[int, str], tick: int) -> int:
    """How many markers there are up to a tick: a line never goes on over one."""
    return sum(each <= tick for each in names)


def _check_keyboard(inputs: bytes) -> None:
    expected = press_jumps(inputs)
    if inputs != expected:
        tick = next(tick for tick, (keys, wanted) in enumerate(zip(inputs, expected, strict=True)) if keys != wanted)
        what = "held" if inputs[tick] & JUMP_HELD else "not held"
        hint = "only replays of ours and demos of N can say it"
        raise ReplayError("a jump that no keyboard can make", found=f"tick {tick}, jump {what}", hint=hint)


def _libtas_word(line: str, file: str, number: int) -> str:
    """The keys of a line ``|Kff53:ffe1|…``, as one of our words; fields of other devices are passed by."""
    fields = [field[1:] for field in line.strip().strip("|").split("|") if field.startswith("K")]
    letters = []
    for keysym in filter(None, ":".join(fields).split(":")):
        if keysym.lower() not in KEYSYMS:
            expected = f"the numbers {', '.join(KEYSYMS)}"
            raise ReplayError("a key that the ninja has not", file, number, 1, repr(keysym[:20]), expected)
        letters.append(KEYSYMS[keysym.lower()])
    return _word(letters, line, file, number)


def _word(letters: Sequence[str], found: str, file: str, number: int) -> str:
    """Keys in our order."""
    if not set(letters) <= set("LRJ"):
        raise ReplayError("a key that the ninja has not", file, number, 1, repr(found[:40]), "L, R and J")
    return "".join(letter for letter in "LRJ" if letter in letters) or "."

"""Notations of inputs: ours, ``R*30 RJ*10 .*5``, and those of CelesteTAS and libTAS (`docs/replay-format.md`)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate, groupby, pairwise, product
from typing import NamedTuple

from ninja_game.errors import ReplayError
from ninja_game.formats.lines import Line, numbered_lines
from ninja_game.sim.inputs import ALL_KEYS, JUMP_HELD, JUMP_PRESSED, KEYS_DOWN, check_inputs, with_press_bits

_WIDTH = 100

KEY_NAMES = (".", "L", "R", "LR", "J", "LJ", "RJ", "LRJ")  # the word for each sum of keys

_WORDS = {
    (keys, usual): KEY_NAMES[keys & KEYS_DOWN] + ("" if keys == usual else "!" if keys & JUMP_PRESSED else "-")
    for keys, usual in product(range(ALL_KEYS + 1), repeat=2)
}
"""The word of a tick by its input; marked if the trigger is not the one of a keyboard, the second number."""


class Marker(NamedTuple):
    """A name of a tick of a run, or a comment there."""

    tick: int
    name: str


_PLAIN_NAME = re.compile(r"[\w.-]+")
_ANY_NAME = re.compile(r'(?! )[^"]{1,100}(?<! )')


def is_marker_name(name: str) -> bool:
    return _ANY_NAME.fullmatch(name) is not None and name.isprintable()


def marker_word(name: str) -> str:
    """Write a marker among inputs, in quotation marks unless its name is plain."""
    return f"#{name}" if _PLAIN_NAME.fullmatch(name) else f'#"{name}"'


def write_inputs(inputs: bytes, markers: Sequence[Marker] = ()) -> list[str]:
    """Write inputs as lines of runs, with a new line for each marker. Raises DemoError for a byte above 15.

    >>> write_inputs(bytes([2, 2, 2, 14, 6, 6, 0]), [Marker(3, "corner")])
    ['R*3', '#corner RJ*3 .']
    """
    check_inputs(inputs)
    ticks = [_WORDS[pair] for pair in zip(inputs, with_press_bits(inputs), strict=True)]
    lines: list[str] = []
    parts = [Marker(0, ""), *sorted(markers), Marker(len(inputs), "")]
    for (start, name), (end, _) in pairwise(parts):
        lines.append(marker_word(name) if name else "")
        for run in _runs(ticks[start:end]):
            longer = f"{lines[-1]} {run}"
            if len(longer) <= _WIDTH:
                lines[-1] = longer.lstrip()
            else:
                lines.append(run)
    return [line for line in lines if line]


def _runs(ticks: Sequence[str]) -> Iterator[str]:
    """Join equal ticks in a row into one word."""
    for text, group in groupby(ticks):
        count = sum(1 for _ in group)
        yield f"{text}*{count}" if count > 1 else text


KEYSYMS = {"ff51": "L", "ff53": "R", "ffe1": "J", "ffe2": "J", "7a": "J", "20": "J"}
"""Keys by their X11 numbers: the arrows; the shift keys, Z and space jump. Writing uses the first of a kind."""

_MAX_FRAMES = 9999  # most frames in a line of CelesteTAS

_FRAMES = re.compile(r"([0-9]{1,7})((?:[ \t]*+,[ \t]*+[A-Za-z0-9.]++)*+)[ \t]*+,?[ \t]*+(?:#.*)?")
_REPEAT = re.compile(r"repeat[ ,]+([1-9][0-9]{0,6})", re.IGNORECASE)
_END = re.compile(r"endrepeat[ ,]*", re.IGNORECASE)
_READ = re.compile(r"read[ ,]+([^,]+),?([^,].*)?", re.IGNORECASE)
_SKIPPED = re.compile(r"#\s.*|#{1,2}|#{2,}.*|\*\*\*.*")
_ABOUT = re.compile(
    r"console[ ,]+load[ ,].*|(?:unsafe|safe|enforcelegal|enforcemaingame|analogmode|completeinfo|exitgame|"
    r"(?:start|finish|end)export\w*|(?:start|stop)recording)(?:[ ,].*)?|(?:author|\w*count|\w*time)[ ]*:.*",
    re.IGNORECASE,
)
"""Lines of CelesteTAS about its own game or about the run, which have no keys."""
_ODD = re.compile(r"[^\w.-]+")
_KEYS = re.compile(r"[0-9a-f]+(:[0-9a-f]+)*")


def is_tas_text(text: str) -> bool:
    """Whether a text may be in one of these notations."""
    for _, raw in numbered_lines(text):
        line = raw.strip()
        if not _SKIPPED.fullmatch(line) and not line.startswith("#") and not _ABOUT.fullmatch(line):
            return line.startswith("|") or any(form.fullmatch(line) for form in (_FRAMES, _REPEAT, _READ))
    return False


def in_our_notation(text: str, file: str = "") -> Iterator[Line]:
    """Translate lines of another tool's inputs to the notation of our replays, with their numbers.

    Raises ReplayError for keys and commands that have no meaning for the ninja.
    """
    repeats: list[tuple[int, str]] = []
    names: dict[str, int] = {}
    for number, raw in numbered_lines(text):
        line = raw.strip()
        if _SKIPPED.fullmatch(line) or _ABOUT.fullmatch(line):
            continue
        if line.startswith("#"):
            yield number, _label(line, names)
        elif line.startswith("|"):
            yield number, _libtas_word(line, file, number)
        elif match := _FRAMES.fullmatch(line):
            word = _celeste_word(match[2], file, number)
            yield number, f"{word}*{int(match[1])}" if int(match[1]) else ""
        elif match := _REPEAT.fullmatch(line):
            repeats.append((number, match[1]))
            yield number, "("
        elif _END.fullmatch(line):
            if not repeats:
                raise ReplayError("EndRepeat without Repeat", file, number, 1, hint="begin with Repeat 4 before it")
            yield number, f")*{repeats.pop()[1]}"
        else:
            yield number, _included(line, file, number)
    if repeats:
        raise ReplayError(
            "Repeat without EndRepeat", file, repeats[-1][0], 1, hint="end what it repeats with EndRepeat"
        )


def _label(line: str, names: dict[str, int]) -> str:
    """Turn a label into a marker: '-' replaces characters that its name cannot have; repeated names get a number.

    ``names``: how often each name was used so far.
    """
    name = _ODD.sub("-", line[1:]).strip("-")[:90] or "label"
    names[name] = names.get(name, 0) + 1
    free = name
    while names[name] > 1 and free in names:
        free = f"{name}-{names[name]}"
        names[name] += free in names
    names.setdefault(free, 1)
    return f"#{free}"


def _included(line: str, file: str, number: int) -> str:
    """Translate a line that includes another file. Raises ReplayError for any other line."""
    match = _READ.fullmatch(line)
    if match is None:
        expected = "frames and keys, such as 30,R,J; Repeat 4, EndRepeat, Read,FILE, #label"
        hint = "other commands of CelesteTAS have no meaning here: take the line out"
        raise ReplayError("not a line of inputs", file, number, 1, repr(line[:40]), expected, hint)
    if match[2]:
        hint = "put the lines that are wanted into a file of their own"
        raise ReplayError("a part of another file", file, number, 1, repr(line[:40]), "Read,FILE", hint)
    name = match[1].strip()
    return f"include {name if '.' in name else name + '.tas'}"


def write_celeste(inputs: bytes, markers: Sequence[Marker] = ()) -> str:
    """Write inputs for CelesteTAS, a frame per tick. Raises ReplayError for a jump that no keyboard can make."""
    _check_keyboard(inputs)
    names = {marker.tick: marker.name for marker in markers}
    lines = []
    # Number the ticks by the markers so far: a line of the text ends at a marker.
    parts = accumulate(tick in names for tick in range(len(inputs)))
    written = 0
    for (_, keys), ticks in groupby(zip(parts, (down & KEYS_DOWN for down in inputs), strict=True)):
        if written in names:
            lines.append(f"#{names[written]}")
        count = sum(1 for _ in ticks)
        frames = (min(_MAX_FRAMES, count - first) for first in range(0, count, _MAX_FRAMES))
        lines += [",".join([f"{frame:>4}", *KEY_NAMES[keys].strip(".")]) for frame in frames]
        written += count
    return "".join(f"{line}\n" for line in lines)


def write_libtas(inputs: bytes) -> str:
    """Write inputs for libTAS, one line per tick. Raises ReplayError for a jump that no keyboard can make."""
    _check_keyboard(inputs)
    numbers = {letter: keysym for keysym, letter in reversed(KEYSYMS.items())}
    lines = []
    for keys in inputs:
        letters = KEY_NAMES[keys & KEYS_DOWN].strip(".")
        lines.append("|K" + ":".join(numbers[letter] for letter in letters) + "|\n")
    return "".join(lines)


def _check_keyboard(inputs: bytes) -> None:
    expected = with_press_bits(inputs)
    if inputs != expected:
        tick = next(tick for tick, (keys, due) in enumerate(zip(inputs, expected, strict=True)) if keys != due)
        what = "held" if inputs[tick] & JUMP_HELD else "not held"
        hint = "only replays of ours and demos of N can say it"
        raise ReplayError("a jump that no keyboard can make", found=f"tick {tick}, jump {what}", hint=hint)


def _libtas_word(line: str, file: str, number: int) -> str:
    """Translate the keys of a line ``|Kff53:ffe1|…`` to one of our words; fields of other devices are skipped."""
    fields = line.strip("|").split("|")
    keys = [field[1:] for field in fields if field.startswith("K")]
    if not keys and _KEYS.fullmatch(fields[0]):
        # Older movies have no letter before the keys.
        keys = fields[:1]
    letters = []
    for keysym in filter(None, ":".join(keys).lower().split(":")):
        letter = KEYSYMS.get(keysym.strip().lstrip("0"))
        if letter is None:
            expected = f"the numbers {', '.join(KEYSYMS)}"
            hint = "take it out, or replace it: the ninja runs left and right, and jumps"
            raise ReplayError("a key that the ninja has not", file, number, 1, repr(keysym[:20]), expected, hint)
        letters.append(letter)
    return sorted_letters(letters)


def _celeste_word(token: str, file: str, number: int) -> str:
    """Translate the keys after the number of frames to one of our words."""
    letters = "".join(token.upper().replace(",", " ").split())
    if not set(letters) <= set("LRJ"):
        hint = "a second jump key would press again what is held: write J" if "K" in letters else "take it out"
        raise ReplayError("a key that the ninja has not", file, number, 1, repr(token[:40]), "L, R and J", hint)
    return sorted_letters(letters)


def sorted_letters(letters: Iterable[str]) -> str:
    """Sort keys into the order of the notation, L, R, J, without repetition."""
    return "".join(letter for letter in "LRJ" if letter in [*letters]) or "."

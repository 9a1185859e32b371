"""Demos, the recordings of the game: ``<length>:<word>|<word>|…``, 4 bits a tick, 7 ticks a word (game.md §4.1).

Demos of older versions begin with ``A`` and have 3 bits a tick, no trigger and no length (game.md §4.2); two defects of
their reader are kept, so that such texts play as in the game.
"""

from __future__ import annotations

import math
import re

from ninja_game.errors import DemoError
from ninja_game.formats.numbers import format_number, parse_flash_number
from ninja_game.sim.inputs import MAX_TICKS, Demo, check_inputs, fit_demo, with_press_bits

TICKS_PER_WORD = 7
_PLAIN_WORD = re.compile(r"0|[1-9][0-9]{0,14}")
_WORD_BITS = 0xFFFFFFF
_KEYS_OF_HEX = bytes.maketrans(b"0123456789abcdef", bytes(range(16)))


def parse_demo(text: str, *, length: float | None = None) -> Demo:
    r"""Read a demo text: 4 bits a tick, or the legacy format if it starts with ``A`` (game.md §4.1, §4.2).

    Odd texts read as in the game: a missing or malformed number is 0, a second ``:`` ends the words. ``length`` is the
    playback length of legacy texts, which have none; without it all of the text is played.

    Raises DemoError for a text that is too long, and for a legacy text that the game cannot have written.

    >>> demo = parse_demo("3:801")
    >>> demo.inputs, demo.playback(5)
    (b'\x01\x02\x03', b'\x01\x02\x03\x03\x00')
    """
    if text.startswith("A"):
        return parse_legacy_demo(text, length=length)
    length_text, _, rest = text.partition(":")
    words = rest.partition(":")[0]
    if (words.count("|") + 1) * TICKS_PER_WORD >= MAX_TICKS:
        found = f"{words.count('|') + 1} words"
        raise DemoError("a demo that is too long", found=found, expected=f"at most {MAX_TICKS // TICKS_PER_WORD}")
    # Seven ticks per word, the first in the lowest bits.
    digits = "".join([f"{_word(word):07x}"[::-1] for word in words.split("|")])
    return fit_demo(digits.encode("ascii").translate(_KEYS_OF_HEX), parse_flash_number(length_text))


def _word(text: str) -> int:
    """The low 28 bits of a word; a negative one counts modulo 2^32, a malformed one is 0."""
    if _PLAIN_WORD.fullmatch(text):
        return int(text) & _WORD_BITS
    value = parse_flash_number(text)
    return int(value) & _WORD_BITS if math.isfinite(value) else 0


def write_demo(demo: Demo) -> str:
    """Write a demo as the game does: after a full word it begins another one, 0 (game.md §4.1).

    Raises DemoError for keys above 15 or a length that is not a number.
    """
    check_inputs(demo.inputs)
    if math.isnan(demo.length):
        raise DemoError("a demo needs a length", found="NaN", expected="the number of ticks")
    words = []
    for start in range(0, len(demo.inputs) + 1, TICKS_PER_WORD):
        word = 0
        for keys in reversed(demo.inputs[start : start + TICKS_PER_WORD]):
            word = word << 4 | keys
        words.append(str(word))
    return f"{format_number(demo.length)}:{'|'.join(words)}"


MAX_DIGITS = 50_000  # the game stops recording at 5000 words of ten ticks

_DIGIT_RUN = re.compile(r"7([0-7])([0-7]{2})|7.*", re.DOTALL)
_RUN_OFFSET = 4

_RUN_CODES = range(103, 151)
_CODE_OFFSET = 100

_PADDING = "3"
_FIRST_PAIR, _LAST_PAIR, _BACKSLASH = 34, 98, 92

_KEYS_OF_DIGIT = bytes.maketrans(b"01234567", bytes(range(8)))


def parse_legacy_demo(text: str, *, length: float | None = None) -> Demo:
    """Read the inputs of a legacy demo text; without ``length`` all of it is played.

    Raises DemoError, with the column, for a text that the game cannot have written.
    """
    if not text.startswith("A"):
        raise DemoError("not a legacy demo", column=1, found=repr(text[:1]), expected="'A'")
    # Defect (b): a last 3 is dropped even if it was not padding, and with it the rest of its run.
    pairs = _digits_of_chars(text).removesuffix(_PADDING)
    digits = _DIGIT_RUN.sub(lambda run: run[1] * (int(run[2], 8) + _RUN_OFFSET) if run[1] else "", pairs)
    _check_length(len(digits))
    inputs = with_press_bits(digits.encode("ascii").translate(_KEYS_OF_DIGIT))
    return fit_demo(inputs, float(len(digits)) if length is None else length)


def _digits_of_chars(text: str) -> str:
    """The digit pairs of the characters after the ``A``, with runs of characters expanded."""
    pairs = []
    count = 0
    place = 1
    while place < len(text):
        code = ord(text[place])
        if code in _RUN_CODES:
            times = code - _CODE_OFFSET
            pairs.append(_pair(text, place + 1) * times)
            place += 3  # defect (a): the character after a run is lost
        else:
            times = 1
            pairs.append(_pair(text, place))
            place += 1
        count += times * 2
        _check_length(count)
    return "".join(pairs)


def _pair(text: str, place: int) -> str:
    """The two octal digits of the character at ``place``."""
    code = ord(text[place]) if place < len(text) else 0
    if not _FIRST_PAIR <= code <= _LAST_PAIR or code == _BACKSLASH:
        found, expected = repr(text[place]) if code else "the end of the text", 'one of " to b, no backslash'
        raise DemoError("a character that no legacy demo has here", column=place + 1, found=found, expected=expected)
    return f"{code - _FIRST_PAIR - (code > _BACKSLASH):02o}"


def _check_length(digits: int) -> None:
    """Raise DemoError for more digits than the game records (one may be padding)."""
    if digits > MAX_DIGITS + 1:
        raise DemoError("a legacy demo that is too long", found=f"{digits} ticks", expected=f"at most {MAX_DIGITS}")

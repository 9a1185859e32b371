"""Demos, the recordings of the game: ``<length>:<word>|<word>|…``, 4 bits a tick, 7 ticks a word (game.md §4.1)."""

from __future__ import annotations

import math
import re

from ninja_game.errors import DemoError
from ninja_game.formats.n14.legacy_demo import parse_legacy_demo
from ninja_game.formats.numbers import format_number, parse_number
from ninja_game.sim.inputs import MAX_TICKS, Demo, check_inputs, fitted_demo

TICKS_PER_WORD = 7
_PLAIN_WORD = re.compile(r"0|[1-9][0-9]{0,14}")
_WORD_BITS = 0xFFFFFFF
_KEYS_OF_HEX = bytes.maketrans(b"0123456789abcdef", bytes(range(16)))


def parse_demo(text: str, *, length: float | None = None) -> Demo:
    r"""The inputs in a demo text: 4 bits a tick, or the legacy format if it starts with ``A`` (game.md §4.1, §4.2).

    Follows the game on odd texts: what is missing or no number reads as 0, a second ``:`` ends the words. ``length``
    is the playback length of legacy texts, which do not hold it; without it all of it is played.

    Raises DemoError for a legacy text that the game cannot have written.

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
    return fitted_demo(_inputs_of_words(words.split("|")), parse_number(length_text))


def _inputs_of_words(words: list[str]) -> bytes:
    """Seven ticks a word, the first in the lowest bits."""
    return "".join([f"{_word(word):07x}"[::-1] for word in words]).encode("ascii").translate(_KEYS_OF_HEX)


def _word(text: str) -> int:
    """The low 28 bits of a word; a negative one counts modulo 2^32, one that is not a number is 0."""
    if _PLAIN_WORD.fullmatch(text):
        return int(text) & _WORD_BITS
    value = parse_number(text)
    return int(value) & _WORD_BITS if math.isfinite(value) else 0


def write_demo(demo: Demo) -> str:
    """The demo text as the game writes it: a word 0 is begun as soon as one is full (game.md §4.1).

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

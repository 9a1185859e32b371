"""The legacy texts of demos, as N wrote them (game.md §4.2): the game only reads them."""

import re

from ninja_game.errors import DemoError
from ninja_game.formats.n14.demo import MAX_DIGITS
from ninja_game.sim.inputs import Demo, check_inputs

_SAME_DIGITS = re.compile(r"([0-7])\1{4,66}")
_SAME_CHARS = re.compile(r"(.)\1{2,49}", re.DOTALL)
_CHAR_OF_PAIR = {f"{value:02o}": chr(34 + value + (34 + value >= ord("\\"))) for value in range(64)}
_DIGIT_OF_KEYS = bytes.maketrans(bytes(range(16)), b"0120456401204564")


def write_legacy_demo(demo: Demo) -> str:
    """The legacy text of a demo's inputs, padded to whole words; triggers and length are lost.

    Left and right together are written as neither. Raises DemoError for more ticks than the game records.
    """
    check_inputs(demo.inputs)
    padded = len(demo.inputs) // 10 * 10 + 10
    if padded - 1 > MAX_DIGITS + 1:
        raise DemoError("a legacy demo that is too long")
    digits = demo.inputs.translate(_DIGIT_OF_KEYS).decode("ascii").ljust(padded, "0")
    digits = _SAME_DIGITS.sub(lambda run: f"7{run[1]}{len(run[0]) - 4:02o}", digits)
    if len(digits) % 2:
        digits += "3"
    chars = "".join(_CHAR_OF_PAIR[digits[place : place + 2]] for place in range(0, len(digits), 2))
    return "A" + _SAME_CHARS.sub(lambda run: chr(100 + len(run[0])) + run[1], chars)

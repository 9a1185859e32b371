"""Flash's number rule: it turns the decimals of level strings and demos into float64, and back into text.

The numbers are *not* rounded correctly, and positions depend on that (game.md §5.2): a value is the running sum of the
values of its digits, each made by repeated squaring. Never "repair" this with ``float``.
"""

from __future__ import annotations

import math
import re
import sys
from decimal import Decimal
from functools import cache, lru_cache

from ninja_game.sim.rules import NAN  # the only NaN that reading gives: as one object it makes equal texts equal tuples

_SHORT_WHOLE = re.compile(r"0|[1-9][0-9]{0,14}")
_DECIMAL = re.compile(r"[ \t\r\n]*([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]+))?")
_HEX = re.compile(r"0[xX]([0-9a-fA-F]+)")
_OCTAL = re.compile(r"([+-]?)(0[0-7]+)")

# From this power on the squared factor is infinite: a digit is worth infinity, a zero NaN (0 times infinity).
_INFINITE_POWER = 512
# Below this power every digit is worth 0.
_MIN_POWER = -330
_EXPONENT_LIMIT = 10**6
_SMALLEST = math.ulp(0.0)


def parse_flash_number(text: str) -> float:
    """Read ``text`` as Flash does; NaN if it is not a number (game.md §5.2).

    A number has blanks, a sign, digits with an optional point, an optional exponent; nothing may follow. ``0x1F``
    without a sign is hexadecimal, and digits 0-7 after a leading 0 are octal, both as wrapping 32-bit integers.
    A zero has no sign.

    >>> parse_flash_number("408.15"), parse_flash_number("0.707106781186547"), parse_flash_number("685 ")
    (408.15000000000003, 0.7071067811865468, nan)
    """
    if _SHORT_WHOLE.fullmatch(text):
        return float(text)  # up to 15 digits every partial sum is an exact integer
    match = _DECIMAL.fullmatch(text)
    if match is None:
        match = _HEX.fullmatch(text)
        return _wrapped(int(match[1][-8:], 16)) if match else NAN
    octal = _OCTAL.fullmatch(text)
    if octal:
        value = _wrapped(int(octal[2][-11:], 8))
        return _signed(value, octal[1])
    sign, whole, fraction, exponent = match.groups()
    digits = whole + (fraction or "")
    if not digits:
        return NAN
    power = len(whole) - 1
    if exponent:
        power += _bounded_exponent(exponent)
    return _signed(_digit_sum(digits, power), sign)


def _signed(value: float, sign: str) -> float:
    """Apply the sign; 0.0 for either zero."""
    return (-value if sign == "-" else value) or 0.0


def _wrapped(value: int) -> float:
    """The 32-bit signed integer with these low bits, as float64."""
    return float(((value & 0xFFFFFFFF) ^ 0x80000000) - 0x80000000)


def _bounded_exponent(text: str) -> int:
    """The exponent, limited to the range that matters for any text of sane length (``int`` refuses endless ones)."""
    size = text.lstrip("+-").lstrip("0")
    value = min(int(size[:9] or "0"), _EXPONENT_LIMIT)
    return -value if text.startswith("-") else value


def _digit_sum(digits: str, power: int) -> float:
    """The sum of S(z, e) over the digits from the left; e decreases from ``power``."""
    if power >= _INFINITE_POWER:
        return NAN if "0" in digits[: power - _INFINITE_POWER + 1] else math.inf
    total = 0.0
    for digit in digits:
        if power < _MIN_POWER:
            break
        total += _digit_value(digit, power)
        power -= 1
    return total


@cache  # at most 10 digits at 843 powers
def _digit_value(digit: str, power: int) -> float:
    """S(z, e): ``digit`` times ten to the ``power`` by squaring, rounded after every step (game.md §5.2)."""
    value, base = float(digit), 10.0
    steps = abs(power)
    while steps:
        if steps & 1:
            value = value * base if power > 0 else value / base
        steps >>= 1
        base *= base
    return value


def format_number(value: float) -> str:
    """Write the shortest decimal with at most 15 significant digits; ``NaN`` for NaN (game.md §5.3).

    A value that was read from a decimal of up to 15 digits reads back the same; other values are rounded. Infinity,
    which the game cannot write, becomes ``1e999``.

    >>> format_number(0.7071067811865468), format_number(-24.0), format_number(0.1 + 0.2)
    ('0.707106781186547', '-24', '0.3')
    """
    return _odd_text(value) or _shortest_text(value, 15) or _plain(Decimal(f"{value:.15g}"))


@lru_cache(maxsize=2**17)  # all numbers of a level with the most objects, which is written and then compared
def format_exact(value: float) -> str:
    """Write the shortest decimal that ``parse_flash_number`` reads as exactly this value; the nearest if there is none.

    Digit sums miss some float64 values, such as 1.13 and 1.15, but hardly any coordinate.
    """
    return _odd_text(value) or _shortest_text(value, 20) or _plain(Decimal(f"{value:.17g}"))


def _odd_text(value: float) -> str:
    """Text of integers, NaN and infinities, '' for all others."""
    if value != value:  # noqa: PLR0124  # NaN
        return "NaN"
    if math.isinf(value):
        return "1e999" if value > 0 else "-1e999"
    return str(int(value)) if abs(value) < 1e15 and value == int(value) else ""


def _shortest_text(value: float, digits: int) -> str:
    """The shortest decimal of at most ``digits`` significant digits that reads as ``value``, '' if there is none.

    The search covers all texts: digit by digit, it keeps every sum that further digits can complete to the value.
    """
    size = abs(value)
    unit = math.ulp(size)
    first = Decimal(size).adjusted() + 1
    # A digit worth less than half a unit of the sum, which may be just below a power of two, changes nothing.
    last = max(first - digits, Decimal(unit).adjusted() - 1)
    power, sums = _first_sums(size, first)
    while size not in sums and power > last:
        power -= 1
        sums = _longer_sums(sums, size, power, (power - last + 1) * unit)
    if size not in sums:
        return ""
    text = _plain(Decimal(f"{sums[size]}e{power}"))
    return f"-{text}" if value < 0 else text


def _first_sums(size: float, first: int) -> tuple[int, dict[float, str]]:
    """The power of ten of the last digits, and sums with their digits, of all texts that may read as ``size``.

    If a unit of the sum is far below the 13th digit, they can only be the nearest 13 digits and those one less.
    """
    if not sys.float_info.min <= size < 1e308:
        return min(first, sys.float_info.max_10_exp) + 1, {0.0: ""}
    mantissa, exponent = f"{size:.12e}".split("e")
    nearest = int(mantissa.replace(".", ""))
    texts = [f"{digits:013}" for digits in (nearest - 1, nearest)]
    sums = {_digit_sum(digits, int(exponent)): digits for digits in texts}
    return int(exponent) - 12, sums


def _longer_sums(sums: dict[float, str], size: float, power: int, roundings: float) -> dict[float, str]:
    """Sums and their digits with one more digit, if further digits can complete them to ``size``.

    ``roundings``: the most that rounding can change these sums and the following ones.
    """
    worth = _digit_values(power)
    one = worth[1]
    slack = roundings + one * 2.0**-46 + 2 * _SMALLEST  # more than the roundings of the digits, too
    longer: dict[float, str] = {}
    for total, text in sums.items():
        rest = size - total
        low, high = 0, 10
        if one:
            low = max(0, int(rest / one - slack / one - 0.01))
            high = min(10, int(rest / one + slack / one + 0.01) + 1)
        for digit in range(low, high):
            if -slack <= size - (total + worth[digit]) <= one + slack:
                longer.setdefault(total + worth[digit], f"{text}{digit}")
    return longer


@cache
def _digit_values(power: int) -> tuple[float, ...]:
    return tuple(_digit_value(digit, power) for digit in "0123456789")


def _plain(number: Decimal) -> str:
    """Write a decimal without superfluous zeros, and without exponent unless it is very large or very small."""
    number = number.normalize()
    if -7 <= number.adjusted() < 21:
        return f"{number:f}"
    return f"{number:e}".replace("+", "")

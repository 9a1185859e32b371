"""Flash's number rule: how the decimals of level strings and demos become float64, and how they are written.

They are *not* rounded correctly, and positions depend on it (game.md §5.2): the value is the running sum of the digits'
own values, each made by repeated squaring. Nothing here may be "repaired" with ``float``.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from functools import cache

NAN = math.nan
"""The one NaN that reading gives; being one object, it makes equal texts equal tuples."""

_PLAIN = re.compile(r"0|[1-9][0-9]{0,14}")
_DECIMAL = re.compile(r"[ \t\r\n]*([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]+))?")
_HEX = re.compile(r"0[xX]([0-9a-fA-F]+)")
_OCTAL = re.compile(r"([+-]?)(0[0-7]+)")

# From this power on, squaring has made the factor infinite: a digit is worth infinity, a zero NaN (0 times infinity).
_INFINITE_POWER = 512
# Below this power every digit is worth 0.
_LOWEST_POWER = -330
_EXPONENT_LIMIT = 10**6


def parse_number(text: str) -> float:
    """The float64 that Flash reads from ``text``; NaN when it is no number (game.md §5.2).

    Blanks, a sign, digits with an optional point, an optional exponent; nothing may follow. ``0x1F`` without a sign is
    hexadecimal and digits 0-7 after a leading 0 are octal, both as wrapping 32-bit integers. A zero has no sign.

    >>> parse_number("408.15"), parse_number("0.707106781186547"), parse_number("685 ")
    (408.15000000000003, 0.7071067811865468, nan)
    """
    if _PLAIN.fullmatch(text):
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
    """The value with its sign; 0.0 for either zero."""
    return (-value if sign == "-" else value) or 0.0


def _wrapped(value: int) -> float:
    """The 32-bit signed integer with these low bits, as float64."""
    return float(((value & 0xFFFFFFFF) ^ 0x80000000) - 0x80000000)


def _bounded_exponent(text: str) -> int:
    """The exponent, cut to where it no longer matters for any text of sane length (``int`` refuses endless ones)."""
    size = text.lstrip("+-").lstrip("0")
    value = min(int(size[:9] or "0"), _EXPONENT_LIMIT)
    return -value if text.startswith("-") else value


def _digit_sum(digits: str, power: int) -> float:
    """The sum of S(z, e) over the digits from the left, e falling from ``power``."""
    if power >= _INFINITE_POWER:
        return NAN if "0" in digits[: power - _INFINITE_POWER + 1] else math.inf
    total = 0.0
    for digit in digits:
        if power < _LOWEST_POWER:
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
    """The shortest decimal with at most 15 significant digits; ``NaN`` for NaN (game.md §5.3).

    What was read from a decimal of up to 15 digits is written so that it reads back the same; other values are rounded.
    Infinity, which the game cannot write, becomes ``1e999``.

    >>> format_number(0.7071067811865468), format_number(-24.0), format_number(0.1 + 0.2)
    ('0.707106781186547', '-24', '0.3')
    """
    return _odd_text(value) or _text_that_reads_as(value, 15) or _plain(Decimal(f"{value:.15g}"))


def format_exact(value: float) -> str:
    """A short decimal that ``parse_number`` reads as exactly this value.

    The digit sum misses some float64 (very large or small ones, hardly any coordinate): there the nearest decimal.
    """
    text = _odd_text(value)
    for digits in (15, 16, 17, 18, 19, 20):
        text = text or _text_that_reads_as(value, digits)
    return text or _text_around(value) or _plain(Decimal(f"{value:.17g}"))


def _odd_text(value: float) -> str:
    """Text of integers, NaN and infinities, '' for all others."""
    if value != value:  # noqa: PLR0124  # NaN
        return "NaN"
    if math.isinf(value):
        return "1e999" if value > 0 else "-1e999"
    return str(int(value)) if abs(value) < 1e15 and value == int(value) else ""


def _text_that_reads_as(value: float, digits: int) -> str:
    """A decimal of ``digits`` significant digits that reads as ``value``, '' when a short search finds none.

    The digit sum is off by a few units in the last place, so the decimal is aimed off by the error that the last try
    had, and its two neighbours are tried with it.
    """
    aim = Decimal(value)
    for _ in range(6):
        near = Decimal(f"{aim:.{digits - 1}e}")
        unit = Decimal(1).scaleb(near.adjusted() - digits + 1)
        found = parse_number(_plain(near))
        if not math.isfinite(found):
            return ""
        for decimal in (near, near - unit, near + unit):
            text = _plain(decimal)
            if parse_number(text) == value:
                return text
        aim += Decimal(value) - Decimal(found)
    return ""


def _text_around(value: float) -> str:
    """A decimal of 17 digits in the neighbourhood that reads as ``value``, '' if there is none.

    The last resort: neighbouring decimals need not read in their order.
    """
    near = Decimal(f"{value:.16e}")
    unit = Decimal(1).scaleb(near.adjusted() - 16)
    texts = (_plain(near + steps * unit) for steps in range(-99, 100))
    return next((text for text in texts if parse_number(text) == value), "")


def _plain(number: Decimal) -> str:
    """A decimal without superfluous zeros, without exponent unless it is very large or very small."""
    number = number.normalize()
    if -7 <= number.adjusted() < 21:
        return f"{number:f}"
    return f"{number:e}".replace("+", "")

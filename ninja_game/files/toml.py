"""TOML texts from anybody: read by the library, within limits."""

from __future__ import annotations

import re
import tomllib
from typing import Any

MOST_PARTS = 50
"""Parts of a key with dots; the library takes time with the square of their number."""

_PART = r"""(?:(?<![\w-])[\w-]++|(?<!\\)"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')"""
_LONG_KEY = re.compile(rf"(?:{_PART}[ \t]*+\.[ \t]*+){{{MOST_PARTS}}}")


def parse_toml(text: str, *, any_number: bool = False) -> dict[str, Any]:
    """The table in a TOML text. Raises ValueError, with line and column in its words where it can.

    ``any_number``: also with numbers that TOML does not have, of which Python may refuse to tell the digits.
    """
    long_key = _LONG_KEY.search(text)
    if long_key:
        before = text[: long_key.start()]
        place = f"(at line {before.count(chr(10)) + 1}, column {len(before) - before.rfind(chr(10))})"
        raise ValueError(f"A key of more than {MOST_PARTS} parts {place}")
    try:
        table = tomllib.loads(text)
        if not any_number:
            _check_numbers(table)
    except RecursionError:
        raise ValueError("Nested too deep") from None
    return table


def _check_numbers(value: object) -> None:
    """Raise ValueError for a whole number of more than 64 bits."""
    if isinstance(value, dict | list):
        for each in value.values() if isinstance(value, dict) else value:
            _check_numbers(each)
    elif isinstance(value, int) and not -(2**63) <= value < 2**63:
        raise ValueError("A whole number of more than 64 bits")

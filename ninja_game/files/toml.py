"""TOML of strangers, read in a time that grows with its length."""

from __future__ import annotations

import re
import tomllib
from typing import Any

MOST_PARTS = 50
"""Of a key with dots; the library takes the square of their number."""

_PART = r"""(?:(?<![\w-])[\w-]++|(?<!\\)"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')"""
_LONG_KEY = re.compile(rf"(?:{_PART}[ \t]*+\.[ \t]*+){{{MOST_PARTS}}}")


def parse_toml(text: str) -> dict[str, Any]:
    """The table in a TOML text. Raises ValueError, with line and column in its words."""
    long_key = _LONG_KEY.search(text)
    if long_key:
        before = text[: long_key.start()]
        place = f"(at line {before.count(chr(10)) + 1}, column {len(before) - before.rfind(chr(10))})"
        raise ValueError(f"A key of more than {MOST_PARTS} parts {place}")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("Nested too deep") from None

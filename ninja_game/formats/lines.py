"""The non-empty lines of a text, with their numbers; the text of a header's value."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

MAX_NAME = 1000  # most characters of a name of a level, run or author: tables repeat it in every row

Line = tuple[int, str]  # a line with its number, from 1

FILLED = re.compile(r"^[^\S\n]*+\S[^\n]*", re.MULTILINE)  # a line that is not blank

UNCOMMENTED = re.compile(r"^[^\S\n]*+(?!;)\S[^\n]*", re.MULTILINE)
"""A line that is neither blank nor a comment; comments begin with a semicolon."""


def numbered_lines(text: str, wanted: re.Pattern[str] = FILLED) -> Iterator[Line]:
    r"""The lines that ``wanted`` matches; megabytes of other lines take no time. Accepts all kinds of line ends.

    >>> list(numbered_lines("a\r\n\r\n b"))
    [(1, 'a'), (3, ' b')]
    """
    text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    number, before = 1, 0
    for match in wanted.finditer(text):
        number += text.count("\n", before, match.start())
        before = match.start()
        yield number, match[0]


def header_text(value: str) -> str:
    """Write a header's value: in double quotes as JSON if it would not read back otherwise."""
    plain = value == value.strip() and not value.startswith('"') and value.isprintable()
    return value if plain else json.dumps(value)


def read_quoted(text: str) -> str | None:
    """Read a text in double quotes, with JSON's escapes; None if it is malformed."""
    try:
        value = json.loads(text)
    except ValueError:
        return None
    return value if isinstance(value, str) else None

"""The non-empty lines of a text, with their numbers; writing a header's value."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

MAX_NAME = 1000  # characters of the name of a level, a run or an author: tables repeat it in every row

Line = tuple[int, str]  # a line with its number, from 1

FILLED = re.compile(r"^[^\S\n]*+\S[^\n]*", re.MULTILINE)  # a line that is not blank

UNCOMMENTED = re.compile(r"^[^\S\n]*+(?!;)\S[^\n]*", re.MULTILINE)
"""A line that is neither blank nor a comment, which begins with a semicolon."""


def numbered_lines(text: str, wanted: re.Pattern[str] = FILLED) -> Iterator[Line]:
    r"""The lines that ``wanted`` matches; megabytes of others take no time. All line ends are known.

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
    """A header's value in writing: in double quotes as JSON if it would not read back otherwise."""
    plain = value == value.strip() and not value.startswith('"') and value.isprintable()
    return value if plain else json.dumps(value)


def read_quoted(text: str) -> str | None:
    """The text in double quotes, with JSON's escapes; None if it is malformed."""
    try:
        value = json.loads(text)
    except ValueError:
        return None
    return value if isinstance(value, str) else None

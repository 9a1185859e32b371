"""Names are data: texts of strangers made safe to show in one line, and to name files with."""

from __future__ import annotations

import re

LONGEST = 200
"""How many characters of a text are shown; no name of a level or player comes near."""

_LONGEST_STEM = 50
_NOT_IN_NAMES = re.compile(r"[^\w.]+")


def shown_text(text: str, longest: int = LONGEST) -> str:
    r"""The text as one line of printable characters, for terminals, reports and windows.

    White space becomes blanks, every other character without a shape of its own (control characters, marks of writing
    direction, halves of surrogate pairs) its escape; what is longer ends in dots.

    >>> shown_text("two\nlines"), shown_text("\x1b[31mred\u202e"), shown_text("Any name", 4)
    ('two lines', '\\x1b[31mred\\u202e', 'Any ...')
    """
    if len(text) > longest:
        return shown_text(text[:longest]) + "..."
    return text if text.isprintable() else "".join(map(shown_character, text))


def shown_character(character: str) -> str:
    """One character of ``shown_text``."""
    if character.isprintable():
        return character
    return " " if character.isspace() else character.encode("unicode_escape").decode("ascii")


def file_stem(text: str, otherwise: str = "") -> str:
    """The text as the first part of a file's name: small letters, digits, ``_ . -``; ``otherwise`` if none is left.

    >>> file_stem("Über - the hill?"), file_stem("../..", "replay")
    ('über-the-hill', 'replay')
    """
    return _NOT_IN_NAMES.sub("-", text[:LONGEST].lower())[:_LONGEST_STEM].strip("-.") or otherwise

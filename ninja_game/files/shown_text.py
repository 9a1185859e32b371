"""Untrusted texts made safe to show in one line, and as names of files."""

from __future__ import annotations

import re
from collections.abc import Container, Sequence
from itertools import chain, count
from unicodedata import category, normalize

MAX_SHOWN = 200  # most characters shown; no name of a level or player comes near

MAX_NAME_BYTES = 200  # bytes of a file's name in UTF-8: systems take 255, and a number, a suffix or `.lock` may follow

_MAX_STEM = 50
_NOT_IN_NAMES = re.compile(r"[^\w.]+")
_BLANKS = re.compile(r"\s{2,}")
INVISIBLE = re.compile(
    "[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u2065\u2800\u3164\ufe00-\ufe0f\uffa0\U0001d159\U000e0000-\U000e0fff]"
)
"""Printable but invisible, besides format characters (Cf): fillers, variation selectors, blank signs."""
_NOWHERE = '/\\:*?"<>|'
_RESERVED = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[1-9¹²³]) *(\..*)?", re.IGNORECASE | re.DOTALL)
"""Names that mean devices on Windows, whatever their suffix."""


def counted(number: int, one: str, more: str = "") -> str:
    """A number with its noun.

    >>> counted(1, "try", "tries"), counted(2, "try", "tries"), counted(1200, "tick")
    ('1 try', '2 tries', '1,200 ticks')
    """
    return f"{number:,} {one if number == 1 else more or one + 's'}"


def files_text(what: str, names: Sequence[str]) -> str:
    """A sentence about files; '' without any.

    >>> files_text("Cannot be read", ["a.txt"]), files_text("Without runs", ["a.txt", "b.txt", "c.txt"])
    ('Cannot be read: a.txt', 'Without runs: a.txt and 2 more files')
    """
    if not names:
        return ""
    more = f" and {counted(len(names) - 1, 'more file')}" if len(names) > 1 else ""
    return f"{what}: {names[0]}{more}"


def shown_text(text: str, longest: int = MAX_SHOWN) -> str:
    r"""The text as one line of printable characters, for terminals, reports and windows.

    White space becomes one blank, so that no name fills a line up to where another seems to begin. Every other
    character without a shape of its own (control characters, marks of writing direction, halves of surrogate pairs,
    fillers) becomes its escape; what is longer ends in dots.

    >>> shown_text("two\nlines"), shown_text("\x1b[31mred\u202e"), shown_text("Any name", 4)
    ('two lines', '\\x1b[31mred\\u202e', 'Any ...')
    """
    if len(text) > longest:
        return shown_text(text[:longest]) + "..."
    if text.isascii() and text.isprintable() and "  " not in text:
        return text  # of most texts at once: pages have a million
    text = INVISIBLE.sub(lambda match: _escape(match[0]), _BLANKS.sub(" ", text))
    return text if text.isprintable() else "".join(map(shown_character, text))


def shown_character(character: str) -> str:
    if character.isprintable():
        return character
    return " " if character.isspace() else _escape(character)


def _escape(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")


def unused_name(name: str, taken: Container[str]) -> str:
    """The name, with a number from 2 on behind it if it is taken.

    >>> unused_name("Cave", ("Cave", "Cave 2"))
    'Cave 3'
    """
    names = chain([name], (f"{name} {number}" for number in count(2)))
    return next(free for free in names if free not in taken)


def file_stem(text: str, otherwise: str = "") -> str:
    """The text as the first part of a file's name: small letters, digits, ``_ . -``, or ``otherwise`` if none is left.

    >>> file_stem("Über - the hill?"), file_stem("../..", "replay"), file_stem("AUX.1")
    ('über-the-hill', 'replay', '_aux.1')
    """
    stem = _NOT_IN_NAMES.sub("-", normalize("NFC", text[:MAX_SHOWN].lower()))[:_MAX_STEM].strip("-.")
    return f"_{stem}" if _RESERVED.fullmatch(stem) else stem or otherwise


def name_problem(name: str) -> str:
    """Why a file should not have this name, which an untrusted file gives it, on every system; "" for a good name.

    >>> name_problem("Größe 2.txt"), name_problem("aux.txt"), name_problem("a.txt ")
    ('', 'a name that Windows reserves', 'it ends in a dot or a blank')
    """
    if not name or any(sign in _NOWHERE for sign in name):
        return f"not one of {_NOWHERE} may be in it" if name else "it is empty"
    if any(not sign.isprintable() and category(sign) != "Zs" for sign in name):
        return "a control or format character"
    if name[-1] == "." or name[-1].isspace():
        return "it ends in a dot or a blank"
    if _RESERVED.fullmatch(name):
        return "a name that Windows reserves"
    return f"more than {MAX_NAME_BYTES} bytes" if len(name.encode()) > MAX_NAME_BYTES else ""


def name_key(name: str) -> str:
    """A key that names share if they are one file on some system: if only case, or how letters are coded, differs."""
    return normalize("NFC", normalize("NFC", name).casefold())

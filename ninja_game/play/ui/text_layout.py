"""Text in lines, and numbers with their nouns."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.play.ui.theme import Theme

NARROWER = (0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6, 0.55)
"""Shares of the width that are tried to make lines equally long."""


def wrapped(theme: Theme, text: str, width: float, size: float) -> list[str]:
    """The text in as few lines as fit a width, about equally long, so that no word is left alone."""
    lines = _filled(theme, text, width, size)
    for share in NARROWER:
        narrower = _filled(theme, text, width * share, size)
        if len(narrower) > len(lines):
            break
        lines = narrower
    return lines


def _filled(theme: Theme, text: str, width: float, size: float) -> list[str]:
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and theme.width(longer, size) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def counted(number: int, one: str, more: str) -> str:
    """A number with its noun.

    >>> counted(1, "try", "tries"), counted(2, "try", "tries")
    ('1 try', '2 tries')
    """
    return f"{number} {one if number == 1 else more}"


def unreadable(names: Sequence[str]) -> str:
    """What to say of files that cannot be read; '' if there are none.

    >>> unreadable(["a.txt"]), unreadable(["a.txt", "b.txt", "c.txt"])
    ('Cannot be read: a.txt', 'Cannot be read: a.txt and 2 more files')
    """
    if not names:
        return ""
    more = f" and {counted(len(names) - 1, 'more file', 'more files')}" if len(names) > 1 else ""
    return f"Cannot be read: {names[0]}{more}"

"""Texts that fit: shortened, wrapped, counted."""

from __future__ import annotations

from bisect import bisect_right

from ninja_game.play.ui.theme import Theme

NARROWEST = 0.2
"""Width of the narrowest letter with its space, as a share of the size: longer texts need not be measured."""

NARROWER = (0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6, 0.55)
"""Shares of the width that are tried to make lines equally long."""


def fit(theme: Theme, text: str, width: float, size: float) -> str:
    """The text, shortened by dots to fit a width."""
    most = int(width / (NARROWEST * size)) + 1
    if len(text) <= most and theme.width(text, size) <= width:
        return text
    lengths = range(min(len(text), most) + 1)
    kept = bisect_right(lengths, width, key=lambda length: theme.width(text[:length] + "...", size)) - 1
    return text[: max(0, kept)].rstrip() + "..."


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

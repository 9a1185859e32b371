"""Texts that fit: shortened, wrapped, counted."""

from __future__ import annotations

from ninja_game.play.ui.theme import Theme


def fit(theme: Theme, text: str, width: float, size: float) -> str:
    """The text, shortened by dots to fit a width."""
    if theme.width(text, size) <= width:
        return text
    while text and theme.width(text + "...", size) > width:
        text = text[:-1]
    return text.rstrip() + "..."


def wrapped(theme: Theme, text: str, width: float, size: float) -> list[str]:
    """The text in lines that fit a width."""
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

"""The page's own letters, for characters that the game has none for."""

from __future__ import annotations

from typing import Any

from .color import packed
from .display_list import TEXT
from .host import LINK
from .surface import SRCALPHA, Surface


def init() -> None:
    """Nothing to do."""


def get_init() -> bool:
    """Always ready."""
    return True


class Font:
    """Letters of ``size`` px."""

    def __init__(self, name: str | None, size: int) -> None:
        self._size = size

    def size(self, text: str) -> tuple[int, int]:
        """Width and height of a text, px."""
        return int(LINK.page.measure(text, self._size)), round(0.7 * self._size)

    def render(self, text: str, antialias: bool, color: Any) -> Surface:
        """The picture of a text."""
        picture = Surface(self.size(text), SRCALPHA)
        picture.settle()
        picture.entries().extend((TEXT, packed(color), LINK.page.letters(text), self._size, picture.h))
        return picture

"""Numbers from pictures of their digits: a roll shows hundreds of different ones."""

from __future__ import annotations

from collections.abc import Iterator

import pygame

from ninja_game.play.ui.theme import Theme

Blit = tuple[pygame.Surface, tuple[int, int]]


class Digits:
    """The characters of numbers in one size and any colours. ``theme``: for which they are made."""

    def __init__(self, theme: Theme, size: float) -> None:
        self.theme, self._size = theme, size
        self._pictures: dict[tuple[str, int], pygame.Surface] = {}
        # Widths of texts are whole px; of many characters the mean is exact.
        widths = {each: (theme.width(each * 21, size) - theme.width(each, size)) / 20 for each in "0123456789.-"}
        # Digits below each other are of one width.
        widest = max(widths[each] for each in "0123456789")
        scale = theme.canvas.scale
        self._advance = {each: (widest if each.isdigit() else width) * scale for each, width in widths.items()}

    def picture(self, character: str, colour: pygame.Color) -> pygame.Surface:
        """A character in a colour."""
        key = character, int(colour)
        if key not in self._pictures:
            self._pictures[key] = self.theme.lettering.rendered(character, self._size, colour)
        return self._pictures[key]

    def blits(self, text: str, right: int, y: int, colour: pygame.Color) -> Iterator[Blit]:
        """What draws a number whose last px is left of ``right``, px."""
        x = float(right)
        for character in reversed(text):
            x -= self._advance[character]
            yield self.picture(character, colour), (round(x), y)

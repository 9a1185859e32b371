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
        scale = theme.canvas.scale
        pair = theme.width("00", size)
        widths = {each: theme.width(f"0{each}0", size) - pair for each in "0123456789.-"}
        # Digits below each other are of one width.
        widest = max(widths[each] for each in "0123456789")
        self._advance = {each: round((widest if each.isdigit() else widths[each]) * scale) for each in widths}

    def picture(self, character: str, colour: pygame.Color) -> pygame.Surface:
        """A character in a colour."""
        key = character, int(colour)
        if key not in self._pictures:
            self._pictures[key] = self.theme.lettering.rendered(character, self._size, colour)
        return self._pictures[key]

    def blits(self, text: str, right: int, y: int, colour: pygame.Color) -> Iterator[Blit]:
        """What draws a number whose last px is left of ``right``, px."""
        for character in reversed(text):
            right -= self._advance[character]
            yield self.picture(character, colour), (right, y)

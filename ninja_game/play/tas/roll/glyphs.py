"""Numbers from pictures of their digits: a roll shows hundreds of different ones."""

from __future__ import annotations

import pygame

from ninja_game.play.ui.theme import Theme

Blit = tuple[pygame.Surface, tuple[int, int]]


class Digits:
    """The characters of numbers in one size and any colours. ``theme``: for which they are made."""

    def __init__(self, theme: Theme, size: float) -> None:
        self.theme, self._size = theme, size
        self._pictures: dict[int, dict[str, tuple[pygame.Surface, float]]] = {}
        # Widths of texts are whole px; of many characters the mean is exact.
        widths = {each: (theme.width(each * 21, size) - theme.width(each, size)) / 20 for each in "0123456789.-"}
        # Digits below each other are of one width.
        widest = max(widths[each] for each in "0123456789")
        scale = theme.canvas.scale
        self._advance = {each: (widest if each.isdigit() else width) * scale for each, width in widths.items()}

    def _of(self, colour: pygame.Color) -> dict[str, tuple[pygame.Surface, float]]:
        """Every character in a colour, and how wide it is."""
        render = self.theme.lettering.rendered
        return {each: (render(each, self._size, colour), wide) for each, wide in self._advance.items()}

    def blits(self, text: str, right: int, y: int, colour: pygame.Color) -> list[Blit]:
        """What draws a number whose last px is left of ``right``, px."""
        key = int(colour)
        if key not in self._pictures:
            self._pictures[key] = self._of(colour)
        characters, x, made = self._pictures[key], right + 0.5, []
        for character in reversed(text):
            picture, wide = characters[character]
            x -= wide
            made.append((picture, (int(x), y)))
        return made

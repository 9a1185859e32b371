"""The change from one picture to the next: the old one is drawn back like a curtain, over the new one."""

from __future__ import annotations

import pygame

from ninja_game.ui.theme import Theme

WIPE_MS = 300
EDGE = 5
"""Width of the curtain's edge, logical px."""


class Wipe:
    """A change that is going on, or none. It only covers: the new screen already takes keys and lets time pass."""

    def __init__(self) -> None:
        self._before: pygame.Surface | None = None
        self._left = 0

    @property
    def going_on(self) -> bool:
        return self._before is not None

    def begin(self, surface: pygame.Surface) -> None:
        """From the picture that is on the surface now."""
        self._before, self._left = surface.copy(), WIPE_MS

    def update(self, real_ms: int) -> None:
        self._left -= real_ms
        if self._left <= 0:
            self._before = None

    def draw(self, surface: pygame.Surface, theme: Theme) -> None:
        """Cover what is still to come by the old picture."""
        if self._before is None:
            return
        width, height = surface.get_size()
        share = self._left / WIPE_MS
        left = width - round(width * share * share)
        surface.blit(self._before, (left, 0), (left, 0, width - left, height))
        surface.fill(theme.palette.accent, (left, 0, theme.canvas.px(EDGE), height))

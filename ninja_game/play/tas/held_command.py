"""A command whose key is held: it is done again and again, as a key repeats in a text."""

from __future__ import annotations

import pygame

from ninja_game.play.menus.menu_screen import LONGEST_STEP_MS
from ninja_game.play.tas.controls import FIRST_REPEAT_MS, REPEATING


class HeldCommand:
    """The command whose key is held, if it is one that repeats."""

    def __init__(self) -> None:
        self._name = ""
        self._key = self._again_in = 0

    def begin(self, name: str, scancode: int) -> None:
        """A command was done; its key is down."""
        if name in REPEATING:
            self._name, self._key, self._again_in = name, scancode, FIRST_REPEAT_MS

    def end(self) -> None:
        """Nothing repeats."""
        self._name = ""

    def follow(self, event: pygame.Event) -> None:
        """It ends when its key is released."""
        if event.type == pygame.KEYUP and event.scancode == self._key:
            self.end()

    def due(self, real_ms: int) -> list[str]:
        """The commands to be done after so much more real time. A stall is not a long press."""
        self._again_in -= min(real_ms, LONGEST_STEP_MS)
        found = []
        while self._name and self._again_in <= 0:
            self._again_in += REPEATING[self._name]
            found.append(self._name)
        return found

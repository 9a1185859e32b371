"""The level beside the roll: the world after the tick under the cursor, and the ways of runs."""

from __future__ import annotations

import pygame

from ninja_game.play.input.events import InputEvent
from ninja_game.play.tas.part import Part
from ninja_game.play.ui.theme import Theme


class LevelPart(Part):
    """The level, smaller than in the game."""

    area = (6, 28, 424, 322)

    def look(self) -> tuple[object, ...]:
        """Run and cursor."""
        return self.bench.take, self.bench.cursor

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Its background."""
        theme.panel(surface, *self.area)

    def stop(self) -> None:
        """End playing and taking over."""

    def capture(self, event: InputEvent) -> bool:
        """Take the keys of the game while the run is taken over; whether it did."""
        return False

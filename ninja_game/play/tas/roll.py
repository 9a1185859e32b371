"""The piano roll: a row a tick, the keys of each, and what the world says after it."""

from __future__ import annotations

import pygame

from ninja_game.play.tas.part import Commands, Part
from ninja_game.play.ui.theme import Theme


class Roll(Part):
    """The rows around the cursor."""

    area = (436, 28, 350, 548)

    def look(self) -> tuple[object, ...]:
        """Run, cursor, selection, what is simulated."""
        bench = self.bench
        return bench.take, bench.cursor, bench.selection, bench.session.timeline.valid

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Its background."""
        theme.panel(surface, *self.area)

    def commands(self) -> Commands:
        """Moving."""
        bench = self.bench
        return {
            "up": lambda: bench.go(bench.cursor - 1), "down": lambda: bench.go(bench.cursor + 1),
            "undo": bench.session.undo, "redo": bench.session.redo,
        }  # fmt: skip

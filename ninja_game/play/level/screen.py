"""A level on the screen: its play, the keys, and what is written over it."""

from __future__ import annotations

import pygame

from ninja_game.play.input.events import InputEvent
from ninja_game.play.level.hud_text import write_over
from ninja_game.play.level.keys import act, use_tools
from ninja_game.play.level.phase import Phase
from ninja_game.play.level.play import LevelPlay


class LevelScreen(LevelPlay):
    """Plays the level of a course."""

    def handle(self, event: InputEvent) -> None:
        """Keys and clicks, by phase."""
        if event.raw.type == pygame.WINDOWFOCUSLOST:
            self.pause()
        actions = event.pressed
        use_tools(self, actions, event.released)
        if event.raw.type == pygame.MOUSEBUTTONDOWN and event.raw.button == 1 and self.phase is not Phase.PLAY:
            actions = (*actions, "confirm")
        act(self, actions)

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """The world, and what is written over it."""
        running = self.phase is not Phase.PAUSED and not self.practice.stepping and not self.practice.rewinding
        fraction = self.clock.fraction if running and self.phase is not Phase.READY else 1.0
        changed = self.view.draw(surface, fraction, whole=self.redraw)
        written = write_over(self, surface)
        for rect in written:
            self.view.also_covered(rect)
        return None if changed is None else changed + written

"""The screen that hides the game from the boss: a spreadsheet."""

from __future__ import annotations

from random import Random

import pygame

from ninja_game.play.screen import BaseScreen
from ninja_game.play.window import TITLE
from ninja_game.ui.canvas import HEIGHT, WIDTH
from ninja_game.ui.input.bindings import InputEvent

_PAPER, _LINE, _HEAD, _INK = "#ffffff", "#d0d4da", "#eef0f3", "#3a3f47"
_ROWS, _ROW_HEIGHT, _TOP = 24, 22.0, 48.0
_COLUMNS = (("", 40.0), ("Item", 210.0), ("Q1", 100.0), ("Q2", 100.0), ("Q3", 100.0), ("Q4", 100.0), ("Total", 142.0))
_ITEMS = ("Paper", "Toner", "Postage", "Travel", "Training", "Licences", "Furniture", "Coffee", "Cleaning", "Repairs")


class BossScreen(BaseScreen):
    """The key that hides the game comes back to it, and so does Esc; the key for leaving ends the program."""

    hides_game = True

    def enter(self) -> None:
        pygame.display.set_caption("Budget")

    def leave(self) -> None:
        pygame.display.set_caption(TITLE)

    def handle(self, event: InputEvent) -> None:
        if event.source == ("keys", "escape"):
            self.app.pop()
        elif "quit" in event.pressed:
            self.app.quit()

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        if not self.redraw:
            return []
        surface.fill(_PAPER)
        canvas, text = self.theme.canvas, self.theme.text
        rng = Random(2)  # noqa: S311 - figures that mean nothing
        canvas.fill_rect(surface, _HEAD, 0, _TOP - _ROW_HEIGHT, WIDTH, _ROW_HEIGHT)
        text(surface, "Budget, second draft", 12, 6, size=11, colour=_INK)
        for row in range(_ROWS + 1):
            y = _TOP + _ROW_HEIGHT * row
            canvas.line(surface, _LINE, (0, y), (WIDTH, y), 0.5)
            figures = [rng.randrange(40, 3000) for _ in range(4)]
            cells = [str(row + 1), _ITEMS[row % len(_ITEMS)], *map(str, figures), str(sum(figures))]
            x = 0.0
            for (head, width), cell in zip(_COLUMNS, cells, strict=True):
                if row == 0:
                    text(surface, head, x + 8, _TOP - 16, size=9, colour=_INK)
                    canvas.line(surface, _LINE, (x, _TOP - _ROW_HEIGHT), (x, HEIGHT), 0.5)
                if row < _ROWS:
                    text(surface, cell, x + 8, y + 6, size=9, colour=_INK)
                x += width
        return None

"""The bar below a replay."""

from __future__ import annotations

import pygame

from ninja_game.formats.run_time import seconds_text
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import Theme, mixed

_LEFT, _WIDTH, _Y = 24.0, 400.0, 588.0


class ReplayBar:
    """The bar below a replay: a press or a drag seeks. ``dragging``: the mouse holds it."""

    def __init__(self) -> None:
        self.dragging = False

    def handle(self, event: pygame.Event, canvas: Canvas, length: int) -> int | None:
        """The tick that the mouse asks for; None if it asks for none."""
        if event.type == pygame.MOUSEBUTTONUP:
            self.dragging = False
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            x, y = canvas.logical(event.pos)
            self.dragging = abs(y - _Y) < 9 and _LEFT - 6 < x < _LEFT + _WIDTH + 6
        elif event.type != pygame.MOUSEMOTION:
            return None
        if not self.dragging:
            return None
        share = (canvas.logical(event.pos)[0] - _LEFT) / _WIDTH
        return round(min(1.0, max(0.0, share)) * length)

    @staticmethod
    def draw(surface: pygame.Surface, theme: Theme, tick: int, end: int, length: int, outcome: str) -> pygame.Rect:
        """The bar with a mark at the end, coloured by the outcome; its px rectangle."""
        palette, canvas = theme.palette, theme.canvas
        trough = mixed(palette.tile, palette.outline, 0.35)
        rect = canvas.fill_rect(surface, trough, _LEFT, _Y - 2, _WIDTH, 4, 2)
        at = _LEFT + _WIDTH * min(1.0, tick / max(1, length))
        canvas.fill_rect(surface, palette.on_tile, _LEFT, _Y - 2, at - _LEFT, 4, 2)
        mark = _LEFT + _WIDTH * end / max(1, length)
        colour = {"exit": palette.bar_full, "dead": palette.bar_empty}.get(outcome, palette.accent)
        canvas.fill_rect(surface, colour, mark - 1, _Y - 5, 2, 10)
        knob = canvas.circle(surface, palette.on_tile, (at, _Y), 5)
        return rect.union(knob).inflate(canvas.px(10), canvas.px(10))

    @staticmethod
    def write(surface: pygame.Surface, theme: Theme, tick: int, end: int, speed: str, *, still: bool) -> pygame.Rect:
        """Time and speed; the tick too where it stands still."""
        at = min(tick, end)
        text = f"{seconds_text(at)} / {seconds_text(end)} s    {speed}" + f"    tick {at}" * still
        return theme.text(surface, text, 768, 583, size=9, colour=theme.palette.on_tile, align="right")

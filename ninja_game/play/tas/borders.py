"""What is between the parts of the bench: a drag there gives one of them more room."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import pygame

from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.layout import BenchLayout, Wishes, bench_canvas, bench_layout
from ninja_game.play.tas.part import Commands, Part
from ninja_game.play.ui.theme import Theme

_LETTERS = (80, 90, 100, 110, 125, 140, 160, 180, 200, 240, 280, 320, 400)
"""Sizes of the letters that one can choose, percent."""


class Borders(Part):
    """``layout``: where everything is, once it ``fit``. ``parts``: what is to be placed.

    What was dragged, and the size of the letters, are settings.
    """

    layout: BenchLayout

    def __init__(self, bench: Bench, parts: Sequence[Part]) -> None:
        super().__init__(bench)
        self._parts = parts
        self._known: tuple[object, ...] = ()
        self._wishes: Wishes | None = None
        self._side = ""
        self._grabbed = 0.0, 0.0
        self._before: BenchLayout | None = None

    @property
    def wishes(self) -> Wishes:
        """What the player has chosen, or is dragging to."""
        settings = self.bench.app.settings
        return self._wishes or Wishes(settings.letters, settings.left_share, settings.tabs_share)

    def fit(self) -> bool:
        """Have theme and layout for the window as it is now, with all parts in their places; whether that is new."""
        shown, wishes = self.bench.app.theme, self.wishes
        if (shown, wishes) == self._known:
            return False
        canvas = bench_canvas(shown.canvas.window, wishes.letters)
        if self._known[:1] != (shown,) or self.bench.theme.canvas.scale != canvas.scale:
            self.bench.theme = Theme(shown.palette, canvas)
        self._known = shown, wishes
        self.layout = bench_layout((canvas.window[0] / canvas.scale, canvas.window[1] / canvas.scale), wishes)
        for part in self._parts:
            part.place(getattr(self.layout, part.slot))
        return True

    def commands(self) -> Commands:
        """The size of the letters."""
        return {
            "larger_letters": lambda: self.change_letters(1), "smaller_letters": lambda: self.change_letters(-1),
            "usual_letters": lambda: self.bench.app.change_settings(letters=0, left_share=0, tabs_share=0),
        }  # fmt: skip

    def change_letters(self, by: int) -> None:
        """The next size, up or down, of those that fit the window."""
        app = self.bench.app
        now = self.bench.theme.canvas.scale * 100
        largest = app.theme.canvas.scale * 100
        sizes = [each for each in _LETTERS if (each - now) * by > 1 and each < largest]
        letters = min(sizes, key=lambda each: abs(each - now), default=round(largest) if by > 0 else 0)
        if not letters or (by > 0 and now > largest - 1):
            app.notify(f"Letters are as {'large as this window allows' if by > 0 else 'small as can be'}")
        else:
            app.change_settings(letters=letters)

    # --- a part of the window, without a picture ---

    def look(self) -> tuple[object, ...]:
        """Nothing."""
        return ()

    def draw(self, surface: pygame.Surface, theme: Theme, *, whole: bool) -> list[pygame.Rect]:
        """Nothing: what is between the parts has been filled already."""
        return []

    def contains(self, x: float, y: float) -> bool:
        """Whether a point lies between parts."""
        return bool(self._side_at(x, y))

    def _side_at(self, x: float, y: float) -> str:
        """Which border is there: "left" of the roll, above the "tabs", or ''."""
        level, strip, roll = self.layout.level, self.layout.strip, self.layout.roll
        if level[0] + level[2] <= x < roll[0] and level[1] <= y < roll[1] + roll[3]:
            return "left"
        return "tabs" if level[0] <= x < roll[0] and level[1] + level[3] <= y < strip[1] else ""

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """A drag moves a border; Ctrl+0 brings back what suits the window."""
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT:
            left, top, w, h = self.layout.level
            self._side, self._grabbed = self._side_at(x, y), (x - left - w, y - top - h)
            self._before = self.layout
        elif event.type == pygame.MOUSEMOTION:
            side = self._side or self._side_at(x, y)
            _show_pointer(pygame.SYSTEM_CURSOR_SIZEWE if side == "left" else pygame.SYSTEM_CURSOR_SIZENS)
            self.bench.hint = "Drag: more room for one side; Ctrl+0: as it suits the window"
            if self._side:
                self._drag(x, y)
        elif event.type == pygame.MOUSEBUTTONUP:
            self._end()
        return True

    def _drag(self, x: float, y: float) -> None:
        (left, top, w, h), tabs = self.layout.level, self.layout.tabs[3]
        dx, dy = self._grabbed
        if self._side == "left":
            self._wishes = self.wishes._replace(left=_percent((x - dx - left) / (w + self.layout.roll[2])))
        else:
            self._wishes = self.wishes._replace(tabs=_percent(1 - (y - dy - top) / (h + tabs)))

    def _end(self) -> None:
        """Keep what was dragged."""
        self._side = ""
        if self._wishes is not None:
            wishes, self._wishes = self._wishes, None
            if self.layout == self._before:
                # Where there is no room to drag, nothing is wished for larger windows either.
                return
            self.bench.app.change_settings(left_share=wishes.left, tabs_share=wishes.tabs)

    def mouse_left(self) -> None:
        """The usual pointer again."""
        _show_pointer(pygame.SYSTEM_CURSOR_ARROW)
        self._end()


def _show_pointer(pointer: int) -> None:
    with suppress(pygame.error):  # some systems have only one
        pygame.mouse.set_cursor(pointer)


def _percent(share: float) -> int:
    return min(99, max(1, round(100 * share)))

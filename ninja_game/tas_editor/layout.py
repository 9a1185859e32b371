"""Where the parts of the TAS editor are in a window of any size, and the splitters between them."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from math import ceil
from typing import NamedTuple

import pygame

from ninja_game.play.workspace import Commands
from ninja_game.tas_editor.editor import TasEditor, TasPart
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas, Point
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Widget

NARROWEST_LEFT, LOWEST_LEVEL, LOWEST_TABS, NARROWEST_ROLL = 424.0, 200.0, 150.0, 350.0
WIDEST_ROLL, USUAL_TABS = 460.0, 203.0
"""Where nothing else is wished, logical px."""

_HEAD, _FOOT, _STRIP = 26.0, 21.0, 18.0
_EDGE, _GAP, _THIN = 6.0, 3.0, 2.0
_ABOVE, _BELOW = _HEAD + _THIN, _FOOT + _GAP
_BETWEEN = _GAP + _STRIP + _THIN
"""From the level to the tabs."""


class LayoutPreferences(NamedTuple):
    """What the player has chosen, each a percentage or 0 for what suits the window.

    ``text_scale``: the size of a logical px; ``left``: the level's share of the width; ``tabs``: of the height.
    """

    text_scale: int = 0
    left: int = 0
    tabs: int = 0


class TasLayout(NamedTuple):
    """Logical px: areas of the parts. ``strip``: of the names of the tabs."""

    size: Point
    head: Area
    level: Area
    strip: Area
    tabs: Area
    roll: Area
    foot: Area


def tas_canvas(window: tuple[int, int], text_scale: int = 0) -> Canvas:
    """A canvas that fills the window. A logical px, and so the text, grows as the root of the window does.

    >>> [round(tas_canvas(size).scale, 2) for size in ((792, 600), (1920, 1080), (2560, 1440))]
    [1.0, 1.34, 1.55]
    """
    width, height = max(1, window[0]), max(1, window[1])
    largest = min(width / WIDTH, height / HEIGHT)
    scale = min(largest, text_scale / 100 if text_scale else largest**0.5)
    return Canvas((width, height), (width / scale, height / scale))


def tas_layout(size: Point, preferences: LayoutPreferences) -> TasLayout:
    """The areas in a window of this logical size, at least that of the stage.

    Level and tabs are at the left, the roll at the right. Where nothing is wished, the level is as large as the usual
    height of the tabs lets it be, and the roll has what that leaves of the width.
    """
    w, h = size
    shared = w - 3 * _EDGE
    high = h - _ABOVE - _BETWEEN - _BELOW
    roll = min(max(NARROWEST_ROLL, shared - (high - USUAL_TABS) * WIDTH / HEIGHT), WIDEST_ROLL)
    left = shared * preferences.left / 100 if preferences.left else shared - roll
    left = min(max(NARROWEST_LEFT, left), shared - NARROWEST_ROLL)
    tabs = high * preferences.tabs / 100 if preferences.tabs else max(USUAL_TABS, high - ceil(left * HEIGHT / WIDTH))
    tabs = min(max(LOWEST_TABS, tabs), high - LOWEST_LEVEL)
    top = _ABOVE + high - tabs
    aside = left + 2 * _EDGE
    return TasLayout(
        size,
        head=(0, 0, w, _HEAD),
        level=(_EDGE, _ABOVE, left, high - tabs),
        strip=(_EDGE, top + _GAP, left, _STRIP),
        tabs=(_EDGE, top + _BETWEEN, left, tabs),
        roll=(aside, _ABOVE, w - aside - _EDGE, h - _ABOVE - _BELOW),
        foot=(0, h - _FOOT, w, _FOOT),
    )


_TEXT_SCALES = (80, 90, 100, 110, 125, 140, 160, 180, 200, 240, 280, 320, 400)
"""Sizes of the letters that one can choose, percent."""


class Splitters(TasPart):
    """The borders between the parts, which the mouse drags. ``layout``: where everything is, once it ``fit``.

    What was dragged, and the size of the letters, are settings.
    """

    layout: TasLayout

    def __init__(self, editor: TasEditor, parts: Sequence[TasPart]) -> None:
        super().__init__(editor)
        self._parts = parts
        self._known: tuple[object, ...] = ()
        self._dragged_to: LayoutPreferences | None = None
        self._side = ""
        self._grabbed = 0.0, 0.0
        self._before: TasLayout | None = None

    @property
    def preferences(self) -> LayoutPreferences:
        settings = self.editor.app.settings
        return self._dragged_to or LayoutPreferences(settings.text_scale, settings.level_width, settings.tabs_height)

    def fit(self) -> bool:
        """Have theme and layout for the window as it is now, with all parts in their places; whether that is new."""
        shown, preferences = self.editor.app.theme, self.preferences
        if (shown, preferences) == self._known:
            return False
        canvas = tas_canvas(shown.canvas.window, preferences.text_scale)
        if self._known[:1] != (shown,) or self.editor.theme.canvas.scale != canvas.scale:
            self.editor.theme = Theme(shown.palette, canvas)
        self._known = shown, preferences
        self.layout = tas_layout((canvas.window[0] / canvas.scale, canvas.window[1] / canvas.scale), preferences)
        for part in self._parts:
            part.place(getattr(self.layout, part.slot))
        return True

    def commands(self) -> Commands:
        return {
            "zoom_in": lambda: self.change_text_scale(1), "zoom_out": lambda: self.change_text_scale(-1),
            "reset_layout": lambda: self.editor.app.change_settings(text_scale=0, level_width=0, tabs_height=0),
        }  # fmt: skip

    def change_text_scale(self, by: int) -> None:
        app = self.editor.app
        now = self.editor.theme.canvas.scale * 100
        largest = app.theme.canvas.scale * 100
        sizes = [each for each in _TEXT_SCALES if (each - now) * by > 1 and each < largest]
        text_scale = min(sizes, key=lambda each: abs(each - now), default=round(largest) if by > 0 else 0)
        if not text_scale or (by > 0 and now > largest - 1):
            app.notify(f"The layout is as {'large as this window allows' if by > 0 else 'small as can be'}")
        else:
            app.change_settings(text_scale=text_scale)

    # --- a part of the window, without a picture ---

    def render_key(self) -> tuple[object, ...]:
        return ()

    def draw(self, surface: pygame.Surface, theme: Theme, focus: Widget | None, *, whole: bool) -> list[pygame.Rect]:
        return []

    def contains(self, x: float, y: float) -> bool:
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
            self.editor.hint = "Drag: more room for one side; Ctrl+0: reset the layout"
            if self._side:
                self._drag(x, y)
        elif event.type == pygame.MOUSEBUTTONUP:
            self._end()
        return True

    def _drag(self, x: float, y: float) -> None:
        (left, top, w, h), tabs = self.layout.level, self.layout.tabs[3]
        dx, dy = self._grabbed
        if self._side == "left":
            self._dragged_to = self.preferences._replace(left=_percent((x - dx - left) / (w + self.layout.roll[2])))
        else:
            self._dragged_to = self.preferences._replace(tabs=_percent(1 - (y - dy - top) / (h + tabs)))

    def _end(self) -> None:
        self._side = ""
        if self._dragged_to is not None:
            preferences, self._dragged_to = self._dragged_to, None
            if self.layout == self._before:
                # Where there is no room to drag, nothing is wished for larger windows either.
                return
            self.editor.app.change_settings(level_width=preferences.left, tabs_height=preferences.tabs)

    def mouse_left(self) -> None:
        _show_pointer(pygame.SYSTEM_CURSOR_ARROW)
        self._end()


def _show_pointer(pointer: int) -> None:
    with suppress(pygame.error):  # some systems have only one
        pygame.mouse.set_cursor(pointer)


def _percent(share: float) -> int:
    return min(99, max(1, round(100 * share)))

"""Widgets: a rectangle of a menu that can have the focus, be clicked and drawn.

Positions and sizes are logical px of the 792 x 600 stage. A widget's method gives ``True`` if it used an input.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Generic, TypeVar

import pygame

from ninja_game.ui.theme import Area, Theme, contains_point

PAD = 8
TEXT_SIZE = 11  # size of ordinary text, px

T = TypeVar("T")


def next_option(options: Sequence[T], present: T, step: int = 1) -> T:
    """The next option, after the last one the first.

    >>> next_option("abc", "c"), next_option("abc", "a", -1)
    ('a', 'c')
    """
    return options[(options.index(present) + step) % len(options)]


class Widget:
    """The base of all widgets. ``hint``: shown at the foot of the screen while it has the focus."""

    focusable = True

    def __init__(self, area: Area, *, hint: str = "") -> None:
        self.area = area
        self.hint = hint
        self.enabled = True

    @property
    def centre(self) -> tuple[float, float]:
        x, y, w, h = self.area
        return x + w / 2, y + h / 2

    def contains(self, x: float, y: float) -> bool:
        return contains_point(self.area, x, y)

    def confirm(self) -> bool:
        """The confirm key, or a click without another meaning."""
        return False

    def nudge(self, action: str) -> bool:
        """A direction or another menu action while it has the focus."""
        return False

    def click(self, x: float, y: float) -> bool:
        return self.confirm()

    def drag(self, x: float, y: float) -> bool:
        """The mouse moves with its button down, after a press in the widget."""
        return False

    def wheel(self, steps: int) -> bool:
        return False

    def text_event(self, event: pygame.Event) -> bool:
        """A key or text event, before anything else gets it."""
        return False

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        raise NotImplementedError

    def draw_base(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        """A panel; with the focus it has a thick edge and a mark at its left, so that colour is not the only sign.

        A disabled widget has no panel, and its edge shows only with the focus.
        """
        theme.row(surface, self.area, chosen=focused, focused=focused, filled=self.enabled)
        if focused:
            x, y, _, h = self.area
            mark = [(x - 9, y + h / 2 - 5), (x - 9, y + h / 2 + 5), (x - 3, y + h / 2)]
            theme.canvas.polygon(surface, theme.palette.accent, mark)


class Label(Widget):
    """A text without an action."""

    focusable = False

    def __init__(self, area: Area, text: str, *, size: float = TEXT_SIZE, faint: bool = False) -> None:
        super().__init__(area)
        self.text = text
        self.size = size
        self.faint = faint

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        x, y, w, h = self.area
        colour = theme.palette.faint if self.faint else theme.palette.text
        theme.text(surface, self.text, x, y, size=self.size, colour=colour, width=w, height=h)


class Button(Widget):
    """A text with an action; without one it is disabled. ``detail``: a smaller line below it."""

    def __init__(
        self,
        area: Area,
        text: str,
        action: Callable[[], object] | None,
        *,
        hint: str = "",
        size: float = TEXT_SIZE,
        detail: str = "",
    ) -> None:
        super().__init__(area, hint=hint)
        self.enabled = action is not None
        self.text = text
        self.detail = detail
        self.action = action
        self.size = size

    def confirm(self) -> bool:
        if self.enabled and self.action:
            self.action()
        return True

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        self.draw_base(surface, theme, focused=focused)
        colour = theme.palette.text if self.enabled else theme.palette.faint
        (x, y), height = self.centre, self.area[3]
        write = partial(theme.text, surface, x=x, align="centre", width=self.area[2] - self.size)
        if self.detail:
            y, height = y - 9, height / 2
            write(text=self.detail, y=y + 14, size=10.5, colour=theme.palette.faint, height=height)
        write(text=self.text, y=y - self.size / 2, size=self.size, colour=colour, bold=focused, height=height)


class Choice(Widget, Generic[T]):
    """One of several values: left and right change it, confirm takes the next. A switch has the values on and off.

    ``more``: the action of confirm, and of a click between the arrows, instead.
    """

    def __init__(
        self,
        area: Area,
        text: str,
        options: Sequence[tuple[str, T]],
        get: Callable[[], T],
        put: Callable[[T], object],
        *,
        hint: str = "",
    ) -> None:
        super().__init__(area, hint=hint)
        self.text = text
        self.options = options
        self.get = get
        self.put = put
        self.more: Callable[[], object] | None = None

    @property
    def index(self) -> int:
        """Number of the present value; that of the first if it is none of them."""
        values = [value for _, value in self.options]
        return values.index(self.get()) if self.get() in values else 0

    def _step(self, by: int) -> bool:
        self.put(self.options[(self.index + by) % len(self.options)][1])
        return True

    def confirm(self) -> bool:
        if self.more:
            self.more()
        return bool(self.more) or self._step(1)

    def nudge(self, action: str) -> bool:
        by = {"left": -1, "right": 1}.get(action)
        return by is not None and self._step(by)

    def click(self, x: float, y: float) -> bool:
        left, width = self._values()
        if self.more and left + 24 <= x < left + width - 24:
            return self.confirm()
        return self._step(-1 if left <= x < left + 24 else 1)

    def _values(self) -> tuple[float, float]:
        """Left edge and width of the value's part: the right half, or everything without a text."""
        x, _, w, _ = self.area
        return (x + w * 0.5, w * 0.5) if self.text else (x, w)

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        self.draw_base(surface, theme, focused=focused)
        x, y, w, h = self.area
        top = y + (h - TEXT_SIZE) / 2
        theme.text(surface, self.text, x + PAD, top, size=TEXT_SIZE, bold=focused, width=w * 0.5 - PAD)
        left, width = self._values()
        value = self.options[self.index][0]
        theme.text(surface, value, left + width / 2, top, size=TEXT_SIZE, align="centre", width=width - 40)
        for side, tip in ((left + 14, -5), (left + width - 14, 5)):
            points = [(side, y + h / 2 - 4), (side, y + h / 2 + 4), (side + tip, y + h / 2)]
            theme.canvas.polygon(surface, theme.palette.accent if focused else theme.palette.panel_edge, points)


class Slider(Widget):
    """A number between two others."""

    def __init__(
        self,
        area: Area,
        text: str,
        span: tuple[float, float, float],
        get: Callable[[], float],
        put: Callable[[float], object],
        *,
        show: Callable[[float], str] = "{:.0f}".format,
        hint: str = "",
    ) -> None:
        super().__init__(area, hint=hint)
        self.text = text
        self.low, self.high, self.step = span
        self.get = get
        self.put = put
        self.show = show

    def _take(self, value: float) -> bool:
        whole = self.low + round((value - self.low) / self.step) * self.step
        self.put(min(self.high, max(self.low, whole)))
        return True

    def nudge(self, action: str) -> bool:
        """One step down or up; left at the lowest number moves the focus on."""
        if action not in ("left", "right") or (action == "left" and self.get() <= self.low):
            return False
        return self._take(self.get() + (self.step if action == "right" else -self.step))

    def click(self, x: float, y: float) -> bool:
        return self.drag(x, y)

    def drag(self, x: float, y: float) -> bool:
        left, width = self._track()
        return self._take(self.low + (self.high - self.low) * (x - left) / width)

    def _track(self) -> tuple[float, float]:
        x, _, w, _ = self.area
        return x + w * 0.5 + 10, w * 0.5 - 80

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        self.draw_base(surface, theme, focused=focused)
        canvas, palette = theme.canvas, theme.palette
        x, y, w, h = self.area
        top = y + (h - TEXT_SIZE) / 2
        theme.text(surface, self.text, x + PAD, top, size=TEXT_SIZE, bold=focused, width=w * 0.5 - PAD)
        theme.text(surface, self.show(self.get()), x + w - PAD, top, size=TEXT_SIZE, align="right", width=64 - PAD)
        left, width = self._track()
        knob = left + width * (self.get() - self.low) / (self.high - self.low)
        canvas.fill_rect(surface, palette.panel_edge, left, y + h / 2 - 1.5, width, 3, 1.5)
        canvas.fill_rect(surface, palette.accent, left, y + h / 2 - 1.5, max(knob - left, 1), 3, 1.5)
        canvas.circle(surface, palette.accent if focused else palette.faint, (knob, y + h / 2), 5)

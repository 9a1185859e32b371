"""What is written on a screen and where: finds texts and widgets that leave their place, overlap, or are cut."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import cache
from typing import Any
from unittest.mock import patch

import pygame

from ninja_game.play.app import App
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.tas_editor.tabs.tab import Rows
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.lettering import Lettering, StrokeFont
from ninja_game.ui.theme import Theme
from ninja_game.ui.widgets import Widget

LONG_NAME = 8 * "W"  # in what has no length of its own, names and paths, and may be shortened
MIN_BOX = (60.0, 14.0)  # logical px from which on a filled rectangle is a panel that its texts must not leave


@dataclass
class Written:
    """A text, the px that its letters cover, and the widget that wrote it."""

    text: str
    ink: pygame.Rect
    owner: Widget | None
    cut: bool


@dataclass
class Layout:
    """What was drawn in one whole picture."""

    texts: list[Written] = field(default_factory=list)
    boxes: list[pygame.Rect] = field(default_factory=list)
    owners: list[Widget] = field(default_factory=list)
    shortened: set[str] = field(default_factory=set)

    def write(self, text: str, rect: pygame.Rect, surface: pygame.Surface) -> None:
        """Note a text; of its line only what letters cover counts."""
        ink = rect.inflate(-2, 0)
        ink.top, ink.height = rect.top + round(0.1 * rect.height), round(0.76 * rect.height)
        owner = self.owners[-1] if self.owners else None
        self.texts.append(Written(text, ink, owner, not surface.get_clip().contains(ink)))

    def cover(self, rect: pygame.Rect, *, everything: bool) -> None:
        """Something solid was drawn over what was there."""
        self.texts = [each for each in self.texts if not (everything or rect.collidepoint(each.ink.center))]
        self.boxes = [] if everything else self.boxes
        self.boxes.append(rect)

    def problems(self, app: App) -> Iterator[str]:
        """What a player would see, in words."""
        window = app.surface.get_rect()
        canvas = app.top.theme.canvas
        rim = 2 * max(1, round(canvas.scale))
        top = app.top
        widgets = top.widgets if isinstance(top, MenuScreen) else []
        areas = [(widget, canvas.rect(*widget.area)) for widget in widgets]
        for widget, area in areas:
            if not window.contains(area):
                yield f"{_name(widget)} leaves the window"
            yield from (
                f"{_name(widget)} overlaps {_name(other)}"
                for other, beside in areas[areas.index((widget, area)) + 1 :]
                if beside.inflate(-2, -2).colliderect(area.inflate(-2, -2))
            )
        for number, each in enumerate(self.texts):
            if each.cut or not window.contains(each.ink):
                yield f"{each.text!r} is cut"
            if each.text in self.shortened:
                yield f"{each.text!r} is shortened, and is no name"
            box = min(
                (box for box in self.boxes if box.collidepoint(each.ink.center)), key=lambda box: box.w * box.h,
                default=window,
            )  # fmt: skip
            if not box.inflate(rim, rim).contains(each.ink):
                yield f"{each.text!r} leaves its panel {box} {each.ink}"
            for other in self.texts[number + 1 :]:
                if other.ink.colliderect(each.ink):
                    yield f"{each.text!r} overlaps {other.text!r}"
            for widget, area in areas:
                # The tabs of the TAS editor write the rows of their tables themselves.
                if each.owner is None and not isinstance(widget, Rows) and area.inflate(-2, -2).colliderect(each.ink):
                    yield f"{each.text!r} lies on {_name(widget)}"
            if each.owner is not None and not canvas.rect(*each.owner.area).inflate(rim, rim).contains(each.ink):
                yield f"{each.text!r} leaves its widget"


def _name(widget: Widget) -> str:
    return f"{type(widget).__name__} {getattr(widget, 'text', '')!r}"


@contextmanager
def noted() -> Iterator[list[Layout]]:
    """While it lasts what is drawn is noted in the last layout of the list, if there is one."""
    layouts: list[Layout] = []
    draw_text, fill, window, fit = Lettering.draw, Canvas.fill_rect, Theme.window, Theme._fit

    def draw(self: Lettering, surface: pygame.Surface | None, text: str, *args: Any, **options: Any) -> pygame.Rect:
        rect = draw_text(self, surface, text, *args, **options)
        if layouts and surface is not None and text and _is_of_window(surface):
            layouts[-1].write(text, rect, surface)
        return rect

    def fill_rect(self: Canvas, surface: pygame.Surface, colour: Any, *place: Any, **options: Any) -> pygame.Rect:
        rect = fill(self, surface, colour, *place, **options)
        if layouts and pygame.Color(colour).a == 255 and place[2] >= MIN_BOX[0] and place[3] >= MIN_BOX[1]:
            layouts[-1].cover(rect, everything=False)
        return rect

    def fitted(self: Theme, text: str, *args: Any, **options: Any) -> str:
        drawn = fit(self, text, *args, **options)
        if layouts and drawn != text and LONG_NAME not in text and "/" not in text:
            layouts[-1].shortened.add(drawn)
        return drawn

    def draw_window(self: Theme, surface: pygame.Surface, *place: float) -> pygame.Rect:
        rect = window(self, surface, *place)
        if layouts:
            layouts[-1].cover(rect, everything=True)
        return rect

    def blank(self: StrokeFont, text: str, _: Any) -> pygame.Surface:
        return pygame.Surface((max(1, self.width(text)), self.height), pygame.SRCALPHA)

    with ExitStack() as stack:
        # Letters are not drawn, only measured, and that once in each size: this is most of the work.
        stack.enter_context(patch.object(StrokeFont, "render", blank))
        stack.enter_context(patch("ninja_game.ui.lettering.StrokeFont", cache(StrokeFont)))
        stack.enter_context(patch.object(Lettering, "draw", draw))
        stack.enter_context(patch.object(Canvas, "fill_rect", fill_rect))
        stack.enter_context(patch.object(Theme, "window", draw_window))
        stack.enter_context(patch.object(Theme, "_fit", fitted))
        for kind in _kinds(Widget):
            if "draw" in vars(kind):
                stack.enter_context(patch.object(kind, "draw", _owned(kind.draw, layouts)))
        yield layouts


def _is_of_window(surface: pygame.Surface) -> bool:
    """Whether what is drawn has its place in the window, not in a picture that is shown somewhere."""
    return surface.get_parent() is not None or surface.get_size() == pygame.display.get_window_size()


def _kinds(kind: type[Widget]) -> Iterator[type[Widget]]:
    for each in kind.__subclasses__():
        yield each
        yield from _kinds(each)


def _owned(draw: Callable[..., None], layouts: list[Layout]) -> Callable[..., None]:
    def owned(widget: Widget, *args: Any, **options: Any) -> None:
        if layouts:
            layouts[-1].owners.append(widget)
        draw(widget, *args, **options)
        if layouts:
            layouts[-1].owners.pop()

    return owned

"""The part of pygame-ce's interface that the game uses, for Pyodide in a page: everything is painted by painter.js."""

from __future__ import annotations

from typing import Any

from . import constants, display, draw, event, font, image, mixer
from .color import Color
from .constants import *
from .devices import joystick, key, mouse, scrap, time, transform
from .event import Event
from .host import LINK
from .rect import Rect
from .surface import BLEND_PREMULTIPLIED, BLEND_RGBA_MULT, SRCALPHA, Surface

globals().update(constants.KEY_CONSTANTS)


class error(RuntimeError):
    """What SDL cannot do."""


def init() -> None:
    """Nothing to do."""


quit = init


class Window:
    """The page's canvas as a window: it can fill the display."""

    position: Any = (0, 0)

    @classmethod
    def from_display_module(cls) -> Window:
        """The one window."""
        return cls()

    @property
    def size(self) -> tuple[int, int]:
        """Size, px. The page sets it."""
        return display.get_window_size()

    @size.setter
    def size(self, size: tuple[int, int]) -> None:
        pass

    def set_fullscreen(self, desktop: bool = False) -> None:
        """Fill the display."""
        LINK.page.fullscreen(True)

    def set_windowed(self) -> None:
        """Be a part of the page again."""
        LINK.page.fullscreen(False)


def __getattr__(name: str) -> Any:
    raise AttributeError(f"the page's pygame has no {name}")


__all__ = [
    "BLEND_PREMULTIPLIED", "BLEND_RGBA_MULT", "SRCALPHA", "Color", "Event", "Rect", "Surface", "Window", "display",
    "draw", "error", "event", "font", "image", "init", "joystick", "key", "mixer", "mouse", "quit", "scrap", "time",
    "transform",
]  # fmt: skip

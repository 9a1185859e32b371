"""The window: the page's canvas."""

from __future__ import annotations

from typing import Any

from .display_list import LIST
from .host import LINK
from .surface import Surface


class _Window:
    """``surface``: the canvas' picture."""

    surface: Surface | None = None


_WINDOW = _Window()


def init() -> None:
    """Nothing to do."""


quit = init


def get_driver() -> str:
    """The page's name among SDL's drivers."""
    return "emscripten"


def set_icon(icon: Surface) -> None:
    """The page has its own."""


def set_caption(title: str) -> None:
    """The page has its own."""


def get_desktop_sizes() -> list[tuple[int, int]]:
    """The canvas is the display."""
    return [get_window_size()]


def get_window_size() -> tuple[int, int]:
    """Size of the canvas, px."""
    return int(LINK.page.width), int(LINK.page.height)


def set_mode(size: Any = None, flags: int = 0) -> Surface:
    """The picture of the canvas, which has the size that the page gives it."""
    old, _WINDOW.surface = _WINDOW.surface, Surface.__new__(Surface)
    if old is not None:
        old.forget()
    _WINDOW.surface.show(get_window_size())
    return _WINDOW.surface


def get_surface() -> Surface | None:
    """The picture of the canvas; a new one where the canvas has another size by now."""
    surface = _WINDOW.surface
    return surface if surface is None or surface.get_size() == get_window_size() else set_mode()


def get_current_refresh_rate() -> int:
    """Pictures a second."""
    return int(LINK.page.rate)


def flip() -> None:
    """Paint what was drawn since the last time."""
    address, count = LIST.numbers.buffer_info()
    LINK.page.paint(address, count)
    LIST.clear()


def update(rectangles: Any = None) -> None:
    """Likewise: the list holds only what changed."""
    flip()

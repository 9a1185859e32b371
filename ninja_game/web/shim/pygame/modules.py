"""pygame's small modules, each under its name."""

from __future__ import annotations

from base64 import b64decode
from types import SimpleNamespace
from typing import Any

from .color import packed
from .event import DEVICES
from .host import LINK, error
from .surface import LIST, SRCALPHA, TEXT, Surface


def _nothing(*_: Any) -> None:
    """Do nothing: a page needs no such call."""


_SCREENS: list[Surface] = []


def _window_size() -> tuple[int, int]:
    return int(LINK.page.width), int(LINK.page.height)


def _set_mode(size: Any = None, flags: int = 0) -> Surface:
    for old in _SCREENS:
        old._number = 0  # the player no longer sees it
    _SCREENS[:] = [Surface.__new__(Surface)]
    _SCREENS[0].show(_window_size())
    return _SCREENS[0]


def _get_surface() -> Surface | None:
    """The picture of the canvas; a new one if the canvas has another size by now."""
    if not _SCREENS or _SCREENS[0].get_size() == _window_size():
        return _SCREENS[0] if _SCREENS else None
    return _set_mode()


def _flip(rectangles: Any = None) -> None:
    address, count = LIST.numbers.buffer_info()
    LINK.page.paint(address, count)
    del LIST.numbers[:]


display = SimpleNamespace(
    init=_nothing, quit=_nothing, set_icon=_nothing, set_caption=_nothing, get_driver=lambda: "emscripten",
    get_window_size=_window_size, get_desktop_sizes=lambda: [_window_size()], set_mode=_set_mode,
    get_surface=_get_surface, get_current_refresh_rate=lambda: int(LINK.page.rate), flip=_flip, update=_flip,
)  # fmt: skip


class Window:
    """The canvas as a window: it can fill the display; its size and place are the page's."""

    position: Any = (0, 0)
    size = property(lambda self: _window_size(), lambda self, size: None)

    @classmethod
    def from_display_module(cls) -> Window:
        return cls()

    def set_fullscreen(self, desktop: bool = False) -> None:
        LINK.page.fullscreen(True)

    def set_windowed(self) -> None:
        LINK.page.fullscreen(False)


def _name(code: int) -> str:
    """The name of a keycode: its character. The game names other keys itself."""
    return chr(code) if 32 < code < 127 or 127 < code < 1 << 21 else ""


def _type(on: bool) -> None:
    LINK.page.input.typing = on


class _Pad:
    """A gamepad by its number: ``Joystick`` and ``Controller`` in one, as far as the game uses them."""

    def __init__(self, number: int) -> None:
        self._number = number

    def as_joystick(self) -> _Pad:
        return self

    def get_instance_id(self) -> int:
        return self._number


class _PlainPad(_Pad):
    """A pad without the layout of a standard pad."""


key = SimpleNamespace(
    get_pressed=lambda: DEVICES.keys, get_mods=lambda: DEVICES.modifiers, name=_name,
    start_text_input=lambda: _type(True), stop_text_input=lambda: _type(False),
)  # fmt: skip
mouse = SimpleNamespace(get_pos=lambda: DEVICES.mouse, set_cursor=lambda _: None)
# The page sets the pace.
time = SimpleNamespace(
    get_ticks=lambda: int(LINK.page.ticks()), Clock=lambda: SimpleNamespace(tick=lambda framerate=0: 0)
)
# A page learns of pads only by their events; numbers from 100 on are pads without the standard layout.
joystick = SimpleNamespace(init=_nothing, get_count=lambda: 0, JoystickType=_PlainPad, Joystick=_PlainPad)
controller = SimpleNamespace(init=_nothing, is_controller=lambda number: number < 100, Controller=_Pad)


class _Font:
    """The page's own letters of ``size`` px, for characters without strokes."""

    def __init__(self, name: str | None, size: int) -> None:
        self._size = size

    def size(self, text: str) -> tuple[int, int]:
        return int(LINK.page.measure(text, self._size)), round(0.7 * self._size)

    def render(self, text: str, antialias: bool, color: Any) -> Surface:
        picture = Surface(self.size(text), SRCALPHA)
        picture.settle()
        picture.entries().extend((TEXT, packed(color), LINK.page.painter.letters(text), self._size, picture.h))
        return picture


def _save(surface: Surface, file: Any, namehint: str = "") -> None:
    number = surface.settle()
    _flip()
    file.write(b64decode(LINK.page.picture(number, surface.w, surface.h)))


def _put_text(text: str) -> None:
    if not LINK.page.copy(text):
        raise error("the page has no clipboard")


font = SimpleNamespace(init=_nothing, get_init=lambda: True, Font=_Font)
image = SimpleNamespace(save=_save)
scrap = SimpleNamespace(put_text=_put_text, get_text=lambda: str(LINK.page.input.clipboard))
transform = SimpleNamespace(smoothscale=lambda surface, size: surface.scaled(size))

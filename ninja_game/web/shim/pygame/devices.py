"""Keyboard, mouse, clipboard, time, gamepads, each under pygame's name for it."""

from __future__ import annotations

from .constants import KEYCODES
from .event import DEVICES
from .host import LINK
from .surface import Surface

_SPOKEN = {
    "KP_DIVIDE": "[/]", "KP_MULTIPLY": "[*]", "KP_MINUS": "[-]", "KP_PLUS": "[+]", "KP_ENTER": "enter",
    "KP_PERIOD": "[.]", "KP_EQUALS": "equals", "LGUI": "left meta", "RGUI": "right meta", "MODE": "alt gr",
    "CAPSLOCK": "caps lock", "PRINTSCREEN": "print screen", "SCROLLLOCK": "scroll lock", "PAUSE": "break",
    "PAGEUP": "page up", "PAGEDOWN": "page down", "NUMLOCKCLEAR": "numlock", "UNKNOWN": "",
} | {f"KP_{n}": f"[{n}]" for n in range(10)}  # fmt: skip
_SIDES = {"L": "left ", "R": "right "}


def _spoken(name: str) -> str:
    if name[1:] in {"CTRL", "SHIFT", "ALT"}:
        return _SIDES[name[0]] + name[1:].lower()
    return _SPOKEN.get(name, name.lower())


_NAMES = {code: _spoken(name) for name, code in reversed(KEYCODES.items())}


class key:
    """The keyboard."""

    @staticmethod
    def get_pressed() -> tuple[bool, ...]:
        """By scancode, whether a key is down."""
        return DEVICES.keys

    @staticmethod
    def get_mods() -> int:
        """The modifier keys that are down."""
        return DEVICES.modifiers

    @staticmethod
    def name(code: int) -> str:
        """What a keycode is called."""
        return chr(code) if 32 < code < 127 or 127 < code < 1 << 21 else _NAMES.get(code, "")

    @staticmethod
    def start_text_input() -> None:
        """From now on keys give characters."""
        LINK.page.typing(True)

    @staticmethod
    def stop_text_input() -> None:
        """No longer."""
        LINK.page.typing(False)


class mouse:
    """The mouse."""

    @staticmethod
    def get_pos() -> tuple[int, int]:
        """Its place, px."""
        return DEVICES.mouse


class scrap:
    """The clipboard."""

    @staticmethod
    def put_text(text: str) -> None:
        """Copy."""
        LINK.page.copy(text)

    @staticmethod
    def get_text() -> str:
        """What the page was given to paste."""
        return str(LINK.page.pasted())


class time:
    """Time."""

    @staticmethod
    def get_ticks() -> int:
        """Milliseconds since the start."""
        return int(LINK.page.ticks())

    class Clock:
        """The page keeps the pace itself."""

        def tick(self, framerate: float = 0) -> int:
            """Nothing to wait for."""
            return 0


class joystick:
    """Gamepads: host.js reads them and posts their events."""

    class JoystickType:
        """Pads that are read as plain joysticks: in a page there are none."""

    Joystick = JoystickType

    @staticmethod
    def init() -> None:
        """Nothing to do."""

    @staticmethod
    def get_count() -> int:
        """A page learns of pads only by events."""
        return 0


class transform:
    """Pictures in other sizes."""

    @staticmethod
    def smoothscale(surface: Surface, size: tuple[float, float]) -> Surface:
        """The picture in another size."""
        return surface.scaled(size)

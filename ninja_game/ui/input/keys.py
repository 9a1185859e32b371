"""Keys by their place on the keyboard (scancode): names for files, labels for people.

A binding is a place, so that a player with another layout uses the same fingers. The label of the key is read from the
layout: SDL sends it with every press.
"""

from __future__ import annotations

import re
from typing import Generic, TypeVar

import pygame

PREFIX = "KSCAN_"

SCANCODES: dict[str, int] = {}
"""Scancode by name: SDL's names in small letters, such as ``left``, ``a``, ``lshift``, ``kp_plus``."""

_OF_KEYCODE: dict[int, int] = {}

for _name in dir(pygame):
    if _name.startswith(PREFIX):
        _code = getattr(pygame, _name)
        _rest = _name.removeprefix(PREFIX)
        SCANCODES[_rest.lower()] = _code
        for _constant in (f"K_{_rest}", f"K_{_rest.lower()}"):
            if hasattr(pygame, _constant):
                _OF_KEYCODE[getattr(pygame, _constant)] = _code

SCANCODE_LIMIT = 512  # SDL's keys have smaller scancodes than this

_NAMES = {code: name for name, code in sorted(SCANCODES.items(), key=lambda item: -len(item[0]))}
_UNNAMED = re.compile(r"scancode-([0-9]{1,3})")

_LABELS = {
    "lshift": "Shift", "rshift": "R Shift", "lctrl": "Ctrl", "rctrl": "R Ctrl", "lalt": "Alt",
    "ralt": "R Alt", "return": "Enter", "kp_enter": "Keypad Enter", "escape": "Esc", "backspace": "Backspace",
    "pageup": "Page Up", "pagedown": "Page Down", "left": "Left", "right": "Right", "up": "Up", "down": "Down",
    "capslock": "Caps Lock", "comma": "Comma", "period": "Period", "minus": "Minus", "equals": "Equals",
    "leftbracket": "[", "rightbracket": "]", "semicolon": "Semicolon", "apostrophe": "Apostrophe",
    "slash": "/", "backslash": "\\", "grave": "Backtick",
    "lgui": "L Meta", "rgui": "R Meta",
}  # fmt: skip

_learnt: dict[int, str] = {}


def scancode_of(event: pygame.Event) -> int:
    """The scancode of a key event; of a made-up event without one, that of its key on a US keyboard."""
    return getattr(event, "scancode", 0) or _OF_KEYCODE.get(event.key, 0)


def key_name(scancode: int) -> str:
    return _NAMES.get(scancode, f"scancode-{scancode}")


def chord(event: pygame.Event) -> str:
    """A key press by name, with ``ctrl+`` and ``shift+``. With Ctrl, letters count by the key's label."""
    name = key_name(scancode_of(event))
    modifiers = getattr(event, "mod", 0)
    ctrl = "ctrl+" if modifiers & (pygame.KMOD_CTRL | pygame.KMOD_META) else ""
    if ctrl and event.key and 97 <= event.key <= 122:
        name = chr(event.key)
    return ctrl + ("shift+" if modifiers & pygame.KMOD_SHIFT else "") + name


def scancode_named(name: str) -> int | None:
    """The scancode of a name; None for an unknown one."""
    unnamed = _UNNAMED.fullmatch(name)
    if unnamed:
        return int(unnamed[1]) if int(unnamed[1]) < SCANCODE_LIMIT else None
    return SCANCODES.get(name)


def learn_label(event: pygame.Event) -> None:
    scancode = scancode_of(event)
    if key_name(scancode) not in _LABELS and (label := pygame.key.name(event.key)):
        _learnt[scancode] = label.capitalize() if len(label) > 1 else label.upper()


def key_label(name: str) -> str:
    """The label of a key, for the player.

    >>> key_label("lshift"), key_label("kp_plus"), key_label("f5")
    ('Shift', 'Keypad plus', 'F5')
    """
    scancode = scancode_named(name)
    if scancode in _learnt:
        return _learnt[scancode]
    if name in _LABELS:
        return _LABELS[name]
    return name.replace("kp_", "keypad ").replace("kp", "keypad ").capitalize()


def key_label_of(name: str) -> str:
    return {"ctrl": "Ctrl", "delete": "Del", "minus": "-", "equals": "="}.get(name) or key_label(
        {"shift": "lshift"}.get(name, name)
    )


T = TypeVar("T")

MAX_STEP_MS = 50  # a longer step is a stall, not a long press: the release may still wait in the queue


class HeldKey(Generic[T]):
    """A key that repeats while it is held. ``what``: its action; None if no key is held."""

    def __init__(self) -> None:
        self.what: T | None = None
        self._key = self._again_in = self._every = 0

    def begin(self, what: T, scancode: int = 0, *, first: int, every: int) -> None:
        """Its key is down after the first action, which repeats after ``first`` ms, then at the given interval."""
        self.what, self._key, self._again_in, self._every = what, scancode, first, every

    def end(self) -> None:
        """Stop repeating."""
        self.what = None

    def follow(self, event: pygame.Event) -> None:
        if event.type == pygame.KEYUP and scancode_of(event) == self._key:
            self.end()

    def due(self, real_ms: int) -> list[T]:
        """The repeated action, once for each time that it is due after that many ms more."""
        self._again_in -= min(real_ms, MAX_STEP_MS)
        actions = []
        while self.what is not None and self._again_in <= 0:
            self._again_in += self._every
            actions.append(self.what)
        return actions

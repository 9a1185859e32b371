"""Events, which host.js collects and sends once per picture; and the held keys and buttons."""

from __future__ import annotations

import json
from typing import Any

from . import constants
from .host import LINK

_QUEUE: list[Any] = []


class Event:
    """``type``, and the attributes of that type."""

    def __init__(self, kind: int, fields: dict[str, Any] | None = None, **more: Any) -> None:
        self.__dict__.update(fields or {}, **more)
        self.type = kind


class InputDevices:
    """State of keyboard and mouse. ``keys``: by scancode, whether they are down. ``mouse``: its place, px."""

    keys: tuple[bool, ...] = (False,) * 512
    modifiers = 0
    mouse = (0, 0)


DEVICES = InputDevices()


def pump() -> None:
    """Take the new events, and track held keys and buttons."""
    text = LINK.page.input.take()
    if text != "[]":
        for name, fields in json.loads(text):
            tuples = {key: tuple(value) if isinstance(value, list) else value for key, value in fields.items()}
            post(Event(getattr(constants, name), tuples))


def post(event: Any) -> None:
    _QUEUE.append(event)
    if event.type in (constants.KEYDOWN, constants.KEYUP):
        keys = list(DEVICES.keys)
        keys[event.scancode] = event.type == constants.KEYDOWN
        DEVICES.keys, DEVICES.modifiers = tuple(keys), event.mod
    elif event.type in (constants.MOUSEMOTION, constants.MOUSEBUTTONDOWN, constants.MOUSEBUTTONUP):
        DEVICES.mouse = event.pos
    elif event.type == constants.WINDOWFOCUSLOST:
        DEVICES.keys, DEVICES.modifiers = InputDevices.keys, 0


def get() -> list[Any]:
    pump()
    events = _QUEUE[:]
    _QUEUE.clear()
    return events

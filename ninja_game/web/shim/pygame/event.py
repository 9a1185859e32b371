"""Events: host.js collects them, and gives them once a picture."""

from __future__ import annotations

import json
from typing import Any

from . import constants
from .host import LINK

_QUEUE: list[Event] = []


class Event:
    """``type``, and attributes as they belong to it."""

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"this event has no {name}")

    def __init__(self, kind: int, fields: dict[str, Any] | None = None, **more: Any) -> None:
        self.__dict__.update(fields or {}, **more)
        self.type = kind

    @property
    def dict(self) -> dict[str, Any]:
        """The attributes."""
        return {name: value for name, value in self.__dict__.items() if name != "type"}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Event) and self.__dict__ == other.__dict__

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<Event({self.type} {self.dict})>"


EventType = Event


class Devices:
    """What is held now. ``keys``: by scancode. ``modifiers``: of the keyboard. ``mouse``: its place, px."""

    keys: tuple[bool, ...] = (False,) * 512
    modifiers = 0
    mouse = (0, 0)


DEVICES = Devices()


def pump() -> None:
    """Take what happened since the last time, and follow what is held."""
    text = LINK.page.events()
    if text != "[]":
        for name, fields in json.loads(text):
            post(
                Event(getattr(constants, name), {k: tuple(v) if isinstance(v, list) else v for k, v in fields.items()})
            )


def post(event: Event) -> None:
    """Add an event."""
    _QUEUE.append(event)
    if event.type in (constants.KEYDOWN, constants.KEYUP):
        keys = list(DEVICES.keys)
        keys[event.scancode] = event.type == constants.KEYDOWN
        DEVICES.keys, DEVICES.modifiers = tuple(keys), event.mod
    elif event.type in (constants.MOUSEMOTION, constants.MOUSEBUTTONDOWN, constants.MOUSEBUTTONUP):
        DEVICES.mouse = event.pos
    elif event.type == constants.WINDOWFOCUSLOST:
        DEVICES.keys, DEVICES.modifiers = Devices.keys, 0


def get() -> list[Event]:
    """What happened since the last call."""
    pump()
    events = _QUEUE[:]
    _QUEUE.clear()
    return events

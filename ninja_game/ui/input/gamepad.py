"""Gamepads: buttons, sticks and triggers as names that can be bound. Pads may come and go at any time.

Pads that SDL knows have the names of a standard pad (``a``, ``dpad-left``, ``leftx-``); others are read as joysticks
(``button-3``, ``axis-0-``, ``hat-left``).
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import pygame

from ninja_game.player.settings import Settings

RELEASE_SHARE = 0.8
"""A stick is at rest again below this share of the dead zone, so that it does not flicker at its edge."""

FULL_AXIS = 32767

BUTTONS = (
    "a", "b", "x", "y", "back", "guide", "start", "leftstick", "rightstick", "leftshoulder", "rightshoulder",
    "dpad-up", "dpad-down", "dpad-left", "dpad-right",
)  # fmt: skip
AXES = ("leftx", "lefty", "rightx", "righty", "lefttrigger", "righttrigger")

_LABELS = {
    "a": "A", "b": "B", "x": "X", "y": "Y", "back": "Back", "guide": "Guide", "start": "Start",
    "leftstick": "Left stick press", "rightstick": "Right stick press", "leftshoulder": "LB", "rightshoulder": "RB",
    "lefttrigger+": "LT", "righttrigger+": "RT", "dpad-up": "D-pad up", "dpad-down": "D-pad down",
    "dpad-left": "D-pad left", "dpad-right": "D-pad right", "leftx-": "Stick left", "leftx+": "Stick right",
    "lefty-": "Stick up", "lefty+": "Stick down", "rightx-": "Right stick left", "rightx+": "Right stick right",
    "righty-": "Right stick up", "righty+": "Right stick down", "hat-up": "Cross up", "hat-down": "Cross down",
    "hat-left": "Cross left", "hat-right": "Cross right",
}  # fmt: skip

Change = tuple[str, bool]  # an input's name, and whether it is down now


class Gamepads:
    """All pads together. ``dead_zone``: share of a stick's range that counts as rest. ``down``: the held inputs."""

    def __init__(self) -> None:
        self.dead_zone = Settings.dead_zone
        self._down: dict[int, set[str]] = {}
        self._open: dict[int, Any] = {}
        with suppress(ImportError, pygame.error):
            from pygame._sdl2 import controller

            controller.init()
            pygame.joystick.init()
            for number in range(pygame.joystick.get_count()):
                self._add(number)

    @property
    def down(self) -> set[str]:
        """Names of the inputs that are held on any pad."""
        return set().union(*self._down.values())

    @property
    def count(self) -> int:
        return len(self._open)

    def changes(self, event: pygame.Event) -> list[Change]:
        """The inputs that an event presses and releases. Pads are opened and closed here as they come and go."""
        kind = event.type
        if kind == pygame.JOYDEVICEADDED:
            self._add(event.device_index)
        elif kind == pygame.JOYDEVICEREMOVED:
            return self._remove(event.instance_id)
        elif kind in (pygame.CONTROLLERBUTTONDOWN, pygame.CONTROLLERBUTTONUP) and event.button < len(BUTTONS):
            return self._set(event.instance_id, BUTTONS[event.button], kind == pygame.CONTROLLERBUTTONDOWN)
        elif kind == pygame.CONTROLLERAXISMOTION and event.axis < len(AXES):
            return self._axis(event.instance_id, AXES[event.axis], event.value / FULL_AXIS)
        elif kind in (pygame.JOYBUTTONDOWN, pygame.JOYBUTTONUP) and self._is_plain(event.instance_id):
            return self._set(event.instance_id, f"button-{event.button}", kind == pygame.JOYBUTTONDOWN)
        elif kind == pygame.JOYAXISMOTION and self._is_plain(event.instance_id):
            return self._axis(event.instance_id, f"axis-{event.axis}", event.value)
        elif kind == pygame.JOYHATMOTION and self._is_plain(event.instance_id):
            return self._hat(event.instance_id, *event.value)
        return []

    def _add(self, number: int) -> None:
        """Open a pad, as a standard one if SDL knows it."""
        from pygame._sdl2 import controller

        with suppress(pygame.error, AttributeError):
            pad: Any
            if controller.is_controller(number):
                pad = controller.Controller(number)
                instance = pad.as_joystick().get_instance_id()
            else:
                pad = pygame.joystick.Joystick(number)
                instance = pad.get_instance_id()
            self._open[instance] = pad

    def _remove(self, instance: int) -> list[Change]:
        self._open.pop(instance, None)
        return [(name, False) for name in self._down.pop(instance, set())]

    def _is_plain(self, instance: int) -> bool:
        pad = self._open.get(instance)
        return pad is None or isinstance(pad, pygame.joystick.JoystickType)

    def _set(self, instance: int, name: str, down: bool) -> list[Change]:
        held = self._down.setdefault(instance, set())
        if (name in held) == down:
            return []
        (held.add if down else held.discard)(name)
        return [(name, down)]

    def _axis(self, instance: int, name: str, value: float) -> list[Change]:
        """Both directions of a stick's axis; a trigger only has the one."""
        changes = []
        for side, depth in (("-", -value), ("+", value)):
            held = name + side in self._down.get(instance, ())
            down = depth > self.dead_zone * (RELEASE_SHARE if held else 1.0)
            changes += self._set(instance, name + side, down)
        return changes

    def _hat(self, instance: int, x: int, y: int) -> list[Change]:
        sides = {"hat-left": x < 0, "hat-right": x > 0, "hat-up": y > 0, "hat-down": y < 0}
        return [change for name, down in sides.items() for change in self._set(instance, name, down)]


def pad_label(name: str) -> str:
    return _LABELS.get(name) or name[:-1].replace("-", " ").capitalize() + name[-1:]

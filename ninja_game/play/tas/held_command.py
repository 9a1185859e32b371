"""A command whose key or button is held: it is done again and again, as a key repeats in a text."""

from __future__ import annotations

import pygame

from ninja_game.play.input.bindings import InputEvent
from ninja_game.play.input.gamepad import Gamepads
from ninja_game.play.input.keys import HeldKey
from ninja_game.play.tas.controls import FIRST_REPEAT_MS, REPEATING


class HeldCommand(HeldKey[str]):
    """The command whose key, or button of one of these pads, is held, if it is one that repeats."""

    def __init__(self, pads: Gamepads) -> None:
        super().__init__()
        self._pads = pads
        self._button = ""

    def hold(self, name: str, event: InputEvent) -> None:
        """A command was done by a key or button that is down."""
        if name in REPEATING:
            kind, button = event.source or ("", "")
            self._button = button if kind == "pad" else ""
            self.begin(name, getattr(event.raw, "scancode", 0), first=FIRST_REPEAT_MS, every=REPEATING[name])

    def follow(self, event: pygame.Event) -> None:
        """It ends when its key or button is released."""
        super().follow(event)
        if self._button and self._button not in self._pads.down:
            self._button = ""
            self.end()

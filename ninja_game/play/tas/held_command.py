"""A command whose key is held: it is done again and again, as a key repeats in a text."""

from __future__ import annotations

from ninja_game.play.input.held_key import HeldKey
from ninja_game.play.tas.controls import FIRST_REPEAT_MS, REPEATING


class HeldCommand(HeldKey[str]):
    """The command whose key is held, if it is one that repeats."""

    def hold(self, name: str, scancode: int) -> None:
        """A command was done; its key is down."""
        if name in REPEATING:
            self.begin(name, scancode, first=FIRST_REPEAT_MS, every=REPEATING[name])

"""Pads with the buttons of a standard one: in a page all of them."""

from __future__ import annotations


def init() -> None:
    """Nothing to do."""


def is_controller(number: int) -> bool:
    """All are."""
    return True


class Controller:
    """A pad; host.js posts its events under its number."""

    def __init__(self, number: int) -> None:
        self._number = number

    def as_joystick(self) -> Controller:
        """Itself."""
        return self

    def get_instance_id(self) -> int:
        """The number in its events."""
        return self._number

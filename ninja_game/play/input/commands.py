"""Commands of the screens that are tools: what they are called, which keys and buttons mean them."""

from __future__ import annotations

from typing import NamedTuple

from ninja_game.play.input.scancodes import key_label


class Command(NamedTuple):
    """``keys``: names of keys, with ``ctrl+`` and ``shift+`` before them; ``pad``: inputs of a standard gamepad."""

    name: str
    label: str
    keys: tuple[str, ...] = ()
    pad: str = ""


def key_text(command: Command) -> str:
    """What to press for a command, for people; '' for nothing."""
    return "+".join(map(key_label_of, command.keys[0].split("+"))) if command.keys else ""


def key_label_of(name: str) -> str:
    """What a key is called."""
    return {"ctrl": "Ctrl", "delete": "Del", "minus": "-", "equals": "="}.get(name) or key_label(
        {"shift": "lshift"}.get(name, name)
    )

"""The commands of an editor: one table of names, keys and buttons; what is held is done again and again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import pygame

from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.gamepad import Gamepads
from ninja_game.ui.input.keys import HeldKey, chord, key_label_of, scancode_of

FIRST_REPEAT_MS = 300
"""A command whose key is held is repeated after so long."""


class Command(NamedTuple):
    """``keys``: names of keys, with ``ctrl+`` and ``shift+`` before them; ``pad``: inputs of a standard gamepad."""

    name: str
    label: str
    keys: tuple[str, ...] = ()
    pad: str = ""


def key_text(command: Command) -> str:
    """What to press for a command, for people; '' for nothing."""
    return "+".join(map(key_label_of, command.keys[0].split("+"))) if command.keys else ""


class CommandTable:
    """All commands of an editor by what means them. The help page shows ``commands``.

    ``pads``: commands by buttons of a pad, besides those in the commands. ``repeating``: the commands that are repeated
    while they are held, and then how often, ms.
    """

    def __init__(
        self, commands: Sequence[Command], *, repeating: Mapping[str, int], pads: Mapping[str, str] | None = None
    ) -> None:
        self.commands = commands
        self.repeating = repeating
        self.by_name = {command.name: command for command in commands}
        self._by_key = {key: command.name for command in commands for key in command.keys}
        self._by_pad = {command.pad: command.name for command in commands if command.pad} | dict(pads or {})

    def meaning(self, event: InputEvent) -> str:
        """The name of the command that a key or a button of a pad means; '' for none."""
        if event.source is None:
            return ""
        if event.source[0] == "pad":
            return self._by_pad.get(event.source[1], "")
        return self._by_key.get(chord(event.raw), "")

    def hint(self, name: str) -> str:
        """What a command does and what to press for it."""
        command = self.by_name[name]
        return "    ".join(filter(None, (command.label, key_text(command))))


class HeldCommand(HeldKey[str]):
    """The command whose key, or button of one of these pads, is held, if it is one that repeats."""

    def __init__(self, table: CommandTable, pads: Gamepads) -> None:
        super().__init__()
        self._repeating, self._pads = table.repeating, pads
        self._button = ""

    def hold(self, name: str, event: InputEvent) -> None:
        """A command was done by a key or button that is down."""
        if name in self._repeating:
            kind, button = event.source or ("", "")
            self._button = button if kind == "pad" else ""
            key = 0 if kind == "pad" else scancode_of(event.raw)
            self.begin(name, key, first=FIRST_REPEAT_MS, every=self._repeating[name])

    def follow(self, event: pygame.Event) -> None:
        """It ends when its key or button is released."""
        super().follow(event)
        if self._button and self._button not in self._pads.down:
            self._button = ""
            self.end()

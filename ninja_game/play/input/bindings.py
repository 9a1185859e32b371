"""Keys and pads to actions, as the player has bound them: the ``Controls`` of the game."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from time import monotonic

import pygame

from ninja_game.play.input.default_bindings import ACTIONS, MENU_KEYS, MENU_PAD
from ninja_game.play.input.gamepad import Gamepads, pad_label
from ninja_game.play.input.key_names import key_label, key_name, learn_label, scancode_named, scancode_of
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT

TAP_SECONDS = 0.06
"""A jump key that went down and up between two ticks still counts in the next one, if it is not older than this."""

MOVES = (("left", KEY_LEFT), ("right", KEY_RIGHT), ("jump", JUMP_HELD))

Inputs = Mapping[str, tuple[str, ...]]
"""Names of inputs by action."""


class Bindings:
    """Which keys and pad inputs mean which actions.

    ``keys`` and ``pad``: what the player has changed, by action; the other actions have their defaults. Unknown names
    are ignored.
    """

    def __init__(self, keys: Inputs | None = None, pad: Inputs | None = None, *, dead_zone: float = 0.35) -> None:
        self.pads = Gamepads(dead_zone)
        self.pad_used = False
        self._keys_down: set[int] = set()
        self._tapped = -inf
        self.bind(keys or {}, pad or {})

    def bind(self, keys: Inputs, pad: Inputs) -> None:
        """Take other bindings."""
        self.keys = {action: tuple(keys.get(action, default.keys)) for action, default in ACTIONS.items()}
        self.pad = {action: tuple(pad.get(action, default.pad)) for action, default in ACTIONS.items()}
        self._by_key: dict[int, list[str]] = {}
        self._by_pad: dict[str, list[str]] = {}
        for action, names in self.keys.items():
            for scancode in filter(None, map(scancode_named, names)):
                self._by_key.setdefault(scancode, []).append(action)
        for action, names in self.pad.items():
            for name in names:
                self._by_pad.setdefault(name, []).append(action)
        self._move_keys = [
            (bit, [code for code in map(scancode_named, self.keys[action]) if code]) for action, bit in MOVES
        ]
        self._move_pad = [(bit, set(self.pad[action])) for action, bit in MOVES]

    # --- Controls ---

    def held(self) -> int:
        """What is held right now: 1 left + 2 right + 4 jump, read from the devices at this moment."""
        pygame.event.pump()
        state = pygame.key.get_pressed()
        pads = self.pads.down
        bits = 0
        for bit, codes in self._move_keys:
            # The tuple below is by scancode; the object's own indexing is by layout.
            if any(tuple.__getitem__(state, code) for code in codes):
                bits |= bit
        for bit, names in self._move_pad:
            if pads & names:
                bits |= bit
        if monotonic() - self._tapped <= TAP_SECONDS:
            bits |= JUMP_HELD
        self._tapped = -inf
        return bits

    def actions(self, event: pygame.Event) -> tuple[str, ...]:
        """All the actions that an event presses; repetitions by the keyboard do not count."""
        found = self._pressed(event, down=True)
        if "jump" in found:
            self._tapped = monotonic()
        return found

    def releases(self, event: pygame.Event) -> tuple[str, ...]:
        """All the actions that an event releases."""
        return self._pressed(event, down=False)

    def name(self, action: str) -> str:
        """What to press for an action: on the pad if that was used last, else on the keyboard."""
        pad, keys = self.pad.get(action, ()), self.keys.get(action, ())
        if self.pad_used and pad:
            return pad_label(pad[0])
        return key_label(keys[0]) if keys else pad_label(pad[0]) if pad else "(no key)"

    def _pressed(self, event: pygame.Event, *, down: bool) -> tuple[str, ...]:
        if event.type == (pygame.KEYDOWN if down else pygame.KEYUP):
            self.pad_used = False
            learn_label(event)
            return tuple(self._by_key.get(scancode_of(event), ()))
        found: list[str] = []
        for name, is_down in self._pad_changes(event):
            if is_down == down:
                found += self._by_pad.get(name, ())
        return tuple(found)

    def _pad_changes(self, event: pygame.Event) -> list[tuple[str, bool]]:
        """What a pad's event changes; the same event may be asked about several times."""
        if getattr(event, "changes", None) is None:
            if event.type < pygame.JOYAXISMOTION and event.type not in PAD_EVENTS:
                return []
            event.changes = self.pads.changes(event)
            self.pad_used = self.pad_used or any(down for _, down in event.changes)
        changes: list[tuple[str, bool]] = event.changes
        return changes

    # --- menus and rebinding ---

    def menu(self, event: pygame.Event) -> str | None:
        """What an event means in menus: up, down, left, right, confirm, back, page_up and so on; None if nothing."""
        if event.type == pygame.KEYDOWN:
            self.pad_used = False
            learn_label(event)
            return MENU_KEYS.get(key_name(scancode_of(event)))
        pressed = [name for name, down in self._pad_changes(event) if down]
        return next((MENU_PAD[name] for name in pressed if name in MENU_PAD), None)

    def menu_release(self, event: pygame.Event) -> str | None:
        """What in menus an event releases."""
        if event.type == pygame.KEYUP:
            return MENU_KEYS.get(key_name(scancode_of(event)))
        released = [name for name, down in self._pad_changes(event) if not down]
        return next((MENU_PAD[name] for name in released if name in MENU_PAD), None)

    def pressed_input(self, event: pygame.Event) -> tuple[str, str] | None:
        """The input that an event presses, to be bound: ("keys" or "pad", its name)."""
        if event.type == pygame.KEYDOWN:
            learn_label(event)
            return "keys", key_name(scancode_of(event))
        pressed = [name for name, down in self._pad_changes(event) if down]
        return ("pad", pressed[0]) if pressed else None


PAD_EVENTS = frozenset(
    {
        pygame.JOYAXISMOTION, pygame.JOYHATMOTION, pygame.JOYBUTTONDOWN, pygame.JOYBUTTONUP, pygame.JOYDEVICEADDED,
        pygame.JOYDEVICEREMOVED, pygame.CONTROLLERAXISMOTION, pygame.CONTROLLERBUTTONDOWN, pygame.CONTROLLERBUTTONUP,
    }
)  # fmt: skip

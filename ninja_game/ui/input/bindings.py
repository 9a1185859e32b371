"""Keys and pads to actions, as the player has bound them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import monotonic
from typing import NamedTuple

import pygame

from ninja_game.files.bundled import asset_rows
from ninja_game.runtime import in_page_or_not
from ninja_game.sim.inputs import JUMP_HELD, MOVES
from ninja_game.ui.input.gamepad import Gamepads, pad_label
from ninja_game.ui.input.keys import key_label, key_name, learn_label, scancode_named, scancode_of

TAP_SECONDS = 0.15
"""A move pressed and released between two ticks counts in the next one, up to this age: longer than any tick."""

_Inputs = Mapping[str, tuple[str, ...]]  # names of inputs by action

TOUCH_LABELS = {
    "left": "Left", "right": "Right", "jump": "Jump", "confirm": "Jump", "back": "Back", "pause": "Pause",
    "retry": "Retry",
}  # fmt: skip
"""The names of the page's buttons on a touch screen, by action."""


class Bindings:
    """The keys and pad inputs of each action: ``keys`` and ``pad``, by action.

    ``tap_to_run``: a press of left or right lasts until the next press of either.
    """

    def __init__(self) -> None:
        self.pads = Gamepads()
        self.pad_used = self.touched = False
        self._taps: dict[int, float] = {}
        self.tap_to_run = False
        self._running = self._jumps_down = 0
        self.bind({}, {})

    def bind(self, keys: _Inputs, pad: _Inputs) -> None:
        """Apply the player's changes, by action; the other actions have their defaults.

        Unknown names are ignored and listed in ``unknown``; an action with only unknown keys keeps its defaults.
        """
        self.unknown = sorted({name for names in keys.values() for name in names if not scancode_named(name)})
        self.keys = {}
        for action, default in ACTIONS.items():
            inputs = tuple(keys.get(action, default.keys))
            known = tuple(name for name in inputs if scancode_named(name) and bindable(action, name, MENU_KEYS))
            self.keys[action] = known if known or not inputs else tuple(default.keys)
        self.pad = {
            action: tuple(name for name in pad.get(action, default.pad) if bindable(action, name, MENU_PAD))
            for action, default in ACTIONS.items()
        }
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
        both = _jumps_and_chooses(self.keys, MENU_KEYS)
        self._jump_choosing = [code for code in map(scancode_named, both) if code]
        self._jump_choosing_pad = _jumps_and_chooses(self.pad, MENU_PAD)

    def poll(self) -> int:
        """Read the devices: the sum of the held keys, 1 left + 2 right + 4 jump.

        A tap of a move since the last poll counts as held, once. A second jump key beside a held one is a new press:
        the jump counts as released this time.
        """
        pygame.event.pump()
        state = pygame.key.get_pressed()
        pads = self.pads.down
        bits = 0
        for bit, codes in self._move_keys:
            # The tuple below is indexed by scancode; the object's own indexing is by layout.
            if any(tuple.__getitem__(state, code) for code in codes):
                bits |= bit
        for bit, names in self._move_pad:
            if pads & names:
                bits |= bit
        now = monotonic()
        bits |= sum(bit for bit, when in self._taps.items() if not bits & bit and now - when <= TAP_SECONDS)
        self._taps.clear()
        jumps = sum(tuple.__getitem__(state, code) for code in self._move_keys[2][1]) + len(pads & self._move_pad[2][1])
        if 0 < self._jumps_down < jumps:
            bits &= ~JUMP_HELD
        self._jumps_down = jumps
        return bits & JUMP_HELD | self._running if self.tap_to_run else bits

    def choosing(self, *, pads: bool = True) -> int:
        """The jump bit while an input for both jump and confirm is down: a confirmation is no jump."""
        state = pygame.key.get_pressed()
        down = any(tuple.__getitem__(state, code) for code in self._jump_choosing)
        return JUMP_HELD if down or (pads and self.pads.down & self._jump_choosing_pad) else 0

    def stop_running(self) -> None:
        """Forget the running of ``tap_to_run``, and taps that have not counted yet."""
        self._running = 0
        self._taps.clear()

    def decode(self, event: pygame.Event) -> InputEvent:
        """The meaning of an event. To be called once for each: pads, layout and taps of the jump key are tracked."""
        if event.type in (pygame.KEYDOWN, pygame.KEYUP):
            return self._decode_key(event)
        changes = self.pads.changes(event)
        if not changes:
            return InputEvent(event)
        pressed = [name for name, down in changes if down]
        released = [name for name, down in changes if not down]
        self.pad_used = self.pad_used or bool(pressed)
        return self._remember(
            InputEvent(
                event,
                tuple(action for name in pressed for action in self._by_pad.get(name, ())),
                tuple(action for name in released for action in self._by_pad.get(name, ())),
                next((MENU_PAD[name] for name in pressed if name in MENU_PAD), ""),
                next((MENU_PAD[name] for name in released if name in MENU_PAD), ""),
                ("pad", pressed[0]) if pressed else None,
            )
        )

    def _decode_key(self, event: pygame.Event) -> InputEvent:
        self.pad_used = False
        learn_label(event)
        code = scancode_of(event)
        name = key_name(code)
        actions = tuple(self._by_key.get(code, ()))
        menu = MENU_KEYS.get(name, "")
        if event.type == pygame.KEYUP:
            return InputEvent(event, released=actions, menu_released=menu)
        return self._remember(InputEvent(event, pressed=actions, menu=menu, source=("keys", name)))

    def _remember(self, event: InputEvent) -> InputEvent:
        """The event. Keeps the time of a press of a move for the next tick, and the running of ``tap_to_run``."""
        self._taps |= {bit: monotonic() for action, bit in MOVES if action in event.pressed}
        for action, bit in MOVES[:2]:
            if action in event.pressed:
                self._running = 0 if self._running else bit
        return event

    def name(self, action: str) -> str:
        """The input for an action: on the screen or the pad if that was used last, else on the keyboard."""
        if self.touched and action in TOUCH_LABELS:
            return TOUCH_LABELS[action]
        pad, keys = self.pad.get(action, ()), self.keys.get(action, ())
        if self.pad_used and pad:
            return pad_label(pad[0])
        return key_label(keys[0]) if keys else pad_label(pad[0]) if pad else "(no key)"

    def all_names(self, action: str) -> tuple[str, str]:
        """All inputs for an action: on the keyboard, on the usual gamepad."""
        buttons = [name for name in self.pad[action] if not name.startswith(("hat-", "axis-", "button-"))]
        return ", ".join(map(key_label, self.keys[action])), ", ".join(map(pad_label, buttons))


def _jumps_and_chooses(inputs: _Inputs, menu: Mapping[str, str]) -> set[str]:
    """The names of inputs that both jump and confirm, in play or in a menu."""
    chosen = {*inputs["confirm"], *(name for name, meaning in menu.items() if meaning == "confirm")}
    return {*inputs["jump"]} & chosen


class KeyAction(NamedTuple):
    """An action of the player. ``where``: "level", "replay", "run" (either) or "everywhere", menus too.

    ``label``: for the settings screen. ``keys``, ``pad``: names of the default inputs.
    """

    where: str
    label: str
    keys: tuple[str, ...]
    pad: tuple[str, ...] = ()


def _read_actions() -> dict[str, KeyAction]:
    """The actions of the bundled table, whose head explains its columns."""
    return {
        name: KeyAction(where, label, tuple(keys.split()), tuple(" ".join(pad).split()))
        for name, where, label, keys, *pad in asset_rows("commands/game.txt")
    }


ACTIONS = _read_actions()

PAGE_KEYS = {"slow": ("x",), "screenshot": ("f10",)}
"""Keys in a page instead of those that the browser uses itself: Ctrl with W, a jump, closes the tab."""

ACTIONS |= {action: ACTIONS[action]._replace(keys=keys) for action, keys in in_page_or_not(PAGE_KEYS, {}).items()}

MENU_KEYS: dict[str, str] = {
    "left": "left", "right": "right", "up": "up", "down": "down", "return": "confirm", "kp_enter": "confirm",
    "space": "confirm", "escape": "back", "backspace": "back", "pageup": "page_up", "pagedown": "page_down",
    "home": "first", "end": "last", "delete": "delete",
}  # fmt: skip
"""Keys in menus; they cannot be rebound, so that menus always work."""

MENU_PAD: dict[str, str] = {
    "dpad-left": "left", "dpad-right": "right", "dpad-up": "up", "dpad-down": "down", "leftx-": "left",
    "leftx+": "right", "lefty-": "up", "lefty+": "down", "a": "confirm", "b": "back", "start": "confirm",
    "leftshoulder": "page_up", "rightshoulder": "page_down", "y": "delete", "x": "next",
    "hat-left": "left", "hat-right": "right", "hat-up": "up", "hat-down": "down", "axis-0-": "left",
    "axis-0+": "right", "axis-1-": "up", "axis-1+": "down", "button-0": "confirm", "button-1": "back",
}  # fmt: skip


def bindable(action: str, name: str, in_menus: Mapping[str, str]) -> bool:
    """Whether an action may have an input: keys of menus must not hide the game.

    >>> [bindable("boss", name, MENU_KEYS) for name in ("return", "b")], bindable("boss", "b", MENU_PAD)
    ([False, True], False)
    """
    return ACTIONS[action].where != "everywhere" or name not in in_menus


@dataclass(frozen=True)
class InputEvent:
    """The actions that an event presses and releases.

    ``raw``: SDL's event. ``pressed``, ``released``: actions in play (``ACTIONS``). ``menu``, ``menu_released``: actions
    in menus (the values of ``MENU_KEYS``), "" for none. ``source``: the pressed input, ("keys", "x") or ("pad", "a");
    None for any other event.
    """

    raw: pygame.Event
    pressed: tuple[str, ...] = ()
    released: tuple[str, ...] = ()
    menu: str = ""
    menu_released: str = ""
    source: tuple[str, str] | None = None

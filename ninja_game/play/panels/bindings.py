"""The tables of keys and buttons in the settings."""

from __future__ import annotations

from functools import partial

import pygame

from ninja_game.play.app import App, Screen
from ninja_game.play.menu_screen import CANCEL, Menu, MenuRow
from ninja_game.ui.input.bindings import ACTIONS, MENU_KEYS, MENU_PAD, InputEvent, bindable
from ninja_game.ui.input.gamepad import pad_label
from ninja_game.ui.input.keys import key_label
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import TEXT_SIZE


def can_clash(first: str, second: str) -> bool:
    """Whether two actions must not share an input: both are read on one screen, and share none by default."""
    a, b = ACTIONS[first], ACTIONS[second]
    if first == second or {a.where, b.where} == {"level", "replay"}:
        return False
    return not (set(a.keys) & set(b.keys) or set(a.pad) & set(b.pad))


def input_label(device: str, name: str) -> str:
    return key_label(name) if device == "keys" else pad_label(name)


class Capture(Screen):
    """Waits for one press, which becomes the input. Esc cancels."""

    see_through = True

    def __init__(self, table: BindingTable, action: str, slot: int) -> None:
        super().__init__(table.app)
        self.table = table
        self.action = action
        self.slot = slot

    def capture(self, event: InputEvent) -> bool:
        if event.raw.type == pygame.MOUSEBUTTONDOWN:
            self.app.pop()
            return True
        if event.source is None:
            return False
        device, name = event.source
        if device == "keys" and name == "escape":
            self.app.pop()
        elif device == self.table.device:
            self.app.pop()
            self.table.taken(self.action, self.slot, name)
        return True

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        if not self.redraw:
            return []
        theme = self.app.theme
        theme.window(surface, 206, 240, 380, 110)
        what = "key" if self.table.device == "keys" else "button, or move a stick,"
        theme.text(surface, ACTIONS[self.action].label, 396, 262, size=16, align="centre", bold=True)
        theme.text(surface, f"Press a {what} now", 396, 292, size=12, align="centre")
        theme.text(surface, "Esc cancels", 396, 318, size=10, colour=theme.palette.faint, align="centre")
        return None


SLOTS = {"keys": 6, "pad": 5}
BINDING_ROW = 30
LIST: Area = (216, 72, 540, 13 * BINDING_ROW)
LABEL_SHARE = 0.34


class BindingTable(ListView):
    """A row per action, a cell per input. Left and right choose the cell, Enter waits for a press, Delete clears."""

    def __init__(self, app: App, device: str) -> None:
        super().__init__(LIST, BINDING_ROW, self._draw_action, self._capture)
        self.app, self.device, self.slots = app, device, SLOTS[device]
        self.actions = [name for name in ACTIONS if self._default(name) or name in ("quit", "skip", "boss")]
        self.slot = 0
        self.hint = "Left and right to choose a slot, Enter to set it, Delete to clear it"
        self.fill(self.actions)

    def inputs(self, action: str) -> tuple[str, ...]:
        return tuple(getattr(self.app.settings, self.device).get(action, self._default(action)))

    def _default(self, action: str) -> tuple[str, ...]:
        return ACTIONS[action].keys if self.device == "keys" else ACTIONS[action].pad

    def bind(self, action: str, inputs: tuple[str, ...]) -> None:
        """Give an action other inputs; default ones are not stored."""
        changed = {**getattr(self.app.settings, self.device), action: inputs}
        if inputs == self._default(action):
            del changed[action]
        self.app.change_settings(**{self.device: changed})

    def nudge(self, action: str) -> bool:
        if action in ("left", "right"):
            slot = self.slot + (1 if action == "right" else -1)
            if not 0 <= slot < self.slots:
                return False
            self.slot = slot
            return True
        if action == "delete":
            name = self.actions[self.index]
            inputs = self.inputs(name)
            self.bind(name, inputs[: self.slot] + inputs[self.slot + 1 :])
            return True
        return super().nudge(action)

    def click(self, x: float, y: float) -> bool:
        left, width = self._cells()
        if x < left:  # the row's name, which waits for no press
            return self.hover(x, y)
        if x < left + self.slots * width:
            self.slot = int((x - left) // width)
        return super().click(x, y)

    def _cells(self) -> tuple[float, float]:
        x, _, w, _ = self.area
        return x + w * LABEL_SHARE, (w * (1 - LABEL_SHARE) - 12) / self.slots

    def _capture(self, index: int) -> None:
        self.app.push(Capture(self, self.actions[index], self.slot))

    def taken(self, action: str, slot: int, name: str) -> None:
        """Use a pressed input for an action; if other actions have it, the player chooses.

        Cancel comes first, against hasty keys.
        """
        if not bindable(action, name, MENU_KEYS if self.device == "keys" else MENU_PAD):
            self.app.notify(f"{input_label(self.device, name)} works the menus: choose another one")
            return
        others = [other for other in ACTIONS if name in self.inputs(other) and can_clash(action, other)]
        share = partial(self.put, action, slot, name)

        def take() -> None:
            for other in others:
                self.bind(other, tuple(input_ for input_ in self.inputs(other) if input_ != name))
            share()

        if not others:
            share()
            return
        labels = " and ".join(ACTIONS[other].label for other in others)
        rows: list[MenuRow] = [CANCEL, (f"Only {ACTIONS[action].label}", take, ""), ("Use it for both", share, "")]
        self.app.push(Menu(self.app, f"{input_label(self.device, name)} already means {labels}", rows))

    def put(self, action: str, slot: int, name: str) -> None:
        """Put an input in its place; one that is twice in a row is kept once."""
        inputs = [input_ for input_ in self.inputs(action) if input_ != name]
        inputs[slot : slot + 1] = [name]
        self.bind(action, tuple(inputs[: self.slots]))

    def _draw_action(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        _, y, _, h = area
        action = self.actions[index]
        top = y + (h - TEXT_SIZE) / 2
        left, width = self._cells()
        theme.text(
            surface, ACTIONS[action].label, area[0] + 2, top, size=TEXT_SIZE, bold=focused, width=left - area[0] - 8
        )
        inputs = self.inputs(action)
        for slot in range(self.slots):
            x = left + slot * width
            is_focused = focused and slot == self.slot
            if slot > len(inputs) - 1 + focused and not is_focused:
                continue
            theme.row(surface, (x + 2, y + 2, width - 4, h - 4), chosen=is_focused, focused=is_focused, radius=3)
            if slot < len(inputs):
                text = input_label(self.device, inputs[slot])
                theme.text(surface, text, x + width / 2, top + 0.5, size=10, align="centre", width=width - 10)

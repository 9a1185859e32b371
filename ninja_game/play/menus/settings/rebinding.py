"""The settings' pages of keys and buttons: every action, up to five inputs each, changed by pressing another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pygame

from ninja_game.play.input.bindings import ACTIONS
from ninja_game.play.menus.settings.capture import Capture, Conflict, clash, input_label
from ninja_game.play.ui.list_view import ListView
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import TEXT, Button, Slider, Widget

if TYPE_CHECKING:
    from ninja_game.play.menus.settings.screen import SettingsScreen


SLOTS = 5
ROW = 30
LIST: Area = (216, 72, 540, 13 * ROW)
LABEL_SHARE = 0.34


def binding_widgets(screen: SettingsScreen, device: str) -> list[Widget]:
    """The widgets of a page. ``device``: "keys" or "pad"."""
    actions = [name for name in ACTIONS if device == "keys" or ACTIONS[name].pad or name in ("quit", "skip", "boss")]
    # The same one again after a press was taken, so that the selection stays.
    table = screen.tables.setdefault(device, BindingTable(screen, device, actions))
    widgets: list[Widget] = [
        table,
        Button((216, 478, 260, 30), "Reset to defaults", lambda: screen.change(**{device: {}})),
    ]
    if device == "pad":
        widgets.append(_dead_zone(screen))
    return widgets


def _dead_zone(screen: SettingsScreen) -> Slider:
    pads = screen.app.controls.pads.count
    return Slider(
        (216, 514, 540, 30), "Dead zone of sticks", (0.05, 0.95, 0.05), lambda: screen.player.settings.dead_zone,
        lambda value: screen.change(dead_zone=round(value, 2)), show=lambda value: f"{100 * value:.0f} %",
        hint=f"{pads} gamepads are plugged in" if pads != 1 else "One gamepad is plugged in",
    )  # fmt: skip


class BindingTable(ListView):
    """One row an action, one cell an input. Left and right choose the cell, Enter waits for a press, Delete clears."""

    def __init__(self, screen: SettingsScreen, device: str, actions: list[str]) -> None:
        super().__init__(LIST, ROW, self._draw_action, self._capture)
        self.screen = screen
        self.device = device
        self.actions = actions
        self.slot = 0
        self.hint = "Left and right choose a place, Enter takes a new press, Delete clears it"
        self.fill(actions)

    def inputs(self, action: str) -> tuple[str, ...]:
        """The names of the inputs that an action has now."""
        changed = getattr(self.screen.player.settings, self.device)
        default = ACTIONS[action].keys if self.device == "keys" else ACTIONS[action].pad
        return tuple(changed.get(action, default))

    def bind(self, action: str, inputs: tuple[str, ...]) -> None:
        """Give an action other inputs; where they are the default ones nothing is stored."""
        changed = dict(getattr(self.screen.player.settings, self.device))
        default = ACTIONS[action].keys if self.device == "keys" else ACTIONS[action].pad
        changed[action] = inputs
        if inputs == default:
            del changed[action]
        self.screen.change(**{self.device: changed})

    def nudge(self, action: str) -> bool:
        """Left and right within the row, Delete."""
        if action in ("left", "right"):
            slot = self.slot + (1 if action == "right" else -1)
            if not 0 <= slot < SLOTS:
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
        """The cell that is clicked."""
        left, width = self._cells()
        if left <= x < left + SLOTS * width:
            self.slot = int((x - left) // width)
        return super().click(x, y)

    def _cells(self) -> tuple[float, float]:
        x, _, w, _ = self.area
        return x + w * LABEL_SHARE, (w * (1 - LABEL_SHARE) - 12) / SLOTS

    def _capture(self, index: int) -> None:
        self.screen.app.push(Capture(self, self.actions[index], self.slot))

    def taken(self, action: str, slot: int, name: str) -> None:
        """An input was pressed for an action: use it, unless other actions have it; then the player chooses."""
        others = [other for other in ACTIONS if name in self.inputs(other) and clash(action, other)]
        if others:
            self.screen.app.push(Conflict(self, action, slot, name, others))
        else:
            self.put(action, slot, name)

    def put(self, action: str, slot: int, name: str) -> None:
        """Put an input in its place; twice in one row is once."""
        inputs = [each for each in self.inputs(action) if each != name]
        inputs[slot : slot + 1] = [name]
        self.bind(action, tuple(inputs[:SLOTS]))

    def _draw_action(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        _, y, _, h = area
        action = self.actions[index]
        top = y + (h - TEXT) / 2
        theme.text(
            surface, ACTIONS[action].label, area[0] + 2, top, size=TEXT, bold=focused, width=LIST[2] * LABEL_SHARE - 8
        )
        left, width = self._cells()
        inputs = self.inputs(action)
        for slot in range(SLOTS):
            x = left + slot * width
            here = focused and slot == self.slot
            theme.row(surface, (x + 2, y + 2, width - 4, h - 4), chosen=here, focused=here, radius=3)
            if slot < len(inputs):
                text = input_label(self.device, inputs[slot])
                theme.text(surface, text, x + width / 2, top + 0.5, size=10, align="centre", width=width - 10)

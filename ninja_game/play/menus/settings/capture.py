"""Taking a press for an action: the panel that waits for it, and the question if another action has it already."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.input.bindings import ACTIONS, InputEvent
from ninja_game.play.input.gamepad import pad_label
from ninja_game.play.input.keys import key_label
from ninja_game.play.menus.panels import Panel
from ninja_game.play.screen import Screen

if TYPE_CHECKING:
    from ninja_game.play.menus.settings.rebinding import BindingTable

IN_REPLAYS_ONLY = frozenset({"faster", "slower", "frame_back", "frame_forward", "edit"})
IN_LEVELS_ONLY = frozenset(
    {"suicide", "replay", "skip", "quick_save", "quick_load", "rewind", "slow", "step"}
)  # fmt: skip
"""Actions that never mean something on the same screen."""


def clash(first: str, second: str) -> bool:
    """Whether two actions must not have the same input: other ones, read on one screen, that share none by default."""
    if first == second:
        return False
    pair = {first, second}
    if pair & IN_REPLAYS_ONLY and pair & IN_LEVELS_ONLY:
        return False
    a, b = ACTIONS[first], ACTIONS[second]
    return not (set(a.keys) & set(b.keys) or set(a.pad) & set(b.pad))


def input_label(device: str, name: str) -> str:
    """What an input is called. ``device``: "keys" or "pad"."""
    return key_label(name) if device == "keys" else pad_label(name)


class Conflict(Panel):
    """An input that other actions have already: the player says what becomes of it."""

    def __init__(self, table: BindingTable, action: str, slot: int, name: str, others: Sequence[str]) -> None:
        labels = " and ".join(ACTIONS[other].label for other in others)
        super().__init__(table.screen.app, f"{input_label(table.device, name)} already means {labels}")
        self.table = table
        self.action = action
        self.slot = slot
        self.name = name
        self.others = others

    def rows(self) -> list[tuple[str, Callable[[], object], str]]:
        """To leave it comes first, so that a hasty key does no harm."""
        label = ACTIONS[self.action].label
        return [
            ("Leave it as it was", self.back, ""),
            (f"Only {label}", self._take, ""),
            ("Use it for both", self._share, ""),
        ]

    def _take(self) -> None:
        """The others lose it."""
        for other in self.others:
            self.table.bind(other, tuple(each for each in self.table.inputs(other) if each != self.name))
        self._share()

    def _share(self) -> None:
        self.app.pop()
        self.table.put(self.action, self.slot, self.name)


class Capture(Screen):
    """Waits for one press, which becomes the input. Esc leaves all as it was."""

    see_through = True

    def __init__(self, table: BindingTable, action: str, slot: int) -> None:
        super().__init__(table.screen.app)
        self.table = table
        self.action = action
        self.slot = slot

    def capture(self, event: InputEvent) -> bool:
        """Take the press, whatever it means elsewhere."""
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
        """What to do."""
        if not self.redraw:
            return []
        theme = self.app.theme
        theme.window(surface, 206, 240, 380, 110)
        what = "key" if self.table.device == "keys" else "button, or move a stick,"
        theme.text(surface, ACTIONS[self.action].label, 396, 262, size=16, align="centre", bold=True)
        theme.text(surface, f"Press a {what} for it", 396, 292, size=12, align="centre")
        theme.text(surface, "Esc leaves it as it was", 396, 318, size=10, colour=theme.palette.faint, align="centre")
        return None

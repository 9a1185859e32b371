"""The row of buttons above the level."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pygame

from ninja_game.editor.tools import EditorTools
from ninja_game.play.editor.controls import COMMANDS, keys_of
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Button

TOP, TALL, GAP = 4.0, 21.0, 3.0

_BUTTONS = (
    ("menu", "File", 36, 0), ("undo", "Undo", 40, 0), ("redo", "Redo", 40, 5),
    ("brush", "Brush", 42, 0), ("rectangle", "Box", 34, 0), ("fill", "Fill", 32, 0), ("select", "Select", 44, 0),
    ("pick", "Pick", 34, 5), ("symmetry", "Mirror: {symmetry}", 100, 0), ("grid", "Grid: {grid}", 104, 0),
    ("snap_next", "Snap: {snap}", 78, 5), ("test", "Test", 42, 0), ("certify", "Certify", 52, 0),
    ("help", "Help", 40, 0),
)  # fmt: skip
"""Command, text, width, more than the usual gap behind it, px."""

_LABELS = {command.name: command.label for command in COMMANDS}


class ToolButton(Button):
    """A button of a command, accented while the command is in force."""

    def __init__(
        self,
        area: Area,
        name: str,
        text: str,
        run: Callable[[str], object],
        tools: EditorTools,
        grid: Callable[[], str],
    ) -> None:
        hint = "    ".join(filter(None, (_LABELS[name], keys_of(name))))
        super().__init__(area, text, lambda: run(name), hint=hint, size=9)
        self.name, self.tools, self.grid = name, tools, grid

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        """Its text in a panel."""
        tools, (x, y, w, h) = self.tools, self.area
        lit = self.name == tools.tool or (self.name == "symmetry" and tools.symmetry != "off")
        theme.row(surface, self.area, chosen=lit, focused=lit, radius=3)
        self.enabled = {"undo": tools.history.can_undo, "redo": tools.history.can_redo}.get(self.name, True)
        text = self.text.format(symmetry=tools.symmetry, grid=self.grid(), snap=tools.snap)
        colour = theme.palette.text if self.enabled else theme.palette.faint
        theme.text(
            surface, text, x + w / 2, y + (h - 9) / 2, size=9, colour=colour, align="centre", bold=lit or focused
        )


def toolbar(tools: EditorTools, run: Callable[[str], object], grid: Callable[[], str]) -> Sequence[ToolButton]:
    """The buttons from left to right. ``run``: does a command; ``grid``: the name of the grid that is shown."""
    x, buttons = 6.0, []
    for name, text, width, gap in _BUTTONS:
        buttons.append(ToolButton((x, TOP, width, TALL), name, text, run, tools, grid))
        x += width + GAP + gap
    return buttons

"""The row of buttons above the level."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pygame

from ninja_game.editor.bench import TOOLS
from ninja_game.play.editor.controls import COMMANDS, keys_of
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Button

TOP, TALL, GAP = 4.0, 21.0, 3.0

_LABELS = {command.name: command.label for command in COMMANDS}


class ToolButton(Button):
    """A button of a command. ``shown``: its text now; ``lit``: whether it is in force."""

    def __init__(
        self, area: Area, name: str, run: Callable[[str], object], shown: Callable[[], str], lit: Callable[[], bool]
    ) -> None:
        keys = keys_of(name)
        super().__init__(
            area, "", lambda: run(name), hint=f"{_LABELS[name]}    {keys}" if keys else _LABELS[name], size=9
        )
        self._shown = shown
        self._lit = lit
        self.able: Callable[[], bool] = lambda: True

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        """Its text in a panel that is accented while it is in force."""
        theme.row(surface, self.area, chosen=self._lit(), focused=self._lit(), radius=3)
        self.enabled = self.able()
        x, y, w, h = self.area
        colour = theme.palette.text if self.enabled else theme.palette.faint
        theme.text(
            surface, self._shown(), x + w / 2, y + (h - 9) / 2, size=9, colour=colour, align="centre",
            bold=self._lit() or focused,
        )  # fmt: skip


def toolbar(session: EditorSession, run: Callable[[str], object], grid: Callable[[], str]) -> Sequence[ToolButton]:
    """The buttons from left to right. ``run``: does a command; ``grid``: the name of the grid that is shown."""
    x = 6.0
    buttons: list[ToolButton] = []

    def add(name: str, text: str | Callable[[], str], width: float, lit: Callable[[], bool] = lambda: False) -> None:
        nonlocal x
        shown = text if callable(text) else lambda: str(text)
        buttons.append(ToolButton((x, TOP, width, TALL), name, run, shown, lit))
        x += width + GAP

    def tool(name: str) -> Callable[[], bool]:
        return lambda: session.bench.tool == name

    add("menu", "File", 36)
    add("undo", "Undo", 40)
    buttons[-1].able = lambda: session.bench.history.can_undo
    add("redo", "Redo", 40)
    buttons[-1].able = lambda: session.bench.history.can_redo
    x += 5
    for name, text, width in zip(TOOLS, ("Brush", "Box", "Fill", "Select", "Pick"), (42, 34, 32, 44, 34), strict=True):
        add(name, text, width, tool(name))
    x += 5
    add("symmetry", lambda: f"Mirror: {session.bench.symmetry}", 100, lambda: session.bench.symmetry != "off")
    add("grid", lambda: f"Grid: {grid()}", 104)
    add("snap_next", lambda: f"Snap: {session.bench.snap}", 78)
    x += 5
    add("test", "Test", 42)
    add("certify", "Certify", 52)
    add("help", "Help", 40)
    return buttons

"""The base of the parts around the level, and their buttons."""

from __future__ import annotations

from collections.abc import Callable

import pygame

from ninja_game.play.editor.commands import EDITOR_COMMANDS
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.view import EditorView
from ninja_game.play.workspace import Pane
from ninja_game.ui.canvas import Colour
from ninja_game.ui.theme import Area, Palette, Theme
from ninja_game.ui.widgets import Button


class EditorPart(Pane):
    """A part around the level."""

    panel: Area | None = None  #: where it is drawn on a panel

    def __init__(self, view: EditorView) -> None:
        self.view = view
        self.session: EditorSession = view.session

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        theme.canvas.fill_rect(surface, theme.palette.tile, *self.area)
        if self.panel:
            theme.canvas.fill_rect(surface, self.panel_colour(theme.palette), *self.panel, 3)

    def panel_colour(self, palette: Palette) -> Colour:
        return palette.panel

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """Show the hint of the button under the mouse in the status line; the widgets do the rest."""
        if event.type != pygame.MOUSEMOTION or any(event.buttons):
            return False
        widget = next((part for part in self.widgets if part.focusable and part.contains(x, y)), None)
        self.view.hint = widget.hint if widget else ""
        return True


class ToolButton(Button):
    """A button of a command, highlighted while the command is active."""

    def __init__(self, area: Area, name: str, text: str, run: Callable[[str], object], view: EditorView) -> None:
        super().__init__(area, text, lambda: run(name), hint=EDITOR_COMMANDS.hint(name), size=9)
        self.name, self.view = name, view

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        tools, (x, y, w, h) = self.view.session.tools, self.area
        symmetry, snap = tools.brush.symmetry, tools.brush.snap
        lit = self.name == tools.effective_tool or (self.name == "symmetry" and symmetry != "off")
        theme.row(surface, self.area, chosen=lit, focused=lit, radius=3)
        self.enabled = {"undo": tools.history.can_undo, "redo": tools.history.can_redo}.get(self.name, True)
        grid, certify = self.view.grid.name, self.view.session.certify_text
        zoom = "fit" if self.view.camera.zoom == 1 else f"{self.view.camera.zoom:.2g}x"
        text = self.text.format(symmetry=symmetry, grid=grid, snap=snap, certify=certify, zoom=zoom)
        colour = theme.palette.text if self.enabled else theme.palette.faint
        bold, place = lit or focused, (x + w / 2, y + (h - 9) / 2)
        theme.text(surface, text, *place, size=9, colour=colour, align="centre", bold=bold, width=w)

"""The screen of an editor: its parts, and which of them gets what mouse and keys do."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import pygame

from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MOUSE, MenuScreen
from ninja_game.play.workspace.commands import CommandTable, HeldCommand
from ninja_game.play.workspace.part import Part
from ninja_game.ui.audio.music import SILENCE
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.widgets import Widget


class WorkspaceScreen(MenuScreen):
    """Parts of a window around a document. A key is a command, unless a text field has the focus.

    ``table``: the commands, which ``run`` does. ``parts``: those that are shown; each is drawn when its ``render_key``
    changes, or what its widgets show.
    """

    table: ClassVar[CommandTable]
    music = SILENCE
    offers_back = False

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.held = HeldCommand(self.table, app.controls.pads)
        self._widgets_changed = True
        self._grabbed: Part | None = None
        self._pointed: Part | None = None

    @property
    def parts(self) -> Sequence[Part]:
        raise NotImplementedError

    def run(self, name: str) -> None:
        raise NotImplementedError

    def hint(self, text: str) -> None:
        """Show a text about what is under the mouse, or none."""
        raise NotImplementedError

    def build(self) -> Sequence[Widget]:
        return [widget for part in self.parts for widget in part.widgets]

    def follow_parts(self) -> None:
        """Have the widgets that the parts have now; one that a part wants gets the focus."""
        self.widgets = list(self.build())
        wanted = next((part.wants for part in self.parts if part.wants is not None), None)
        for part in self.parts:
            part.wants = None
        focus = wanted or (self.focus if self.focus in self.widgets else None)
        if focus is not self.focus:
            self.focus = focus
            self.widgets_changed()
            self.await_text()

    def enter(self) -> None:
        super().enter()
        self.focus = None
        self.await_text()
        self.widgets_changed()

    def leave(self) -> None:
        """Covered or closed: what is held ends."""
        super().leave()
        self.held.end()
        self._grabbed = None  # its release goes to what covers this

    def chime(self, name: str) -> None:
        """Editing is silent."""

    def back(self) -> None:
        """Escape is a command."""

    def widgets_changed(self) -> None:
        """The parts with widgets are drawn again, not the whole window."""
        self._widgets_changed = True

    def await_text(self) -> None:
        """Only while a field has the focus: the letter of a command's key is not typed into what the key opens."""
        if self.app.top is self:
            typing = isinstance(self.focus, TextEntry)
            (pygame.key.start_text_input if typing else pygame.key.stop_text_input)()

    # --- keys and mouse ---

    def meaning(self, event: InputEvent) -> str:
        """The command that an event means; '' for none."""
        return self.table.meaning(event)

    def capture(self, event: InputEvent) -> bool:
        """Keys go to the widget with the focus, typed text to a field, until Escape."""
        self.held.follow(event.raw)
        if self.focus is not None and event.source == ("keys", "escape"):
            self.focus = None
            self.widgets_changed()
            self.await_text()
            return True
        return super().capture(event)

    def handle(self, event: InputEvent) -> None:
        command = self.meaning(event)
        if event.raw.type == pygame.KEYDOWN:
            self.held.end()
        typing = self.focus is not None and event.menu in ("confirm", "up", "down", "left", "right", "first", "last")
        if event.raw.type in MOUSE:
            self._give_mouse(event.raw)
        elif command and not typing:
            self.run(command)
            self.held.hold(command, event)
        elif typing or not self.edit_by_key(event):
            super().handle(event)
        self.follow_parts()
        self.await_text()

    def edit_by_key(self, event: InputEvent) -> bool:
        """Take a key that edits without a command; whether it did."""
        return False

    def _give_mouse(self, raw: pygame.Event) -> None:
        pos = pygame.mouse.get_pos() if raw.type == pygame.MOUSEWHEEL else raw.pos
        x, y = self.theme.canvas.logical(pos)
        if raw.type == pygame.MOUSEMOTION:
            self.hint("")
        part = self._grabbed or next((each for each in self.parts if each.contains(x, y)), None)
        if self._pointed is not part and self._pointed is not None:
            self._pointed.mouse_left()
        self._pointed = part
        if raw.type == pygame.MOUSEBUTTONDOWN:
            self._grabbed = part
        elif raw.type == pygame.MOUSEBUTTONUP:
            self._grabbed = None
        if raw.type != pygame.MOUSEMOTION and self.focus is not None and not (part and self.focus in part.widgets):
            self.focus = None
            self.widgets_changed()
        if part is None or not part.mouse(raw, x, y):
            focus = self.focus
            self._handle_mouse(raw)
            # Neither the mouse over a widget nor a click on a button takes keys away from the document.
            if raw.type == pygame.MOUSEBUTTONDOWN:
                focus = self.focus if isinstance(self.focus, TextEntry) else None
            self.focus = focus

    # --- time and picture ---

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        for command in self.held.due(real_ms):
            self.run(command)

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        theme, whole = self.theme, self.redraw
        if whole:
            surface.fill(theme.palette.tile)
        changed = []
        for part in self.parts:
            again = whole or (self._widgets_changed and bool(part.widgets))
            changed += part.draw(surface, theme, self.focus, whole=again)
        self._widgets_changed = False
        return None if whole else changed

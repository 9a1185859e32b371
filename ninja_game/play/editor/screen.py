"""The editor in the window: where its parts are, and what mouse, keys and pads do."""

from __future__ import annotations

from collections.abc import Sequence

import pygame

from ninja_game.editor.brush import Tool
from ninja_game.editor.files import Source
from ninja_game.editor.palette import SNAPS, snapped
from ninja_game.editor.specs import properties, word
from ninja_game.editor.stamp import Selection
from ninja_game.play.app import App
from ninja_game.play.editor.bars import StatusLine, Toolbar
from ninja_game.play.editor.commands import EDITOR_COMMANDS, EditorCommands
from ninja_game.play.editor.object_list import ObjectList
from ninja_game.play.editor.palette_view import PaletteView, entry_of_key, live_changes
from ninja_game.play.editor.panels import FilePart, Findings, PalettePart
from ninja_game.play.editor.properties import Properties
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.play.menu_screen import DIRECTIONS
from ninja_game.play.workspace import Pane, WorkspaceScreen
from ninja_game.ui.canvas import HEIGHT
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.widgets import next_option


class EditorScreen(WorkspaceScreen):
    """The level editor. ``session``: the edited level; ``view``: the level in the middle."""

    table = EDITOR_COMMANDS
    small_notices = True
    foot_height = HEIGHT - LAYOUT.findings[1]  #: in the level's lower border

    def __init__(self, app: App, source: Source | None = None, *, offers_recovered: bool = True) -> None:
        super().__init__(app)
        app.follow_mood(self.mood)
        self.session = EditorSession(app, source)
        x, y, w, h = LAYOUT.palette
        self.palette = PaletteView((x + 6, y + 4, w - 10, h - 19), self.session.tools)
        self.view = EditorView(app, self.session)
        self.commands = EditorCommands(app, self.session, self.view, self.palette)
        self.properties = Properties(self.view)
        self.sides: tuple[Pane, Pane] = PalettePart(self.view, self.palette, self.run), ObjectList(self.view, self.run)
        self._parts: list[Pane] = [
            self.view, Toolbar(self.view, self.commands.choose), self.properties,
            Findings(self.view, self.commands.go_to_finding), FilePart(self.view), StatusLine(self.view, self.run),
        ]  # fmt: skip
        self._dragged_to: InputEvent | None = None
        self._entered = not offers_recovered

    @property
    def notice_room(self) -> tuple[float, float]:
        return LAYOUT.level[0], LAYOUT.level[0] + LAYOUT.level[2]

    @property
    def parts(self) -> Sequence[Pane]:
        return [*self._parts, self.sides[self.view.listing]]

    def run(self, name: str) -> None:
        self.commands.run(name)
        self.redraw = self.redraw or name in ("list", "find")
        if name == "find":
            self.sides[1].wants = self.sides[1].widgets[0]

    def hint(self, text: str) -> None:
        self.view.hint = text

    def follow_parts(self) -> None:
        """Show the properties of another object, unless one is being typed."""
        if not isinstance(self.focus, TextEntry):
            self.properties.refresh()
        super().follow_parts()

    def enter(self) -> None:
        """The first time, ask about an unsaved level, unless a level was just chosen."""
        super().enter()
        with self.app.errors_as_notices():
            self.session.follow_move()
        self.follow_parts()
        if not self._entered:
            self._entered = True
            self.commands.offer_recovered()

    def leave(self) -> None:
        super().leave()
        self.session.leave()

    def capture(self, event: InputEvent) -> bool:
        """Enter ends what is typed, too."""
        ends = event.raw.type == pygame.KEYDOWN and chord(event.raw) in ("return", "kp_enter")
        if ends and isinstance(self.focus, TextEntry):
            self.focus = None
            self.widgets_changed()
            self.follow_parts()
            return True
        return super().capture(event)

    def handle(self, event: InputEvent) -> None:
        """The mouse reports many places per picture: a drag goes to the last one."""
        if event.raw.type == pygame.MOUSEMOTION and self.session.tools.is_dragging:
            self._dragged_to = event
            return
        self._drag_on()
        super().handle(event)

    def _drag_on(self) -> None:
        event, self._dragged_to = self._dragged_to, None
        if event is not None:
            super().handle(event)

    def edit_by_key(self, event: InputEvent) -> bool:
        """Keys choose what is drawn; confirm is the left button after keys or a pad have moved the pointer."""
        if event.source and event.source[0] == "keys" and self._choose_by_key(chord(event.raw)):
            return True
        if event.menu == "confirm":
            if self.view.by_keys:
                self.view.press()
            else:
                self.view.hovering = self.view.by_keys = True
                self.view.hint = "Arrows move the pointer, Space draws there"
            return True
        return event.menu_released == "confirm" and self.view.release()

    def act(self, action: str, *, held: bool = False) -> None:
        if action not in DIRECTIONS:
            return
        tools, (dx, dy) = self.session.tools, DIRECTIONS[action]
        if tools.tool == Tool.SELECT and tools.selection and not self.view.by_keys:
            tools.selected.nudge(dx, dy)
            return
        snap = tools.brush.snap if tools.brush.draws_objects or tools.tool == Tool.SELECT else "cell"
        x, y = tools.pointer
        step = SNAPS[snap]
        self.view.hovering = self.view.by_keys = True
        tools.move(*snapped(x + dx * step, y + dy * step, snap))
        self.view.follow(*tools.pointer)

    def _choose_by_key(self, key: str) -> bool:
        """Keys that choose a tile, an object, a direction; Shift and arrows move what is selected."""
        tools = self.session.tools
        if key.startswith("shift+") and key[6:] in DIRECTIONS:
            tools.selected.nudge(*DIRECTIONS[key[6:]])
            return True
        if self._change_by_key(key):
            return True
        what = entry_of_key(tools, key)
        if what is None:
            return False
        tools.selection = Selection()
        self.palette.take(what)
        return True

    def _change_by_key(self, key: str) -> bool:
        """Change a property of the drawn or selected objects; whether they have it."""
        tools = self.session.tools
        changes = {name: letters[key] for name, letters in live_changes(tools).items() if key in letters}
        for name, to in changes.items():
            tools.selected.put_word(name, self._words_on(name, to) if isinstance(to, int) else to)
        return bool(changes)

    def _words_on(self, name: str, by: int) -> str:
        spec = next(subject for subject in self.session.tools.selected.subjects if name in properties(subject))
        words, now = list(properties(spec)[name].words), word(spec, name)
        return next_option(words, now if now in words else words[0], by)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        self._drag_on()
        self.session.update()
        self.commands.follow_file()
        for part in self.parts:
            part.update(real_ms)

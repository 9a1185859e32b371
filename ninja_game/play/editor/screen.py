"""The editor in the window: where its parts are, and what mouse, keys and pads do to them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pygame

from ninja_game.editor.brush import SNAPS, snapped
from ninja_game.editor.files import Source
from ninja_game.editor.records import PROPERTIES, properties, with_word, word
from ninja_game.play.editor.commands import EditorCommands
from ninja_game.play.editor.controls import DIRECTION_KEYS, OBJECT_TYPE_OF_KEY, command_of, tile_of_key
from ninja_game.play.editor.palette_view import PaletteView
from ninja_game.play.editor.properties import property_widgets, subject
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.toolbar import toolbar
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.play.input.bindings import InputEvent
from ninja_game.play.input.keys import chord
from ninja_game.play.menus.menu_screen import DIRECTIONS, MenuScreen
from ninja_game.play.ui.list_view import ListView
from ninja_game.play.ui.text_entry import TextEntry
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Widget

if TYPE_CHECKING:
    from ninja_game.play.app import App

_MOUSE = (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEWHEEL)
_LEFT, _MIDDLE, _RIGHT = 1, 2, 3


class EditorScreen(MenuScreen):
    """A level is made here. ``session``: what is edited; ``view``: what is seen of it."""

    def __init__(self, app: App, source: Source | None = None) -> None:
        super().__init__(app)
        self.session = EditorSession(app, source)
        self.view = EditorView(app, self.session)
        self.commands = EditorCommands(app, self.session, self.view)
        self.findings = ListView(
            LAYOUT.findings, 19, self._draw_finding, self.commands.go_to_finding, empty="No problems found",
            hint="A click goes there and selects it",
        )  # fmt: skip
        self._subject: tuple[object, ...] = ()
        self._held = False
        self._dragged_to: pygame.Event | None = None
        self._entered = False

    def build(self) -> Sequence[Widget]:
        """Toolbar, palette, properties, findings."""
        tools = self.session.tools
        self._subject = subject(tools)
        self.palette_view = PaletteView(LAYOUT.palette, tools)
        self.view.toolbar = list(toolbar(tools, self.commands.run, lambda: self.view.grid.name))
        self.view.properties = list(property_widgets(tools, LAYOUT.properties))
        return [*self.view.toolbar, self.palette_view, *self.view.properties, self.findings]

    def enter(self) -> None:
        """Nothing has the focus: keys draw."""
        super().enter()
        self.focus = None
        self.commands.step_palette = self.palette_view.step
        self.view.stale = True
        if not self._entered:
            self._entered = True
            self.commands.offer_recovered()

    def leave(self) -> None:
        """Covered or closed: what is edited is kept safe at once."""
        super().leave()
        self.session.autosave.flush(self.session.draft, self.session.source)

    def chime(self, name: str) -> None:
        """Editing is silent."""

    # --- keys and pads ---

    def capture(self, event: InputEvent) -> bool:
        """What is typed goes into the field that has the focus; Enter and Escape end it."""
        ends = event.raw.type == pygame.KEYDOWN and chord(event.raw) in ("return", "kp_enter", "escape")
        if ends and isinstance(self.focus, TextEntry):
            self.focus = None
            self._follow()
            return True
        with self._panels_only():
            return super().capture(event)

    @contextmanager
    def _panels_only(self) -> Iterator[None]:
        """What the widgets want drawn again is the panels, not the level."""
        before, self.redraw = self.redraw, False
        yield
        self.view.stale, self.redraw = self.view.stale or self.redraw, before

    def handle(self, event: InputEvent) -> None:
        """Mouse, keys, pads. A mouse tells of many places in a picture: what is dragged goes to the last one."""
        if event.raw.type == pygame.MOUSEMOTION and self.session.tools.dragging:
            self._dragged_to = event.raw
            return
        self._drag_on()
        if event.raw.type in _MOUSE:
            self._handle_mouse(event.raw)
        elif command := command_of(event):
            self.commands.run(command)
        elif event.source and event.source[0] == "keys" and self._choose_by_key(chord(event.raw)):
            pass
        elif event.menu == "confirm":
            self._held = True
            self.session.tools.press()
        elif event.menu_released == "confirm" and self._held:
            self._held = False
            self.session.tools.release()
        else:
            super().handle(event)
        if event.raw.type != pygame.MOUSEMOTION:
            self._follow()

    def _drag_on(self) -> None:
        event, self._dragged_to = self._dragged_to, None
        if event is not None:
            self._handle_mouse(event)

    def _follow(self) -> None:
        """What is shown follows what was done."""
        self.view.stale = True
        if subject(self.session.tools) != self._subject and not isinstance(self.focus, TextEntry):
            self.widgets = list(self.build())
            self.focus = None

    def act(self, action: str, *, held: bool = False) -> None:
        """Arrows move the pointer by the snap."""
        if action not in DIRECTIONS:
            return
        tools, (dx, dy) = self.session.tools, DIRECTIONS[action]
        snap = tools.snap if tools.objects or tools.tool == "select" else "cell"
        x, y = tools.pointer
        step = SNAPS[snap]
        self.view.hovering = True
        tools.move(*snapped(x + dx * step, y + dy * step, snap))
        self.view.moved = True

    def _choose_by_key(self, key: str) -> bool:
        """Keys that choose a tile, an object, a direction; Shift and arrows move what is selected."""
        tools = self.session.tools
        if key.startswith("shift+") and key[6:] in DIRECTIONS:
            tools.nudge(*DIRECTIONS[key[6:]])
            return True
        if not tools.objects and not tools.selection:
            tile = tile_of_key(key, tools.tile)
            if tile is not None:
                tools.pick_up(tile)
            return tile is not None
        object_type = OBJECT_TYPE_OF_KEY.get(key)
        if object_type and not tools.selection:
            tools.pick_up(object_type.record)
        elif key in DIRECTION_KEYS:
            self._direct(DIRECTION_KEYS[key])
        elif key in ("q", "e"):
            self._next_word("movement", -1 if key == "q" else 1)
        elif key == "n":
            self._next_word("seeker", 1)
        else:
            return object_type is not None
        return True

    def _direct(self, direction: str) -> None:
        """Turn the object in hand, or the selected one; doors have sides instead."""
        record = self.session.tools.subject
        side = {"up": "top", "down": "bottom"}.get(direction, direction)
        for name, text in (("direction", direction), ("side", side)):
            if name in properties(record):
                self.session.tools.put_subject(with_word(record, name, text))

    def _next_word(self, name: str, by: int) -> None:
        record = self.session.tools.subject
        if name in properties(record):
            words = list(PROPERTIES[record.kind][name].words)
            place = words.index(word(record, name)) if word(record, name) in words else 0
            self.session.tools.put_subject(with_word(record, name, words[(place + by) % len(words)]))

    # --- the mouse ---

    def _handle_mouse(self, event: pygame.Event) -> None:
        tools, view = self.session.tools, self.view
        pos = pygame.mouse.get_pos() if event.type == pygame.MOUSEWHEEL else event.pos
        over = view.overlay.area.collidepoint(pos) and self._dragged is None
        if event.type == pygame.MOUSEMOTION:
            view.hovering = over
            if over or self._held:
                view.hint = ""
                tools.move(*view.overlay.canvas.logical(pos))
            elif self._dragged is not None:
                self._dragged.drag(*self.app.canvas.logical(pos))
                view.stale = True
            else:
                self._hover(*self.app.canvas.logical(pos))
            view.moved = True
        elif event.type == pygame.MOUSEWHEEL and over:
            self.palette_view.step(-event.y)
        elif event.type == pygame.MOUSEBUTTONDOWN and over:
            self.focus = None
            self._held = True
            tools.move(*view.overlay.canvas.logical(pos))
            add = bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)
            tools.press(erase=event.button == _RIGHT, pick=event.button == _MIDDLE, add=add)
        elif event.type == pygame.MOUSEBUTTONUP and self._held:
            self._held = False
            tools.release()
        else:
            with self._panels_only():
                super()._handle_mouse(event)

    def _hover(self, x: float, y: float) -> None:
        """Say what the thing under the mouse is."""
        widget = self._at(x, y)
        self.view.hint = self.palette_view.hover(x, y) if widget is self.palette_view else widget.hint if widget else ""

    # --- findings ---

    def _draw_finding(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        finding = self.view.shown_findings[index]
        x, y, w, _ = area
        theme.text(surface, "!", x + 4, y + 5, size=9.5, bold=True, colour=theme.palette.bad)
        theme.text(surface, f"{finding.sentence}. {finding.hint}", x + 14, y + 5, size=9.5, width=w - 16)

    # --- time and picture ---

    def update(self, real_ms: int) -> None:
        """What works in the background tells its news."""
        super().update(real_ms)
        self._drag_on()
        self.session.update()
        if self.session.certifier.text != self.view.shown_certificate:
            self.view.shown_certificate = self.session.certifier.text
            self.view.stale = True
        if self.session.findings is not self.view.shown_findings:
            self.view.shown_findings = self.session.findings
            self.findings.fill(self.session.findings)
            self.view.stale = True

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """All of it, or what has changed."""
        return self.view.draw(surface, self.widgets, self.focus, whole=self.redraw)

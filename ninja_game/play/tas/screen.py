"""The TAS editor in the window: its parts, and which of them gets what mouse and keys do."""

from __future__ import annotations

import gc
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

import pygame

from ninja_game.formats.recording import Recording
from ninja_game.play.input.bindings import InputEvent
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.tas.borders import Borders
from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.tas.file_commands import FileCommands
from ninja_game.play.tas.head import Foot, Head
from ninja_game.play.tas.held_command import HeldCommand
from ninja_game.play.tas.level.part import LevelPart
from ninja_game.play.tas.part import Commands, Part
from ninja_game.play.tas.roll.part import Roll
from ninja_game.play.tas.tabs.all_tabs import all_tabs
from ninja_game.play.tas.tabs.tab import Tab, TabName, put_side_by_side
from ninja_game.play.ui.text_entry import TextEntry
from ninja_game.play.ui.theme import Theme
from ninja_game.play.ui.widgets import Widget
from ninja_game.tas.session import Session

if TYPE_CHECKING:
    from ninja_game.play.app import App
    from ninja_game.tas.files import OpenedRun
    from ninja_game.tas.journal import Recovered

_MOUSE = (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEWHEEL)


class TasScreen(MenuScreen):
    """A run is edited here. ``editor``: what is seen and selected; ``session``: the run.

    ``beside``: other runs of its level; ``found``: what was not saved of the run last time. Raises LevelError for a run
    on a level that cannot be played, ReplayError for one beside that is of another level or has another body, FileError
    for what another window continues with.
    """

    def __init__(
        self, app: App, opened: OpenedRun, beside: Sequence[Recording] = (), found: Recovered | None = None
    ) -> None:
        super().__init__(app)
        self.session = Session(opened, app.player.folder)
        if found is not None:
            self.session.recover(found)
        self.editor = TasEditor(app, self.session)
        self.level, self.roll = LevelPart(self.editor), Roll(self.editor)
        self.tabs = all_tabs(self.editor)
        self.tab: Tab = self.tabs[0]
        self.names = [TabName(tab, partial(self.show_tab, tab)) for tab in self.tabs]
        self.head, self.foot_line = Head(self.editor), Foot(self.editor)
        self.files = FileCommands(app, self.editor, self._run, self._go_on)
        self.level.others.open(beside)
        self.borders = Borders(self.editor, [self.head, self.level, self.roll, self.foot_line, *self.tabs])
        self._entered = found is not None
        self._widgets_stale = True
        self._dragging: Part | None = None
        self._held = HeldCommand(app.controls.pads)
        self._pointed: Part | None = None

    @property
    def parts(self) -> list[Part]:
        """All that draws itself."""
        return [self.head, self.level, self.roll, self.tab, self.foot_line, self.borders]

    @property
    def theme(self) -> Theme:
        """The TAS editor's own: a larger window has room for more, where other screens are larger."""
        if self.borders.fit():
            self.redraw, layout = True, self.borders.layout
            self.notice_area = layout.notices
            put_side_by_side(self.names, layout.strip)
        return self.editor.theme

    def commands(self) -> Commands:
        """What commands do, by name."""
        own: Commands = {"next_tab": self.next_tab, **self.files.commands()}
        for part in (*self.parts, *self.tabs):
            own = {**own, **part.commands()}
        return own

    def _run(self, name: str) -> None:
        self.commands()[name]()

    def _go_on(self, found: Recovered) -> None:
        self.app.replace(TasScreen(self.app, found.opened, found=found))

    def build(self) -> Sequence[Widget]:
        """The names of the tabs, and what is in the present one."""
        return [*self.names, *self.tab.widgets]

    def enter(self) -> None:
        """Nothing has the focus: keys edit."""
        super().enter()
        self.editor.theme = self.theme  # all parts are in their places before the first of them looks around
        self.focus = self._dragging = None
        self.await_text()
        self._widgets_stale = True
        # All that there is now (compiled code has much) is left out when memory is cleared up: that took 80 ms.
        gc.freeze()
        if not self._entered:
            self._entered = True
            self.files.offer_recovered()

    def leave(self) -> None:
        """Covered or closed: what is going on ends."""
        super().leave()
        gc.unfreeze()
        self.level.stop()
        self.session.end()
        self._held.end()
        self._dragging = None  # its release goes to what covers this
        if self not in self.app.stack:
            for tab in self.tabs:
                tab.close()
            self.session.close(keep=True)  # what is not saved is offered again

    def chime(self, name: str) -> None:
        """Editing is silent."""

    def show_tab(self, tab: Tab) -> None:
        """Show another tab."""
        self.tab = tab
        self.editor.tab = tab.name
        self.rebuild()

    def next_tab(self) -> None:
        """The next tab."""
        self.show_tab(self.tabs[(self.tabs.index(self.tab) + 1) % len(self.tabs)])

    def _show_asked(self) -> None:
        """Show the tab that the TAS editor says, and give the focus to what wants it."""
        asked = next(tab for tab in self.tabs if tab.name == self.editor.tab)
        if asked is not self.tab or asked.wants is not None:
            self.show_tab(asked)

    def await_text(self) -> None:
        """Only while a field has the focus: the letter of a command's key is not typed into what the key opens."""
        if self.app.top is self:
            typing = isinstance(self.focus, TextEntry)
            (pygame.key.start_text_input if typing else pygame.key.stop_text_input)()

    def rebuild(self) -> None:
        """Take the widgets of the tab that is shown now."""
        self.widgets = list(self.build())
        self.focus, self.tab.wants = self.tab.wants, None
        self.await_text()
        self._widgets_stale = True

    # --- keys and mouse ---

    @contextmanager
    def _widgets_only(self) -> Iterator[None]:
        """What widgets want drawn again is their tab."""
        before, self.redraw = self.redraw, False
        yield
        self._widgets_stale, self.redraw = self._widgets_stale or self.redraw, before

    def capture(self, event: InputEvent) -> bool:
        """Typed text goes into the field with the focus, keys of the game to the ninja that was taken over."""
        self._held.follow(event.raw)
        if self.level.capture(event):
            return True
        if isinstance(self.focus, TextEntry) and event.source == ("keys", "escape"):
            self.focus, self._widgets_stale = None, True
            self.await_text()
            return True
        with self._widgets_only():
            return super().capture(event)

    def handle(self, event: InputEvent) -> None:
        """Commands, then the mouse, then the widgets of the tab."""
        command = self.level.meaning(event)
        if event.raw.type == pygame.KEYDOWN:
            self._held.end()
        typing = self.focus is not None and event.menu in ("confirm", "up", "down", "left", "right", "first", "last")
        if event.raw.type in _MOUSE:
            self._give_mouse(event.raw)
        elif command and not typing:
            self._run(command)
            self._show_asked()
            self._held.hold(command, event)
        else:
            with self._widgets_only():
                super().handle(event)
        self.await_text()

    def back(self) -> None:
        """Escape is a command."""

    def _give_mouse(self, raw: pygame.Event) -> None:
        pos = pygame.mouse.get_pos() if raw.type == pygame.MOUSEWHEEL else raw.pos
        x, y = self.theme.canvas.logical(pos)
        if raw.type == pygame.MOUSEMOTION:
            self.editor.hint = ""
        part = self._dragging or next((each for each in self.parts if each.contains(x, y)), None)
        if self._pointed is not part and self._pointed is not None:
            self._pointed.mouse_left()
        self._pointed = part
        if raw.type == pygame.MOUSEBUTTONDOWN and raw.button <= pygame.BUTTON_RIGHT:
            self._dragging = part
        elif raw.type == pygame.MOUSEBUTTONUP and raw.button <= pygame.BUTTON_RIGHT:
            self._dragging = None
        if part not in (None, self.tab) and raw.type != pygame.MOUSEMOTION:
            self.focus, self._widgets_stale = None, self._widgets_stale or self.focus is not None
        if part is None or not part.mouse(raw, x, y):
            focus = self.focus
            with self._widgets_only():
                super()._handle_mouse(raw)
            # Neither the mouse over a widget nor a click on a button takes keys away from the run.
            if raw.type == pygame.MOUSEBUTTONDOWN:
                focus = self.focus if isinstance(self.focus, TextEntry) else None
            self.focus = focus

    # --- time and picture ---

    def update(self, real_ms: int) -> None:
        """Simulate what is not simulated yet; parts go on."""
        super().update(real_ms)
        for command in self._held.due(real_ms):
            self._run(command)
        if not self.level.take_over.on:
            self.session.timeline.simulate(self.session.ticks_per_frame)
        for part in (self.level, self.roll, *self.tabs):
            part.update(real_ms)
        self._show_asked()

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """What has changed."""
        theme, whole = self.theme, self.redraw
        if whole:
            surface.fill(theme.palette.tile)
        stale = whole or self._widgets_stale
        changed = []
        for part in self.parts:
            drawn = part.draw(surface, theme, whole=whole or (part is self.tab and stale))
            changed += drawn
            if part is self.tab and drawn:
                self.draw_widgets(surface)
                changed.append(theme.canvas.rect(*self.borders.layout.strip))
        self._widgets_stale = False
        return None if whole else changed

"""The base of the level editor and the TAS editor in the window: a document, its commands, and parts around it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import ClassVar, NamedTuple, Protocol

import pygame

from ninja_game.document import OccupiedError
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.bundled import asset_rows
from ninja_game.play.app import App
from ninja_game.play.menu_screen import CANCEL, MOUSE, Action, Menu, MenuRow, MenuScreen, nothing
from ninja_game.ui.audio.music import SILENCE
from ninja_game.ui.input.bindings import ACTIONS, InputEvent
from ninja_game.ui.input.gamepad import Gamepads
from ninja_game.ui.input.keys import HeldKey, chord, key_label_of, scancode_of
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme, contains_point
from ninja_game.ui.widgets import Widget

_FIRST_REPEAT_MS = 300  # ms before the command of a held key repeats


class KeyCommand(NamedTuple):
    """A command of an editor. ``keys``: names of keys, with ``ctrl+`` and ``shift+`` before them.

    ``pad``: an input of a standard gamepad. ``repeats_ms``: interval of repeats while it is held; 0: none.
    """

    name: str
    label: str
    keys: tuple[str, ...] = ()
    pad: str = ""
    repeats_ms: int = 0


def bundled_commands(file: str) -> list[KeyCommand]:
    """The commands of an editor from a bundled file, whose head explains its columns."""
    return [_command(*cells) for cells in asset_rows(f"commands/{file}")]


def _command(name: str, label: str = "", keys: str = "", pad: str = "", repeats_ms: str = "0") -> KeyCommand:
    if label:
        return KeyCommand(name, label, tuple(keys.split()), pad, int(repeats_ms))
    return KeyCommand(name, ACTIONS[name].label, ACTIONS[name].keys)


def key_text(command: KeyCommand) -> str:
    """The key of a command, for people; '' for none."""
    return "+".join(map(key_label_of, command.keys[0].split("+"))) if command.keys else ""


class CommandTable:
    """All commands of an editor by their keys. The help page shows ``commands``.

    ``pads``: commands by buttons of a pad, besides those in the commands.
    """

    def __init__(self, commands: Sequence[KeyCommand], pads: Mapping[str, str] | None = None) -> None:
        self.commands = commands
        self.by_name = {command.name: command for command in commands}
        self._by_key = {key: command.name for command in commands for key in command.keys}
        self._by_pad = {command.pad: command.name for command in commands if command.pad} | dict(pads or {})

    def meaning(self, event: InputEvent) -> str:
        """The name of the command of a key or a button of a pad; '' for none."""
        if event.source is None:
            return ""
        if event.source[0] == "pad":
            return self._by_pad.get(event.source[1], "")
        return self._by_key.get(chord(event.raw), "")

    def hint(self, name: str) -> str:
        command = self.by_name[name]
        return "    ".join(filter(None, (command.label, key_text(command))))


class CommandMenu(Menu):
    """A menu of a document. The keys of the commands ``names`` work in it too: it closes, and ``run`` does them."""

    def __init__(
        self,
        app: App,
        title: str,
        rows: Sequence[MenuRow],
        *,
        table: CommandTable,
        names: Collection[str],
        run: Callable[[str], object],
    ) -> None:
        super().__init__(app, title, rows)
        self._table, self._names, self._run = table, names, run

    def handle(self, event: InputEvent) -> None:
        name = self._table.meaning(event)
        if name in self._names and event.source and event.source[0] == "keys":
            self.app.pop()
            self._run(name)
        else:
            super().handle(event)


class HeldCommand(HeldKey[str]):
    """The command whose key, or button of one of these pads, is held, if it repeats."""

    def __init__(self, table: CommandTable, pads: Gamepads) -> None:
        super().__init__()
        self._table, self._pads = table, pads
        self._button = ""

    def hold(self, name: str, event: InputEvent) -> None:
        if every := self._table.by_name[name].repeats_ms:
            kind, button = event.source or ("", "")
            self._button = button if kind == "pad" else ""
            key = 0 if kind == "pad" else scancode_of(event.raw)
            self.begin(name, key, first=_FIRST_REPEAT_MS, every=every)

    def follow(self, event: pygame.Event) -> None:
        super().follow(event)
        if self._button and self._button not in self._pads.down:
            self._button = ""
            self.end()


Commands = Mapping[str, Callable[[], object]]  # actions by the names of the table of commands


class Pane:
    """A part of a workspace, drawn again only when its ``render_key`` changes."""

    area: Area = (0, 0, 0, 0)  #: logical px
    widgets: Sequence[Widget] = ()  #: widgets in the pane; their state is part of ``render_key``
    wants: Widget | None = None  #: gets the focus as soon as the part is shown
    _drawn: tuple[object, ...] | None = None

    def render_key(self) -> tuple[object, ...]:
        """All that its picture depends on, besides the window's size, the palette and the focus."""
        raise NotImplementedError

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Draw all but the widgets; the clip is its area."""
        raise NotImplementedError

    def commands(self) -> Commands:
        return {}

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """A mouse event in its area, or of a drag that began there; whether it was used.

        ``x``, ``y``: logical px of the window.
        """
        return False

    def mouse_left(self) -> None:
        """The mouse has left the area."""

    def update(self, real_ms: int) -> None:
        """Let real time pass."""

    def place(self, area: Area) -> None:
        """Set the area; all is drawn again."""
        self.area = area

    def contains(self, x: float, y: float) -> bool:
        return contains_point(self.area, x, y)

    def draw(self, surface: pygame.Surface, theme: Theme, focus: Widget | None, *, whole: bool) -> list[pygame.Rect]:
        """Draw it if anything has changed; the px that changed."""
        key = self.render_key()
        if not whole and key == self._drawn:
            return []
        self._drawn = key
        rect = theme.canvas.rect(*self.area)
        surface.set_clip(rect)
        self.paint(surface, theme)
        for widget in sorted(self.widgets, key=lambda widget: widget is focus):
            widget.draw(surface, theme, focused=widget is focus)
        surface.set_clip(None)
        return [rect]


class WorkspaceScreen(MenuScreen):
    """Parts of a window around a document. A key is a command, unless a text field has the focus.

    ``table``: commands, which ``run`` does. ``parts``: shown ones, drawn when their ``render_key`` or widgets change.
    """

    table: ClassVar[CommandTable]
    music = SILENCE
    offers_back = False

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.held = HeldCommand(self.table, app.controls.pads)
        self._widgets_changed = True
        self._grabbed: Pane | None = None
        self._pointed: Pane | None = None

    @property
    def parts(self) -> Sequence[Pane]:
        raise NotImplementedError

    def run(self, name: str) -> None:
        raise NotImplementedError

    def hint(self, text: str) -> None:
        raise NotImplementedError

    def build(self) -> Sequence[Widget]:
        return [widget for part in self.parts for widget in part.widgets]

    def follow_parts(self) -> None:
        """Take over the parts' present widgets; one that a part wants gets the focus."""
        self.widgets = list(self.build())
        asking = next((part.wants for part in self.parts if part.wants is not None), None)
        for part in self.parts:
            part.wants = None
        focus = asking or (self.focus if self.focus in self.widgets else None)
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
        super().leave()
        self.held.end()
        self._grabbed = None  # the covering screen gets its release

    def chime(self, name: str) -> None:
        """Editing is silent."""

    def back(self) -> None:
        """Escape is a command."""

    def widgets_changed(self) -> None:
        """Draw the parts with widgets again, not the whole window."""
        self._widgets_changed = True

    def await_text(self) -> None:
        """Switch text input on only while a text field has the focus.

        Else the letter of a key that opens a field would also be typed into that field.
        """
        if self.app.top is self:
            typing = isinstance(self.focus, TextEntry)
            (pygame.key.start_text_input if typing else pygame.key.stop_text_input)()

    def meaning(self, event: InputEvent) -> str:
        return self.table.meaning(event)

    def capture(self, event: InputEvent) -> bool:
        """Keys go to the focused widget, typed text to a field, until Escape."""
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
        """Handle a key that edits without a command; whether it did."""
        return False

    def _give_mouse(self, raw: pygame.Event) -> None:
        pos = pygame.mouse.get_pos() if raw.type == pygame.MOUSEWHEEL else raw.pos
        x, y = self.theme.canvas.logical(pos)
        if raw.type == pygame.MOUSEMOTION:
            self.hint("")
        part = self._grabbed or next((other for other in self.parts if other.contains(x, y)), None)
        if self._pointed is not part and self._pointed is not None:
            self._pointed.mouse_left()
        self._pointed = part
        if raw.type == pygame.MOUSEBUTTONDOWN:
            self._grabbed = part
        elif raw.type == pygame.MOUSEBUTTONUP:
            self._grabbed = None
        if raw.type == pygame.MOUSEBUTTONDOWN and self.focus is not None and not (part and self.focus in part.widgets):
            self.focus = None
            self.widgets_changed()
        if part is None or not part.mouse(raw, x, y):
            focus = self.focus
            self._handle_mouse(raw)
            # The document keeps the keys while the mouse is over a widget or clicks a button.
            if raw.type == pygame.MOUSEBUTTONDOWN:
                focus = self.focus if isinstance(self.focus, TextEntry) else None
            self.focus = focus

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
            redraws = whole or (self._widgets_changed and bool(part.widgets))
            changed += part.draw(surface, theme, self.focus, whole=redraws)
        self._widgets_changed = False
        return None if whole else changed


class Document(Protocol):
    """The level or run under edit in a workspace, with its file."""

    @property
    def name(self) -> str:
        """The document's name."""

    @property
    def is_saved(self) -> bool:
        """Whether its file holds the present document."""

    def end(self) -> None:
        """Finish a drawing or an edit that is going on."""

    def save(self, path: Path, *, replacing: bool = False) -> object:
        """Write it. Raises OccupiedError where that would replace another file, or one changed by others; OSError."""

    def close(self) -> None:
        """Leave it; unsaved changes are discarded."""


class DocumentCommands:
    """Saving and leaving. Subclasses give a document's path, and ask for a name."""

    def __init__(self, app: App, document: Document) -> None:
        self.app = app
        self.document = document

    def own_path(self) -> Path | None:
        """The path for saving without a question; None if the player must be asked."""
        raise NotImplementedError

    def save_as(self, then: Action = nothing) -> None:
        raise NotImplementedError

    def reload_rows(self, path: Path) -> list[MenuRow]:
        """More choices for a document whose file another program has changed."""
        return []

    def saved_text(self, path: Path) -> str:
        raise NotImplementedError

    def save(self, then: Action = nothing) -> None:
        """Write the document into its file, and call ``then``; ask for a name where it has none."""
        path = self.own_path()
        if path is None:
            self.save_as(then)
        else:
            self.save_to(path, then)

    def save_to(
        self, path: Path, then: Action = nothing, *, save: Callable[..., object] | None = None, replacing: bool = False
    ) -> None:
        """Write the document, and call ``then``; ask before a file is replaced. ``save``: instead of the document's."""
        try:
            (save or self.document.save)(path, replacing=replacing)
        except OccupiedError as error:
            text, replace_it = str(error), partial(self.save_to, path, then, save=save, replacing=True)
            rows: list[MenuRow] = [
                ("Save under another name", lambda: self.save_as(then), ""),
                *self.reload_rows(path),
                ("Replace it", replace_it, "What it holds now is lost"),
                CANCEL,
            ]
            self.app.push(Menu(self.app, text[0].upper() + text[1:], rows))
        except (NinjaGameError, OSError) as error:
            self.app.notify(f"Not saved: {reason(error)}")
        else:
            self.app.notify(self.saved_text(path), here=True)
            then()

    def unless_unsaved(self, action: Action) -> None:
        """Do something that closes the present document; ask first if it is not saved."""
        self.document.end()
        if self.document.is_saved:
            action()
            return
        rows: list[MenuRow] = [CANCEL, ("Save", lambda: self.save(action), ""), ("Discard changes", action, "")]
        self.app.push(Menu(self.app, f"{self.document.name} is not saved", rows))

    def leave(self) -> None:
        self.unless_unsaved(self.close)

    def close(self) -> None:
        self.document.close()
        self.app.pop()

    def ask_about_recovered(self, name: str, recover: Action, forget: Callable[[], bool], *, about: str) -> None:
        """Ask what to do with a document that was open when the program crashed. ``about``: its state."""
        keep: MenuRow = "Keep for later", nothing, "It is offered again"

        def discard() -> None:
            if not forget():
                self.app.notify("It stays: another window continues with it")

        def ask() -> None:
            self.app.push(Menu(self.app, f"Discard {name}?", [keep, ("Discard", discard, "It is lost")]))

        def try_to_recover() -> None:
            with self.app.errors_as_notices():
                recover()

        rows: list[MenuRow] = [("Recover", try_to_recover, about), keep, ("Discard...", ask, "")]
        self.app.push(Menu(self.app, f"Not saved last time: {name}", rows, unasked=True))

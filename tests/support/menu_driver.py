"""What the menus' tests share: the program under the dummy driver, keys pressed by script, time that is counted."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar
from unittest.mock import patch

import pygame

from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.play.app import build_app
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.level.level_play import DEATH_PAUSE, STUCK_AFTER
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import FormPanel
from ninja_game.play.panels.settings import SettingsScreen
from ninja_game.play.screen import BaseScreen
from ninja_game.player.player_data import PlayerData
from ninja_game.tas_editor.opening import open_tas_editor
from ninja_game.ui.audio.player import AudioOutput
from ninja_game.ui.input.bindings import Bindings
from ninja_game.ui.input.keys import SCANCODES
from ninja_game.ui.theme import Area
from ninja_game.ui.widgets import Widget
from tests.support.waiting import LONGEST

FRAME_MS = 25
S = TypeVar("S", bound=BaseScreen)


class ScriptedKeys(Bindings):
    """The usual bindings, but what is held in a tick comes from a list of inputs: 1 left, 2 right, 4 jump."""

    script: list[int]

    def poll(self) -> int:
        """The next tick's input; nothing where the script has ended."""
        return self.script.pop(0) if self.script else 0


class MenuDriver:
    """The program with its main menu. ``keys``: what plays."""

    def __init__(self, folder: Path, size: tuple[int, int] = (792, 600)) -> None:
        self.keys = ScriptedKeys()
        self.keys.script = []
        self.app = build_app(
            folder, size=size, controls=self.keys, audio_output=AudioOutput(), tas_editor=open_tas_editor
        )
        self.app.push(MainMenu(self.app))
        self.frames(2)

    @property
    def player(self) -> PlayerData:
        """The player's data."""
        return self.app.player

    def earn_gold(self) -> None:
        """A gold medal in every level, which opens the authors' runs."""
        for entry in self.player.catalogue.ours.levels:
            if entry.pars:
                self.player.marks.passed(entry.digest, entry.pars.par("gold"), 0)

    def top(self) -> BaseScreen:
        """The screen on top."""
        return self.app.top

    def shown(self, kind: type[S]) -> S:
        """The screen on top, which is of this kind."""
        top = self.app.top
        assert isinstance(top, kind), top
        return top

    def opened(self, entry: str, kind: type[S]) -> S:
        """Choose an entry of the main menu by its text; its screen, which is of this kind."""
        self.open(entry)
        return self.shown(kind)

    def frames(self, count: int = 1, ms: int = FRAME_MS) -> None:
        """Let pictures pass."""
        for _ in range(count):
            if self.app.running and self.app.stack:
                self.app.frame(ms)

    def press(self, *names: str) -> None:
        """Press and release keys, named by their places, perhaps with ``shift+``; a picture after each."""
        for name in names:
            mod, code = pygame.KMOD_SHIFT * ("shift+" in name), SCANCODES[name.removeprefix("shift+")]
            for kind in (pygame.KEYDOWN, pygame.KEYUP):
                pygame.event.post(pygame.Event(kind, key=0, scancode=code, mod=mod, unicode=""))
            self.frames(1)

    def type(self, text: str) -> None:
        """Type a text as the system gives it: a key and then its character."""
        for char in text:
            name = {" ": "space", ",": "comma"}.get(char, char.lower())
            pygame.event.post(pygame.Event(pygame.KEYDOWN, key=0, scancode=SCANCODES[name], mod=0, unicode=char))
            pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=char))
            pygame.event.post(pygame.Event(pygame.KEYUP, key=0, scancode=SCANCODES[name], mod=0, unicode=char))
            self.frames(1)

    def chord(self, key: str, *modifiers: int) -> None:
        """A key with modifiers."""
        for kind in (pygame.KEYDOWN, pygame.KEYUP):
            pygame.event.post(pygame.Event(kind, key=0, scancode=SCANCODES[key], mod=sum(modifiers), unicode=""))
        self.frames()

    def button(self, text: str) -> Widget:
        """The widget with a text on the screen on top."""
        widgets = self.top().widgets  # type: ignore[attr-defined]
        found: Widget = next(each for each in widgets if getattr(each, "text", "") == text)
        return found

    def choose(self, text: str) -> None:
        """Click the button with a text, once a menu that opened by itself listens."""
        while getattr(self.top(), "_deaf_ms", 0):
            self.frames()
        self.mouse(*self.button(text).centre)

    def choose_in_menu(self, text: str) -> None:
        """Open the menu of an editor, and click a button of it."""
        before = self.top()
        self.press("escape")
        if self.top() is before:
            self.press("escape")
        self.choose(text)

    def fill(self, text: str, button: str = "Save") -> None:
        """Put a text into the first field of the form on top, and click a button."""
        self.shown(FormPanel).texts[0] = text
        self.choose(button)

    def wait(self, condition: Callable[[], object], what: str = "", *, seconds: float = LONGEST) -> None:
        """Let pictures pass until something is so."""
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, what
            time.sleep(0.01)
            self.frames()

    def mouse(self, x: float, y: float, *, click: bool = True) -> None:
        """Move the mouse to a logical point, and click."""
        place = self.top().theme.canvas.point(x, y)
        pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=place, rel=(0, 0), buttons=(0, 0, 0), touch=False))
        if click:
            for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
                pygame.event.post(pygame.Event(kind, pos=place, button=1, touch=False))
        self.frames(1)

    def carry(self, start: Area, goal: Area, *, drop: bool = True) -> None:
        """Drag from the middle of one place to that of another, and let go there."""
        for kind, (x, y, w, h) in (
            (pygame.MOUSEMOTION, start), (pygame.MOUSEBUTTONDOWN, start), (pygame.MOUSEMOTION, goal),
        ):  # fmt: skip
            place = self.top().theme.canvas.point(x + w / 2, y + h / 2)
            more = {"button": 1} if kind == pygame.MOUSEBUTTONDOWN else {"rel": (0, 0), "buttons": (1, 0, 0)}
            pygame.event.post(pygame.Event(kind, pos=place, touch=False, **more))
            self.frames(1)
        if drop:
            self.mouse_up(goal)

    def mouse_up(self, place: Area = (0, 0, 0, 0)) -> None:
        """Let the button go over a place."""
        x, y, w, h = place
        pos = self.top().theme.canvas.point(x + w / 2, y + h / 2)
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=pos, button=1, touch=False))
        self.frames(1)

    def wheel(self, notches: int, x: float, y: float) -> None:
        """Turn the wheel over a logical point; as SDL has it, each notch is a press of a fourth or fifth button too."""
        place = self.top().theme.canvas.point(x, y)
        for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP) * abs(notches):
            pygame.event.post(pygame.Event(kind, pos=place, button=4 if notches > 0 else 5, touch=False))
        pygame.event.post(pygame.Event(pygame.MOUSEWHEEL, x=0, y=notches, flipped=False))
        with patch.object(pygame.mouse, "get_pos", lambda: place):
            self.frames(1)

    def drop_file(self, path: Path) -> None:
        """Drop a file on the window."""
        pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
        self.frames(2)

    def pad(self, button: int) -> None:
        """Press and release a button of a standard gamepad."""
        for kind in (pygame.CONTROLLERBUTTONDOWN, pygame.CONTROLLERBUTTONUP):
            pygame.event.post(pygame.Event(kind, instance_id=77, button=button))
        self.frames(1)

    def open(self, entry: str) -> BaseScreen:
        """Choose an entry of the main menu by its text."""
        menu = self.shown(MainMenu)
        menu.focus = next(widget for widget in menu.widgets if getattr(widget, "text", "") == entry)
        self.press("return")
        return self.top()

    def open_level(self) -> LevelScreen:
        """Press what has the focus; the level that it opens."""
        self.press("return")
        return self.shown(LevelScreen)

    def stuck_level(self) -> LevelScreen:
        """The first level, after this many deaths that help is offered."""
        level = self.open_level()
        for number in range(STUCK_AFTER):
            if number:
                level.retry()
            level.begin()
            self.keys.script = [0] * 30
            self.frames(30)
            assert not level.play.is_stuck
            level.give_up()
        self.frames(DEATH_PAUSE + 3)
        return level

    def settings_page(self, page: str) -> SettingsScreen:
        """Choose a page of the settings, which are open, with the mouse."""
        screen = self.shown(SettingsScreen)
        x, y, w, h = screen.tabs.row_area(screen.titles.index(page))
        self.mouse(x + w / 2, y + h / 2)
        return screen

    def play_replay(self, number: int) -> None:
        """Feed the certificate of a bundled level (from 1) to the level on top; it runs to its end and a little on."""
        recording = load_replays(bundled_replays()[number - 1])[0]
        self.keys.script = [keys & 7 for keys in recording.inputs]
        for _ in recording.inputs:
            self.app.advance(FRAME_MS)  # without its picture, which nobody looks at
        self.frames(10)

    def leave_editor(self) -> None:
        """Close the level editor on top, which asks nothing."""
        self.shown(EditorScreen).session.close()
        self.app.pop()

    def close(self) -> None:
        """Leave everything."""
        self.app.stack.clear()
        self.player.close()
        pygame.event.clear()

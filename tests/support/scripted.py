"""A player made of a script: controls whose keys go down and up at given pictures, and an app without a display."""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pygame

from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.recording import Recording
from ninja_game.levels.episodes import Entry
from ninja_game.play.app import App, build_app
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.screen import LevelScreen
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.sim.level import Level
from ninja_game.ui.audio.player import AudioOutput
from ninja_game.ui.input.bindings import MENU_KEYS, Bindings, InputEvent

PRESS = pygame.USEREVENT + 1
RELEASE = pygame.USEREVENT + 2


class ScriptedControls(Bindings):
    """``held_bits`` is what is down; actions come as events posted by ``press`` and ``release``."""

    def __init__(self) -> None:
        super().__init__()
        self.held_bits = 0
        self.script: Iterator[int] | None = None

    def poll(self) -> int:
        if self.script is not None:
            return next(self.script, 0)
        return self.held_bits

    def decode(self, event: pygame.Event) -> InputEvent:
        if event.type == PRESS:
            menu = next((action for action in event.actions if action in MENU_KEYS.values()), "")
            return InputEvent(event, pressed=event.actions, menu=menu)
        if event.type == RELEASE:
            return InputEvent(event, released=event.actions)
        return super().decode(event)

    def name(self, action: str) -> str:
        return action.capitalize()


def level_run(app: App, level: Level, title: str = "level", **options: Any) -> LevelPlaythrough:
    """A level by itself, played by the app's player."""
    return LevelPlaythrough(app.player, Entry(NamedLevel(title, "", "", level, ""), "yours"), **options)


def press(*actions: str) -> None:
    pygame.event.post(pygame.Event(PRESS, actions=actions))


def release(*actions: str) -> None:
    pygame.event.post(pygame.Event(RELEASE, actions=actions))


def frames(app: App, count: int = 1, ms: int = 25) -> None:
    """Some pictures, each this many ms after the one before."""
    for _ in range(count):
        app.frame(ms)


def tap(app: App, *actions: str, pictures: int = 1) -> None:
    """Press, and let pictures pass."""
    press(*actions)
    frames(app, pictures)


def open_level(app: App, recording: Recording, **options: Any) -> LevelScreen:
    screen = LevelScreen(app, level_run(app, recording.level, **options))
    app.push(screen)
    frames(app)
    return screen


def phase_of(screen: LevelScreen) -> Phase:
    """The phase, for a type checker that thinks it cannot change."""
    return screen.phase


def play_to_the_end(app: App, controls: ScriptedControls, screen: LevelScreen, recording: Recording) -> None:
    controls.script = iter(recording.inputs)
    press("confirm")
    while screen.phase in {Phase.READY, Phase.PLAY}:
        frames(app)
        assert screen.attempt.simulation.tick < 4000
    controls.script = None


@contextmanager
def scripted_app(size: tuple[int, int] = (792, 600), **settings: object) -> Iterator[tuple[App, ScriptedControls]]:
    """An app without a display or sound, with a player who has chosen these settings and has played nothing."""
    with tempfile.TemporaryDirectory() as folder:
        controls = ScriptedControls()
        app = build_app(Path(folder), size=size, controls=controls, audio_output=AudioOutput())
        if settings:
            app.change_settings(**settings)
        pygame.event.clear()
        try:
            yield app, controls
        finally:
            app.stack.clear()
            app.player.close()
            pygame.display.quit()

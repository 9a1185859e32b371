"""A player made of a script: controls whose keys go down and up at given pictures, and an app without a display."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pygame

from ninja_game.play.app import App, build_app
from ninja_game.play.audio.output import NullAudio
from ninja_game.play.input.actions import MENU_KEYS
from ninja_game.play.input.bindings import Bindings
from ninja_game.play.input.events import InputEvent

PRESS = pygame.USEREVENT + 1
RELEASE = pygame.USEREVENT + 2


class ScriptedControls(Bindings):
    """``held_bits`` is what is down; actions come as events posted by ``press`` and ``release``."""

    def __init__(self) -> None:
        super().__init__()
        self.held_bits = 0
        self.script: Iterator[int] | None = None

    def held(self) -> int:
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


def press(*actions: str) -> None:
    pygame.event.post(pygame.Event(PRESS, actions=actions))


def release(*actions: str) -> None:
    pygame.event.post(pygame.Event(RELEASE, actions=actions))


def frames(app: App, count: int = 1, ms: int = 25) -> None:
    """Some pictures, each so many ms after the one before."""
    for _ in range(count):
        app.frame(ms)


@contextmanager
def scripted_app(size: tuple[int, int] = (792, 600), **settings: object) -> Iterator[tuple[App, ScriptedControls]]:
    """An app without a display or sound, with a player who has chosen these settings and has played nothing."""
    with tempfile.TemporaryDirectory() as folder:
        controls = ScriptedControls()
        app = build_app(Path(folder), size=size, controls=controls, audio_output=NullAudio())
        if settings:
            app.change_settings(**settings)
        pygame.event.clear()
        try:
            yield app, controls
        finally:
            app.stack.clear()
            app.player.close()
            pygame.display.quit()

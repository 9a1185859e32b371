"""A player made of a script: controls whose keys go down and up at given pictures, and an app without a display."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pygame

from ninja_game.play.app import App
from ninja_game.play.menus.boss import BossScreen
from ninja_game.play.options import Options

PRESS = pygame.USEREVENT + 1
RELEASE = pygame.USEREVENT + 2


class ScriptedControls:
    """``held_bits`` is what is down; actions come as events posted by ``press`` and ``release``."""

    def __init__(self) -> None:
        self.held_bits = 0
        self.script: Iterator[int] | None = None

    def held(self) -> int:
        if self.script is not None:
            return next(self.script, 0)
        return self.held_bits

    def actions(self, event: pygame.Event) -> tuple[str, ...]:
        return event.actions if event.type == PRESS else ()

    def releases(self, event: pygame.Event) -> tuple[str, ...]:
        return event.actions if event.type == RELEASE else ()

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
def scripted_app(
    size: tuple[int, int] = (792, 600), options: Options | None = None
) -> Iterator[tuple[App, ScriptedControls]]:
    """An app without a display, sound or player."""
    controls = ScriptedControls()
    app = App(options or Options(), controls, size=size)
    app.hiding = BossScreen
    pygame.event.clear()
    try:
        yield app, controls
    finally:
        app.stack.clear()
        pygame.display.quit()

"""Somebody at the TAS editor, with mouse and keys."""

from collections.abc import Sequence
from pathlib import Path
from typing import Self

import pygame

from ninja_game.formats.recording import Recording
from ninja_game.play.app import build_app
from ninja_game.simulation import Simulation
from ninja_game.tas.files import open_run
from ninja_game.tas_editor.screen import TasScreen
from ninja_game.ui.audio.player import AudioOutput
from tests.support.menu_driver import MenuDriver, ScriptedKeys


class TasDriver(MenuDriver):
    """A run on the TAS editor, alone in its window."""

    def __init__(self, folder: Path, run: Path, size: tuple[int, int] = (792, 600), record: int | None = None) -> None:
        self.keys = ScriptedKeys()
        self.keys.script = []
        self.app = build_app(folder, size=size, controls=self.keys, audio_output=AudioOutput())
        self.screen = TasScreen(self.app, open_run(run, record=record))
        self.editor = self.screen.editor
        self.session = self.screen.session
        self.app.push(self.screen)
        self.frames(2)

    @classmethod
    def over(cls, driver: MenuDriver, run: Path, beside: Sequence[Recording] = ()) -> Self:
        """The same over the screens of a program that runs already."""
        made = cls.__new__(cls)
        made.keys, made.app = driver.keys, driver.app
        made.app.push(TasScreen(made.app, open_run(run), beside))
        made.adopt()
        made.frames(2)
        return made

    def adopt(self) -> None:
        """Go on at the TAS editor on top: it has taken the first one's place."""
        assert isinstance(self.app.top, TasScreen)
        self.screen = self.app.top
        self.editor, self.session = self.screen.editor, self.screen.session

    def event(self, kind: int, x: float = 0, y: float = 0, **more: object) -> None:
        """A mouse event at a logical point, and a picture."""
        px = self.top().theme.canvas.point(x, y)
        shared = {"pos": px, "rel": (0, 0), "buttons": (0, 0, 0), "touch": False}
        pygame.event.post(pygame.Event(kind, shared | more))
        self.frames()

    def drag(self, *places: tuple[float, float], button: int = 1) -> None:
        """Press a mouse button at the first place, go to all others, release it."""
        self.event(pygame.MOUSEMOTION, *places[0])
        self.event(pygame.MOUSEBUTTONDOWN, *places[0], button=button)
        for place in places[1:]:
            self.event(pygame.MOUSEMOTION, *place, buttons=(button == 1, button == 2, button == 3))
        self.event(pygame.MOUSEBUTTONUP, *places[-1], button=button)

    def keys_down(self, first: int, last: int) -> list[int]:
        """The keys of the ticks ``first`` … ``last`` - 1."""
        return [self.editor.track.keys_at(tick) for tick in range(first, last)]

    def cell(self, tick: int, column: str) -> tuple[float, float]:
        """The middle of a cell of the roll, which may be beyond its edges; a logical point."""
        roll = self.screen.roll
        layout = roll.layout
        place = next(each for each in layout.places if each.column.name == column)
        y = layout.body.top + (tick - roll.top) * layout.row + layout.row // 2
        return self.top().theme.canvas.logical((place.left + place.width // 2, y))

    def write(self, text: str) -> None:
        """Type any text, as the system gives it behind the keys."""
        pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=text))
        self.frames()

    def shown_digest(self) -> str:
        """Of the world that the level shows."""
        return self.screen.level.picture.run.digest()

    def straight_digest(self, tick: int) -> str:
        """Of the world after a tick of the run, run from its start."""
        origin, inputs = self.session.origin, self.editor.track.inputs
        run = Simulation(origin.level, body=origin.body)
        for each in range(tick + 1):
            run.step_keys(inputs[each] if each < len(inputs) else 0)
        return run.digest()

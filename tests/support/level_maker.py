"""Somebody who makes a level in the editor, with mouse, keys and pad."""

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.editor.examination import LevelQuestion
from ninja_game.editor.files import new_source
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.editor.view import LAYOUT
from ninja_game.play.screen import BaseScreen
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import Level, ObjectSpec
from tests.support.menu_driver import MenuDriver

ROOM = with_stamp(
    Draft(Level(), "Room", "me"),
    Stamp(
        dict.fromkeys([(column, 23) for column in range(1, 32)], 1),
        (ObjectSpec(NINJA, (60.0, 542.0)), ObjectSpec(EXIT, (180.0, 540.0, 120.0, 540.0))),
    ),
)
"""A floor, a ninja, a switch and an exit on the way to the right."""


def examine(editor: EditorScreen) -> None:
    """Have the level's problems found now."""
    job = editor.session.edited.examination.job
    job.ask(LevelQuestion(editor.session.draft.level, (), editor.session.draft.says, b""))
    job.finish()


class Maker(MenuDriver):
    """Somebody who makes a level."""

    def open(self, entry: str) -> BaseScreen:
        """In the editor with nothing drawn, instead of the room with which it begins."""
        screen = super().open(entry)
        if isinstance(screen, EditorScreen) and not screen.session.edited.source.path:
            screen.session.begin(new_source(self.app.settings.name))
            screen.follow_parts()
        return self.top()

    @property
    def editor(self) -> EditorScreen:
        screen = next(each for each in self.app.stack._screens if isinstance(each, EditorScreen))
        assert screen is not None
        return screen

    @property
    def draft(self) -> Draft:
        return self.editor.session.draft

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Where a point of the level is seen."""
        left, top, width, _ = LAYOUT.level
        return left + x * width / 792, top + y * width / 792

    def drag(self, *places: tuple[float, float], button: int = 1) -> None:
        for number, place in enumerate(places):
            px = self.app.canvas.point(*self.at(*place))
            pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=px, rel=(0, 0), buttons=(0, 0, 0), touch=False))
            if number == 0:
                pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=px, button=button, touch=False))
            self.frames()
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=px, button=button, touch=False))
        self.frames()

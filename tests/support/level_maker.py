"""Somebody who makes a level in the editor, with mouse, keys and pad."""

from dataclasses import replace

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.editor.examination import LevelQuestion
from ninja_game.editor.files import new_source
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.play.editor.part import ToolButton
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.editor.view import LAYOUT
from ninja_game.play.screen import BaseScreen
from ninja_game.sim.grid import middle_of
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
        screen = next(each for each in self.app.stack.screens if isinstance(each, EditorScreen))
        assert screen is not None
        return screen

    @property
    def draft(self) -> Draft:
        return self.editor.session.draft

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Where a point of the level is seen."""
        left, top, width, _ = LAYOUT.level
        return left + x * width / 792, top + y * width / 792

    def at_cell(self, column: int, row: int) -> tuple[float, float]:
        """Where the middle of a cell is seen."""
        return self.at(*middle_of((column, row)))

    def put(self, draft: Draft) -> None:
        """Have this level in the editor."""
        self.editor.session.tools.history.change(draft)
        self.frames()

    def put_says(self, says: str) -> None:
        """Have the level say this to its player."""
        self.put(replace(self.draft, says=says))

    def put_more(self, *objects: ObjectSpec) -> None:
        """Have these objects in the level, too."""
        self.put(with_stamp(self.draft, Stamp({}, objects)))

    def point(self, x: float, y: float) -> None:
        """Move the mouse to a point of the level, without a click."""
        self.mouse(*self.at(x, y), click=False)

    def take(self, name: str, *, click: bool = True) -> None:
        """Click what has this name in the palette, or point at it."""
        x, y, w, h = next(at for what, at in self.editor.palette.places() if getattr(what, "name", "") == name)
        self.mouse(x + w / 2, y + h / 2, click=click)

    def tool_button(self, name: str) -> ToolButton:
        """The button of a command above the level."""
        return next(each for each in self.editor.widgets if isinstance(each, ToolButton) and each.name == name)

    def await_problems(self) -> None:
        """Let pictures pass until the problems of the level as it is are known."""
        self.wait(lambda: self.editor.session.edited.examination.level is self.draft.level, "problems")

    def drag(self, *places: tuple[float, float], button: int = 1) -> None:
        for number, place in enumerate(places):
            px = self.app.canvas.point(*self.at(*place))
            pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=px, rel=(0, 0), buttons=(0, 0, 0), touch=False))
            if number == 0:
                pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=px, button=button, touch=False))
            self.frames()
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=px, button=button, touch=False))
        self.frames()

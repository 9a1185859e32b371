"""A list of problems, each with its whole text, how to mend it, and a way to its place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import pygame

from ninja_game.files.shown_text import counted, shown_text
from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Widget

ROW = 33
LONGEST = 900
"""Characters of a problem that are shown, more than any message of the program has."""


class Problem(NamedTuple):
    """``text``: where and what; ``hint``: how to mend it. ``go``: leads to its place, ``accept``: lets it be.

    ``accepted``: it is accepted already, and ``accept`` takes that back.
    """

    text: str
    hint: str = ""
    go: Callable[[], object] | None = None
    accept: Callable[[], object] | None = None
    accepted: bool = False


class ProblemsScreen(MenuScreen):
    """``find``: the problems as they are now, asked whenever the screen is entered."""

    title = "Problems"

    def __init__(self, app: App, find: Callable[[], Sequence[Problem]]) -> None:
        super().__init__(app)
        self._find = find
        self.problems: Sequence[Problem] = ()
        self.list = ListView(
            (44, 66, 704, 10 * ROW), ROW, self._draw_row, lambda _: self._go(), empty="There are no problems",
            selected=lambda _: self._offer(), opens=True,
        )  # fmt: skip
        self.go = Button((464, 530, 136, 28), "Go there", self._go)
        self.accept = Button((612, 530, 136, 28), "Accept it...", self._accept)

    def build(self) -> Sequence[Widget]:
        self.problems = self._find()
        self.list.fill(self.problems)
        self._offer()
        return [self.list, self.go, self.accept]

    @property
    def selected(self) -> Problem:
        return self.problems[self.list.index] if self.problems else Problem("")

    def _offer(self) -> None:
        self.go.enabled, self.accept.enabled = bool(self.selected.go), bool(self.selected.accept)
        self.accept.text = "Take it back" if self.selected.accepted else "Accept it..."
        self.accept.hint = "It is a problem again" if self.selected.accepted else "With a reason, kept in the pack"
        self.list.hint = "Enter or a second click leads there" if self.selected.go else ""

    def _go(self) -> None:
        if self.selected.go:
            self.selected.go()

    def _accept(self) -> None:
        if self.selected.accept:
            self.selected.accept()

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, problem = self.theme, self.selected
        theme.panel(surface, 44, 418, 704, 104)
        texts = [f"{shown_text(problem.text, LONGEST)}.", problem.hint] if problem.text else []
        theme.paragraph(surface, texts, (54, 426, 684, 90), 11, 14)
        accepted = sum(each.accepted for each in self.problems)
        count = counted(len(self.problems) - accepted, "problem") + f", {accepted} accepted" * bool(accepted)
        theme.text(surface, count, 44, 538, size=10, colour=theme.palette.faint)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x, y + 1, w, h - 2), chosen=index == self.list.index, focused=focused)
        problem, place = self.problems[index], (x + 10, y + 4, w - 20, h - 6)
        colour = theme.palette.faint if problem.accepted else theme.palette.text
        theme.paragraph(surface, [shown_text(problem.text, LONGEST)], place, 10, 13, colour=colour)


def of_files(texts: Sequence[str]) -> list[Problem]:
    return [Problem(text, "Mend the file as the message says, or take it out of the folder.") for text in texts]


def problems_button(app: App, area: Area, find: Callable[[], Sequence[Problem]]) -> list[Widget]:
    """A button that shows the problems; none where there are none."""
    count = len(find())
    text = f"{counted(count, 'problem')}: show {'it' if count == 1 else 'them'}"
    return [Button(area, text, lambda: app.push(ProblemsScreen(app, find)), size=10)] if count else []

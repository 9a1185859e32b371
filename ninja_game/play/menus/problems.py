"""A list of problems, each with its whole text, how to fix it, and a button to its place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import pygame

from ninja_game.files.shown_text import counted, shown_text
from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme, wrapped
from ninja_game.ui.widgets import Button, Widget

ROW = 33
SEARCH = "Search for 5 minutes"
MAX_TEXT = 900
"""Most characters of a problem that are shown; no message of the program has more."""


class Problem(NamedTuple):
    """``text``: where and what; ``hint``: how to fix it. ``go``: leads to its place, ``accept``: accepts it as it is.

    ``accepted``: it is accepted already, and ``accept`` takes that back. ``search``: gives the solver more time.
    ``to_do``: no problem, but work that nobody has begun.
    """

    text: str
    hint: str = ""
    go: Callable[[], object] | None = None
    accept: Callable[[], object] | None = None
    accepted: bool = False
    search: Callable[[], object] | None = None
    to_do: bool = False


class ProblemsScreen(MenuScreen):
    """``find``: gives the present problems, called whenever the screen is entered."""

    title = "Problems"

    def __init__(self, app: App, find: Callable[[], Sequence[Problem]]) -> None:
        super().__init__(app)
        self._find = find
        self.problems: Sequence[Problem] = ()
        self.list = ListView(
            (44, 66, 704, 10 * ROW),
            ROW,
            self._draw_row,
            lambda _: self._go(),
            empty="There are no problems",
            selected=lambda _: self._offer(),
            opens=True,
        )
        self.search = Button((316, 530, 136, 28), SEARCH, self._search, size=10)
        self.search.hint = "For the run that is missing: the solver had less time before"
        self.go = Button((464, 530, 136, 28), "Go there", self._go)
        self.accept = Button((612, 530, 136, 28), "Accept it...", self._accept)

    def build(self) -> Sequence[Widget]:
        self.problems = self._find()
        self.list.fill(self.problems)
        self._offer()
        searches = [self.search] * any(problem.search for problem in self.problems)
        return [self.list, *searches, self.go, self.accept]

    @property
    def selected(self) -> Problem:
        return self.problems[self.list.index] if self.problems else Problem("")

    def _offer(self) -> None:
        self.go.enabled, self.accept.enabled = bool(self.selected.go), bool(self.selected.accept)
        self.search.enabled = bool(self.selected.search)
        self.accept.text = "Take it back" if self.selected.accepted else "Accept it..."
        self.accept.hint = "It is a problem again" if self.selected.accepted else "With a reason, kept in the pack"
        self.list.hint = "Enter or a second click leads there" if self.selected.go else ""

    def _go(self) -> None:
        if self.selected.go:
            self.selected.go()

    def _search(self) -> None:
        if self.selected.search:
            self.app.pop()
            self.selected.search()

    def _accept(self) -> None:
        if self.selected.accept:
            self.focus = self.list
            self.selected.accept()

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, problem = self.theme, self.selected
        theme.panel(surface, 44, 418, 704, 104)
        texts = [f"{shown_text(problem.text, MAX_TEXT)}.", problem.hint] if problem.text else []
        theme.paragraph(surface, texts, (54, 426, 684, 90), 11, 14)
        accepted, to_do = (sum(getattr(other, kind) for other in self.problems) for kind in ("accepted", "to_do"))
        count = counted(len(self.problems) - accepted - to_do, "problem") + f", {accepted} accepted" * bool(accepted)
        theme.text(surface, count, 44, 538, size=10, colour=theme.palette.faint)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x, y + 1, w, h - 2), chosen=index == self.list.index, focused=focused)
        problem = self.problems[index]
        text, palette = shown_text(problem.text, MAX_TEXT), theme.palette
        top = y + (h - 13 * min(2, len(wrapped(theme, text, w - 20, 10)))) / 2
        colour = palette.faint if problem.accepted or problem.to_do else palette.text
        theme.paragraph(surface, [text], (x + 10, top, w - 20, y + h - top), 10, 13, colour=colour)


def of_files(texts: Sequence[str]) -> list[Problem]:
    return [Problem(text, "Mend the file as the message says, or take it out of the folder.") for text in texts]


def problems_button(app: App, area: Area, find: Callable[[], Sequence[Problem]]) -> list[Widget]:
    """A button that shows the problems; none where there are none."""
    count = len(find())
    text = f"{counted(count, 'problem')}: show {'it' if count == 1 else 'them'}"
    return [Button(area, text, lambda: app.push(ProblemsScreen(app, find)), size=10)] if count else []

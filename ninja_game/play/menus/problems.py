"""A list of problems, each with its whole text, how to fix it, and a button to its place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import pygame

from ninja_game.files.shown_text import counted, shown_text
from ninja_game.play.app import App
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme, wrapped
from ninja_game.ui.widgets import Button, Widget

_ROW = 38
_SEARCH = "Search for 5 minutes"
_MAX_TEXT = 900  # most characters of a problem that are shown; no message of the program has more


class Problem(NamedTuple):
    """A row of the screen of problems."""

    text: str  #: place and problem
    hint: str = ""  #: how to fix it
    go: Callable[[], object] | None = None  #: leads to its place
    accept: Callable[[], object] | None = None  #: accepts it as it is, or takes that back
    accepted: bool = False  #: whether it is accepted already
    search: Callable[[], object] | None = None  #: gives the solver more time
    step: str = ""  #: the next step, where nothing is wrong: the text of the button of ``go``


class ProblemsScreen(MenuScreen):
    """A list of problems. ``find``: gives those of now whenever the screen is entered, None while they are looked for.

    ``news``: whether they have been found since; asked before each picture.
    """

    title = "Problems"

    def __init__(
        self, app: App, find: Callable[[], Sequence[Problem] | None], news: Callable[[], bool] = lambda: False
    ) -> None:
        super().__init__(app)
        self._find, self._news, self._waited_ms = find, news, 0
        self.problems: Sequence[Problem] = ()
        self.list = ListView((44, 66, 704, 9 * _ROW), _ROW, self._draw_row, lambda _: self._go(), opens=True)
        self.list.selected = lambda _: self._offer()
        self.buttons = {
            "search": Button((316, 530, 136, 28), _SEARCH, self._search, size=10),
            "go": Button((464, 530, 136, 28), "Go there", self._go),
            "accept": Button((612, 530, 136, 28), "Accept it...", self._accept),
        }
        self.buttons["search"].hint = "For the run that is missing: the solver had less time before"

    def build(self) -> Sequence[Widget]:
        problems = self._find()
        self._waited_ms = int(problems is None)
        self.list.empty = "Looking for problems" if problems is None else "There are no problems"
        if not self.problems:
            self.list.index = next((k for k, problem in enumerate(problems or ()) if not problem.accepted), 0)
        self.problems = self.problems if problems is None else problems
        self.list.fill(self.problems)
        self._offer()
        offered = {name for name in self.buttons for problem in self.problems if getattr(problem, name)}
        return [self.list, *(button for name, button in self.buttons.items() if name in offered)]

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        if self._waited_ms:
            before, self._waited_ms = self._waited_ms, self._waited_ms + real_ms
            self.redraw |= self._waited_ms // 1000 > before // 1000
        if self._news():
            self.enter()
            self.redraw = True

    @property
    def selected(self) -> Problem:
        return self.problems[self.list.index] if self.problems else Problem("")

    def _offer(self) -> None:
        for name, button in self.buttons.items():
            button.enabled = bool(getattr(self.selected, name)) and not self._waited_ms
        step = self.selected.step
        self.buttons["go"].text = step or "Go there"
        accept = self.buttons["accept"]
        accept.text = "Take it back" if self.selected.accepted else "Accept it..."
        accept.hint = "It is a problem again" if self.selected.accepted else "With a reason, kept in the pack"
        self.list.hint = f"Enter or a second click: {step or 'go there'}" if self.selected.go else ""

    def _go(self) -> None:
        if self.selected.go and self.buttons["go"].enabled:
            if self.selected.step:
                self.app.pop()
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
        texts = [f"{shown_text(problem.text, _MAX_TEXT)}.", problem.hint] if problem.text else []
        theme.paragraph(surface, texts, (54, 426, 684, 90), 11, 14)
        accepted = sum(bool(problem.accepted) for problem in self.problems)
        steps = sum(bool(problem.step) for problem in self.problems)
        count = counted(len(self.problems) - accepted - steps, "problem")
        count += f", {accepted} accepted" if accepted else ""
        text = f"Looking for problems: {self._waited_ms // 1000} s" if self._waited_ms else count
        theme.text(surface, text, 44, 538, size=10, colour=theme.palette.faint)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x, y + 1, w, h - 2), chosen=index == self.list.index, focused=focused)
        problem = self.problems[index]
        text, palette = shown_text(problem.text, _MAX_TEXT), theme.palette
        top = y + (h - 13 * min(2, len(wrapped(theme, text, w - 20, 10)))) / 2
        colour = palette.faint if problem.accepted or problem.step else palette.text
        theme.paragraph(surface, [text], (x + 10, top, w - 20, y + h - top), 10, 13, colour=colour)


def file_problems(texts: Sequence[str]) -> list[Problem]:
    return [Problem(text, "Mend the file as the message says, or take it out of the folder.") for text in texts]


def problems_button(app: App, area: Area, find: Callable[[], Sequence[Problem]]) -> list[Widget]:
    """A button that shows the problems; none where there are none."""
    count = len(find())
    text = f"{counted(count, 'problem')}: show {'it' if count == 1 else 'them'}"
    return [Button(area, text, lambda: app.push(ProblemsScreen(app, find)), size=10)] if count else []

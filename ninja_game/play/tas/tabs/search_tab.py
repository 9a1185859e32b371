"""Searches in the selected ticks for keys that reach a goal, or bring more of something."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import pygame

from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.play.menus.panels import Menu
from ninja_game.play.tas.editor import Span, TasEditor
from ninja_game.play.tas.tabs.span_results import SpanResults
from ninja_game.play.tas.tabs.tab import SMALL, UNPLACED, EntryField, Rows, Tab, what_is_wrong
from ninja_game.play.ui.theme import Area, Theme, wrapped
from ninja_game.play.ui.widgets import Button, Choice
from ninja_game.play.workspace.part import Commands
from ninja_game.search.formula.language import FormulaError
from ninja_game.search.formula.methods import fewest_ticks
from ninja_game.search.formula.task import Found, SpanTask
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.tas.goals import PRESETS, SearchedSpan, Wanted

LONGEST = 300
"""Characters of a formula that one can type."""

EARLIEST, GREATEST, SMALLEST = "earliest", "greatest", "smallest"
_METHODS = (
    ("both methods", "auto"),
    ("beam", "beam"),
    ("small changes", "local"),
    ("all keys there are", "exhaustive"),
)
_ORDERS = (("the earliest", EARLIEST), ("the greatest", GREATEST), ("the smallest", SMALLEST))
_RESTS = (("end at the goal", False), ("then the rest", True))
_NAMES = "x y vx vy speed tick gold state dead won in_air distance(x, y) taken(id) opened(id) and or not < > abs(a)"
_LEFT, _COLUMNS, _WIDTHS = 14, (232, 182, 122), (46, 58, 30)
"""Of the cells of a result, px: the first from the left of a row, the others from its right; widths of the others."""
_HEADS = ("Result", "Other from", "Ends at x, y", "Speed")
_EXPLAINED = (
    "Say what for: a goal that is true after one of these ticks, as early as possible, or a value that is to be "
    "the greatest or smallest then. Other keys for these ticks are searched; a click puts a result into the run."
)


class SearchTab(Tab):
    """Span, goal, measure and method; below them the results."""

    name = "Search"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.span: Span = (0, 0)
        self.order: object = EARLIEST
        self.rest: object = False
        self.method: object = "auto"
        self.results: SpanResults | None = None
        self._preset: tuple[Callable[[SearchedSpan], Wanted], Wanted] | None = None
        self.found: tuple[Found, ...] = ()
        self.goal = EntryField(
            "x > 400, taken(12), distance(300, 200) < 6 ...", self.start, longest=LONGEST, hint=_NAMES
        )
        self.measure = EntryField("speed; vx, y, gold ...", self.start, longest=LONGEST, hint=_NAMES)
        self._button = Button(UNPLACED, "Start", self._start_or_stop, size=SMALL)
        self.list = Rows(self._draw_row, self._put, keeps=False,
                         hint="Under the mouse: its path in the level; a click puts it into the run")  # fmt: skip
        self.widgets = [
            Button(UNPLACED, "Use the selection", self.use_selection, size=SMALL),
            Button(UNPLACED, "Presets", self.propose, size=SMALL, hint="Common goals, to begin with"),
            self.goal,
            Choice(UNPLACED, "", _ORDERS, lambda: self.order, self._put_order,
                   hint="Best is what reaches the goal first, or has the most or least of the value beside this"),
            self.measure,
            Choice(UNPLACED, "", _RESTS, lambda: self.rest, self._put_rest,
                   hint="What follows the goal in the run is played, too, and must still reach the exit"),
            Choice(UNPLACED, "", _METHODS, lambda: self.method, partial(setattr, self, "method"),
                   hint="Beam: many states at once; small changes: of the keys there; all keys: short spans only"),
            self._button,
            self.list,
        ]  # fmt: skip

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        """What is wanted, in three rows, above the results."""
        areas = (
            (x + w - 182, y + 4, 96, 18), (x + w - 82, y + 4, 78, 18), (x + 40, y + 25, w - 44, 18),
            (x + 4, y + 46, 118, 18), (x + 126, y + 46, w - 280, 18), (x + w - 150, y + 46, 146, 18),
            (x + 4, y + 67, 150, 18), (x + 158, y + 67, 58, 18), (x + 4, y + 99, w - 8, h - 101),
        )  # fmt: skip
        for widget, area in zip(self.widgets, areas, strict=True):
            widget.area = area

    def commands(self) -> Commands:
        """Searching."""
        return {"search": self.ask}

    # --- what is wanted ---

    def ask(self) -> None:
        """Show this tab for the selected ticks, with the focus on the goal."""
        self.use_selection()
        self.editor.show_tab(self.name)
        self.wants = self.goal

    def use_selection(self) -> None:
        """Search the selected ticks; where only one is, a second from there on. A goal from the menu is made again."""
        first, last = self.editor.selection
        second = min(first + TICKS_PER_SECOND, max(len(self.editor.track), last))
        before, self.span = self.span, (first, last if last > first + 1 else second)
        if self.span == before:
            return
        if self.results is not None and not self.results.running:
            self.close()
        if self._preset is not None and (self.goal.text, self.measure.text) == self._preset[1][:2]:
            self._fill(self._preset[0])

    def propose(self) -> None:
        """A menu of what people want; it fills the fields."""
        rows = [(name, partial(self._fill, make), hint) for name, hint, make in PRESETS]
        self.editor.app.push(Menu(self.editor.app, "Presets", rows))

    def _fill(self, make: Callable[[SearchedSpan], Wanted]) -> None:
        try:
            wanted = make(SearchedSpan(self.editor.session, *self.span))
        except NinjaGameError as error:
            self.editor.app.notify(str(error))
            return
        self._preset = make, wanted
        self.goal.show(wanted.goal)
        self.measure.show(wanted.measure)
        self.order = EARLIEST if not wanted.measure else SMALLEST if wanted.least else GREATEST
        self.rest = wanted.rest
        self.wants = self.goal

    def _put_order(self, order: object) -> None:
        self.order = order
        self.rest = bool(self.rest) and order == EARLIEST

    def _put_rest(self, rest: object) -> None:
        self.rest = rest
        self.order = EARLIEST if rest else self.order

    @property
    def task(self) -> SpanTask:
        """What is wanted as a task. Raises FormulaError, ArgumentError."""
        session, (first, last) = self.editor.session, self.span
        measure = "" if self.order == EARLIEST else self.measure.text.strip() or "speed"
        return SpanTask(
            session.about.level, session.track.inputs, first, last, self.goal.text.strip(), measure,
            least=self.order == SMALLEST, rest=bool(self.rest), body=session.about.body,
        )  # fmt: skip

    # --- the search ---

    def start(self) -> None:
        """Search; a search that is going on ends. What is wrong is reported."""
        self.close()
        self.list.over = -1
        try:
            task = self.task
            if not (task.goal or task.measure or task.rest):
                raise ArgumentError("Say what for: a goal, or a value that is to be the greatest or smallest")
            every = fewest_ticks(task.length) if self.method == "exhaustive" else 1
            self.results = SpanResults(self.editor, task, str(self.method), every)
        except FormulaError as error:
            self.editor.app.notify(what_is_wrong(error))
        except NinjaGameError as error:
            self.editor.app.notify(str(error))

    def _start_or_stop(self) -> None:
        if self.results is not None and self.results.running:
            self.results.stop()
        else:
            self.start()

    def close(self) -> None:
        """End the search."""
        if self.results is not None:
            self.results.close()
        self.results, self.found, self.editor.preview = None, (), None

    def update(self, real_ms: int) -> None:
        """Take what was found; where the run has changed, the search ends."""
        if not self.span[1]:
            self.use_selection()
        results = self.results
        if results is None:
            return
        if results.behind is None and results.running:
            results.stop()
        results.refresh()
        self.found = results.better
        self.list.fill(self.found)
        over = self.list.over if results.behind is not None and self.editor.tab == self.name else -1
        self.editor.preview = results.preview(self.found[over]) if 0 <= over < len(self.found) else None

    def _put(self, index: int) -> None:
        if self.results is not None and index < len(self.found):
            self.results.put(self.found[index])

    # --- picture ---

    def render_key(self) -> tuple[object, ...]:
        """Span, what is wanted, how the search stands, its results."""
        results = self.results
        state = (
            (results.status, results.running, results.behind, self.editor.track, *map(id, self.found))
            if results
            else ()
        )
        return self.span, self.editor.selection, self.order, self.rest, self.goal.text, self.list.over, state

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Span and state; all else is widgets."""
        super().paint(surface, theme)
        palette, results, (x, y, w, _) = theme.palette, self.results, self.area
        first, last = self.span
        theme.text(surface, f"Ticks {first} to {last - 1}", x + 6, y + 8, size=11, bold=True, width=120)
        if self.span != self.editor.selection and self.editor.anchor is not None:
            theme.text(surface, "not the selection", x + 132, y + 9, size=SMALL, colour=palette.faint, width=w - 318)
        theme.text(surface, "Goal", x + 6, y + 29, size=11)
        self._button.text = "Stop" if results is not None and results.running else "Start"
        status, colour = "Enter in the goal starts, too", palette.faint
        if results is not None:
            status, colour = results.status, palette.bad if results.search.problem else palette.text
            if results.behind is None:
                status, colour = "the run was changed: search again", palette.bad
        theme.text(surface, status, x + 222, y + 72, size=SMALL, colour=colour, width=w - 226)
        if self.found:
            for at, head in zip(self._cells(self.list.row_area(0)), _HEADS, strict=True):
                theme.text(surface, head, at, y + 88, size=8, colour=palette.faint)
        for k, line in enumerate(wrapped(theme, results.note if results else _EXPLAINED, w - 28, 10)):
            theme.text(surface, line, x + 10, y + 97 + 15 * k, size=10, colour=palette.faint)

    @staticmethod
    def _cells(row: Area) -> tuple[float, ...]:
        """Where the cells of a row begin."""
        x, _, w, _ = row
        return x + _LEFT, *(x + w - at for at in _COLUMNS)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, _: bool) -> None:
        """A sign if it is in the run, what a result brings; those that do not fit are faint."""
        if self.results is None or index >= len(self.found):
            return
        x, y, w, _h = area
        widths = w - _LEFT - _COLUMNS[0] - 4, *_WIDTHS
        palette, fits = theme.palette, self.results.behind is not None
        *cells, gain = self.results.words(self.found[index])
        for at, cell, width in zip(self._cells(area), cells, widths, strict=True):
            theme.text(surface, cell, at, y + 3, size=SMALL, width=width,
                       colour=palette.text if fits else palette.faint)  # fmt: skip
        theme.text(surface, gain, x + w - 6, y + 3, size=SMALL, bold=fits, align="right", width=96,
                   colour=palette.good if fits else palette.faint)  # fmt: skip

"""Searches in the selected ticks for keys that reach a goal or increase a measure, and their results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import pygame

from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.play.menu_screen import Menu
from ninja_game.play.workspace import Commands
from ninja_game.search.formula.methods import fewest_ticks
from ninja_game.search.formula.task import SpanResult, SpanTask
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.tas.goals import IMPROVE, IMPROVE_GOLD, IMPROVES, PRESETS, RunPiece, SearchedSpan, SpanGoal, whole_run
from ninja_game.tas_editor.editor import OtherRun, Span, TasEditor
from ninja_game.tas_editor.span_pieces import SpanPieces
from ninja_game.tas_editor.span_results import SpanResults
from ninja_game.tas_editor.tabs.tab import SMALL, TAB_ROW, UNPLACED, EntryField, Rows, Tab, put_in_a_row, what_is_wrong
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.theme import Area, Theme, wrapped
from ninja_game.ui.widgets import Button, Choice, Widget

FORGET = "Forget earlier"
PIECES = "Nothing better so far. A click searches one of these, best first:"

_MAX_FORMULA = 300  # characters of a formula
MAX_TITLE = 30  # characters of it in the name of a branch

EARLIEST, GREATEST, SMALLEST = "earliest", "greatest", "smallest"
_METHODS = (
    ("both methods", "auto"),
    ("beam", "beam"),
    ("small changes", "local"),
    ("all keys there are", "exhaustive"),
    ("the whole run", IMPROVE),
    ("the whole run, same gold", IMPROVE_GOLD),
)
_ORDERS = (("the earliest", EARLIEST), ("the greatest", GREATEST), ("the smallest", SMALLEST))
_RESTS = (("end at the goal", False), ("then the rest", True))
_ORDER_HINT = "Best is what reaches the goal first, or has the most or least of the value beside this"
_REST_HINT = "What follows the goal in the run is played, too, and must still reach the exit"
_METHOD_HINT = "Beam: many states at once; small changes: of the keys there; all keys: short spans only"
_RESULT_HINT = "Under the mouse: its path in the level; a click puts it into the run"
_NAMES = "x y vx vy speed tick gold state dead won in_air distance(x, y) taken(id) opened(id) and or not < > abs(a)"
_LEFT = 14  # start of a result's first cell from the left of its row, px
_COLUMNS = (228, 180, 120)  # starts of the others from its right
_WIDTHS = (44, 58, 36)
_HEADS = ("Result", "Other from", "Ends at x, y", "Speed")
_EXPLAINED = (
    "Say what for: a goal that is true after one of these ticks, as early as possible, or a value that is to be "
    "the greatest or smallest then. Other keys for these ticks are searched; a click puts a result into the run."
)


class PresetMenu(Menu):
    """A menu over the roll, so that the run in the level stays visible, with what a row does below its name."""

    row_height = 46
    veil = 40

    @property
    def _box(self) -> Area:
        _, y, w, h = super()._box
        return WIDTH - w - 10, y, w, h

    def build(self) -> Sequence[Widget]:
        (x, y, w, _), height = self._box, self.row_height
        return [
            Button((x + 12, y + 48 + height * k, w - 24, height - 4), text, action, size=12, detail=explanation)
            for k, (text, action, explanation) in enumerate(self.rows())
        ]


class _Preset(NamedTuple):
    """A choice from the menu, and the goal that it gave for the ticks."""

    name: str
    make: Callable[[SearchedSpan], SpanGoal]
    goal: SpanGoal


class _Line(NamedTuple):
    """Widgets side by side in the form, px."""

    top: float
    height: float
    widgets: Sequence[Widget]  #: one of class Widget itself: the room of a text
    widths: Sequence[float]  #: 0: what the others leave


class SearchTab(Tab):
    """The form of a span search (goal, measure, method), its progress, and its results to put into the run."""

    name = "Search"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.span: Span = (0, 0)
        self._first_behind = 0  #: the first tick that follows the goal in the run
        self.span_reason = ""  #: why the span is not the selection
        self._last_selection: Span = (0, 0)  #: the selection from which the span was made
        self.order = EARLIEST
        self.rest = False  #: whether what follows the goal is played, too
        self.method = "auto"
        self.results: SpanResults | None = None
        self._preset: _Preset | None = None
        self.proposed: SpanPieces | None = None
        self.earlier: list[tuple[SpanResults, SpanResult]] = []
        self._rows: list[tuple[SpanResults, SpanResult] | RunPiece] = []
        formula = partial(EntryField, enter=self.start, longest=_MAX_FORMULA, hint=_NAMES, put=self._typed)
        self.goal = formula("x > 400, taken(12), distance(300, 200) < 6 ...")
        self.measure = formula("speed; vx, y, gold ...")
        selected = Button(UNPLACED, "Use the selection", self.use_selection, size=SMALL)
        presets = Button(UNPLACED, "Presets", self.propose, size=SMALL, hint="Common goals, to begin with")
        order = Choice(UNPLACED, "", _ORDERS, lambda: self.order, self.set_order, hint=_ORDER_HINT)
        rest = Choice(UNPLACED, "", _RESTS, lambda: self.rest, self.set_rest, hint=_REST_HINT)
        method = Choice(UNPLACED, "", _METHODS, lambda: self.method, self._set_method, hint=_METHOD_HINT)
        self._button = Button(UNPLACED, "Start", self._start_or_stop, size=SMALL)
        self._forget = Button(UNPLACED, "", self.earlier.clear, size=8, hint="The results of earlier searches")
        self.list = Rows(self._draw_row, self._use_row, keeps=False, hint=_RESULT_HINT)
        self._texts = span, goal, status, heads = [Widget(UNPLACED) for _ in range(4)]
        self._lines = (
            _Line(4, 18, (span, selected, presets), (0, 96, 78)),
            _Line(25, 18, (goal, self.goal), (32, 0)),
            _Line(46, 18, (order, self.measure, rest), (118, 0, 146)),
            _Line(67, 18, (method, self._button, status), (150, 58, 0)),
            _Line(86, 13, (heads, self._forget), (0, 76)),
        )
        placed = (widget for line in self._lines for widget in line.widgets)
        self.widgets = [*(widget for widget in placed if widget not in self._texts), self.list]

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        for line in self._lines:
            put_in_a_row((x + 4, y + line.top, w - 8, line.height), line.widgets, line.widths)
        self.list.area = x + 4, y + 99, w - 8, h - 101

    def commands(self) -> Commands:
        return {"search": self.focus_goal}

    # --- the task ---

    def focus_goal(self) -> None:
        """Show this tab for the selected ticks, with the focus on the goal; without new ones it stays as it is.

        Without a goal, in ticks in which the run dies, that is to reach the exit.
        """
        self._follow_selection()
        tick, outcome = self.editor.session.timeline.end
        if not self.goal.text and not self.measure.text and outcome == "dead" and tick in range(*self.span):
            name, _, make = PRESETS[0]
            self._fill(name, make)
        self.editor.tab = self.name
        self.wants = self.goal

    def _follow_selection(self) -> None:
        if self.editor.anchor is not None or self.editor.selection != self._last_selection:
            self.use_selection()

    def use_selection(self) -> None:
        """Search the selected ticks; if only one is selected, a second from there on.

        A goal from the menu is made again for them; one with its own ticks, up to the exit, stays.
        """
        first, last = self._last_selection = self.editor.selection
        second = min(first + TICKS_PER_SECOND, max(len(self.editor.track), last))
        before = self.span, self.span_reason
        self.span = (first, last if last > first + 1 else second)
        self._first_behind, self.span_reason = 0, ""
        self.method = "auto" if self.method in IMPROVES else self.method
        if before == (self.span, ""):
            return
        if self.results is not None and not self.results.running:
            self._end_search()
        if self._preset is not None and self._is_from_menu:
            self._fill(self._preset.name, self._preset.make if self.goal.text != "won" else lambda _: SpanGoal())

    def propose(self) -> None:
        """Open a menu of common goals for the selected ticks; a choice fills the fields and starts."""
        self._follow_selection()
        first, last = self.span
        fill = partial(self._fill, start=True)
        rows = [(name, partial(fill, name, make), hint.format(first, last - 1)) for name, hint, make in PRESETS]
        self.editor.app.push(PresetMenu(self.editor.app, f"Presets for ticks {first} to {last - 1}", rows))

    @property
    def _is_from_menu(self) -> bool:
        """Whether a choice from the menu, or of a piece, has filled the fields."""
        goal = self._preset and self._preset.goal
        return goal is not None and (self.goal.text, self.measure.text) == (goal.goal, goal.measure)

    def _fill(self, name: str, make: Callable[[SearchedSpan], SpanGoal], *, start: bool = False) -> None:
        try:
            goal = make(SearchedSpan(self.editor.session, *self.span))
        except NinjaGameError as error:
            self.editor.app.notify(str(error))
            return
        self._preset = _Preset(name, make, goal)
        self.goal.show(goal.goal)
        self.measure.show(goal.measure)
        self.order = EARLIEST
        if goal.measure:
            self.order = SMALLEST if goal.least else GREATEST
        self.rest = goal.rest
        self.method = goal.method or ("auto" if self.method in IMPROVES else self.method)
        first, self._first_behind = self.span
        first = 0 if goal.method else first
        self.span = first, goal.last or self._first_behind
        self.span_reason = goal.why
        if start:
            self.start()

    def _typed(self, _: str) -> None:
        """A goal was typed: no method for the whole run."""
        if self.method in IMPROVES:
            self.use_selection()

    def _set_method(self, method: str) -> None:
        """Set a method; the span that is no longer the whole run becomes the selection."""
        old, self.method = self.method, method
        if old in IMPROVES and method not in IMPROVES:
            self.use_selection()

    def set_order(self, order: str) -> None:
        self.order = order
        self.rest = self.rest and order == EARLIEST

    def set_rest(self, rest: bool) -> None:
        self.rest = rest
        self.order = EARLIEST if rest else self.order

    @property
    def task(self) -> SpanTask:
        """The fields as a task. Raises FormulaError, ArgumentError."""
        session, (first, last) = self.editor.session, self.span
        measure = "" if self.order == EARLIEST else self.measure.text.strip() or "speed"
        return SpanTask(
            session.origin.level, session.track.inputs, first, last, self.goal.text.strip(), measure,
            least=self.order == SMALLEST, rest=self.rest, body=session.origin.body, behind=self._first_behind,
        )  # fmt: skip

    def _span_whole_run(self) -> SpanTask:
        """Make the whole run the span, to be shortened. Raises ArgumentError for one that is too long, or empty."""
        session = self.editor.session
        session.timeline.simulate(len(session.timeline))
        goal = whole_run(SearchedSpan(session, *self.span))
        self.span, self.span_reason = (0, goal.last), goal.why
        return SpanTask(session.origin.level, session.track.inputs, *self.span, "won", body=session.origin.body)

    # --- the search ---

    def start(self) -> None:
        """Search; a running search ends. Errors are reported."""
        self._end_search()
        self.list.over = -1
        try:
            whole = self.method in IMPROVES
            task = self._span_whole_run() if whole else self.task
            if not (task.goal or task.measure or task.rest):
                raise ArgumentError("Say what for: a goal, or a value that is to be the greatest or smallest")
            every = fewest_ticks(task.length) if self.method == "exhaustive" else 1
            self.results = SpanResults(self.editor, task, self.method, None if whole else every, self._title(task))
        except NinjaGameError as error:
            self.editor.refuse(what_is_wrong(error))
        else:
            self.editor.accept()

    def _title(self, task: SpanTask) -> str:
        if self.method in IMPROVES:
            return "Whole run"
        goal = self._preset.name if self._preset and self._is_from_menu else task.measure or task.goal
        return f"{task.first}-{task.last - 1} {goal[:MAX_TITLE]}"

    def _start_or_stop(self) -> None:
        if not self.stop():
            self.start()

    def stop(self) -> bool:
        if self.results is None or not self.results.running:
            return False
        self.results.stop()
        return True

    def close(self) -> None:
        self._end_search()
        self.earlier.clear()
        self._fill_list()

    def _end_search(self) -> None:
        """End the search; its results join those of earlier ones."""
        if self.results is not None:
            self.results.close()
            reached = [result for result in self.results.better if result.missed_by is None]
            self.earlier[:0] = [(self.results, result) for result in reached]
        self.results = self.proposed = None
        self._fill_list()

    def update(self, real_ms: int) -> None:
        if not self.span[1]:
            self.use_selection()
        results = self.results
        if results is not None:
            if results.first_behind is None and results.running:
                results.stop()
            results.refresh()
            if self.proposed is None and results.found_nothing:
                self.proposed = SpanPieces(self.editor, results.task)
            if self.proposed is not None:
                self.proposed.refresh()
        self._forget.enabled, self._forget.text = bool(self.earlier), FORGET if self.earlier else ""
        self._fill_list()

    @property
    def better(self) -> tuple[SpanResult, ...]:
        return self.results.better if self.results else ()

    @property
    def pieces(self) -> tuple[RunPiece, ...]:
        return self.proposed.pieces if self.proposed else ()

    def _fill_list(self) -> None:
        results = self.results
        self._rows = [*((results, result) for result in self.better if results), *self.pieces, *self.earlier]
        self.list.fill(self._rows)

    @property
    def preview(self) -> OtherRun | None:
        over, rows = self.list.over, self._rows
        row = rows[over] if 0 <= over < len(rows) else None
        if row is None or isinstance(row, RunPiece) or row[0].is_in_run(row[1]):
            return None  # a result in the run is visible as a change
        results, result = row
        return results.shown_run(result)

    def _use_row(self, index: int) -> None:
        """Use a result, or search a piece; the others stay for later."""
        row = self._rows[index]
        if isinstance(row, RunPiece):
            proposed = self.proposed
            self.span = row.first, row.last
            self._fill(row.name, lambda _: row.wanted, start=True)
            self.proposed = proposed
        else:
            results, result = row
            results.put_into_run(result)

    # --- picture ---

    def render_key(self) -> tuple[object, ...]:
        results = self.results
        state = tuple[object, ...]((len(self.earlier), self.editor.track))
        if results:
            state += (results.status, results.running, results.first_behind, self.pieces, *map(id, self.better))
        form = self.order, self.rest, self.goal.text
        return self.span, self.span_reason, self.editor.selection, *form, self.list.over, state

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        palette, results, (x, y, w, h) = theme.palette, self.results, self.area
        first, last = self.span
        # Texts stand 2 px from the edges of their rooms.
        span, goal, start, heads = (
            (left + 2, top, width - 2) for left, top, width, _ in (text.area for text in self._texts)
        )
        theme.text(surface, f"Ticks {first} to {last - 1}", span[0], span[1] + 4, size=11, bold=True, width=120)
        if self.span_reason or (self.span != self.editor.selection and self.editor.anchor is not None):
            why = self.span_reason or "not the selection"
            left, width = span[0] + 126, span[2] - 126
            theme.text(surface, why, left, span[1] + 5, size=SMALL, colour=palette.faint, width=width)
        theme.text(surface, "Goal", goal[0], goal[1] + 4, size=11)
        self._button.text = "Stop" if results is not None and results.running else "Start"
        status, colour = "Enter in the goal starts, too", palette.faint
        if results is not None:
            status = results.status
            colour = palette.bad if results.search.problem else palette.text
            if results.first_behind is None:
                status, colour = "edited since: a click takes it as it was", palette.bad
        theme.text(surface, status, start[0], start[1] + 5, size=SMALL, colour=colour, width=start[2])
        if self.pieces:
            note = PIECES
        elif results:
            note = results.note
        else:
            note = "" if self.earlier else _EXPLAINED
        if self.better:
            for at, head in zip(self._cells(self.list.row_area(0)), _HEADS, strict=True):
                theme.text(surface, head, at, heads[1] + 2, size=8, colour=palette.faint)
        elif self.list.count:
            left, width = x + _LEFT + 4, heads[2] - _LEFT
            theme.text(surface, note, left, heads[1] + 2, size=8, colour=palette.faint, width=width)
        advice = results.advice if results else ""
        top = self.list.area[1] - 2 + (TAB_ROW + 4) * self.list.count
        lines = wrapped(theme, advice if self.list.count else note, w - 28, 10)
        for k, line in enumerate(lines if top + 15 * len(lines) <= y + h else ()):
            theme.text(surface, line, x + 10, top + 15 * k, size=10, colour=palette.faint)

    @staticmethod
    def _cells(row: Area) -> tuple[float, ...]:
        x, _, w, _ = row
        return x + _LEFT, *(x + w - at for at in _COLUMNS)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, _: bool) -> None:
        row = self._rows[index]
        if isinstance(row, RunPiece):
            self._draw_piece(surface, theme, row, area)
            return
        x, y, w, _h = area
        results, result = row
        widths: tuple[float, ...] = (w - _LEFT - _COLUMNS[0] - 4, *_WIDTHS)
        palette, fits = theme.palette, results.first_behind is not None
        *cells, gain = results.words(result)
        if results is not self.results:
            cells, widths = [f"earlier: {results.title}: {cells[0]}"], (w - _LEFT - 90,)
        for at, cell, width in zip(self._cells(area), cells, widths, strict=False):
            theme.text(
                surface, cell, at, y + 3, size=SMALL, width=width, colour=palette.text if fits else palette.faint
            )
        colour = palette.faint if not fits else palette.good if result.missed_by is None else palette.bad
        theme.text(surface, gain, x + w - 6, y + 3, size=SMALL, colour=colour, bold=fits, align="right", width=78)

    def _draw_piece(self, surface: pygame.Surface, theme: Theme, piece: RunPiece, area: Area) -> None:
        x, y, w, _ = area
        ticks = f"ticks {piece.first} to {piece.last - 1}"
        searched = (piece.first, piece.last) == self.span and piece.wanted.rest == self.rest
        theme.text(surface, piece.name, x + _LEFT, y + 3, size=SMALL, bold=searched, width=w - _COLUMNS[0] - _LEFT)
        theme.text(surface, ticks, x + w - _COLUMNS[0], y + 3, size=SMALL, width=104)
        click = "is searched" if searched else "search it"
        theme.text(surface, click, x + w - 6, y + 3, size=SMALL, align="right", colour=theme.palette.faint)

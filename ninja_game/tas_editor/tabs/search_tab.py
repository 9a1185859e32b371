"""Searches in the selected ticks for keys that reach a goal or increase a measure, and their results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from math import hypot
from time import monotonic

import numpy as np
import pygame

from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.files.shown_text import counted
from ninja_game.formats.recording import Recording
from ninja_game.play.menu_screen import Menu
from ninja_game.play.workspace import Commands
from ninja_game.runs.compare import Split, run_splits
from ninja_game.runtime import NewestJob, cores
from ninja_game.search.certificate import moved_markers
from ninja_game.search.formula.background import RunSearch, SpanSearch
from ninja_game.search.formula.methods import KEPT, fewest_ticks
from ninja_game.search.formula.task import SpanResult, SpanTask, distinct_ways, score_text
from ninja_game.sim.inputs import fit_inputs, with_press_bits
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.tas.contributions import Contributions
from ninja_game.tas.goals import (
    GOALS,
    IMPROVE,
    IMPROVE_GOLD,
    IMPROVES,
    PRESETS,
    RunPiece,
    SearchedSpan,
    SpanGoal,
    pieces_of,
    whole_run,
)
from ninja_game.tas.tracks import InputTrack, first_difference
from ninja_game.tas_editor.editor import OtherRun, Span, TasEditor
from ninja_game.tas_editor.tabs.tab import ROW, SMALL, UNPLACED, EntryField, Rows, Tab, what_is_wrong
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.theme import Area, Theme, wrapped
from ninja_game.ui.widgets import Button, Choice, Widget

CLOSING_SECONDS = 0.5  # longest wait for a cancelled search when the TAS editor is left

COMPILING = (
    "Searches are loaded; the first time on a machine they are compiled, some minutes (`ninja-game compile` does it "
    "beforehand). Meanwhile you can play, look around and edit; only an edit in the ticks that are searched, or before "
    "them, ends the search."
)
NOT_BEGUN = "Stopped before it began. The rules are still made ready, for the next search."
NOTHING_YET = "Nothing yet comes nearer to the goal than the run itself."
PATIENCE = 5.0  # seconds of a search before pieces of its span are proposed
FORGET = "Forget earlier"
WITHOUT_REST = "End at the goal, not then the rest"
PIECES = "Nothing better so far. A click searches one of these:"
NOTHING = "The goal was not reached. More time, a longer span or another method may reach it."

MAX_FORMULA = 300  # characters of a formula
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
_NAMES = "x y vx vy speed tick gold state dead won in_air distance(x, y) taken(id) opened(id) and or not < > abs(a)"
_LEFT, _COLUMNS, _WIDTHS = 14, (228, 180, 120), (44, 58, 36)
"""Starts of a result's cells, px: the first from the left of a row, others from its right; their widths."""
_HEADS = ("Result", "Other from", "Ends at x, y", "Speed")
_EXPLAINED = (
    "Say what for: a goal that is true after one of these ticks, as early as possible, or a value that is to be "
    "the greatest or smallest then. Other keys for these ticks are searched; a click puts a result into the run."
)


Cut = tuple[InputTrack, Recording]
Splits = tuple[InputTrack, tuple[Split, ...]]


class SpanResults:
    """Runs a task in the background, and puts results into the run, while the ticks before them are unchanged.

    ``better``: the results with more than the run's own keys, best first, one per route; before the goal is reached,
    the nearest. ``every``: as of SpanSearch; None: search the whole run. ``title``: the search in a few words;
    ``stopped``: it was cancelled. Raises as SpanSearch does.
    """

    def __init__(self, editor: TasEditor, task: SpanTask, method: str, every: int | None, title: str) -> None:
        self.editor = editor
        self.task = task
        self.title = title
        self._begun = editor.track
        timeline, jobs = editor.session.timeline, max(1, cores() - 1)
        self._to_exit = task.rest or task.goal == "won"
        timeline.simulate(len(timeline) if self._to_exit else 0)
        end = timeline.end[0]
        self._gold = int(timeline.column("gold")[end if end >= 0 else len(task.inputs) - 1]) if self._to_exit else 0
        self._others = tuple(editor.others) if every is None else ()
        self.search = (
            self._whole(method, jobs)
            if every is None
            else SpanSearch(task, method, jobs, every=every, memory=timeline.asked_memory)
        )
        # Beginnings of runs that results fit to, and in each the first tick that follows a result: of the searched run
        # and of those that results were put into.
        whole = len(task.inputs) if task.rest else task.last
        self._fitting = [(task.inputs[:whole], (task.rest and task.behind) or task.last)]
        self.better: tuple[SpanResult, ...] = ()
        self._seen: tuple[SpanResult, ...] = ()
        self._preview: tuple[SpanResult, OtherRun] | None = None
        self.search.start()
        self._started = monotonic()
        self.stopped = False

    def _whole(self, method: str, jobs: int) -> RunSearch:
        gold = self._gold if method == IMPROVE_GOLD else 0
        return RunSearch(self.task, jobs, gold=gold, others=tuple(other.track.inputs for other in self._others))

    @property
    def running(self) -> bool:
        return not self.search.done

    def stop(self) -> None:
        self.stopped = True
        self.search.cancel()

    def close(self) -> None:
        self.stop()
        self.search.finish(CLOSING_SECONDS)

    @property
    def behind(self) -> int | None:
        """The first tick behind a result in the present run; None: it has changed, and no result fits.

        The ticks that follow are those that the run had after its own moment at the goal.
        """
        inputs = self.editor.track.inputs
        for begin, behind in reversed(self._fitting):
            if inputs == begin if self.task.rest else inputs.startswith(begin):
                return behind
        return None

    def put(self, result: SpanResult) -> bool:
        """Put a result into the run, as one edit; whether that was possible. Branches keep the earlier run, and it.

        A run that has changed so that the result does not fit becomes the searched run with the result. Cursor and
        selection keep their ticks; behind the span they move with the ticks that follow it.
        """
        editor, end = self.editor, self.task.first + result.ticks
        behind, track, taken = self.behind, editor.track, self._taken(result)
        old = behind is None
        if behind is None:
            track, behind, taken = self._begun, self._fitting[0][1], self._begun.made + taken
        cursor, anchor = editor.cursor, editor.anchor
        made = self._made(track, result, behind)
        if made.inputs == editor.track.inputs:
            return True
        editor.session.keep_version(f"before {self.title}")
        editor.places[editor.track] = cursor, anchor
        edited = self._whose(result) is not None  # a person's keys were taken, no search has found them
        if not editor.attempt(lambda: editor.session.change(made, taken=taken, whole=old, edited=edited)):
            return False
        editor.session.keep_version(self.title)
        if old:
            editor.app.notify("The run as it was searched, with this result. Undo, or Branches, has yours")
        self._fitting.append((made.inputs if self.task.rest else made.inputs[:end], end))
        if not isinstance(self.search, RunSearch):  # a result for a whole run replaces all ticks

            def moved(tick: int) -> int:
                return tick + end - behind if tick >= behind else min(tick, end - 1)

            editor.go(moved(cursor if anchor is None else anchor))
            editor.go(moved(cursor), select=anchor is not None)
        return True

    def _whose(self, result: SpanResult) -> OtherRun | None:
        """The other run that equals a result, if any."""
        if result.own_route or not result.inputs:
            return None
        ticks, keys = len(result.inputs), with_press_bits(result.inputs)
        same = (other for other in self._others if with_press_bits(fit_inputs(other.track.inputs, ticks)) == keys)
        return next(same, None)

    def _like(self, result: SpanResult) -> str:
        """The other run whose route is nearest to that of a result, in words."""

        def apart(other: OtherRun) -> float:
            ticks = min(len(result.path), len(other.positions))
            return float(np.hypot(*(result.path[:ticks] - other.positions[:ticks]).T).mean())

        return f"like {min(self._others, key=apart).name}"

    def _taken(self, result: SpanResult) -> Contributions:
        """The contributions to a result: the search, and the authors whose routes may be in it."""
        whose = self._whose(result)
        if whose is not None:
            return whose.made
        routes = () if result.own_route else self._others
        command = "improve" if isinstance(self.search, RunSearch) else "search"
        return sum((other.made for other in routes), Contributions(commands=(command,)))

    def _made(self, track: InputTrack, result: SpanResult, behind: int) -> InputTrack:
        """The run with a result in it; with ``rest``, the run that reached the exit in the search."""
        first, keys = self.task.first, result.keys[: result.ticks].tolist()
        if self.task.goal == "won":  # keys behind an exit would take the run's claims away
            inputs = track.inputs[:first] + result.inputs[first:]
            return InputTrack(inputs, moved_markers(self.editor.session.recording(), inputs))
        if not self.task.rest:
            return track.replaced(first, behind, keys)
        end = int(min(result.score, len(result.inputs)))  # no keys behind the exit, if it is reached
        made = track.replaced(first, behind, keys)
        return InputTrack(track.inputs[:first] + result.inputs[first:], made.markers).up_to(end)

    def is_in_run(self, result: SpanResult) -> bool:
        ours, theirs = self.editor.track.inputs, result.inputs
        return first_difference(ours, theirs) == min(len(ours), len(theirs))

    def looked_at(self, result: SpanResult) -> OtherRun:
        if self._preview is None or self._preview[0] is not result:
            self._preview = result, self.editor.other_run("the result", InputTrack(result.inputs))
        return self._preview[1]

    # --- in words ---

    def refresh(self) -> None:
        results, miss = self.search.results, self.search.miss
        if not results and miss is not None:
            self.better = (miss,)
        if [*map(id, results)] == [*map(id, self._seen)]:  # each report of a search is a new tuple
            return
        self._seen, own = results, self.search.own
        if own is not None:
            self._fitting[0] = self._fitting[0][0], self.task.first + own.ticks
        # Results of a whole run are those that no other beats.
        before = () if isinstance(self.search, RunSearch) else self.better
        better = [
            run
            for run in (*results, *before)  # of equal ones the tidy one
            if run.missed_by is None
            and (own is None or run.score < own.score or (run.score == own.score and run.gold > own.gold))
        ]
        self.better = tuple(distinct_ways(better, measured=bool(self.task.measure))[:KEPT])

    def words(self, result: SpanResult) -> tuple[str, ...]:
        """Cells of a result: score, first tick with other keys, place and speed at the goal, gain."""
        own, words = self.search.own, score_text(self.task, result)
        if result.missed_by == 0.0:
            words += f": {self.looked_at(result).ending}"
        if self._to_exit and result.missed_by is None and result.gold != self._gold:  # of the run as it was
            words += f", {abs(self._gold - result.gold)} gold {'fewer' if result.gold < self._gold else 'more'}"
        if self._others:
            whose = self._whose(result)
            route = "own route" if result.own_route else f"this is {whose.name}" if whose else self._like(result)
            words = f"{words.removeprefix('exit in ')}, {route}"  # long names are truncated, gold is not
        gain = "new" if result.missed_by is None else "a miss"
        if own is not None:
            more = own.score - result.score
            gain = f"better by {more:.4g}" if self.task.measure else f"{counted(int(more), 'tick', 'ticks')} sooner"
        x, y, vx, vy = result.end
        other = first_difference(result.inputs, self.task.inputs)
        return words, str(other), f"{x:.1f}, {y:.1f}", f"{hypot(vx, vy):.3f}", gain

    @property
    def status(self) -> str:
        search = self.search
        if search.problem:
            return "cannot be searched"
        if not search.ticks_run:
            return f"getting ready: {monotonic() - self._started:.0f} s" if self.running else "ended"
        doing = "searching" if self.running else "ended"
        return f"{doing}: {search.ticks_run / 1e6:.1f} million ticks, {search.seconds:.0f} s"

    @property
    def note(self) -> str:
        search = self.search
        if search.problem or self.better:
            return search.problem
        if search.own is not None:
            yet = "yet " if self.running else ""
            return f"Nothing better {yet}than the run's own keys: {score_text(self.task, search.own)}."
        if not search.ticks_run:
            return COMPILING if self.running else NOT_BEGUN
        return NOTHING_YET if self.running else NOTHING

    @property
    def advice(self) -> str:
        """What the nearest miss lacks, and what to try; "" while there is something better."""
        miss = next((each for each in self.better if each.missed_by is not None), None)
        if miss is None:
            return ""
        last, ending = self.task.first + miss.ticks - 1, self.looked_at(miss).ending
        if miss.missed_by == 0.0:
            return f"With what follows the goal, {ending}. Try: {WITHOUT_REST.lower()}; or Same end, sooner."
        lacks = ", ".join(miss.missing) or score_text(self.task, miss).removeprefix("closest: ").partition(" after ")[0]
        shut = f"; {ending}" * ("untouched" in ending and "won" in self.task.goal)
        late = miss.ticks > 0.9 * self.task.length
        part = "; or a part of the goal alone" * bool(miss.missing)
        where = "a longer span, it is nearest at its end" if late else "an earlier first tick"
        return f"Missing after tick {last}: {lacks}{shut}. Try: {where}{part}."


class PresetMenu(Menu):
    """A menu over the roll, so that the run in the level stays visible, with what a row does below its name."""

    row_height = 46
    veil = 40

    @property
    def _box(self) -> Area:
        _, y, w, h = super()._box
        return WIDTH - w - 10, y, w, h

    def build(self) -> Sequence[Widget]:
        (x, y, w, _), high = self._box, self.row_height
        return [
            Button((x + 12, y + 48 + high * k, w - 24, high - 4), text, action, size=12, detail=explanation)
            for k, (text, action, explanation) in enumerate(self.rows())
        ]


class SearchTab(Tab):
    name = "Search"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.span: Span = (0, 0)
        self._behind = 0
        self._why = ""
        self._taken: Span = (0, 0)
        self.order = EARLIEST
        self.rest = False
        self.method = "auto"
        self.results: SpanResults | None = None
        self._preset: tuple[Callable[[SearchedSpan], SpanGoal], SpanGoal, str] | None = None
        self.found: tuple[SpanResult, ...] = ()
        self.earlier: list[tuple[SpanResults, SpanResult]] = []
        self._rows: list[tuple[SpanResults, SpanResult] | RunPiece] = []
        self.pieces: tuple[RunPiece, ...] = ()
        self._in_pieces: Span | None = None
        self._cut: InputTrack | None = None
        self._asked: InputTrack | None = None
        self._splits = NewestJob[Cut, Splits](lambda cut: (cut[0], run_splits(cut[1], tuple(GOALS)).splits))
        fields = ("x > 400, taken(12), distance(300, 200) < 6 ...", "speed; vx, y, gold ...")
        self.goal, self.measure = (
            EntryField(prompt, self.start, longest=MAX_FORMULA, hint=_NAMES, put=self._typed) for prompt in fields
        )
        self._button = Button(UNPLACED, "Start", self._start_or_stop, size=SMALL)
        self._forget = Button(UNPLACED, "", self.earlier.clear, size=8, hint="The results of earlier searches")
        self.list = Rows(
            self._draw_row,
            self._put,
            keeps=False,
            hint="Under the mouse: its path in the level; a click puts it into the run",
        )
        self.widgets = [
            Button(UNPLACED, "Use the selection", self.use_selection, size=SMALL),
            Button(UNPLACED, "Presets", self.propose, size=SMALL, hint="Common goals, to begin with"),
            self.goal,
            Choice(UNPLACED, "", _ORDERS, lambda: self.order, self._put_order,
                   hint="Best is what reaches the goal first, or has the most or least of the value beside this"),
            self.measure,
            Choice(UNPLACED, "", _RESTS, lambda: self.rest, self._put_rest,
                   hint="What follows the goal in the run is played, too, and must still reach the exit"),
            Choice(UNPLACED, "", _METHODS, lambda: self.method, self._put_method,
                   hint="Beam: many states at once; small changes: of the keys there; all keys: short spans only"),
            self._button,
            self._forget,
            self.list,
        ]  # fmt: skip

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        areas = (
            (x + w - 182, y + 4, 96, 18), (x + w - 82, y + 4, 78, 18), (x + 40, y + 25, w - 44, 18),
            (x + 4, y + 46, 118, 18), (x + 126, y + 46, w - 280, 18), (x + w - 150, y + 46, 146, 18),
            (x + 4, y + 67, 150, 18), (x + 158, y + 67, 58, 18), (x + w - 80, y + 86, 76, 13),
            (x + 4, y + 99, w - 8, h - 101),
        )  # fmt: skip
        for widget, area in zip(self.widgets, areas, strict=True):
            widget.area = area

    def commands(self) -> Commands:
        return {"search": self.ask}

    # --- the task ---

    def ask(self) -> None:
        """Show this tab for the selected ticks, with the focus on the goal; without new ones it stays as it is."""
        self._follow_selection()
        self.editor.tab = self.name
        self.wants = self.goal

    def _follow_selection(self) -> None:
        if self.editor.anchor is not None or self.editor.selection != self._taken:
            self.use_selection()

    def use_selection(self) -> None:
        """Search the selected ticks; if only one is selected, a second from there on.

        A goal from the menu is made again for them; one with its own ticks, up to the exit, stays.
        """
        first, last = self._taken = self.editor.selection
        second = min(first + TICKS_PER_SECOND, max(len(self.editor.track), last))
        before, self.span = (self.span, self._why), (first, last if last > first + 1 else second)
        self._behind, self._why = 0, ""
        self.method = "auto" if self.method in IMPROVES else self.method
        if before == (self.span, ""):
            return
        if self.results is not None and not self.results.running:
            self._put_away()
        if self._preset is not None and self._is_from_menu:
            make, _, name = self._preset
            self._fill(name, make if self.goal.text != "won" else lambda _: SpanGoal())

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
        return self._preset is not None and (self.goal.text, self.measure.text) == self._preset[1][:2]

    def _fill(self, name: str, make: Callable[[SearchedSpan], SpanGoal], *, start: bool = False) -> None:
        try:
            goal = make(SearchedSpan(self.editor.session, *self.span))
        except NinjaGameError as error:
            self.editor.app.notify(str(error))
            return
        self._preset = make, goal, name
        self.goal.show(goal.goal)
        self.measure.show(goal.measure)
        self.order = EARLIEST if not goal.measure else SMALLEST if goal.least else GREATEST
        self.rest = goal.rest
        self.method = goal.method or ("auto" if self.method in IMPROVES else self.method)
        first, self._behind = self.span
        self.span, self._why = (0 if goal.method else first, goal.last or self._behind), goal.why
        if start:
            self.start()

    def _typed(self, _: str) -> None:
        """A goal was typed: no method for the whole run."""
        if self.method in IMPROVES:
            self.use_selection()

    def _put_method(self, method: str) -> None:
        """Set a method; the span that is no longer the whole run becomes the selection."""
        left, self.method = self.method, method
        if left in IMPROVES and method not in IMPROVES:
            self.use_selection()

    def _put_order(self, order: str) -> None:
        self.order = order
        self.rest = self.rest and order == EARLIEST

    def _put_rest(self, rest: bool) -> None:
        self.rest = rest
        self.order = EARLIEST if rest else self.order

    @property
    def task(self) -> SpanTask:
        """The fields as a task. Raises FormulaError, ArgumentError."""
        session, (first, last) = self.editor.session, self.span
        measure = "" if self.order == EARLIEST else self.measure.text.strip() or "speed"
        return SpanTask(
            session.origin.level, session.track.inputs, first, last, self.goal.text.strip(), measure,
            least=self.order == SMALLEST, rest=self.rest, body=session.origin.body, behind=self._behind,
        )  # fmt: skip

    @property
    def _whole_task(self) -> SpanTask:
        """The whole run, to be shortened. Raises ArgumentError for one that is too long, or empty."""
        session = self.editor.session
        session.timeline.simulate(len(session.timeline))
        goal = whole_run(SearchedSpan(session, *self.span))
        self.span, self._why = (0, goal.last), goal.why
        return SpanTask(session.origin.level, session.track.inputs, *self.span, "won", body=session.origin.body)

    # --- the search ---

    def start(self) -> None:
        """Search; a running search ends. Errors are reported."""
        self._put_away()
        self.list.over = -1
        try:
            whole = self.method in IMPROVES
            task = self._whole_task if whole else self.task
            if not (task.goal or task.measure or task.rest):
                raise ArgumentError("Say what for: a goal, or a value that is to be the greatest or smallest")
            every = None if whole else fewest_ticks(task.length) if self.method == "exhaustive" else 1
            self.results = SpanResults(self.editor, task, self.method, every, self._title(task))
        except NinjaGameError as error:
            self.editor.refuse(what_is_wrong(error))
        else:
            self.editor.accept()

    def _title(self, task: SpanTask) -> str:
        if self.method in IMPROVES:
            return "Whole run"
        wanted = self._preset[2] if self._preset and self._is_from_menu else task.measure or task.goal
        return f"{task.first}-{task.last - 1} {wanted[:MAX_TITLE]}"

    def _start_or_stop(self) -> None:
        if not self.stop():
            self.start()

    def stop(self) -> bool:
        if self.results is None or not self.results.running:
            return False
        self.results.stop()
        return True

    def close(self) -> None:
        self._put_away()
        self.earlier.clear()
        self._fill_list()

    def _put_away(self) -> None:
        """End the search; its results join those of earlier ones."""
        if self.results is not None:
            self.results.close()
            found = [each for each in self.results.better if each.missed_by is None]
            self.earlier[:0] = [(self.results, each) for each in found]
        self.results, self.found = None, ()
        self.pieces, self._in_pieces, self._cut = (), None, None
        self._fill_list()

    def update(self, real_ms: int) -> None:
        if not self.span[1]:
            self.use_selection()
        results = self.results
        if results is not None:
            if results.behind is None and results.running:
                results.stop()
            results.refresh()
            self.found = results.better
            self._propose_pieces(results)
        self._forget.enabled, self._forget.text = bool(self.earlier), FORGET * bool(self.earlier)
        self._fill_list()

    def _fill_list(self) -> None:
        results = self.results
        self._rows = [*((results, each) for each in self.found if results), *self.pieces, *self.earlier]
        self.list.fill(self._rows)

    @property
    def preview(self) -> OtherRun | None:
        over, rows = self.list.over, self._rows
        row = rows[over] if 0 <= over < len(rows) else None
        if row is None or isinstance(row, RunPiece) or row[0].is_in_run(row[1]):
            return None  # a result in the run is visible as a change
        results, found = row
        return results.looked_at(found)

    def _propose_pieces(self, results: SpanResults) -> None:
        """When a search for an earlier end has found nothing for a while, propose the pieces of its span.

        They are those of the present run.
        """
        search, task, whole = results.search, results.task, self.method in IMPROVES
        late = search.ticks_run and (search.seconds > PATIENCE or not (results.running or results.stopped))
        nothing = late and all(run.missed_by is not None for run in self.found)
        sooner = not task.measure and (search.own is not None or task.rest or "won" in task.goal)
        if self._in_pieces is None and nothing and sooner and not whole and results.behind is not None:
            self._in_pieces = self.span
        session, track, known = self.editor.session, self.editor.track, self._splits.result
        if self._in_pieces is None or self._cut is track:
            return
        self.pieces = ()
        if known is not None and known[0] is track:
            pieces = pieces_of(SearchedSpan(session, *self._in_pieces), known[1])
            if task.rest and task.goal and self._in_pieces[1] <= len(track):
                pieces.insert(0, RunPiece(*self._in_pieces, WITHOUT_REST, SpanGoal(task.goal)))
            self._cut, self.pieces = track, tuple(pieces)
        elif self._asked is not track:
            self._asked = track
            self._splits.ask((track, session.recording()))  # in a thread: runs may be long

    def _put(self, index: int) -> None:
        """Use a result, or search a piece; the others stay for later."""
        row = self._rows[index]
        if isinstance(row, RunPiece):
            kept = self._in_pieces, self._cut, self.pieces
            self.span = row.first, row.last
            self._fill(row.name, lambda _: row.wanted, start=True)
            self._in_pieces, self._cut, self.pieces = kept
        else:
            results, found = row
            results.put(found)

    # --- picture ---

    def render_key(self) -> tuple[object, ...]:
        results, state = self.results, tuple[object, ...]((len(self.earlier), self.editor.track))
        if results:
            state += (results.status, results.running, results.behind, self.pieces, *map(id, self.found))
        wanted = self.order, self.rest, self.goal.text
        return self.span, self._why, self.editor.selection, *wanted, self.list.over, state

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        palette, results, (x, y, w, h) = theme.palette, self.results, self.area
        first, last = self.span
        theme.text(surface, f"Ticks {first} to {last - 1}", x + 6, y + 8, size=11, bold=True, width=120)
        if self._why or (self.span != self.editor.selection and self.editor.anchor is not None):
            why = self._why or "not the selection"
            theme.text(surface, why, x + 132, y + 9, size=SMALL, colour=palette.faint, width=w - 318)
        theme.text(surface, "Goal", x + 6, y + 29, size=11)
        self._button.text = "Stop" if results is not None and results.running else "Start"
        status, colour = "Enter in the goal starts, too", palette.faint
        if results is not None:
            status, colour = results.status, palette.bad if results.search.problem else palette.text
            if results.behind is None:
                status, colour = "edited since: a click takes it as it was", palette.bad
        theme.text(surface, status, x + 222, y + 72, size=SMALL, colour=colour, width=w - 226)
        note = PIECES if self.pieces else results.note if results else "" if self.earlier else _EXPLAINED
        if self.found:
            for at, head in zip(self._cells(self.list.row_area(0)), _HEADS, strict=True):
                theme.text(surface, head, at, y + 88, size=8, colour=palette.faint)
        elif self.list.count:
            theme.text(surface, note, x + _LEFT + 4, y + 88, size=8, colour=palette.faint, width=w - 104)
        text, top = (
            (results.advice if results else "") if self.list.count else note,
            y + 97 + (ROW + 4) * self.list.count,
        )
        lines = wrapped(theme, text, w - 28, 10)
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
        results, found = row
        widths: tuple[float, ...] = (w - _LEFT - _COLUMNS[0] - 4, *_WIDTHS)
        palette, fits = theme.palette, results.behind is not None
        *cells, gain = results.words(found)
        if results is not self.results:
            cells, widths = [f"earlier: {results.title}: {cells[0]}"], (w - _LEFT - 90,)
        for at, cell, width in zip(self._cells(area), cells, widths, strict=False):
            theme.text(
                surface, cell, at, y + 3, size=SMALL, width=width, colour=palette.text if fits else palette.faint
            )
        theme.text(surface, gain, x + w - 6, y + 3, size=SMALL, bold=fits, align="right", width=78,
                   colour=palette.faint if not fits else palette.bad if gain == "a miss" else palette.good)  # fmt: skip

    def _draw_piece(self, surface: pygame.Surface, theme: Theme, piece: RunPiece, area: Area) -> None:
        x, y, w, _ = area
        ticks = f"ticks {piece.first} to {piece.last - 1}"
        now = (piece.first, piece.last) == self.span and piece.wanted.rest == self.rest
        theme.text(surface, piece.name, x + _LEFT, y + 3, size=SMALL, bold=now, width=w - _COLUMNS[0] - _LEFT)
        theme.text(surface, ticks, x + w - _COLUMNS[0], y + 3, size=SMALL, width=104)
        what = "is searched" if now else "search it"
        theme.text(surface, what, x + w - 6, y + 3, size=SMALL, align="right", colour=theme.palette.faint)

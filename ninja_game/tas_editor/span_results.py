"""The results of a search of a span: which are better than the run, how they are put into it, and their words."""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from time import monotonic

import numpy as np

from ninja_game.files.shown_text import counted
from ninja_game.runtime import cores
from ninja_game.search.certificate import moved_markers
from ninja_game.search.formula.background import RunSearch, SpanSearch
from ninja_game.search.formula.methods import KEPT
from ninja_game.search.formula.task import SpanResult, SpanTask, distinct_routes, score_text
from ninja_game.sim.inputs import fit_inputs, with_press_bits
from ninja_game.tas.contributions import Contributions
from ninja_game.tas.goals import IMPROVE_GOLD
from ninja_game.tas.tracks import InputTrack, first_different_index
from ninja_game.tas_editor.editor import OtherRun, TasEditor
from ninja_game.tas_editor.span_pieces import WITHOUT_REST

PATIENCE, STALLED = 5.0, 10.0  # seconds without a result, or a better one, before other searches are proposed
CLOSING_SECONDS = 0.5  # longest wait for a cancelled search when the TAS editor is left

COMPILING_SEARCHES = (
    "Searches are loaded; the first time on a machine they are compiled, some minutes (`ninja-game compile` does it "
    "beforehand). Meanwhile you can play, look around and edit; only an edit in the ticks that are searched, or before "
    "them, ends the search."
)
NOT_BEGUN = "Stopped before it began. The rules are still made ready, for the next search."
NOTHING_YET = "Nothing yet comes nearer to the goal than the run itself."
NOTHING = "The goal was not reached. More time, a longer span, another method or Whole run may reach it."


class SpanResults:
    """Runs a task in the background, and puts results into the run, while the ticks before them are unchanged.

    ``every``: as in SpanSearch, or None to search the whole run. Raises as SpanSearch does.
    """

    def __init__(self, editor: TasEditor, task: SpanTask, method: str, every: int | None, title: str) -> None:
        self.editor = editor
        self.title = title  #: the search in a few words
        self._searched_track = editor.track
        timeline, jobs = editor.session.timeline, max(1, cores() - 1)
        self._to_exit = task.rest or task.goal == "won"
        timeline.simulate(len(timeline) if self._to_exit else 0)
        end = timeline.end[0] if timeline.end[0] >= 0 else len(task.inputs) - 1
        self._gold = int(timeline.column("gold")[end]) if self._to_exit else 0
        self._others = tuple(editor.others) if every is None or method == "auto" else ()
        self.task = task = replace(task, others=tuple(other.track.inputs for other in self._others))
        self.search: RunSearch | SpanSearch
        if every is None:
            self.search = RunSearch(task, jobs, gold=self._gold if method == IMPROVE_GOLD else 0)
        else:
            self.search = SpanSearch(task, method, jobs, every=every, memory=timeline.asked_memory)
        # Beginnings of runs that results fit to, and in each the first tick that follows a result: of the searched run
        # and of those that results were put into.
        whole = len(task.inputs) if task.rest else task.last
        self._fitting = [(task.inputs[:whole], (task.rest and task.behind) or task.last)]
        #: Results with more than the run's own keys, best first, one per route; before the goal is reached, the nearest
        self.better: tuple[SpanResult, ...] = ()
        self._last_results: tuple[SpanResult, ...] = ()
        self._preview: tuple[SpanResult, OtherRun] | None = None
        self._gained_at = 0.0  #: seconds of the search up to its last gain
        self.search.start()
        self._started = monotonic()
        self.stopped = False  #: whether it was cancelled

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
    def first_behind(self) -> int | None:
        """The first tick behind a result in the present run; None if that has changed, so that no result fits.

        From it on the run is as it was after it reached the goal itself.
        """
        inputs = self.editor.track.inputs
        for begin, behind in reversed(self._fitting):
            if inputs == begin if self.task.rest else inputs.startswith(begin):
                return behind
        return None

    def put_into_run(self, result: SpanResult) -> bool:
        """Put a result into the run, as one edit; whether that was possible. Branches keep the earlier run, and it.

        A run that has changed so that the result does not fit becomes the searched run with the result. Cursor and
        selection keep their ticks; behind the span they move with the ticks that follow it.
        """
        editor, end = self.editor, self.task.first + result.ticks
        behind = self.first_behind
        contributions = self.contributions(result)
        old = behind is None
        track = self._searched_track if old else editor.track
        if behind is None:
            behind = self._fitting[0][1]
            contributions = track.made + contributions
        cursor, anchor = editor.cursor, editor.anchor
        new_track = self._track_with(track, result, behind)
        if new_track.inputs == editor.track.inputs:
            return True
        editor.session.keep_version(f"before {self.title}")
        editor.places[editor.track] = cursor, anchor
        edited = self._equal_run(result) is not None  # a person's keys were taken, no search has found them
        if not editor.attempt(lambda: editor.session.change(new_track, taken=contributions, whole=old, edited=edited)):
            return False
        editor.session.keep_version(self.title)
        if old:
            editor.app.notify("The run as it was searched, with this result. Undo, or Branches, has yours")
        self._fitting.append((new_track.inputs if self.task.rest else new_track.inputs[:end], end))
        if not isinstance(self.search, RunSearch):  # a result for a whole run replaces all ticks

            def moved(tick: int) -> int:
                return tick + end - behind if tick >= behind else min(tick, end - 1)

            editor.go(moved(cursor if anchor is None else anchor))
            editor.go(moved(cursor), select=anchor is not None)
        return True

    def _equal_run(self, result: SpanResult) -> OtherRun | None:
        """The other run that equals a result, if any."""
        if result.own_route or not result.inputs:
            return None
        ticks, keys = len(result.inputs), with_press_bits(result.inputs)
        same = (other for other in self._others if with_press_bits(fit_inputs(other.track.inputs, ticks)) == keys)
        return next(same, None)

    def _nearest_run(self, result: SpanResult) -> str:
        """The other run whose route is nearest to that of a result, in words."""

        def apart(other: OtherRun) -> float:
            theirs = other.trajectory.positions[min(self.task.first, len(other.trajectory) - 1) :]
            ticks = min(len(result.path), len(theirs))
            return float(np.hypot(*(result.path[:ticks] - theirs[:ticks]).T).mean())

        return f"like {min(self._others, key=apart).name}"

    def contributions(self, result: SpanResult) -> Contributions:
        """The contributions to a result: the search, and the authors whose routes may be in it."""
        equal = self._equal_run(result)
        if equal is not None:
            return equal.made
        routes = () if result.own_route else self._others
        command = "improve" if isinstance(self.search, RunSearch) else "search"
        return sum((other.made for other in routes), Contributions(commands=(command,)))

    def _track_with(self, track: InputTrack, result: SpanResult, behind: int) -> InputTrack:
        """The run with a result in it; with ``rest``, the run that reached the exit in the search."""
        first, keys = self.task.first, result.keys[: result.ticks].tolist()
        if self.task.goal == "won":  # keys behind an exit would take the run's claims away
            inputs = track.inputs[:first] + result.inputs[first:]
            return InputTrack(inputs, moved_markers(self.editor.session.recording(), inputs))
        if not self.task.rest:
            return track.replaced(first, behind, keys)
        end = int(min(result.score, len(result.inputs)))  # no keys behind the exit, if it is reached
        new_track = track.replaced(first, behind, keys)
        return InputTrack(track.inputs[:first] + result.inputs[first:], new_track.markers).up_to(end)

    def is_in_run(self, result: SpanResult) -> bool:
        ours, searched = self.editor.track.inputs, result.inputs
        return first_different_index(ours, searched) == min(len(ours), len(searched))

    def shown_run(self, result: SpanResult) -> OtherRun:
        if self._preview is None or self._preview[0] is not result:
            self._preview = result, self.editor.other_run("the result", InputTrack(result.inputs))
        return self._preview[1]

    # --- in words ---

    def refresh(self) -> None:
        results, miss = self.search.results, self.search.miss
        if not results and miss is not None:
            self.better = (miss,)
        if [*map(id, results)] == [*map(id, self._last_results)]:  # each report of a search is a new tuple
            return
        self._last_results, own = results, self.search.own
        if own is not None:
            self._fitting[0] = self._fitting[0][0], self.task.first + own.ticks
        # A RunSearch already gives all results that no other one beats.
        before = () if isinstance(self.search, RunSearch) else self.better
        better = [
            run
            for run in (*results, *before)  # new ones first: they may be tidier
            if run.missed_by is None
            and (own is None or run.score < own.score or (run.score == own.score and run.gold > own.gold))
        ]
        routes = distinct_routes(better, measured=bool(self.task.measure))[:KEPT]
        # A run beside that is only found again comes last.
        routes.sort(key=lambda run: self._equal_run(run) is not None)
        if [run.score for run in routes] != [run.score for run in self.better]:
            self._gained_at = self.search.seconds
        self.better = tuple(routes)

    def words(self, result: SpanResult) -> tuple[str, ...]:
        """Cells of a result: score, first tick with other keys, place and speed at the goal, gain."""
        own, words = self.search.own, score_text(self.task, result)
        if result.missed_by == 0.0:
            words += f": {self.shown_run(result).ending}"
        if self._to_exit and result.missed_by is None and result.gold != self._gold:  # of the run as it was
            words += f", {abs(self._gold - result.gold)} gold {'fewer' if result.gold < self._gold else 'more'}"
        if self._others and (isinstance(self.search, RunSearch) or not result.own_route):
            equal = self._equal_run(result)
            route = "own route" if result.own_route else f"this is {equal.name}" if equal else self._nearest_run(result)
            words = f"{words.removeprefix('exit in ')}, {route}"  # long names are truncated, gold is not
        gain = "new" if result.missed_by is None else "a miss"
        if own is not None:
            more = own.score - result.score
            gain = f"better by {more:.4g}" if self.task.measure else f"{counted(int(more), 'tick', 'ticks')} sooner"
        x, y, vx, vy = result.end
        other = first_different_index(result.inputs, self.task.inputs)
        return words, str(other), f"{x:.1f}, {y:.1f}", f"{hypot(vx, vy):.3f}", gain

    @property
    def found_nothing(self) -> bool:
        """Whether an earlier end was searched for a while without a gain, or all there is."""
        search, task = self.search, self.task
        patience = STALLED if any(run.missed_by is None for run in self.better) else PATIENCE
        late = search.seconds - self._gained_at > patience or not (self.running or self.stopped)
        sooner = not task.measure and (search.own is not None or task.rest or "won" in task.goal)
        fits = self.first_behind is not None and not isinstance(search, RunSearch)
        return bool(search.ticks_run and late and sooner and fits)

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
            whole = "" if self.running or isinstance(search, RunSearch) else " Try Whole run, in Presets."
            return f"Nothing better {yet}than the run's own keys: {score_text(self.task, search.own)}.{whole}"
        if not search.ticks_run:
            return COMPILING_SEARCHES if self.running else NOT_BEGUN
        return NOTHING_YET if self.running else NOTHING

    @property
    def advice(self) -> str:
        """The parts of the goal that the nearest miss lacks, with advice; "" if there is a result."""
        miss = next((result for result in self.better if result.missed_by is not None), None)
        if miss is None:
            return ""
        # A miss is simulated only if its end is shown: nearer misses come often during a search.
        to_exit = miss.missed_by == 0.0 or "won" in self.task.goal
        last = self.task.first + miss.ticks - 1
        ending = self.shown_run(miss).ending if to_exit else ""
        if miss.missed_by == 0.0:
            return f"With what follows the goal, {ending}. Try: {WITHOUT_REST.lower()}; or Same end, sooner."
        lacks = ", ".join(miss.missing) or score_text(self.task, miss).removeprefix("closest: ").partition(" after ")[0]
        shut = f"; {ending}" if "untouched" in ending else ""
        late = miss.ticks > 0.9 * self.task.length
        part = "; or a part of the goal alone" if miss.missing else ""
        remedy = "a longer span, it is nearest at its end" if late else "an earlier first tick"
        return f"Missing after tick {last}: {lacks}{shut}. Try: {remedy}{part}."

"""A search of a span of the run in the TAS editor, and what becomes of its results."""

from __future__ import annotations

from math import hypot
from time import monotonic

import numpy as np

from ninja_game.batch.thread_pool import cores
from ninja_game.play.tas.editor import OtherRun, TasEditor
from ninja_game.play.ui.theme import counted
from ninja_game.search.formula.background import SpanSearch
from ninja_game.search.formula.methods import KEPT
from ninja_game.search.formula.task import Found, SpanTask, score_in_words
from ninja_game.tas.input_track import InputTrack, first_difference
from ninja_game.tas.timeline import Timeline

CLOSING_SECONDS = 0.5
"""How long a search that is cancelled is waited for when the TAS editor is left."""


COMPILING = "The rules are made ready. On a machine that has never searched this takes a minute or two."
NOT_BEGUN = "Stopped before it began. The rules are still made ready, for the next search."
NOTHING_YET = "Nothing yet."
NOTHING = "The goal was not reached. More time, a longer span or another method may reach it."


class SpanResults:
    """Runs a task in the background, and puts results into the run, while nothing that they rely on has changed.

    ``better``: the results that bring more than the run's own keys, best first; of those that end alike the best one.
    Raises what SpanSearch does.
    """

    def __init__(self, editor: TasEditor, task: SpanTask, method: str, every: int) -> None:
        self.editor = editor
        self.task = task
        memory = editor.session.timeline.memory
        self.search = SpanSearch(task, method, max(1, cores() - 1), every=every, memory=memory)
        # The begins of runs that results fit to, and the first tick that follows a result in each: the run that is
        # searched and those that results were put into.
        whole = len(task.inputs) if task.rest else task.last
        self._fitting = [(task.inputs[:whole], task.last)]
        self.better: tuple[Found, ...] = ()
        self._seen: tuple[Found, ...] = ()
        self._preview: tuple[Found, OtherRun] | None = None
        self.search.start()
        self._started = monotonic()

    @property
    def running(self) -> bool:
        """Whether it still searches."""
        return not self.search.done

    def stop(self) -> None:
        """End the search; results stay."""
        self.search.cancel()

    def close(self) -> None:
        """End the search and wait for it."""
        self.search.cancel()
        self.search.finish(CLOSING_SECONDS)

    @property
    def behind(self) -> int | None:
        """The first tick behind a result that is put into the run as it is now; None: it was changed, and none fits.

        As with the rest of a run, what follows is what the run did after its own moment at the goal.
        """
        inputs = self.editor.track.inputs
        for begin, behind in reversed(self._fitting):
            if inputs == begin if self.task.rest else inputs.startswith(begin):
                return behind
        return None

    def put(self, found: Found) -> bool:
        """Put a result into the run, as one edit, and select it; whether that was possible."""
        behind = self.behind
        if behind is None:
            self.editor.app.notify("The run was changed: search again")
            return False
        made = self._made(self.editor.track, found, behind)
        if not self.editor.edit(lambda _: made):
            return False
        end = self.task.first + found.ticks
        self._fitting.append((made.inputs if self.task.rest else made.inputs[:end], end))
        self.editor.select(self.task.first, end)
        return True

    def _made(self, track: InputTrack, found: Found, behind: int) -> InputTrack:
        """The run with a result in it; with ``rest`` it is the run that reached the exit in the search."""
        first, keys = self.task.first, found.keys[: found.ticks].tolist()
        if not self.task.rest:
            return track.replaced(first, behind, keys)
        rest = len(found.inputs) - first - found.ticks
        made = track.replaced(first, len(track) - rest, keys)
        return InputTrack(track.inputs[:first] + found.inputs[first:], made.markers)

    def preview(self, found: Found) -> OtherRun:
        """The run that a result makes, to be looked at."""
        if self._preview is None or self._preview[0] is not found:
            task = self.task
            timeline = Timeline(task.level, found.inputs, body=task.body, memory=self.editor.session.timeline.memory)
            timeline.simulate(len(found.inputs))
            self._preview = found, OtherRun("result", InputTrack(found.inputs), timeline.trajectory())
        return self._preview[1]

    # --- in words ---

    def refresh(self) -> None:
        """Take what was found since."""
        found = self.search.found
        if found is self._seen:
            return
        self._seen, own = found, self.search.own
        if own is not None:
            self._fitting[0] = self._fitting[0][0], self.task.first + own.ticks
        different: dict[object, Found] = {}
        for each in sorted([*self.better, *found]):
            if own is None or each.score < own.score:
                different.setdefault((each.gold, *np.round(each.end, 2)), each)
        self.better = tuple(different.values())[:KEPT]

    def words(self, found: Found) -> tuple[str, ...]:
        """What a better result brings; from where on it has other keys; place and speed at the goal; what it gains."""
        own, words = self.search.own, score_in_words(self.task, found)
        if own is not None and self.task.rest and found.gold < own.gold:
            words += f", {own.gold - found.gold} gold fewer"
        gain = "new"
        if own is not None:
            more = own.score - found.score
            gain = f"better by {more:.4g}" if self.task.measure else f"{counted(int(more), 'tick', 'ticks')} sooner"
        x, y, vx, vy = found.end
        other = first_difference(found.inputs, self.task.inputs)
        return words, str(other), f"{x:.1f}, {y:.1f}", f"{hypot(vx, vy):.3f}", gain

    @property
    def status(self) -> str:
        """How it stands, in a few words."""
        search = self.search
        if search.problem:
            return "cannot be searched"
        if not search.ticks_run:
            return f"getting ready: {monotonic() - self._started:.0f} s" if self.running else "ended"
        doing = "searching" if self.running else "ended"
        return f"{doing}: {search.ticks_run / 1e6:.1f} million ticks, {search.seconds:.0f} s"

    @property
    def note(self) -> str:
        """What is to be said where there is no result."""
        search = self.search
        if search.problem or self.better:
            return search.problem
        if search.own is not None:
            yet = "yet " if self.running else ""
            return f"Nothing better {yet}than the run's own keys: {score_in_words(self.task, search.own)}."
        if not search.ticks_run:
            return COMPILING if self.running else NOT_BEGUN
        return NOTHING_YET if self.running else NOTHING

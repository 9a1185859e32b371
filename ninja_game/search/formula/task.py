"""The task of a span search, and the trial of keys for it: many worlds at once, tick by tick."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Batch, Keys
from ninja_game.errors import ArgumentError
from ninja_game.search.certificate import without_idle_keys
from ninja_game.search.formula.language import UNTRUE, Formula, FormulaError, FormulaValues, parse_measure, parse_truth
from ninja_game.search.formula.names import FACTS, SPAN_NAMES, UNREACHABLE, difference_from, distance_views, view_of
from ninja_game.sim.inputs import KEYS_DOWN, with_press_bits
from ninja_game.sim.level import Body, Level
from ninja_game.sim.states import OUTCOME_EXIT, OUTCOME_RUNNING

MAX_SPAN = 4000  # most ticks of a span


@dataclass(frozen=True)
class SpanTask:
    """A search for keys in the ticks ``first`` … ``last`` - 1 of a run that reach a goal with the best measure.

    ``rest``: after the goal, play the inputs that follow in the run after its own first tick at the goal; the exit must
    still be reached, as early as possible.

    Raises FormulaError for a broken formula, ArgumentError for a span outside the run.
    """

    level: Level
    inputs: bytes  #: the run, one byte per tick
    first: int
    last: int
    goal: str = ""  #: a formula that must be true after one of these ticks; "": every run reaches it, after the last
    measure: str = ""  #: a formula to be as great as possible at that tick; "": the goal as early as possible
    least: bool = False  #: the measure should be as small as possible
    rest: bool = False
    body: Body = "circle"
    behind: int = 0  #: the tick of the run from which the rest is played, if it has no goal; 0: the end of the span
    others: tuple[bytes, ...] = ()  #: other runs of the level, along which ways to the exit are searched too

    def __post_init__(self) -> None:
        if not 0 <= self.first < self.last <= self.first + MAX_SPAN:
            expected = f"expected a later tick, at most {MAX_SPAN} later"
            raise ArgumentError(f"a span from tick {self.first} to {self.last}; {expected}")
        if self.first > len(self.inputs):
            raise ArgumentError(f"the span begins in tick {self.first}, the run ends in tick {len(self.inputs) - 1}")
        if self.rest and self.measure:
            raise ArgumentError("with the rest of the run its length is the measure; leave the other one out")

    @property
    def length(self) -> int:
        return self.last - self.first

    @property
    def base(self) -> Keys:
        keys = np.frombuffer(self.inputs[self.first : self.last], np.uint8) & KEYS_DOWN
        return np.pad(keys, (0, self.length - len(keys)))

    def check(self) -> None:
        """Raise FormulaError for a broken formula, ArgumentError for an object that is missing or of the wrong kind."""
        view = view_of(Batch(self.level, 1, body=self.body, memory="plain")) | {"difference": lambda _: np.zeros(1)}
        with np.errstate(all="ignore"):
            for formula in filter(None, self.formulas()):
                formula.value(view)

    def formulas(self) -> tuple[Formula, Formula | None]:
        """Goal and measure. Raises FormulaError; its text tells which of the two is wrong."""
        what = "goal"
        try:
            goal = parse_truth(self.goal or f"tick >= {self.last - 1}", SPAN_NAMES, FACTS)
            what = "measure"
            return goal, parse_measure(self.measure, SPAN_NAMES, FACTS) if self.measure else None
        except FormulaError as error:
            error.file = what
            raise


@dataclass(order=True)
class SpanResult:
    """Keys that reach the goal, or come near it. Results are ordered: the smaller, the better.

    ``score``: minus the measure (with ``least``: the measure), or the ticks to the goal or exit. ``ticks``: ticks of
    the span up to the goal. ``inputs``: the whole run with these keys, up to the goal or to its end. ``gold``: pieces
    at the end. ``end``: x, y (px), vx, vy (px/tick) at the goal. ``own_route``: no other run's route is part of it.
    ``missed_by``: None if the goal was reached; otherwise the remaining margin, 0 if only the exit after the goal was
    missed. A miss takes the tick nearest to the goal for the goal; ``missing``: parts of an ``and`` goal that
    were not true then. ``path``: the ninja after each tick up to the goal, float (ticks, 2), px; empty for a miss.
    """

    score: float
    ticks: int
    keys: Keys = field(compare=False, repr=False)  #: keys of the span up to the goal
    inputs: bytes = field(compare=False, repr=False, default=b"")
    gold: int = field(compare=False, default=0)
    end: tuple[float, ...] = field(compare=False, default=(0.0,) * 4)
    own_route: bool = field(compare=False, default=True)
    missed_by: float | None = field(compare=False, default=None)
    path: NDArray[np.floating] = field(compare=False, repr=False, default_factory=lambda: np.zeros((0, 2)))
    missing: tuple[str, ...] = field(compare=False, default=())


def without_useless_keys(task: SpanTask, result: SpanResult) -> SpanResult:
    """Remove keys that do nothing from a result (``without_idle_keys``)."""
    first, last = task.first, task.first + result.ticks
    inputs = without_idle_keys(
        task.level, result.inputs, with_press_bits(task.inputs), body=task.body, first=first, last=last
    )
    keys = result.keys.copy()
    keys[: result.ticks] = np.frombuffer(inputs[first:last], np.uint8) & KEYS_DOWN
    return replace(result, keys=keys, inputs=inputs)


SAME_ROUTE_PX, SAME_ROUTE_TICKS = 24.0, 6
"""Two runs take the same route if neither is farther than this from the other, px, within this many ticks."""


def distinct_routes(results: Iterable[SpanResult], *, measured: bool) -> list[SpanResult]:
    """Keep the best result of each route, best first; with a measure, none that another beats in score and in tick."""
    routes: list[SpanResult] = []
    for result in sorted(results):
        beaten = measured and any(route.score < result.score and route.ticks < result.ticks for route in routes)
        if not beaten and not any(_is_same_route(route, result) for route in routes):
            routes.append(result)
    return routes


def _is_same_route(one: SpanResult, other: SpanResult) -> bool:
    if (one.own_route, one.gold) != (other.own_route, other.gold) or abs(one.ticks - other.ticks) > SAME_ROUTE_TICKS:
        return False
    if not len(one.path) or not len(other.path):
        return not len(one.path)
    ticks = np.arange(len(one.path))[:, np.newaxis] + np.arange(-SAME_ROUTE_TICKS, SAME_ROUTE_TICKS + 1)
    there = other.path[np.clip(ticks, 0, len(other.path) - 1)]
    apart = np.abs(there - one.path[:, np.newaxis]).max(2)  # px in x or y, by tick of the one and ticks around it
    return bool((apart.min(1) <= SAME_ROUTE_PX).all())


def target_of(task: SpanTask) -> int | None:
    """The slot of the object that the goal wants taken or opened, 0 for the exit, None for any other goal."""
    match = _match_target(task.goal)
    return match and int(match[1] or -1) + 1


def _match_target(goal: str) -> re.Match[str] | None:
    return re.fullmatch(r"won|(?:taken|opened)\((\d+)\)", goal.replace(" ", ""))


def _short_text(goal: str, margin: float) -> str:
    """The distance to a goal, or to a part of one."""
    if margin == UNREACHABLE:
        return "no way"
    return f"{-margin - 1.0:.0f} px" if _match_target(goal) else f"{-margin:.3g} short"


def score_text(task: SpanTask, result: SpanResult) -> str:
    """Describe the result of a search in words."""
    last = task.first + result.ticks - 1
    if result.missed_by == 0.0:
        return f"goal after tick {last}, but not the exit"
    if result.missed_by is not None:
        short = ", ".join(result.missing) or _short_text(task.goal, -result.missed_by)
        return f"closest: {short} after tick {last}"
    if task.rest:
        return f"exit in tick {result.score - 1:.0f}"
    if task.goal == "won":
        return f"exit in tick {last}"
    if task.measure:
        return f"{task.measure} is {result.score if task.least else -result.score:.6g} after tick {last}"
    return f"goal after tick {last}"


@dataclass
class Trials:
    """The results of many key sequences: score (infinite: goal missed), ticks to the goal, best margin on the way.

    ``ends``: x, y (px), vx, vy (px/tick) at the goal.
    """

    scores: FormulaValues
    ticks: NDArray[np.int64]
    margins: FormulaValues
    ends: FormulaValues

    @property
    def order(self) -> NDArray[np.intp]:
        """Indices of the trials, best first: those that reach the goal by score, then the others by margin."""
        return np.lexsort((-self.margins, self.scores))


class SpanWorlds:
    """Many worlds at the start of a span."""

    def __init__(self, task: SpanTask, count: int, *, memory: str = "auto", threads: int | None = None) -> None:
        self.task = task
        self.batch = Batch(task.level, count, body=task.body, memory=memory, threads=threads)
        difference = {"difference": difference_from(task.level, task.inputs, self.batch)}
        self.view = view_of(self.batch) | distance_views(task.level, self.batch) | difference
        self.goal, self.measure = task.formulas()
        before = np.frombuffer(task.inputs[: task.first], np.uint8)
        single = Batch(task.level, 1, body=task.body, memory=memory)
        single.run(before[:, np.newaxis], stop=True)
        if single.outcomes[0]:
            raise ArgumentError(f"the run is over before tick {task.first}")
        self.start = single.save([0] * count)
        self.batch.restore(self.start)
        self.ticks_run = task.first
        self.miss: SpanResult | None = None
        self._nearest = -np.inf
        self._paths = np.zeros((task.length, count, 2), np.float32)
        self.rest: Keys = np.zeros(0, np.uint8)
        own = int(self._try(np.tile(task.base[:, np.newaxis], (1, count))).ticks[0]) if task.rest and task.goal else 0
        self.miss, self._nearest = None, -np.inf  # the miss of the run's own keys ignored the rest
        self.rest = np.frombuffer(
            task.inputs[task.first + own if own else task.behind or task.last :], np.uint8
        ) & np.uint8(KEYS_DOWN)

    def measured(self) -> tuple[NDArray[np.bool_], FormulaValues, FormulaValues]:
        """Whether the worlds are at the goal now, their margins, their scores: an array each."""
        with np.errstate(all="ignore"):
            at_goal = np.broadcast_to(self.goal.value(self.view) > 0, (self.batch.count,))
            margin = np.nan_to_num(np.broadcast_to(self.goal.margin(self.view), at_goal.shape), nan=-np.inf)
            if self.measure is None:
                score = self.batch.ticks.astype(float)
            else:
                value = np.broadcast_to(self.measure.value(self.view), at_goal.shape)
                # A value that does not exist, such as 1 / 0, is not a result.
                score = np.where(np.isfinite(value), value if self.task.least else -value, np.inf)
        return at_goal, margin, score

    def result_of(
        self, index: int, keys: Keys, score: float, ticks: int, end: list[float], missed_by: float | None = None
    ) -> SpanResult:
        """Make a result, or a miss, of the keys of a world."""
        rest = self.rest.tolist() if self.task.rest else []
        run = with_press_bits([*self.task.inputs[: self.task.first], *keys[:ticks].tolist(), *rest])
        # The path of a miss is unknown: a beam continues from copies of other worlds.
        path = self._paths[: ticks if missed_by is None else 0, index].copy()
        gold = int(self.batch.gold[index])
        return SpanResult(score, ticks, keys.copy(), run, gold, tuple(end), missed_by=missed_by, path=path)

    def note_miss(self, margins: FormulaValues, keys: Keys, ticks: int) -> None:
        """Keep the living world nearest to the goal after ``ticks`` ticks of the span, if none was nearer before.

        It must be nearer than the start of the span, which is not a result.
        """
        batch = self.batch
        living = np.where(batch.outcomes == OUTCOME_RUNNING, np.minimum(margins, 0.0), -np.inf)
        index = int(np.argmax(living))
        if living[index] > self._nearest and living[index] not in (UNTRUE, UNREACHABLE):
            self._nearest = living[index]
            end = [*batch.positions[index].tolist(), *batch.velocities()[index].tolist()]
            own = np.array_equal(keys[:ticks, index], self.task.base[:ticks])
            result = self.result_of(index, keys[:, index], np.inf, ticks, end, abs(float(living[index])))
            self.miss = None if own else replace(result, missing=self._missing(index))

    def _missing(self, index: int) -> tuple[str, ...]:
        """The parts of the goal that are not true in a world, and how far it is to each."""

        def there(values: FormulaValues) -> float:
            return float(np.broadcast_to(values, (self.batch.count,))[index])

        with np.errstate(all="ignore"):
            left = [(text, part) for text, part in self.goal.parts if not there(part.value(self.view)) > 0]
            return tuple(f"{text}: {_short_text(text, there(part.margin(self.view)))}" for text, part in left)

    def try_all(self, keys: Keys) -> Trials:
        """Play keys, (ticks of the span, worlds), from the start of the span."""
        trials = self._try(keys)
        if self.task.rest:
            self._play_rest(keys, trials)
        return trials

    def _try(self, keys: Keys) -> Trials:
        """Play keys in the span itself and measure every tick."""
        batch, count = self.batch, self.batch.count
        batch.restore(self.start)
        trials = Trials(
            np.full(count, np.inf), np.zeros(count, np.int64), np.full(count, -np.inf), np.zeros((count, 4))
        )
        for tick in range(self.task.length):
            self.ticks_run += batch.run(keys[np.newaxis, tick], stop=True, press=True)
            at_goal, margin, score = self.measured()
            self._paths[tick] = batch.positions
            self.note_miss(margin, keys, tick + 1)
            np.maximum(trials.margins, margin, out=trials.margins)
            better = at_goal & (score < trials.scores)
            trials.scores[better] = score[better]
            trials.ticks[better] = tick + 1
            if better.any():
                trials.ends[better] = np.column_stack([batch.positions[better], batch.velocities()[better]])
            if self.measure is None and (trials.ticks > 0).all():
                break
        return trials

    def _play_rest(self, keys: Keys, trials: Trials) -> None:
        """Play on with the rest of the run; the score becomes the tick of the exit."""
        batch, task = self.batch, self.task
        batch.restore(self.start)
        following = self.rest
        total = task.length + len(following)
        padded = np.vstack([keys, np.zeros((len(following), batch.count), np.uint8)])
        # A world continues with the rest as soon as it has reached the goal.
        when = np.arange(total)[:, np.newaxis] - trials.ticks
        reached = trials.ticks > 0
        rest = np.append(following, 0)[np.clip(when, 0, len(following))]
        played = np.where((when >= 0) & reached, rest, padded).astype(np.uint8)
        self.ticks_run += batch.run(played, stop=True, press=True)
        passed = (batch.outcomes == OUTCOME_EXIT) & reached
        trials.scores[:] = np.where(passed, batch.ticks, np.inf)
        trials.margins[:] = np.where(reached & ~passed, 0.0, trials.margins)


def own_tick(task: SpanTask) -> int | None:
    """The tick after which the run itself reaches the goal, in the span or behind it; None if it never does."""
    last = min(task.first + MAX_SPAN, max(task.last, len(task.inputs)))
    whole = replace(task, last=last, measure="", rest=False)
    ticks = int(SpanWorlds(whole, 1, threads=1).try_all(whole.base[:, np.newaxis]).ticks[0])
    return task.first + ticks - 1 if ticks else None


ReportResults = Callable[[int, tuple[SpanResult, ...]], bool]
"""Gets the ticks run so far and the best results so far, best first; returning False ends the search."""

ReportMiss = Callable[[SpanResult], object]  # gets the nearest result as long as nothing has reached the goal

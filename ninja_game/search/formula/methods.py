"""Methods to search a span: small changes of its keys, beams of the most promising states, all possible keys."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import compiled
from ninja_game.batch.batch import Batch, Keys
from ninja_game.errors import ArgumentError
from ninja_game.search.formula.leg import LegSearch, OtherRoutes
from ninja_game.search.formula.task import (
    ReportMiss,
    ReportResults,
    SpanResult,
    SpanTask,
    SpanWorlds,
    Trials,
    distinct_routes,
    target_of,
)
from ninja_game.search.local_search import mutate
from ninja_game.search.nodes import RandomState, random_below, zeroed
from ninja_game.sim.level import Body, Level
from ninja_game.sim.schema.declare import kernel
from ninja_game.sim.states import OUTCOME_RUNNING

METHODS = ("local", "beam", "exhaustive")

WORLDS = 1024  # worlds that are tried at once
KEPT = 8  # results that are kept
_ACTIONS = np.array([0, 1, 2, 4, 5, 6], np.uint8)  # left, right or neither, each with and without jump
ROUNDS, ROUNDS_BESIDE_LEGS = 40, 4
"""Rounds of small changes per turn; the second number holds while nothing is found and LegSearch is more useful."""
TURNS_BESIDE = 6  # Searches along other runs per turn. Not tuned.
REPORT_TICKS = 100_000  # ticks of a beam between two reports: a second on a slow machine
_STEPS = (4, 6, 3, 8, 2, 12, 1)  # ticks between two choices of a beam, one step size per beam
_MAX_ENDS = 2_000_000  # number of key sequences up to which all are tried


@kernel
def mutate_rows(rows: Keys, length: int, source: list[RandomState]) -> None:
    """Change each row of keys by one or more small edits."""
    for index in range(len(rows)):
        row = rows[index]
        mutate(row, length, random_below(source[0], length), source[0])
        while random_below(source[0], 2):
            mutate(row, length, random_below(source[0], length), source[0])


def _kernel_rng(seed: int) -> list[RandomState]:
    source: list[RandomState] = zeroed(RandomState, 1)
    source[0].random = seed
    return source


class Results:
    """The best keys so far, and for ``report`` the best of each route; until there are any, the miss."""

    def __init__(self, worlds: SpanWorlds, report: ReportResults, report_miss: ReportMiss) -> None:
        self.worlds = worlds
        self.best: tuple[SpanResult, ...] = ()
        self.routes: tuple[SpanResult, ...] = ()
        self.going = True
        self._report, self._report_miss = report, report_miss

    def try_all(self, keys: Keys, *, own_route: bool = True) -> Trials:
        """Try keys, (ticks, worlds), and keep the good ones. ``going`` then tells whether to continue.

        ``own_route``: as in SpanResult.
        """
        trials = self.worlds.try_all(keys)
        for index in trials.order[:KEPT]:
            if not np.isfinite(trials.scores[index]):
                break
            of_trial = float(trials.scores[index]), int(trials.ticks[index]), trials.ends[index].tolist()
            result = replace(self.worlds.result_of(int(index), keys[:, index], *of_trial), own_route=own_route)
            if any(np.array_equal(result.keys[: result.ticks], old.keys[: old.ticks]) for old in self.best):
                continue
            self.best = tuple(sorted([*self.best, result])[:KEPT])
            measured = self.worlds.measure is not None
            self.routes = tuple(distinct_routes([*self.routes, result], measured=measured)[:KEPT])
        self.report()
        return trials

    def try_some(self, keys: list[Keys], *, own_route: bool = True) -> None:
        """Try a few arrays of keys, each for the whole span."""
        self.try_all(np.stack((keys * (WORLDS // len(keys) + 1))[:WORLDS], axis=1), own_route=own_route)

    def spend(self, ticks: int) -> bool:
        """Count ticks that were run elsewhere; true if the search must end."""
        self.worlds.ticks_run += ticks
        self.report()
        return not self.going

    def report(self) -> None:
        if self.worlds.miss is not None and not self.best:
            self._report_miss(self.worlds.miss)
        self.going = self._report(self.worlds.ticks_run, self.routes)


def search_span(
    task: SpanTask,
    report: ReportResults,
    *,
    method: str = "auto",
    every: int = 1,
    seed: int = 1,
    memory: str = "auto",
    threads: int | None = None,
    report_miss: ReportMiss = lambda _: None,
) -> tuple[SpanResult, ...]:
    """Find the best keys of each route, best first, at most KEPT; none if nothing reached the goal.

    ``method``: one of METHODS, or "auto": a beam, then small changes of its results, again and again. On the compiled
    memory "auto" also searches along the task's other runs (OtherRoutes) and, while nothing is found, uses the solver
    (LegSearch). ``every``: how many ticks a choice of keys holds in "exhaustive". ``report`` is called first when
    everything is compiled; the search continues until it returns False, "exhaustive" only until all is tried.
    ``report_miss`` gets, with each report, the nearest result as long as nothing reaches the goal. The same seed does
    the same work in the same order. Raises ArgumentError for a span with too many ways through it, and the errors of
    SpanTask.
    """
    if method == "exhaustive":
        count_ways(task, every)
    worlds = SpanWorlds(task, WORLDS, memory=memory, threads=threads)
    mutated = compiled(mutate_rows) if worlds.batch.memory == "compiled" else mutate_rows
    mutated(np.zeros((1, 1), np.uint8), 1, _kernel_rng(1))
    solves = method == "auto" and worlds.batch.memory == "compiled"
    target = target_of(task) if solves else None
    legs = None if target is None else LegSearch(task, target, seed)
    along = OtherRoutes(task, seed) if task.others and solves else None
    results = Results(worlds, report, report_miss)
    rng = np.random.default_rng(seed)
    results.try_all(np.tile(task.base[:, np.newaxis], (1, WORLDS)))
    if method == "exhaustive":
        exhaust(task, every, results)
    turn = 0
    while results.going and method != "exhaustive":
        for _ in range(TURNS_BESIDE if along else 0):
            if along and results.going and (keys := along.search(results.spend)):
                results.try_some(keys, own_route=False)
        if method != "local":
            beam(task, _STEPS[turn % len(_STEPS)], results, rng, noise=0.1 * (turn // len(_STEPS)))
        if legs and not results.best and results.going and (keys := legs.search(results.spend)):
            results.try_some(keys)
        if method != "beam" and results.going:
            change(task, mutated, results, rng, ROUNDS if results.best or not legs else ROUNDS_BESIDE_LEGS)
        turn += 1
    return results.routes


CUTS = 20, 60, 180, 540  # numbers of last ticks of a run that are left out, one after the other
WAY_TICKS = 600  # ticks after the cut within which the exit must be reached


def to_exit(
    level: Level,
    inputs: bytes,
    seconds: float,
    *,
    body: Body = "circle",
    seed: int = 1,
    threads: int | None = None,
    goes_on: Callable[[int], bool] = lambda _: True,
) -> bytes | None:
    """Find a run to the exit that begins like a run that ends before it; ever more of its last ticks are replaced.

    None if there is none in the time. ``goes_on`` gets the ticks that were run; False ends the search.
    """
    for cut in CUTS:
        first = max(0, len(inputs) - cut)
        began: list[float] = []

        def report(ticks: int, results: tuple[SpanResult, ...], began: list[float] = began) -> bool:
            began.append(time.monotonic())
            return goes_on(ticks) and not results and began[-1] - began[0] < seconds / len(CUTS)

        task = SpanTask(level, inputs, first, first + WAY_TICKS, goal="won", body=body)
        if results := search_span(task, report, seed=seed, threads=threads):
            return results[0].inputs
    return None


def count_ways(task: SpanTask, every: int) -> int:
    """Count the ways through a span. Raises ArgumentError for too many; the message has the limit."""
    choices = -(-task.length // every)
    if len(_ACTIONS) ** choices > _MAX_ENDS:
        few = fewest_ticks(task.length)
        what = f"{task.length} ticks with a choice every {every} have over {_MAX_ENDS:,} ways through"
        raise ArgumentError(f"{what}; a choice every {few} ticks has few enough")
    return int(len(_ACTIONS) ** choices)


def exhaust(task: SpanTask, every: int, results: Results) -> None:
    """Try all keys that change every ``every`` ticks."""
    ends, choices = count_ways(task, every), -(-task.length // every)
    weights = len(_ACTIONS) ** np.arange(choices)[:, np.newaxis]
    for first in range(0, ends, WORLDS):
        numbers = np.arange(first, first + WORLDS) % ends
        digits = numbers // weights % len(_ACTIONS)
        results.try_all(np.repeat(_ACTIONS[digits], every, axis=0)[: task.length])
        if not results.going:
            return


def change(
    task: SpanTask, mutated: Callable[..., None], results: Results, rng: np.random.Generator, rounds: int
) -> None:
    """Change keys a little, many ways at once, and go on from the best of them."""
    source = _kernel_rng(int(rng.integers(1, 1 << 62)))
    chosen = results.best[int(rng.integers(len(results.best)))] if results.best else None
    own_route = chosen is None or chosen.own_route
    current, standing = (chosen.keys if chosen else task.base).copy(), (np.inf, np.inf)
    for _ in range(rounds):
        rows = np.tile(current, (WORLDS, 1))
        mutated(rows[1:], task.length, source)
        trials = results.try_all(rows.T.copy(), own_route=own_route)
        best = int(trials.order[0])
        reached = (float(trials.scores[best]), -float(trials.margins[best]))
        if reached <= standing:
            # Accept equally good keys, too, so that the search does not get stuck.
            others = np.flatnonzero((trials.scores == reached[0]) & (-trials.margins == reached[1]))
            current, standing = rows[int(rng.choice(others))].copy(), reached
        if not results.going:
            return


def beam(task: SpanTask, step: int, results: Results, rng: np.random.Generator, noise: float) -> None:
    """Go through the span in steps of ``step`` ticks, with all actions at each, and keep the most promising states."""
    worlds, batch = results.worlds, results.worlds.batch
    batch.restore(worlds.start)
    survivors, reported = np.zeros(1, np.intp), worlds.ticks_run
    keys = np.zeros((task.length, batch.count), np.uint8)
    sequences: list[Keys] = []
    for tick in range(0, task.length, step):
        parents = np.repeat(survivors, len(_ACTIONS))[: batch.count]
        chosen = np.tile(_ACTIONS, len(survivors))[: len(parents)]
        used = np.arange(len(parents))
        batch.copy(parents, used)
        keys[:, used] = keys[:, parents]
        ticks = min(step, task.length - tick)
        keys[tick : tick + ticks, used] = chosen
        margin = score = np.zeros(0)
        for played in range(ticks):
            worlds.ticks_run += batch.run(keys[np.newaxis, tick + played], stop=True, press=True)
            at_goal, margin, score = worlds.measured()
            worlds.note_miss(margin, keys, tick + played + 1)
            for index in np.flatnonzero(at_goal[used])[:KEPT]:
                ended = keys[:, index].copy()
                ended[tick + played + 1 :] = 0
                sequences.append(ended)
        if worlds.ticks_run - reported >= REPORT_TICKS:
            reported = worlds.ticks_run
            results.report()
        promising = (margin if worlds.measure is None else -score) * rng.normal(1.0, noise, len(margin))
        alive = used[batch.outcomes[used] == OUTCOME_RUNNING]
        halves = [alive[np.argsort(-scores[alive], kind="stable")] for scores in (margin, promising)]
        survivors = _different(batch, halves, batch.count // len(_ACTIONS))
        if not len(survivors) or not results.going:
            break
    if sequences:
        picked = [sequences[int(index)] for index in rng.permutation(len(sequences))[:WORLDS]]
        picked[:KEPT] = sequences[-KEPT:]
        results.try_some(picked)
    else:
        results.report()


def _different(batch: Batch, orders: list[NDArray[np.intp]], most: int) -> NDArray[np.intp]:
    """Take the first worlds of some orders, in turn, without worlds in about the same state."""
    velocity = batch.velocities()
    in_air = batch.records["ninja"]["in_air"]
    cells = np.column_stack([np.floor(batch.positions / 4), np.floor(velocity * 4), batch.states, batch.gold, in_air])
    seen: set[bytes] = set()
    chosen = []
    for index in np.column_stack(orders).ravel().tolist() if orders[0].size else ():
        cell = cells[index].tobytes()
        if cell not in seen:
            seen.add(cell)
            chosen.append(index)
            if len(chosen) == most:
                break
    return np.array(chosen, np.intp)


def fewest_ticks(length: int) -> int:
    """The least ticks that a choice of keys must hold so that all ways through a span can be tried.

    >>> fewest_ticks(8), fewest_ticks(40)
    (1, 5)
    """
    return next(every for every in range(1, length + 1) if len(_ACTIONS) ** -(-length // every) <= _MAX_ENDS)

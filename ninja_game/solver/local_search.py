"""Local improvement of a run: random mutations, played from the save-state before the first changed tick.

A run is kept if it is shorter; of runs of equal length that which is deeper in the exit's disc in the last tick, a
measure between two ticks. Now and then a slightly longer one is kept too, to get out of dead ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.compile_cache import compiled
from ninja_game.sim.inputs import press_jumps, pressed
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.memory.declare import entry_point, f8, fast, i8, struct
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.states import OUTCOME_EXIT, OUTCOME_RUNNING
from ninja_game.sim.world import step
from ninja_game.solver.mutations import Keys, mutate
from ninja_game.solver.search_memory import RandomState, Start, Words, random_below, zeroed

CHECKPOINT = 8
"""Ticks between the save-states of the current run."""
ROOM = 64
"""Ticks by which a current run may be longer than the run that the local search began with."""
LEASH = 90.0
"""Px; a trial run that is farther from the current run's path is given up."""


@struct
class LocalCounters(RandomState):
    """Where a local search stands. A score is in ticks, see ``score_of``."""

    ticks: i8  #: of the current run
    score: f8
    best_ticks: i8  #: of the best run
    best_score: f8
    trials: i8  #: runs tried
    played: i8  #: ticks simulated


class Runs(NamedTuple):
    """The best, the current and the trial run, one byte a tick without trigger bit; more about the current one."""

    best: Keys
    current: Keys
    trial: Keys
    path: NDArray[np.float64]  #: px, after each tick of the current run
    checkpoints: NDArray[np.int64]  #: its save-states, as words
    counters: Sequence[LocalCounters]


@fast
def score_of(w: World) -> float:
    """Ticks of a run that has just ended at the exit, less the depth of the contact (0 to 0.99)."""
    n = w.ninja
    nearest = 22.0
    for slot in range(1, w.id_count + 1):
        o = w.objects[slot]
        if o.kind == EXIT and o.is_open:
            nearest = min(nearest, sqrt((o.x - n.x) * (o.x - n.x) + (o.y - n.y) * (o.y - n.y)))
    return float(w.tick) - 0.99 * (1.0 - nearest / 22.0)


@fast
def copy_words(target: Words, source: Words) -> None:
    """Copy a save-state."""
    for k in range(len(target)):
        target[k] = source[k]


@entry_point
def retrace(start: Start, runs: Runs, tick: int, limit: int) -> int:
    """Play the current run on from the checkpoint at or before ``tick``: its path and checkpoints; its ticks.

    0 if it does not reach the exit before ``limit``.
    """
    w = start.worlds[1]
    first = min(tick, limit - 1) // CHECKPOINT
    copy_words(start.work_words, start.base if first == 0 else runs.checkpoints[first])
    for k in range(first * CHECKPOINT, limit):
        if k % CHECKPOINT == 0:
            copy_words(runs.checkpoints[k // CHECKPOINT], start.work_words)
        step(start.levels[0], w, pressed(runs.current[k], w.ninja.jump_held))
        runs.path[k, 0] = w.ninja.x
        runs.path[k, 1] = w.ninja.y
        if w.outcome != OUTCOME_RUNNING:
            return int(w.tick) if w.outcome == OUTCOME_EXIT else 0
    return 0


@fast
def try_run(level: TileMap, w: World, runs: Runs, first: int, shift: int, limit: int) -> int:
    """Play the trial run from tick ``first`` on; the ticks played. It is given up far from the current run's path."""
    path = runs.path
    ticks = runs.counters[0].ticks
    for k in range(first, limit):
        step(level, w, pressed(runs.trial[k], w.ninja.jump_held))
        if w.outcome != OUTCOME_RUNNING:
            return k + 1 - first
        if k % 8 == 7:
            now = min(k, ticks - 1)
            then = min(max(k + shift, 0), ticks - 1)
            near = abs(w.ninja.x - path[now, 0]) + abs(w.ninja.y - path[now, 1])
            if near > LEASH and abs(w.ninja.x - path[then, 0]) + abs(w.ninja.y - path[then, 1]) > LEASH:
                return k + 1 - first
    return limit - first


@fast
def make_trial(runs: Runs, room: int) -> tuple[int, int]:
    """Make the trial run of the current one by mutations near each other: the first changed tick, ticks of delay."""
    current = runs.current
    trial = runs.trial
    counters = runs.counters[0]
    ticks = counters.ticks
    for k in range(room):
        trial[k] = current[k]
    first = random_below(counters, ticks)
    tick, shift = mutate(trial, room, first, counters)
    while random_below(counters, 2):
        near = max(0, min(first + random_below(counters, 80) - 40, ticks - 1))
        again, more = mutate(trial, room, near, counters)
        tick = min(tick, again)
        shift += more
    while tick < ticks and trial[tick] == current[tick]:
        tick += 1
    return tick, shift


@entry_point
def local_search(start: Start, runs: Runs, gold: int, temperature: float, budget: int) -> None:
    """Try mutations of the current run until about ``budget`` ticks were played."""
    w = start.worlds[1]
    counters = runs.counters[0]
    stop = counters.played + budget
    while counters.played < stop:
        counters.trials += 1
        ticks = counters.ticks
        room = min(ticks + 4, len(runs.trial))
        tick, shift = make_trial(runs, room)
        if tick >= ticks:
            counters.played += 2
            continue
        luck = random_below(counters, 1000) / 1000.0
        allowed = counters.score + temperature * luck * luck * luck * luck
        checkpoint = tick // CHECKPOINT
        copy_words(start.work_words, runs.checkpoints[checkpoint])
        limit = min(int(allowed) + 1, room)
        counters.played += try_run(start.levels[0], w, runs, checkpoint * CHECKPOINT, shift, limit) + 4
        if w.outcome != OUTCOME_EXIT or w.gold < gold:
            continue
        score = score_of(w)
        if score > allowed:
            continue
        for k in range(room):
            runs.current[k] = runs.trial[k]
        counters.score = score
        counters.ticks = w.tick
        if score < counters.best_score:
            counters.best_score = score
            counters.best_ticks = w.tick
            for k in range(room):
                runs.best[k] = runs.trial[k]
        retrace(start, runs, tick, w.tick)


class LocalSearch:
    """Improves a run by random mutations.

    ``inputs`` must reach the exit; ``gold``: pieces that every run must collect.
    """

    def __init__(self, start: Start, inputs: bytes, *, gold: int, seed: int) -> None:
        self.start = start
        self.gold = gold
        room = len(inputs) + ROOM
        best, current, trial = np.zeros((3, room), np.uint8)
        checkpoints = np.zeros((room // CHECKPOINT + 1, len(start.base)), np.int64)
        self.runs = Runs(best, current, trial, np.zeros((room, 2)), checkpoints, zeroed(LocalCounters, 1))
        self.counters = self.runs.counters[0]
        self.counters.random = int(np.random.default_rng([seed, 7]).integers(1, 1 << 62))
        self.counters.best_ticks = len(inputs)
        self.counters.best_score = len(inputs)
        best[: len(inputs)] = np.frombuffer(inputs, np.uint8) & 7
        self.return_to_best()

    def return_to_best(self) -> None:
        """Make the best run the current one. Raises ValueError if it does not reach the exit."""
        self.runs.current[:] = self.runs.best
        if not compiled(retrace)(self.start, self.runs, 0, self.ticks):
            raise ValueError("the run does not reach the exit with triggers only where the jump key goes down")
        self.counters.score = self.counters.best_score
        self.counters.ticks = self.ticks

    def run(self, budget: int, *, temperature: float) -> None:
        """Try mutations for about ``budget`` ticks; ``temperature``: how many ticks longer a kept run may be."""
        compiled(local_search)(self.start, self.runs, self.gold, temperature, budget)

    def best(self) -> bytes:
        """The inputs of the best run, up to the tick of the exit contact."""
        return press_jumps(self.runs.best[: self.ticks].tolist())

    @property
    def ticks(self) -> int:
        """Ticks of the best run."""
        return int(self.counters.best_ticks)

    @property
    def played(self) -> int:
        """Ticks simulated so far."""
        return int(self.counters.played)

    @property
    def trials(self) -> int:
        """Edited runs tried so far."""
        return int(self.counters.trials)

"""Local improvement of a run: random mutations, played from the save-state before the first changed tick.

A run is kept if it is shorter; of runs of equal length that which is deeper in the exit's disc in the last tick, a
measure between two ticks. Now and then a slightly longer one is kept too, to get out of dead ends.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import Any

import numpy as np

from ninja_game.compile_cache import compiled
from ninja_game.sim.inputs import press_jumps, pressed
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.states import OUTCOME_EXIT, OUTCOME_RUNNING
from ninja_game.sim.world import step
from ninja_game.solver.mutations import mutate, random_below
from ninja_game.solver.search_memory import Start

CHECKPOINT = 8
"""Ticks between the save-states of the current run."""

# Counters (int64) of a local search; index 0 is the random state.
CURRENT_TICKS, SHORTEST, TRIALS, PLAYED, GOLD_WANTED = range(1, 6)
# Scores (float64): of the current and of the best run; how much longer (ticks) a kept run may be.
CURRENT_SCORE, BEST_SCORE, TEMPERATURE, LEASH = range(4)

BEST_ROW, CURRENT_ROW, TRIAL_ROW = 0, 1, 2


@fast
def score_of(w: Any) -> float:
    """Ticks of a run that has just ended at the exit, less the depth of the contact (0 to 0.99)."""
    n = w.ninja
    nearest = 22.0
    for slot in range(1, w.id_count + 1):
        o = w.objects[slot]
        if o.kind == EXIT and o.is_open:
            nearest = min(nearest, sqrt((o.x - n.x) * (o.x - n.x) + (o.y - n.y) * (o.y - n.y)))
    return float(w.tick) - 0.99 * (1.0 - nearest / 22.0)


@fast
def copy_words(target: Any, source: Any) -> None:
    """Copy a save-state."""
    for k in range(len(target)):
        target[k] = source[k]


@entry_point
def retrace(levels: Any, worlds: Any, words: Any, keys: Any, path: Any, checkpoints: Any, tick: int, limit: int) -> int:
    """Play the current run on from the checkpoint at or before ``tick``: its path and checkpoints; its ticks.

    0 if it does not reach the exit before ``limit``.
    """
    base, work_words = words
    w = worlds[1]
    first = min(tick, limit - 1) // CHECKPOINT
    copy_words(work_words, base if first == 0 else checkpoints[first])
    current = keys[CURRENT_ROW]
    for k in range(first * CHECKPOINT, limit):
        if k % CHECKPOINT == 0:
            copy_words(checkpoints[k // CHECKPOINT], work_words)
        step(levels[0], w, pressed(current[k], w.ninja.jump_held))
        path[k, 0] = w.ninja.x
        path[k, 1] = w.ninja.y
        if w.outcome != OUTCOME_RUNNING:
            return int(w.tick) if w.outcome == OUTCOME_EXIT else 0
    return 0


@fast
def try_run(
    level: Any, w: Any, keys: Any, path: Any, start: int, shift: int, limit: int, leash: float, ticks: int
) -> int:
    """Play the trial run from tick ``start`` on; the ticks played. It is given up far from the current run's path."""
    trial = keys[TRIAL_ROW]
    for k in range(start, limit):
        step(level, w, pressed(trial[k], w.ninja.jump_held))
        if w.outcome != OUTCOME_RUNNING:
            return k + 1 - start
        if k % 8 == 7:
            now = min(k, ticks - 1)
            then = min(max(k + shift, 0), ticks - 1)
            near = abs(w.ninja.x - path[now, 0]) + abs(w.ninja.y - path[now, 1])
            if near > leash and abs(w.ninja.x - path[then, 0]) + abs(w.ninja.y - path[then, 1]) > leash:
                return k + 1 - start
    return limit - start


@fast
def make_trial(keys: Any, room: int, ticks: int, counters: Any) -> tuple[int, int]:
    """Make the trial run of the current one by mutations near each other: the first changed tick, ticks of delay."""
    for k in range(room):
        keys[TRIAL_ROW, k] = keys[CURRENT_ROW, k]
    first = random_below(counters, ticks)
    tick, shift = mutate(keys[TRIAL_ROW], room, first, counters)
    while random_below(counters, 2):
        near = max(0, min(first + random_below(counters, 80) - 40, ticks - 1))
        again, more = mutate(keys[TRIAL_ROW], room, near, counters)
        tick = min(tick, again)
        shift += more
    while tick < ticks and keys[TRIAL_ROW, tick] == keys[CURRENT_ROW, tick]:
        tick += 1
    return tick, shift


@entry_point
def local_search(
    levels: Any, worlds: Any, words: Any, keys: Any, path: Any, checkpoints: Any, counters: Any, scores: Any,
    budget: int,
) -> None:  # fmt: skip
    """Try mutations of the current run until about ``budget`` ticks were played.

    ``keys`` (3 rows, uint8): the best, the current and the trial run, one byte a tick without trigger bit; ``path``
    (px) and ``checkpoints`` belong to the current run, see ``retrace``.
    """
    work_words = words[1]
    level = levels[0]
    w = worlds[1]
    stop = counters[PLAYED] + budget
    while counters[PLAYED] < stop:
        counters[TRIALS] += 1
        ticks = counters[CURRENT_TICKS]
        room = min(ticks + 4, keys.shape[1])
        tick, shift = make_trial(keys, room, ticks, counters)
        if tick >= ticks:
            counters[PLAYED] += 2
            continue
        allowed = scores[CURRENT_SCORE]
        luck = random_below(counters, 1000) / 1000.0
        allowed += scores[TEMPERATURE] * luck * luck * luck * luck
        checkpoint = tick // CHECKPOINT
        copy_words(work_words, checkpoints[checkpoint])
        start = checkpoint * CHECKPOINT
        limit = min(int(allowed) + 1, room)
        played = try_run(level, w, keys, path, start, shift, limit, scores[LEASH], ticks)
        counters[PLAYED] += played + 4
        if w.outcome != OUTCOME_EXIT or w.gold < counters[GOLD_WANTED]:
            continue
        score = score_of(w)
        if score > allowed:
            continue
        for k in range(room):
            keys[CURRENT_ROW, k] = keys[TRIAL_ROW, k]
        scores[CURRENT_SCORE] = score
        counters[CURRENT_TICKS] = w.tick
        if score < scores[BEST_SCORE]:
            scores[BEST_SCORE] = score
            counters[SHORTEST] = w.tick
            for k in range(room):
                keys[BEST_ROW, k] = keys[TRIAL_ROW, k]
        retrace(levels, worlds, words, keys, path, checkpoints, tick, w.tick)


ROOM = 64
"""Ticks by which a current run may be longer than the run that the local search began with."""


class LocalSearch:
    """Improves a run by random mutations.

    ``inputs`` must reach the exit; ``gold``: pieces that every run must collect.
    """

    def __init__(self, start: Start, inputs: bytes, *, gold: int, seed: int) -> None:
        self.start = start
        room = len(inputs) + ROOM
        self.keys = np.zeros((3, room), np.uint8)
        self.path = np.zeros((room, 2))
        self.checkpoints = np.zeros((room // CHECKPOINT + 1, start.size), np.int64)
        self.counters = np.zeros(16, np.int64)
        self.scores = np.zeros(8)
        self.counters[0] = np.random.default_rng([seed, 7]).integers(1, 1 << 62)
        self.counters[GOLD_WANTED] = gold
        self.counters[SHORTEST] = len(inputs)
        self.scores[BEST_SCORE] = len(inputs)
        self.scores[LEASH] = 90.0
        self.keys[BEST_ROW, : len(inputs)] = np.frombuffer(inputs, np.uint8) & 7
        self.return_to_best()

    def return_to_best(self) -> None:
        """Make the best run the current one. Raises ValueError if it does not reach the exit."""
        self.keys[CURRENT_ROW] = self.keys[BEST_ROW]
        limit = int(self.counters[SHORTEST])
        if not self._call(retrace, 0, limit):
            raise ValueError("the run does not reach the exit with triggers only where the jump key goes down")
        self.scores[CURRENT_SCORE] = self.scores[BEST_SCORE]
        self.counters[CURRENT_TICKS] = limit

    def run(self, budget: int, *, temperature: float) -> None:
        """Try mutations for about ``budget`` ticks; ``temperature``: how many ticks longer a kept run may be."""
        self.scores[TEMPERATURE] = temperature
        self._call(local_search, self.counters, self.scores, budget)

    def _call(self, entry: Callable[..., Any], *more: Any) -> Any:
        start = self.start
        words = (start.base, start.work_words)
        return compiled(entry)(
            start.levels, start.worlds, words, self.keys, self.path, self.checkpoints, *more
        )  # fmt: skip

    def best(self) -> bytes:
        """The inputs of the best run, up to the tick of the exit contact."""
        return press_jumps(self.keys[BEST_ROW, : self.ticks].tolist())

    @property
    def ticks(self) -> int:
        """Ticks of the best run."""
        return int(self.counters[SHORTEST])

    @property
    def played(self) -> int:
        """Ticks simulated so far."""
        return int(self.counters[PLAYED])

    @property
    def trials(self) -> int:
        """Edited runs tried so far."""
        return int(self.counters[TRIALS])

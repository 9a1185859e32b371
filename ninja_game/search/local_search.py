"""Small random changes of a run's inputs, like the trial and error of a speedrunner. Inputs here have no trigger bit.

Edits move, stretch, cut, double or overwrite rows of keys. An edit changes ``keys[:length]`` in place and gives (first
changed tick, ticks by which the following keys move forward).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import compiled
from ninja_game.batch.batch import Keys
from ninja_game.search.heuristics import UNREACHED
from ninja_game.search.nodes import MUTATIONS, RandomState, Start, copy_words, random_below, ticks_at_once, zeroed
from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN, with_press_bit, with_press_bits
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.rules import EXIT_RADIUS, RADIUS
from ninja_game.sim.schema.declare import f8, fast, i8, kernel, struct
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import OUTCOME_EXIT, OUTCOME_RUNNING
from ninja_game.sim.world import step


@fast
def cut(keys: Keys, length: int, tick: int, count: int) -> None:
    """Remove ticks; the following keys move forward, and the last input is repeated at the end."""
    for k in range(tick, length):
        keys[k] = keys[min(k + count, length - 1)]


@fast
def stretch(keys: Keys, length: int, tick: int, count: int) -> None:
    """Repeat the input of a tick; the following keys move back."""
    for k in range(length - 1, tick + count - 1, -1):
        keys[k] = keys[k - count]
    for k in range(tick + 1, min(tick + count, length)):
        keys[k] = keys[tick]


@fast
def overwrite(keys: Keys, length: int, start: int, end: int, mask: int, value: int) -> None:
    """Set the keys of ``mask`` to ``value`` in the ticks from start to end (excluded)."""
    for k in range(max(start, 0), min(end, length)):
        keys[k] = (keys[k] & (KEYS_DOWN - mask)) | value


@fast
def next_change(keys: Keys, length: int, tick: int, mask: int) -> int:
    """The first tick after ``tick`` whose keys under the mask differ from the tick before; else ``length``."""
    for k in range(tick + 1, length):
        if (keys[k] ^ keys[k - 1]) & mask:
            return k
    return length


@fast
def shift_boundary(keys: Keys, length: int, tick: int, mask: int, by: int) -> int:
    """Move the next change of some keys earlier or later; gives the first changed tick."""
    change = next_change(keys, length, tick, mask)
    if change >= length:
        return length
    before = keys[change - 1] & mask
    after = keys[change] & mask
    if by < 0:
        overwrite(keys, length, change + by, change, mask, after)
        return max(change + by, 0)
    overwrite(keys, length, change, change + by, mask, before)
    return change


@fast
def shift_pulse(keys: Keys, length: int, tick: int, by: int) -> int:
    """Move the next jump as a whole; gives the first changed tick."""
    start = next_change(keys, length, tick, JUMP_HELD)
    if start < length and not keys[start] & JUMP_HELD:
        start = next_change(keys, length, start, JUMP_HELD)
    if start >= length:
        return length
    end = next_change(keys, length, start, JUMP_HELD)
    overwrite(keys, length, start, end, JUMP_HELD, 0)
    overwrite(keys, length, start + by, end + by, JUMP_HELD, JUMP_HELD)
    return max(min(start, start + by), 0)


_SIDES = KEYS_DOWN - JUMP_HELD
_CUT, _STRETCH, _TRADE, _SHIFT_SIDES, _SHIFT_JUMP, _SHIFT_PULSE, _SET_SIDES, _SET_JUMP, _SET_ALL = range(9)
_CHANCES = {_SHIFT_SIDES: 2, _SHIFT_JUMP: 2, _SHIFT_PULSE: 2}  # of the kinds of edits; the others have 1
_EDITS = tuple(kind for kind in range(9) for _ in range(_CHANCES.get(kind, 1)))


@fast
def mutate(keys: Keys, length: int, tick: int, source: RandomState) -> tuple[int, int]:
    """Make a random edit; gives the first changed tick, and by how many ticks what follows comes earlier."""
    kind = _EDITS[random_below(source, len(_EDITS))]
    by = 1 + random_below(source, 2 if random_below(source, 2) else 8)
    sign = 1 if random_below(source, 2) else -1
    if kind == _CUT:
        cut(keys, length, tick, min(by, 3))
        return tick, min(by, 3)
    if kind == _STRETCH:
        stretch(keys, length, tick, min(by, 3))
        return tick, -min(by, 3)
    if kind == _TRADE:
        # Remove ticks here and add as many a little later: the keys between come earlier.
        other = min(tick + 1 + random_below(source, 60), length - 1)
        if sign > 0:
            cut(keys, length, tick, by)
            stretch(keys, length, other, by)
        else:
            stretch(keys, length, tick, by)
            cut(keys, length, min(other + by, length - 1), by)
        return tick, 0
    if kind == _SHIFT_SIDES:
        return shift_boundary(keys, length, tick, _SIDES, sign * by), 0
    if kind == _SHIFT_JUMP:
        return shift_boundary(keys, length, tick, JUMP_HELD, sign * by), 0
    if kind == _SHIFT_PULSE:
        return shift_pulse(keys, length, tick, sign * by), 0
    span = 1 + random_below(source, 4 if random_below(source, 2) else 24)
    way = random_below(source, 3) if kind != _SET_JUMP else 0
    jump = JUMP_HELD * random_below(source, 2) if kind != _SET_SIDES else 0
    overwrite(keys, length, tick, tick + span, (_SIDES, JUMP_HELD, KEYS_DOWN)[kind - _SET_SIDES], way + jump)
    return tick, 0


CHECKPOINT = 8  # ticks between the save-states of the current run
SPARE_TICKS = 64  # ticks by which a current run may be longer than the first run of the local search
LEASH = 90.0  # px; a trial run farther than this from the current run's path is dropped


@struct
class LocalCounters(RandomState):
    """The state of a local search. Scores are in ticks (``score_of``)."""

    ticks: i8  #: ticks of the current run
    score: f8
    best_ticks: i8  #: ticks of the best run
    best_score: f8
    played: i8  #: ticks of the trial runs; those that met the current run again count to its end


class Runs(NamedTuple):
    """The best, the current and the trial run, one byte per tick without trigger bit; data of the current one."""

    best: Keys
    current: Keys
    trial: Keys
    path: NDArray[np.float64]  #: px, after each tick of the current run
    checkpoints: NDArray[np.int64]  #: save-states of the current run, as words
    counters: Sequence[LocalCounters]


@fast
def score_of(w: World) -> float:
    """Ticks of a run that has just reached the exit, less 0 to 0.99 for the depth of the contact."""
    n = w.ninja
    nearest = EXIT_RADIUS + RADIUS
    for slot in range(1, w.id_count + 1):
        o = w.objects[slot]
        if o.kind == EXIT and o.is_open:
            nearest = min(nearest, sqrt((o.x - n.x) * (o.x - n.x) + (o.y - n.y) * (o.y - n.y)))
    return float(w.tick) - 0.99 * (1.0 - nearest / (EXIT_RADIUS + RADIUS))


@kernel
def retrace(start: Start, runs: Runs, tick: int, limit: int) -> int:
    """Play the current run from the checkpoint at or before ``tick`` on and record path and checkpoints.

    Gives its ticks, 0 if it does not reach the exit before ``limit``.
    """
    w = start.worlds[1]
    first = min(tick, limit - 1) // CHECKPOINT
    copy_words(start.scratch, start.initial if first == 0 else runs.checkpoints[first])
    for k in range(first * CHECKPOINT, limit):
        if k % CHECKPOINT == 0:
            copy_words(runs.checkpoints[k // CHECKPOINT], start.scratch)
        step(start.maps[0], w, with_press_bit(runs.current[k], w.ninja.jump_held))
        runs.path[k, 0] = w.ninja.x
        runs.path[k, 1] = w.ninja.y
        if w.outcome != OUTCOME_RUNNING:
            return int(w.tick) if w.outcome == OUTCOME_EXIT else 0
    return 0


@fast
def try_run(start: Start, runs: Runs, first: int, shift: int, limit: int, gold: int) -> tuple[int, float]:
    """Play the trial run from tick ``first`` on; gives the last tick played and the score, UNREACHED if dropped.

    It is dropped far from the current run's path. It ends early, with that run's score, where its state and its
    remaining keys equal those of the current run.
    """
    w = start.worlds[1]
    path = runs.path
    score = runs.counters[0].score  # whole ticks as long as the depth of the exit contact is unknown
    differs = ticks = runs.counters[0].ticks
    while runs.trial[differs - 1] == runs.current[differs - 1]:
        differs -= 1
    for k in range(first, limit):
        step(start.maps[0], w, with_press_bit(runs.trial[k], w.ninja.jump_held))
        if w.outcome != OUTCOME_RUNNING:
            return k + 1, score_of(w) if w.outcome == OUTCOME_EXIT and w.gold >= gold else UNREACHED
        if (k + 1) % CHECKPOINT == 0:
            now = min(k, ticks - 1)
            then = min(max(k + shift, 0), ticks - 1)
            away = abs(w.ninja.x - path[now, 0]) + abs(w.ninja.y - path[now, 1])
            if away > LEASH and abs(w.ninja.x - path[then, 0]) + abs(w.ninja.y - path[then, 1]) > LEASH:
                return k + 1, UNREACHED
            is_back = away == 0.0 and differs <= k + 1 < ticks and score < ticks
            word = 0 if is_back else len(start.scratch)
            while word < len(start.scratch) and start.scratch[word] == runs.checkpoints[(k + 1) // CHECKPOINT, word]:
                word += 1
            if is_back and word == len(start.scratch):
                return k + 1, score
    return limit, UNREACHED


@fast
def make_trial(runs: Runs, capacity: int) -> tuple[int, int]:
    """Make the trial run from the current one by edits near each other; gives the first changed tick and the delay."""
    current = runs.current
    trial = runs.trial
    counters = runs.counters[0]
    ticks = counters.ticks
    for k in range(capacity):
        trial[k] = current[k]
    first = random_below(counters, ticks)
    tick, shift = mutate(trial, capacity, first, counters)
    while random_below(counters, 2):
        near = max(0, min(first + random_below(counters, 80) - 40, ticks - 1))
        again, more = mutate(trial, capacity, near, counters)
        tick = min(tick, again)
        shift += more
    while tick < ticks and trial[tick] == current[tick]:
        tick += 1
    return tick, shift


@kernel
def local_search(start: Start, runs: Runs, gold: int, temperature: float, budget: int) -> None:
    """Try edits of the current run for about ``budget`` ticks."""
    w = start.worlds[1]
    counters = runs.counters[0]
    stop = counters.played + budget
    while counters.played < stop:
        ticks = counters.ticks
        capacity = min(ticks + 4, len(runs.trial))
        tick, shift = make_trial(runs, capacity)
        if tick >= ticks:
            counters.played += 2
            continue
        luck = random_below(counters, 1000) / 1000.0
        allowed = counters.score + temperature * luck * luck * luck * luck
        checkpoint = tick // CHECKPOINT
        copy_words(start.scratch, runs.checkpoints[checkpoint])
        limit = min(int(allowed) + 1, capacity)
        end, score = try_run(start, runs, checkpoint * CHECKPOINT, shift, limit, gold)
        back = w.outcome == OUTCOME_RUNNING and score < UNREACHED
        counters.played += (ticks if back else end) - checkpoint * CHECKPOINT + 4
        if score > allowed:
            continue
        for k in range(capacity):
            runs.current[k] = runs.trial[k]
        retrace(start, runs, tick, end)
        if w.outcome == OUTCOME_EXIT:
            counters.score = score
            counters.ticks = end
            if score < counters.best_score:
                counters.best_score = score
                counters.best_ticks = end
                for k in range(capacity):
                    runs.best[k] = runs.trial[k]


class LocalSearch:
    """Improves a run by random mutations. ``inputs`` must reach the exit; ``gold``: pieces that a run must collect."""

    def __init__(self, start: Start, inputs: bytes, *, gold: int, seed: int) -> None:
        self.start = start
        self.gold = gold
        capacity = len(inputs) + SPARE_TICKS
        best, current, trial = np.zeros((3, capacity), np.uint8)
        checkpoints = np.zeros((capacity // CHECKPOINT + 1, len(start.initial)), np.int64)
        self.runs = Runs(best, current, trial, np.zeros((capacity, 2)), checkpoints, zeroed(LocalCounters, 1))
        self.counters = self.runs.counters[0]
        self.counters.random = int(np.random.default_rng([seed, MUTATIONS]).integers(1, 1 << 62))
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
        """Try edits for about ``budget`` ticks. ``temperature``: how many ticks longer a run that is kept may be."""
        budget = min(budget, ticks_at_once(self.start))
        compiled(local_search)(self.start, self.runs, self.gold, temperature, budget)

    def best(self) -> bytes:
        """The inputs of the best run, up to the tick of the exit contact."""
        return with_press_bits(self.runs.best[: self.ticks].tolist())

    @property
    def ticks(self) -> int:
        return int(self.counters.best_ticks)

    @property
    def played(self) -> int:
        return int(self.counters.played)

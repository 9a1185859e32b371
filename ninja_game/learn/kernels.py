"""What environments call of a memory: the ticks of one action in some worlds, with what they earned."""

from __future__ import annotations

from typing import Any

from ninja_game.learn.protocol import next_random
from ninja_game.sim.events import EXIT_OPENED, GOLD_TAKEN, MINE_EXPLODED
from ninja_game.sim.inputs import pressed
from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.memory.schema import MAX_EVENTS
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_EXIT
from ninja_game.sim.world import step

PAID_EXIT, PAID_DEATH, PAID_PIECE, PAID_TICK = range(4)
"""Columns of what is paid."""
OUTCOME, TICKS, GOLD, EVENTS, ENDED, PLAYED, WAIT, RANDOM = range(8)
"""Columns of what is told of each world; the last three are the keys of its last step, and of `protocol.py`."""
TERMINATED, TRUNCATED = 1, 2
"""How an episode has ended; 0: it goes on."""
CHANGES = (1 << GOLD_TAKEN) | (1 << MINE_EXPLODED) | (1 << EXIT_OPENED)
"""Events after which objects that stay where they are look another way."""


@entry_point
def advance_worlds(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, keys: Any,
    frame_skip: int, time_limit: int, repeat: int, weights: Any,
    rewards: Any, facts: Any, changed: Any, terminated: Any, truncated: Any,
) -> int:  # fmt: skip
    """Run worlds ``which[first:last]``, each with its ``keys`` for ``frame_skip`` ticks; the number of ticks run.

    A world stops at its first exit contact or death, and at ``time_limit`` ticks. Jump is pressed, as at a keyboard,
    where it is held and was not in the tick before. ``repeat`` of CHANCES: how often it plays the keys of the step
    before; while it waits, none. ``weights`` (PAID_EXIT to PAID_TICK): what each is worth;
    ``rewards`` (worlds) receives the sum. ``facts`` (worlds x OUTCOME to RANDOM): EVENTS are those of all ticks, as
    bits. ``changed`` (worlds): whether one of CHANGES happened; also set where the list of events was full.
    ``terminated``, ``truncated`` (worlds): what ENDED tells.
    """
    total = 0
    for k in range(first, last):
        index = which[k]
        level = maps[level_of[index]]
        w = worlds[index]
        down = int(keys[index])
        if repeat:
            facts[index, RANDOM] = next_random(int(facts[index, RANDOM]))
            if facts[index, RANDOM] < repeat:
                down = int(facts[index, PLAYED])
        if facts[index, WAIT]:
            facts[index, WAIT] -= 1
            down = 0
        facts[index, PLAYED] = down
        tick = w.tick
        gold = w.gold
        seen = 0
        crowded = False
        for _ in range(frame_skip):
            step(level, w, pressed(down, w.ninja.jump_held))
            for event in range(w.event_count):
                seen |= 1 << w.events[event].kind
            if w.event_count >= MAX_EVENTS:
                crowded = True
            if w.outcome or w.tick >= time_limit:
                break
        ticks = w.tick - tick
        reward = weights[PAID_PIECE] * (w.gold - gold) + weights[PAID_TICK] * ticks
        if w.outcome == OUTCOME_EXIT:
            reward += weights[PAID_EXIT]
        elif w.outcome == OUTCOME_DEAD:
            reward += weights[PAID_DEATH]
        rewards[index] = reward
        facts[index, OUTCOME] = w.outcome
        facts[index, TICKS] = w.tick
        facts[index, GOLD] = w.gold
        facts[index, EVENTS] = seen
        facts[index, ENDED] = TERMINATED if w.outcome else TRUNCATED if w.tick >= time_limit else 0
        terminated[index] = w.outcome != 0
        truncated[index] = w.outcome == 0 and w.tick >= time_limit
        changed[index] = crowded or (seen & CHANGES) != 0
        total += ticks
    return total

"""Whether the ninja can live on from a moment, or is falling into what kills it."""

from __future__ import annotations

from ninja_game.sim.memory.declare import fast
from ninja_game.sim.states import OUTCOME_DEAD
from ninja_game.solver.macro_actions import PRESSED, RELEASED, play_macro
from ninja_game.solver.open_list import load_state
from ninja_game.solver.search_memory import Node, SearchMemory, Start, random_below

SURVIVAL = 60
"""Ticks that the ninja must be able to live."""


@fast
def survives(node: Node, start: Start, memory: SearchMemory, rollouts: int) -> bool:
    """Whether a ninja with random keys, from a node's save-state on, ever lands or lives for a while.

    The working world is used.
    """
    w = start.worlds[1]
    counters = memory.counters[0]
    for _ in range(rollouts):
        load_state(start.work_words, start.base, node, memory)
        until = w.tick + SURVIVAL
        while w.outcome != OUTCOME_DEAD:
            if w.tick >= until or not w.ninja.in_air:
                return True
            direction = random_below(counters, 3) - 1
            mode = RELEASED if random_below(counters, 3) else PRESSED
            counters.ticks += play_macro(start.levels[0], w, direction, mode, 4 + random_below(counters, 30))
    return False

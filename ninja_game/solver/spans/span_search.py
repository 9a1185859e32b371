"""Best-first search along a known run: away from it within a span, ahead of it behind the span.

The node with the least (ticks so far + ticks ahead) is expanded next. Besides the macros of every search there is one
that plays on as the known run did, so that what was gained in the span is carried to the exit.
"""

from __future__ import annotations

from ninja_game.sim.inputs import pressed
from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.states import OUTCOME_EXIT, OUTCOME_RUNNING
from ninja_game.sim.world import step
from ninja_game.solver.macro_actions import action_code, play_macro
from ninja_game.solver.open_list import pop_lowest, push
from ninja_game.solver.search import CHOICES, EXHAUSTED, MORE, NO_ROOM, add_node, keep_node, macro_of, take_state
from ninja_game.solver.search_memory import BUCKETS, Resolution, SearchMemory, Start, random_below
from ninja_game.solver.spans.known_run import KnownRun, nearest
from ninja_game.solver.state_abstraction import MIX, Goals, find, is_news, key_of, open_mask

FOLLOWED = 3
"""Mode of an action that plays on as the known run did, from the row in its bits 16 and up."""
FOLLOW_CHOICES = 3
"""From the row most like the present moment, from the one before, from the next one."""
MOST_ROWS = 1 << 15
"""An action has no room for a row from here on."""
LEAST_GAIN = 0.5
"""Ticks by which what is behind the span must promise to be shorter than the best run."""


@fast
def follow(level: TileMap, w: World, run: KnownRun, row: int, limit: int) -> int:
    """Play on as the known run did from a row on; the ticks played."""
    for k in range(limit):
        if row + k >= len(run.keys):
            return k
        step(level, w, pressed(run.keys[row + k], w.ninja.jump_held))
        if w.outcome != OUTCOME_RUNNING:
            return k + 1
    return limit


@entry_point
def expand_along(
    start: Start, memory: SearchMemory, goals: Goals, run: KnownRun, resolution: Resolution, budget: int
) -> int:
    """Expand nodes until ``budget`` ticks were run: MORE, EXHAUSTED (nothing is left) or NO_ROOM (for nodes)."""
    here = start.worlds[0]
    w = start.worlds[1]
    counters = memory.counters[0]
    stop = counters.ticks + budget
    while counters.ticks < stop:
        if counters.nodes + 16 > len(memory.nodes) or counters.entries * 4 > len(memory.table) * 3:
            return NO_ROOM
        index = pop_lowest(memory)
        if index < 0:
            return EXHAUSTED
        if not take_state(memory.nodes[index], start, memory, resolution):
            continue
        counters.expanded += 1
        held = here.ninja.jump_held
        row, _ = nearest(run, here, open_mask(here, goals.switch_slots))
        for choice in range(CHOICES + FOLLOW_CHOICES):
            action = 0
            played = 0
            if choice < CHOICES:
                direction, mode, limit = macro_of(here.ninja, choice, counters, resolution)
                if limit == 0:
                    continue
                for k in range(len(start.node_words)):
                    start.work_words[k] = start.node_words[k]
                played = play_macro(start.levels[0], w, direction, mode, limit)
                action = action_code(direction, mode, held, played)
            else:
                first = row + (choice - CHOICES + 1) % FOLLOW_CHOICES - 1
                if row < 0 or not 0 <= first < MOST_ROWS:
                    continue
                for k in range(len(start.node_words)):
                    start.work_words[k] = start.node_words[k]
                played = follow(start.levels[0], w, run, first, 3 + random_below(counters, 24))
                action = FOLLOWED << 2 | played << 8 | first << 16
            counters.ticks += played
            if played == 0:
                continue
            if w.outcome == OUTCOME_RUNNING:
                keep_ahead(index, action, start, memory, goals, run, resolution)
            elif w.outcome == OUTCOME_EXIT and w.gold >= goals.gold and w.tick < counters.best_ticks:
                counters.best_ticks = w.tick
                counters.best_node = add_node(index, action, w.tick, memory)
    return MORE


@fast
def keep_ahead(
    parent: int, action: int, start: Start, memory: SearchMemory, goals: Goals, run: KnownRun, resolution: Resolution
) -> None:
    """Make a node of the working world if its key is news and it promises a shorter run."""
    w = start.worlds[1]
    counters = memory.counters[0]
    mask = open_mask(w, goals.switch_slots)
    _, ahead = nearest(run, w, mask)
    promise = w.tick + ahead
    late = run.behind if w.tick < run.span[1] else -LEAST_GAIN
    if promise > counters.best_ticks + late:
        return
    # A key has nine bits for what is open: the bits of further switches are mixed into them.
    switches = (mask ^ ((mask >> 9) * MIX >> 40)) & 511
    key = key_of(w, goals, switches, 0, resolution)
    slot = find(memory.table, key)
    entry = memory.table[slot]
    if entry.key != 0 and not is_news(entry, w.tick, resolution):
        return
    index = keep_node(parent, action, slot, key, ahead, start, memory)
    # Two buckets a tick; the known run's own moments wait in the middle one.
    push(index, 0.5 * BUCKETS + 2.0 * (promise - len(run.keys)), memory)

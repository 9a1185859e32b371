"""Best-first search over save-states: the compiled inner loop.

The node with the least (ticks so far + weight x estimated ticks to go) is taken from the buckets, all macros are
played from its save-state, and every moment whose key is news becomes a node.

All functions here share the arguments of ``expand``, in groups, and unpack what they need.
"""

from __future__ import annotations

from typing import Any

from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import JUMPING, OUTCOME_EXIT, OUTCOME_RUNNING
from ninja_game.solver.distance_field import point_at
from ninja_game.solver.macro_actions import PRESSED, PRESSED_AGAIN, RELEASED, action_code, play_macro
from ninja_game.solver.open_list import draw, drop_highest, free_state, keep_state, load_state, pop_lowest, push
from ninja_game.solver.search_memory import (
    BEST_NODE,
    BEST_TICKS,
    ENTRIES,
    EXPANDED,
    GOLD_NEEDED,
    LINKS,
    MACRO_JITTER,
    MACRO_TICKS,
    NEW_SWITCH_STATES,
    NODES,
    OFF_GUIDE,
    PATIENCE,
    REVISITS,
    SLACK,
    TICKS,
    WAITING,
    WEIGHT,
)
from ninja_game.solver.state_abstraction import estimate, find, gold_hash, is_news, key_of, switch_state_of

CHOICES = 10
"""Macros to choose from: three directions by three modes of the jump key, and waiting."""
BOUND_SHARE = 0.4
"""What share of the estimate a run may count on when it is compared with the best one; fields are a guide only."""


@entry_point
def begin(place: Any, memory: Any, switch_states: Any, heuristics: Any, guide: Any, budget: int) -> int:
    """Make the root, the start of the level. Arguments as for ``expand``."""
    _, worlds, (base, _, work_words) = place
    nodes, table, _, pool, buckets, counters, parameters = memory
    for k in range(len(base)):
        work_words[k] = base[k]
    w = worlds[1]
    switch_state = switch_state_of(w, heuristics, switch_states, counters, 0)
    key = key_of(w, switch_state, gold_hash(w, heuristics, counters), parameters)
    slot = find(table, key)
    table[slot].key = key
    table[slot].visits = 1
    counters[ENTRIES] += 1
    root = nodes[0]
    counters[NODES] += 1
    root.parent = -1
    root.tick = 0
    root.action = 0
    root.switch_state = switch_state
    root.entry = slot
    root.ahead = 0.0
    keep_state(work_words, base, root, pool, counters)
    push(nodes, 0, 0.0, buckets, counters)
    return 0


@entry_point
def expand(place: Any, memory: Any, switch_states: Any, heuristics: Any, guide: Any, budget: int) -> int:
    """Expand nodes until ``budget`` ticks were run, a new switch state wants its field, or nothing is left.

    ``place``: level, worlds (the node's and the working one), and their states as words, the start's first.
    ``memory``: nodes, table, links, pool, buckets, counters, parameters. ``switch_states``: their bits, where they
    were first seen, their fields. ``heuristics``: slots of the switches, how many, slots of the gold, fields of the
    gold. ``guide``: the table of an earlier search whose ``value`` is the estimate (length 1: none), its parameters.

    Answers 0: go on, 1: nothing left, 2: no room for nodes.
    """
    levels, worlds, (_, node_words, work_words) = place
    nodes, table, links, _, buckets, counters, parameters = memory
    here = worlds[0]
    w = worlds[1]
    stop = counters[TICKS] + budget
    while counters[TICKS] < stop and counters[NEW_SWITCH_STATES] == 0:
        full = counters[NODES] + 16 > len(nodes) or counters[LINKS] + 16 > len(links)
        if full or counters[ENTRIES] * 4 > len(table) * 3:
            return 2
        index = pop_lowest(nodes, buckets, counters)
        if index < 0:
            return 1
        if not take_state(nodes[index], place, memory):
            continue
        counters[EXPANDED] += 1
        held = here.ninja.jump_held
        for choice in range(CHOICES):
            direction, mode, limit = macro_of(here.ninja, choice, counters, parameters)
            if limit == 0:
                continue
            for k in range(len(node_words)):
                work_words[k] = node_words[k]
            played = play_macro(levels[0], w, direction, mode, limit)
            counters[TICKS] += played
            action = action_code(direction, mode, held, played)
            if w.outcome == OUTCOME_RUNNING:
                if w.tick < LIFETIME + GOLD_BONUS * w.gold:
                    keep_child(index, action, played, place, memory, switch_states, heuristics, guide)
            elif w.outcome == OUTCOME_EXIT and w.gold >= counters[GOLD_NEEDED]:
                keep_end(index, action, played, w.tick, memory)
    return 0


@fast
def take_state(node: Any, place: Any, memory: Any) -> bool:
    """Load a node's save-state and give its chunks back. False, and nothing loaded, if the node is pointless by now.

    A bound that fell since, or an earlier arrival at the same key, makes it so.
    """
    base, node_words, _ = place[2]
    _, table, _, pool, _, counters, parameters = memory
    if node.chunk < 0:
        return False
    stale = table[node.entry].first < node.tick and parameters[REVISITS] < 2.0
    late = counters[BEST_TICKS] > 0 and node.tick + 1 >= counters[BEST_TICKS]
    wanted = not (stale or late)
    if wanted:
        load_state(node_words, base, node, pool)
    free_state(node.chunk, pool, counters)
    node.chunk = -1
    return wanted


@fast
def macro_of(ninja: Any, choice: int, counters: Any, parameters: Any) -> tuple[int, int, int]:
    """Direction, mode and most ticks of a choice; 0 ticks if it makes no difference to this ninja."""
    wall = ninja.in_air and ninja.near_wall
    limit = int(parameters[MACRO_TICKS])
    if parameters[MACRO_JITTER] > 0.0:
        limit += draw(counters) % (int(parameters[MACRO_JITTER]) + 1)
    direction = choice % 3 - 1
    mode = choice // 3
    if mode == PRESSED:
        useful = ninja.state == JUMPING if ninja.jump_held else not ninja.in_air or wall
    elif mode == PRESSED_AGAIN:
        useful = ninja.jump_held and (wall or not ninja.in_air)
    elif mode > PRESSED_AGAIN:
        # Waiting: only at rest, and longer than a macro, or it would not be news.
        slow = abs(ninja.x - ninja.prev_x) + abs(ninja.y - ninja.prev_y) < 0.5
        useful = slow and not ninja.in_air and parameters[REVISITS] >= 2.0
        direction = 0
        mode = RELEASED
        limit = int(parameters[PATIENCE])
    else:
        useful = True
    return direction, mode, limit if useful else 0


@fast
def keep_end(parent: int, action: int, played: int, tick: int, memory: Any) -> None:
    """Note that a node leads to the exit; keep the run if it is the shortest."""
    nodes, _, links, _, _, counters, _ = memory
    note_link(links, counters, nodes[parent].entry, -1, played)
    if counters[BEST_TICKS] == 0 or tick < counters[BEST_TICKS]:
        counters[BEST_TICKS] = tick
        counters[BEST_NODE] = add_node(parent, action, tick, memory)


@fast
def keep_child(
    parent: int, action: int, played: int, place: Any, memory: Any, switch_states: Any, heuristics: Any, guide: Any
) -> None:
    """Make a node of the working world if its key is news and it can still beat the best run."""
    _, worlds, (base, _, work_words) = place
    nodes, table, links, pool, buckets, counters, parameters = memory
    w = worlds[1]
    source = nodes[parent]
    switch_state = switch_state_of(w, heuristics, switch_states, counters, source.switch_state)
    if switch_state < 0:
        return
    tick = w.tick
    best = counters[BEST_TICKS]
    ahead = estimate(w, heuristics, switch_states, counters, switch_state, point_at(w.ninja.x, w.ninja.y), source.ahead)
    if best > 0 and tick + ahead * BOUND_SHARE >= best:
        return
    gold = gold_hash(w, heuristics, counters)
    key = key_of(w, switch_state, gold, parameters)
    slot = find(table, key)
    entry = table[slot]
    if entry.key != 0:
        note_link(links, counters, source.entry, slot, played)
        if not is_news(entry, tick, parameters):
            return
    guide_table, guide_parameters = guide
    if len(guide_table) > 1:
        known = guide_table[find(guide_table, key_of(w, switch_state, gold, guide_parameters))]
        if known.key != 0 and known.value < 1.0e8:
            ahead = 0.0 + known.value
        else:
            ahead = source.ahead - played + parameters[OFF_GUIDE] * played
        if best > 0 and tick + ahead > best + parameters[SLACK]:
            return
    if entry.key == 0:
        counters[ENTRIES] += 1
        entry.key = key
        entry.first = tick
        entry.last = tick
        note_link(links, counters, source.entry, slot, played)
    entry.visits += 1
    entry.first = min(entry.first, tick)
    entry.last = max(entry.last, tick)
    index = add_node(parent, action, tick, memory)
    child = nodes[index]
    child.switch_state = switch_state
    child.entry = slot
    child.ahead = ahead
    while not keep_state(work_words, base, child, pool, counters) and counters[WAITING] > 0:
        drop_highest(nodes, buckets, pool, counters)
    push(nodes, index, tick + parameters[WEIGHT] * ahead, buckets, counters)


@fast
def add_node(parent: int, action: int, tick: int, memory: Any) -> int:
    """A new node without a save-state; its index."""
    nodes, counters = memory[0], memory[5]
    index = counters[NODES]
    counters[NODES] += 1
    node = nodes[index]
    node.parent = parent
    node.tick = tick
    node.action = action
    node.chunk = -1
    return int(index)


@fast
def note_link(links: Any, counters: Any, source: int, target: int, ticks: int) -> None:
    """Remember that a macro leads from one table entry to another."""
    link = links[counters[LINKS]]
    counters[LINKS] += 1
    link.source = source
    link.target = target
    link.ticks = ticks

"""Best-first search over save-states: the compiled inner loop.

The node with the least (ticks so far + weight x estimated ticks to go) is taken from the buckets, all macros are
played from its save-state, and every moment whose key is news becomes a node.
"""

from __future__ import annotations

from typing import Any

from ninja_game.many.distance_field import point_at
from ninja_game.many.macros import PRESSED, PRESSED_AGAIN, RELEASED, action_code, play_macro
from ninja_game.many.search_keys import find, is_news, key_of
from ninja_game.many.search_memory import (
    BEST_NODE,
    BEST_TICKS,
    BUCKETS,
    CHUNK,
    DROPPED,
    ENTRIES,
    EXPANDED,
    FREE_CHUNK,
    FULL,
    GOLD_NEEDED,
    HIGHEST,
    LINKS,
    LOWEST,
    MACRO_JITTER,
    MACRO_TICKS,
    MAX_STAGES,
    MOST_GOLD,
    NEW_STAGES,
    NODES,
    OFF_GUIDE,
    PATIENCE,
    RANDOM,
    REVISITS,
    SLACK,
    STAGES,
    TICKS,
    WAITING,
    WEIGHT,
)
from ninja_game.sim.memory import entry_point, fast
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import JUMPING, OUTCOME_EXIT, OUTCOME_RUNNING

GOLD_STEP = 60.0
"""Estimated ticks for each further piece of gold."""


@fast
def draw(counters: Any) -> int:
    """A pseudo-random number, 0 to 2^31 - 1 (xorshift)."""
    x = counters[RANDOM]
    x ^= x << 13
    x ^= (x >> 7) & 0x01FFFFFFFFFFFFFF
    x ^= x << 17
    counters[RANDOM] = x
    return int((x >> 20) & 0x7FFFFFFF)


@fast
def keep_state(words: Any, base: Any, node: Any, pool: Any, counters: Any) -> bool:
    """Store the first word and those that differ from the start; False, and nothing stored, if the pool is empty."""
    chunk_next, chunk_index, chunk_value = pool
    first = -1
    chunk = -1
    count = 0
    for k in range(len(words)):
        if words[k] != base[k] or k == 0:
            if count % CHUNK == 0:
                free = counters[FREE_CHUNK]
                if free < 0:
                    if first >= 0:
                        chunk_next[chunk] = -1
                        free_state(first, pool, counters)
                    return False
                counters[FREE_CHUNK] = chunk_next[free]
                if first < 0:
                    first = free
                else:
                    chunk_next[chunk] = free
                chunk = free
            place = chunk * CHUNK + count % CHUNK
            chunk_index[place] = k
            chunk_value[place] = words[k]
            count += 1
    if first >= 0:
        chunk_next[chunk] = -1
    node.chunk = first
    node.words = count
    return True


@fast
def free_state(first: int, pool: Any, counters: Any) -> None:
    """Give a chain of chunks back."""
    chunk_next = pool[0]
    last = first
    while chunk_next[last] >= 0:
        last = chunk_next[last]
    chunk_next[last] = counters[FREE_CHUNK]
    counters[FREE_CHUNK] = first


@fast
def load_state(words: Any, base: Any, node: Any, pool: Any) -> None:
    """Make the world of a node: the start with the node's words."""
    chunk_next, chunk_index, chunk_value = pool
    for k in range(len(base)):
        words[k] = base[k]
    chunk = node.chunk
    left = node.words
    while left > 0:
        place = chunk * CHUNK
        for k in range(place, place + min(left, CHUNK)):
            words[chunk_index[k]] = chunk_value[k]
        left -= CHUNK
        chunk = chunk_next[chunk]


@fast
def push(nodes: Any, index: int, priority: float, buckets: Any, counters: Any) -> None:
    """Put a node into its bucket."""
    bucket = int(priority)
    bucket = 0 if bucket < 0 else min(bucket, BUCKETS - 1)
    nodes[index].priority = bucket
    nodes[index].next = buckets[bucket]
    buckets[bucket] = index
    counters[WAITING] += 1
    if bucket < counters[LOWEST]:
        counters[LOWEST] = bucket
    if bucket > counters[HIGHEST]:
        counters[HIGHEST] = bucket


@fast
def pop_lowest(nodes: Any, buckets: Any, counters: Any) -> int:
    """Take the most promising node; -1 if there is none."""
    bucket = counters[LOWEST]
    while bucket < BUCKETS and buckets[bucket] < 0:
        bucket += 1
    counters[LOWEST] = bucket
    if bucket >= BUCKETS:
        return -1
    index = buckets[bucket]
    buckets[bucket] = nodes[index].next
    counters[WAITING] -= 1
    return int(index)


@fast
def drop_highest(nodes: Any, buckets: Any, pool: Any, counters: Any) -> None:
    """Give up the least promising node, for the sake of its memory."""
    bucket = counters[HIGHEST]
    while bucket >= 0 and buckets[bucket] < 0:
        bucket -= 1
    counters[HIGHEST] = bucket
    if bucket < 0:
        return
    index = buckets[bucket]
    buckets[bucket] = nodes[index].next
    counters[WAITING] -= 1
    counters[DROPPED] += 1
    if nodes[index].chunk >= 0:
        free_state(nodes[index].chunk, pool, counters)
        nodes[index].chunk = -1


@fast
def stage_of(w: Any, switch_slots: Any, switches: int, stages: Any, places: Any, counters: Any, guess: int) -> int:
    """Index of the present stage; a stage that is seen for the first time is noted for the caller. -1: too many."""
    mask = 0
    for k in range(switches):
        if w.things[switch_slots[k]].spent:
            mask |= 1 << k
    if stages[guess] == mask and guess < counters[STAGES]:
        return guess
    for k in range(counters[STAGES]):
        if stages[k] == mask:
            return k
    index = counters[STAGES]
    if index >= MAX_STAGES:
        return -1
    stages[index] = mask
    places[index, 0] = w.ninja.x
    places[index, 1] = w.ninja.y
    counters[STAGES] = index + 1
    counters[NEW_STAGES] += 1
    return int(index)


@fast
def gold_hash(w: Any, gold_slots: Any) -> int:
    """Sixteen bits that tell which pieces have been collected; 0 for none."""
    mixed = 0
    for k in range(len(gold_slots)):
        if w.things[gold_slots[k]].spent:
            mixed ^= (k + 1) * 40503
    return mixed & 0xFFFF


@fast
def gold_ahead(w: Any, needed: int, gold_slots: Any, gold_fields: Any, point: int) -> float:
    """Estimated ticks for the gold that is still needed: the nearest piece, and a step for each further one."""
    nearest = 1.0e9
    for k in range(len(gold_slots)):
        if not w.things[gold_slots[k]].spent and gold_fields[k, point] < nearest:
            nearest = gold_fields[k, point]
    return nearest + GOLD_STEP * needed


@fast
def note_link(links: Any, counters: Any, source: int, target: int, ticks: int) -> None:
    """Remember that a macro leads from one table entry to another."""
    link = links[counters[LINKS]]
    counters[LINKS] += 1
    link.source = source
    link.target = target
    link.ticks = ticks


@entry_point
def begin(
    levels: Any, worlds: Any, words: Any, nodes: Any, table: Any, links: Any, pool: Any, buckets: Any,
    counters: Any, parameters: Any, stages: Any, places: Any, fields: Any, goals: Any, gold_fields: Any,
    guide: Any, guide_parameters: Any, budget: int,
) -> int:  # fmt: skip
    """Make the root, the start of the level. Arguments as for ``expand``."""
    base, _, work_words = words
    switch_slots, switches, gold_slots = goals
    for k in range(len(base)):
        work_words[k] = base[k]
    w = worlds[1]
    stage = stage_of(w, switch_slots, switches, stages, places, counters, 0)
    key = key_of(w, stage, gold_hash(w, gold_slots) if counters[GOLD_NEEDED] > 0 else 0, parameters)
    slot = find(table, key)
    table[slot].key = key
    table[slot].visits = 1
    counters[ENTRIES] += 1
    root = nodes[0]
    counters[NODES] += 1
    root.parent = -1
    root.tick = 0
    root.action = 0
    root.stage = stage
    root.entry = slot
    root.ahead = 0.0
    keep_state(work_words, base, root, pool, counters)
    push(nodes, 0, 0.0, buckets, counters)
    return 0


@entry_point
def expand(
    levels: Any, worlds: Any, words: Any, nodes: Any, table: Any, links: Any, pool: Any, buckets: Any,
    counters: Any, parameters: Any, stages: Any, places: Any, fields: Any, goals: Any, gold_fields: Any,
    guide: Any, guide_parameters: Any, budget: int,
) -> int:  # fmt: skip
    """Expand nodes until ``budget`` ticks were run, a new stage wants its field, or nothing is left.

    ``words``: the start, the node's world and the working world as words; ``pool``: the chunk arrays; ``goals``: slots
    of the switches, how many, slots of the gold. ``guide``: the table of an earlier search whose ``value`` is the
    estimate (length 1: none). Answers 0: go on, 1: nothing left, 2: no room for nodes.
    """
    base, node_words, work_words = words
    switch_slots, switches, gold_slots = goals
    level = levels[0]
    here = worlds[0]
    w = worlds[1]
    guided = len(guide) > 1
    stop = counters[TICKS] + budget
    while counters[TICKS] < stop and counters[NEW_STAGES] == 0:
        if counters[NODES] + 16 > len(nodes) or counters[LINKS] + 16 > len(links):
            counters[FULL] = 1
            return 2
        index = pop_lowest(nodes, buckets, counters)
        if index < 0:
            return 1
        node = nodes[index]
        if node.chunk < 0:
            continue
        # A bound that fell since, or an earlier arrival at the same key, may have made it pointless.
        stale = table[node.entry].first < node.tick and parameters[REVISITS] < 2.0
        if stale or (counters[BEST_TICKS] > 0 and node.tick + 1 >= counters[BEST_TICKS]):
            free_state(node.chunk, pool, counters)
            node.chunk = -1
            continue
        load_state(node_words, base, node, pool)
        free_state(node.chunk, pool, counters)
        node.chunk = -1
        counters[EXPANDED] += 1
        ninja = here.ninja
        held = ninja.held
        wall = ninja.in_air and ninja.near_wall
        slow = abs(ninja.x - ninja.px) + abs(ninja.y - ninja.py) < 0.5
        for choice in range(10):
            direction = choice % 3 - 1
            mode = choice // 3
            limit = int(parameters[MACRO_TICKS])
            if parameters[MACRO_JITTER] > 0.0:
                limit += draw(counters) % (int(parameters[MACRO_JITTER]) + 1)
            if mode == 3:
                # Waiting: only at rest, and longer than a macro, or it would not be news.
                if ninja.in_air or not slow or parameters[REVISITS] < 2.0:
                    continue
                direction = 0
                mode = RELEASED
                limit = int(parameters[PATIENCE])
            elif mode == PRESSED:
                if held:
                    if ninja.state != JUMPING:
                        continue
                elif ninja.in_air and not wall:
                    continue
            elif mode == PRESSED_AGAIN and not (held and (wall or not ninja.in_air)):
                continue
            for k in range(len(node_words)):
                work_words[k] = node_words[k]
            played = play_macro(level, w, direction, mode, limit)
            counters[TICKS] += played
            if w.outcome != OUTCOME_RUNNING:
                if w.outcome != OUTCOME_EXIT or w.gold < counters[GOLD_NEEDED]:
                    continue
                note_link(links, counters, node.entry, -1, played)
                if counters[BEST_TICKS] == 0 or w.tick < counters[BEST_TICKS]:
                    counters[BEST_TICKS] = w.tick
                    counters[BEST_NODE] = counters[NODES]
                    child = nodes[counters[NODES]]
                    counters[NODES] += 1
                    child.parent = index
                    child.tick = w.tick
                    child.action = action_code(direction, mode, held, played)
                    child.chunk = -1
                continue
            if w.tick >= LIFETIME + GOLD_BONUS * w.gold:
                continue
            stage = stage_of(w, switch_slots, switches, stages, places, counters, node.stage)
            if stage < 0:
                continue
            point = point_at(w.ninja.x, w.ninja.y)
            needed = counters[GOLD_NEEDED] - w.gold
            gold = 0
            ahead = fields[stage, point] if fields[stage, 0] >= 0.0 else node.ahead
            if counters[GOLD_NEEDED] > 0:
                gold = gold_hash(w, gold_slots)
                if w.gold > counters[MOST_GOLD]:
                    counters[MOST_GOLD] = w.gold
                if needed > 0:
                    ahead = gold_ahead(w, needed, gold_slots, gold_fields, point)
            best = counters[BEST_TICKS]
            if best > 0 and w.tick + ahead * 0.4 >= best:
                continue
            key = key_of(w, stage, gold, parameters)
            slot = find(table, key)
            if table[slot].key != 0:
                note_link(links, counters, node.entry, slot, played)
                if not is_news(table[slot], w.tick, parameters):
                    continue
            if guided:
                known = find(guide, key_of(w, stage, gold, guide_parameters))
                if guide[known].key != 0 and guide[known].value < 1.0e8:
                    ahead = guide[known].value
                else:
                    ahead = node.ahead - played + parameters[OFF_GUIDE] * played
                if best > 0 and w.tick + ahead > best + parameters[SLACK]:
                    continue
            entry = table[slot]
            if entry.key == 0:
                if counters[ENTRIES] * 4 > len(table) * 3:
                    counters[FULL] = 1
                    return 2
                counters[ENTRIES] += 1
                entry.key = key
                entry.first = w.tick
                entry.last = w.tick
                note_link(links, counters, node.entry, slot, played)
            entry.visits += 1
            entry.first = min(entry.first, w.tick)
            entry.last = max(entry.last, w.tick)
            child_index = counters[NODES]
            child = nodes[child_index]
            counters[NODES] += 1
            child.parent = index
            child.tick = w.tick
            child.action = action_code(direction, mode, held, played)
            child.stage = stage
            child.entry = slot
            child.ahead = ahead
            child.chunk = -1
            while not keep_state(work_words, base, child, pool, counters) and counters[WAITING] > 0:
                drop_highest(nodes, buckets, pool, counters)
            push(nodes, child_index, w.tick + parameters[WEIGHT] * ahead, buckets, counters)
    return 0

"""Best-first search over save-states: the compiled inner loop.

The node with the least (ticks so far + weight x estimated ticks to go) is taken from the buckets, all macros are
played from its save-state, and every moment whose key is news becomes a node.
"""

from __future__ import annotations

from ninja_game.search.heuristics import point_at
from ninja_game.search.known_run import KnownRun, nearest
from ninja_game.search.macros import PRESSED, PRESSED_AGAIN, RELEASED, action_code, play_macro
from ninja_game.search.nodes import (
    BUCKETS,
    Counters,
    Guide,
    Node,
    Resolution,
    SearchMemory,
    Start,
    drop_highest,
    free_state,
    keep_state,
    load_state,
    pop_lowest,
    push,
    random_below,
)
from ninja_game.search.states import MIX, Goals, estimate, find, gold_hash, is_news, key_of, open_mask, switch_state_of
from ninja_game.sim.inputs import pressed
from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.memory.schema import Ninja, TileMap, World
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import JUMPING, OUTCOME_DEAD, OUTCOME_EXIT, OUTCOME_RUNNING
from ninja_game.sim.world import step

CHOICES = 10
"""Macros to choose from: three directions by three modes of the jump key, and waiting."""
BOUND_SHARE = 0.4
"""What share of the estimate a run may count on when it is compared with the best one; fields are a guide only."""
OTHER_ENDS = 8
"""Ends of a leg that are kept where another switch than a wanted one was touched."""
MORE, EXHAUSTED, NO_ROOM = 0, 1, 2
"""How a slice of a search ended."""


@entry_point
def add_root(start: Start, memory: SearchMemory, goals: Goals, resolution: Resolution) -> None:
    """Make the working world a node from which the search begins."""
    w = start.worlds[1]
    counters = memory.counters[0]
    switch_state = max(switch_state_of(w, goals, counters, 0), 0)
    key = key_of(w, goals, switch_state, 0, resolution)
    slot = find(memory.table, key)
    if memory.table[slot].key == 0:
        memory.table[slot].key = key
        memory.table[slot].visits = 1
        memory.table[slot].first = w.tick
        memory.table[slot].last = w.tick
        counters.entries += 1
    index = add_node(-1, 0, w.tick, memory)
    root = memory.nodes[index]
    root.switch_state = switch_state
    root.entry = slot
    root.ahead = 0.0
    keep_state(start.work_words, start.base, root, memory)
    push(index, 0.0 + w.tick, memory)


@entry_point
def load_node(start: Start, memory: SearchMemory, index: int) -> None:
    """Make the save-state of a node that has one the working world."""
    load_state(start.work_words, start.base, memory.nodes[index], memory)


@entry_point
def expand(start: Start, memory: SearchMemory, goals: Goals, guide: Guide, resolution: Resolution, budget: int) -> int:
    """Expand nodes until ``budget`` ticks were run, a switch state wants its field, or enough ends of a leg are found.

    Answers MORE, EXHAUSTED (nothing is left) or NO_ROOM (for nodes).
    """
    here = start.worlds[0]
    w = start.worlds[1]
    counters = memory.counters[0]
    stop = counters.ticks + budget
    while counters.ticks < stop and counters.wanted_fields == 0 and counters.ends - counters.others < goals.ends:
        full = counters.nodes + 16 > len(memory.nodes) or counters.links + 16 > len(memory.links)
        if full or counters.entries * 4 > len(memory.table) * 3:
            return NO_ROOM
        index = pop_lowest(memory)
        if index < 0:
            return EXHAUSTED
        if not take_state(memory.nodes[index], start, memory, resolution):
            continue
        counters.expanded += 1
        held = here.ninja.jump_held
        for choice in range(CHOICES):
            direction, mode, limit = macro_of(here.ninja, choice, counters, resolution)
            if limit == 0:
                continue
            for k in range(len(start.node_words)):
                start.work_words[k] = start.node_words[k]
            played = play_macro(start.levels[0], w, direction, mode, limit)
            counters.ticks += played
            action = action_code(direction, mode, held, played)
            if w.outcome == OUTCOME_RUNNING:
                if w.tick < LIFETIME + GOLD_BONUS * w.gold:
                    keep_child(index, action, played, start, memory, goals, guide, resolution)
            elif w.outcome == OUTCOME_EXIT and w.gold >= goals.gold:
                keep_end(index, action, played, w.tick, memory)
    return MORE


@fast
def take_state(node: Node, start: Start, memory: SearchMemory, resolution: Resolution) -> bool:
    """Load a node's save-state and give its chunks back. False, and nothing loaded, if the node is pointless by now.

    A bound that fell since, or an earlier arrival at the same key, makes it so.
    """
    if node.chunk < 0:
        return False
    stale = memory.table[node.entry].first < node.tick and resolution.visits < 2
    best = memory.counters[0].best_ticks
    late = best > 0 and node.tick + 1 >= best
    wanted = not (stale or late)
    if wanted:
        load_state(start.node_words, start.base, node, memory)
    free_state(node.chunk, memory)
    node.chunk = -1
    return wanted


@fast
def macro_of(ninja: Ninja, choice: int, counters: Counters, resolution: Resolution) -> tuple[int, int, int]:
    """Direction, mode and most ticks of a choice; 0 ticks if it makes no difference to this ninja."""
    wall = ninja.in_air and ninja.near_wall
    limit = resolution.macro
    if resolution.jitter > 0:
        limit += random_below(counters, resolution.jitter + 1)
    direction = choice % 3 - 1
    mode = choice // 3
    if mode == PRESSED:
        useful = ninja.state == JUMPING if ninja.jump_held else not ninja.in_air or wall
    elif mode == PRESSED_AGAIN:
        useful = ninja.jump_held and (wall or not ninja.in_air)
    elif mode > PRESSED_AGAIN:
        # Waiting: only at rest, and longer than a macro, or it would not be news.
        slow = abs(ninja.x - ninja.prev_x) + abs(ninja.y - ninja.prev_y) < 0.5
        useful = slow and not ninja.in_air and resolution.visits >= 2
        direction = 0
        mode = RELEASED
        limit = resolution.patience
    else:
        useful = True
    return direction, mode, limit if useful else 0


@fast
def keep_end(parent: int, action: int, played: int, tick: int, memory: SearchMemory) -> None:
    """Note that a node leads to the exit; keep the run if it is the shortest."""
    counters = memory.counters[0]
    note_link(memory, memory.nodes[parent].entry, -1, played)
    if counters.best_ticks == 0 or tick < counters.best_ticks:
        counters.best_ticks = tick
        counters.best_node = add_node(parent, action, tick, memory)


@fast
def keep_child(
    parent: int, action: int, played: int, start: Start, memory: SearchMemory, goals: Goals, guide: Guide,
    resolution: Resolution,
) -> None:  # fmt: skip
    """Make a node of the working world if its key is news and it can still beat the best run."""
    w = start.worlds[1]
    counters = memory.counters[0]
    source = memory.nodes[parent]
    switch_state = switch_state_of(w, goals, counters, source.switch_state)
    if switch_state < 0:
        return
    tick = w.tick
    best = counters.best_ticks
    ahead = estimate(goals, switch_state, point_at(w.ninja.x, w.ninja.y), source.ahead)
    if best > 0 and tick + ahead * BOUND_SHARE >= best:
        return
    at_end = goals.leg > 0 and (w.gold >= goals.leg or goals.masks[switch_state] != goals.mask)
    gold = gold_hash(w, goals) if at_end else 0
    elsewhere = at_end and goals.wanted != 0 and not goals.masks[switch_state] & goals.wanted
    if elsewhere and counters.others >= OTHER_ENDS:
        return
    key = key_of(w, goals, switch_state, gold, resolution)
    slot = find(memory.table, key)
    entry = memory.table[slot]
    if entry.key != 0:
        note_link(memory, source.entry, slot, played)
        if not is_news(entry, tick, resolution):
            return
    if len(guide.table) > 1:
        known = guide.table[find(guide.table, key_of(w, goals, switch_state, gold, guide.resolution))]
        if known.key != 0 and known.value < 1.0e8:
            ahead = 0.0 + known.value
        else:
            ahead = source.ahead - played + resolution.off_guide * played
        if best > 0 and tick + ahead > best + resolution.slack:
            return
    if entry.key == 0:
        note_link(memory, source.entry, slot, played)
    index = keep_node(parent, action, slot, key, ahead, start, memory)
    child = memory.nodes[index]
    child.switch_state = switch_state
    if not at_end:
        push(index, tick + resolution.weight * ahead, memory)
    elif child.chunk >= 0 and (goals.rollouts == 0 or survives(child, start, memory, goals.rollouts)):
        memory.ends[counters.ends] = index
        counters.ends += 1
        counters.others += elsewhere


@fast
def keep_node(parent: int, action: int, slot: int, key: int, ahead: float, start: Start, memory: SearchMemory) -> int:
    """Make the working world a node, with a save-state if there is room, and note it under its key; its index.

    ``slot``: the place of the key in the table.
    """
    counters = memory.counters[0]
    tick = start.worlds[1].tick
    entry = memory.table[slot]
    if entry.key == 0:
        counters.entries += 1
        entry.key = key
        entry.first = tick
    entry.visits += 1
    entry.first = min(entry.first, tick)
    entry.last = max(entry.last, tick)
    index = add_node(parent, action, tick, memory)
    node = memory.nodes[index]
    node.entry = slot
    node.ahead = ahead
    while not keep_state(start.work_words, start.base, node, memory) and counters.waiting > 0:
        drop_highest(memory)
    return index


@fast
def add_node(parent: int, action: int, tick: int, memory: SearchMemory) -> int:
    """A new node without a save-state; its index."""
    counters = memory.counters[0]
    index = counters.nodes
    counters.nodes += 1
    node = memory.nodes[index]
    node.parent = parent
    node.tick = tick
    node.action = action
    node.chunk = -1
    return int(index)


@fast
def note_link(memory: SearchMemory, source: int, target: int, ticks: int) -> None:
    """Remember that a macro leads from one table entry to another."""
    counters = memory.counters[0]
    link = memory.links[counters.links]
    counters.links += 1
    link.source = source
    link.target = target
    link.ticks = ticks


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

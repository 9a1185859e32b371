"""Best-first search (weighted A*) over save-states: the compiled inner loop of every search.

The search takes the node with the least (ticks so far + weight x estimated ticks to go) from the open list, plays all
macros from its save-state, and makes a node of every state that is not a duplicate. Goals differ in the estimate and in
the end of the search: the exit, the end of a leg, or a run shorter than a known one (``Goal``).

The kernels share these arguments. ``start``: the level and two scratch worlds; ``arrays``: the arrays of the search;
``backed_up``: the table of an earlier search; ``resolution``: how finely states are told apart; ``parent``: the index
of a node; ``action``: the macro (macros.py) that leads from it to the scratch world, ``played``: its ticks.
"""

from __future__ import annotations

from ninja_game.search.heuristics import UNREACHED, point_at
from ninja_game.search.known_run import KnownRun, nearest_row
from ninja_game.search.macros import (
    MAX_ROWS,
    PRESSED,
    PRESSED_AGAIN,
    RELEASED,
    action_code,
    follow,
    followed_code,
    play_macro,
)
from ninja_game.search.nodes import (
    BUCKETS,
    BackedUpHeuristic,
    Counters,
    Node,
    Resolution,
    SearchArrays,
    Start,
    copy_words,
    drop_highest,
    free_state,
    keep_state,
    load_state,
    pop_lowest,
    push_node,
    random_below,
)
from ninja_game.search.states import Goal, estimate, find_entry, gold_hash, is_done, is_new, state_key, switch_state_of
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.world_fields import Ninja
from ninja_game.sim.states import JUMPING, OUTCOME_DEAD, OUTCOME_EXIT, OUTCOME_RUNNING

CHOICES = 10  # macros per state: three directions by three modes of the jump key, and waiting
FOLLOW_CHOICES = 3
"""Rows of a known run from which a search follows it: the one nearest to the state, and its two neighbours."""
FEWEST_TICKS_FOLLOWED, DRAWN_TICKS_FOLLOWED = 3, 24
"""Ticks for which a known run is followed at once: the fewest, and how many numbers are drawn from there."""
ROOM = 16  # nodes and links for which there must be room before a node is expanded, more than it has children
BOUND_SHARE = 0.4
"""Share of the estimate in the comparison of a node with the best run: fields may be too high. Not tuned."""
MIN_GAIN = 0.5  # Ticks by which the part after a span must seem shorter than that of the known run. Not tuned.
OTHER_ENDS = 8  # Ends of a leg that are kept although they touched a switch that was not wanted. Not tuned.
SURVIVAL = 60  # Ticks that the ninja must be able to survive after the end of a leg. Not tuned.
MORE, EXHAUSTED, OUT_OF_NODES = 0, 1, 2  # result of a slice of a search


@kernel
def add_root(start: Start, arrays: SearchArrays, goal: Goal, resolution: Resolution) -> None:
    """Make the scratch world a root of the search."""
    w = start.worlds[1]
    counters = arrays.counters[0]
    switch_state = max(switch_state_of(w, goal, counters, 0), 0)
    key = state_key(w, goal, switch_state, 0, resolution)
    slot = find_entry(arrays.table, key)
    if arrays.table[slot].key == 0:
        arrays.table[slot].key = key
        arrays.table[slot].visits = 1
        arrays.table[slot].first = w.tick
        arrays.table[slot].last = w.tick
        counters.entries += 1
    index = add_node(-1, 0, w.tick, arrays)
    root = arrays.nodes[index]
    root.switch_state = switch_state
    root.entry = slot
    root.to_go = 0.0
    keep_state(start.scratch, start.initial, root, arrays)
    push_node(index, 0.0 + w.tick, arrays)


@kernel
def load_node(start: Start, arrays: SearchArrays, index: int) -> None:
    load_state(start.scratch, start.initial, arrays.nodes[index], arrays)


@kernel
def expand(
    start: Start,
    arrays: SearchArrays,
    goal: Goal,
    known: KnownRun | None,
    backed_up: BackedUpHeuristic,
    resolution: Resolution,
    budget: int,
) -> int:
    """Expand nodes until ``budget`` ticks were run, a switch state needs its field, or a leg has enough ends.

    ``known``: the run along which to search. None: a search for the exit or of a leg; the code for known runs is not
    compiled then. Returns MORE, EXHAUSTED (no node left) or OUT_OF_NODES (no room for nodes).
    """
    here = start.worlds[0]
    w = start.worlds[1]
    counters = arrays.counters[0]
    stop = counters.ticks + budget
    while counters.ticks < stop and counters.fields_wanted == 0 and counters.ends - counters.other_ends < goal.ends:
        full = counters.nodes + ROOM > len(arrays.nodes) or counters.links + ROOM > len(arrays.links)
        if full or counters.entries * 4 > len(arrays.table) * 3:
            return OUT_OF_NODES
        index = pop_lowest(arrays)
        if index < 0:
            return EXHAUSTED
        if not take_state(arrays.nodes[index], start, arrays, resolution):
            continue
        held = here.ninja.jump_held
        row = -1
        if known is not None:
            row, _ = nearest_row(known, here, goal.masks[arrays.nodes[index].switch_state])
        for choice in range(CHOICES + FOLLOW_CHOICES if row >= 0 else CHOICES):
            if choice < CHOICES:
                direction, mode, limit = macro_of(here.ninja, choice, counters, resolution)
                if limit == 0:
                    continue
                copy_words(start.scratch, start.node)
                played = play_macro(start.maps[0], w, direction, mode, limit)
                action = action_code(direction, mode, held, played)
            else:
                first = row + (choice - CHOICES + 1) % FOLLOW_CHOICES - 1
                if not 0 <= first < MAX_ROWS:
                    continue
                copy_words(start.scratch, start.node)
                played = 0
                if known is not None:
                    limit = FEWEST_TICKS_FOLLOWED + random_below(counters, DRAWN_TICKS_FOLLOWED)
                    played = follow(start.maps[0], w, known.keys, first, limit)
                action = followed_code(first, played)
            counters.ticks += played
            if w.outcome == OUTCOME_RUNNING and played > 0:
                if known is not None:
                    keep_along(index, action, start, arrays, goal, known, resolution)
                elif w.tick < LIFETIME + GOLD_BONUS * w.gold:
                    keep_child(index, action, played, start, arrays, goal, backed_up, resolution)
            elif w.outcome == OUTCOME_EXIT and w.gold >= goal.gold:
                note_exit(index, action, played, w.tick, arrays, known)
    return MORE


@fast
def take_state(node: Node, start: Start, arrays: SearchArrays, resolution: Resolution) -> bool:
    """Load a node's save-state and give its chunks back; False, without loading, if the node cannot help any more.

    It cannot if a shorter run or an earlier arrival at the same key came in the meantime.
    """
    if node.chunk < 0:
        return False
    stale = arrays.table[node.entry].first < node.tick and resolution.visits < 2
    best = arrays.counters[0].best_ticks
    late = best > 0 and node.tick + 1 >= best
    wanted = not (stale or late)
    if wanted:
        load_state(start.node, start.initial, node, arrays)
    free_state(node.chunk, arrays)
    node.chunk = -1
    return wanted


@fast
def macro_of(ninja: Ninja, choice: int, counters: Counters, resolution: Resolution) -> tuple[int, int, int]:
    """Direction, mode and most ticks of a choice; 0 ticks if the choice changes nothing for this ninja."""
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
        # Waiting: only at rest, and longer than a macro, otherwise it equals one.
        slow = abs(ninja.x - ninja.prev_x) + abs(ninja.y - ninja.prev_y) < 0.5
        useful = slow and not ninja.in_air and resolution.visits >= 2
        direction = 0
        mode = RELEASED
        limit = resolution.patience
    else:
        useful = True
    return direction, mode, limit if useful else 0


@fast
def note_exit(parent: int, action: int, played: int, tick: int, arrays: SearchArrays, known: KnownRun | None) -> None:
    """Record that a node leads to the exit; keep the run if it is the shortest."""
    counters = arrays.counters[0]
    if known is None:
        note_link(arrays, arrays.nodes[parent].entry, -1, played)
    if counters.best_ticks == 0 or tick < counters.best_ticks:
        counters.best_ticks = tick
        counters.best_node = add_node(parent, action, tick, arrays)


@fast
def keep_along(
    parent: int, action: int, start: Start, arrays: SearchArrays, goal: Goal, known: KnownRun, resolution: Resolution
) -> None:
    """Make the scratch world a node if it is not a duplicate and may lead to a shorter run than the known one.

    Its ticks to go are those of the known run from the row that is most like the scratch world.
    """
    w = start.worlds[1]
    switch_state = switch_state_of(w, goal, arrays.counters[0], arrays.nodes[parent].switch_state)
    if switch_state < 0:
        return
    key = state_key(w, goal, switch_state, 0, resolution)
    slot = find_entry(arrays.table, key)
    if not is_new(arrays.table[slot], w.tick, resolution):
        return
    _, to_go = nearest_row(known, w, goal.masks[switch_state])
    run_ticks = w.tick + to_go
    delay = known.max_delay if w.tick < known.span[1] else -MIN_GAIN
    if run_ticks <= arrays.counters[0].best_ticks + delay:
        index = keep_node(parent, action, slot, key, to_go, switch_state, start, arrays)
        # Two buckets per tick; the states of the known run itself are in the middle one.
        push_node(index, 0.5 * BUCKETS + 2.0 * (run_ticks - len(known.keys)), arrays)


@fast
def keep_child(
    parent: int,
    action: int,
    played: int,
    start: Start,
    arrays: SearchArrays,
    goal: Goal,
    backed_up: BackedUpHeuristic,
    resolution: Resolution,
) -> None:
    """Make the scratch world a node on the way to the exit or to the end of a leg.

    Its ticks to go come from the distance field of its switch state, or from the table of an earlier search.
    """
    w = start.worlds[1]
    counters = arrays.counters[0]
    source = arrays.nodes[parent]
    switch_state = switch_state_of(w, goal, counters, source.switch_state)
    if switch_state < 0:
        return
    tick = w.tick
    best = counters.best_ticks
    to_go = estimate(goal, switch_state, point_at(w.ninja.x, w.ninja.y), source.to_go)
    if best > 0 and tick + to_go * BOUND_SHARE >= best:
        return
    mask = goal.masks[switch_state]
    at_end = goal.leg > 0 and (is_done(w, goal.target) if goal.target else w.gold >= goal.leg or mask != goal.mask)
    gold = gold_hash(w, goal) if at_end else 0
    other_end = at_end and goal.wanted != 0 and not mask & goal.wanted
    if other_end and counters.other_ends >= OTHER_ENDS:
        return
    key = state_key(w, goal, switch_state, gold, resolution)
    slot = find_entry(arrays.table, key)
    entry = arrays.table[slot]
    if entry.key != 0:
        note_link(arrays, source.entry, slot, played)
        if not is_new(entry, tick, resolution):
            return
    if len(backed_up.table) > 1:
        known = backed_up.table[
            find_entry(backed_up.table, state_key(w, goal, switch_state, gold, backed_up.resolution))
        ]
        if known.key != 0 and known.value < UNREACHED:
            to_go = 0.0 + known.value
        else:
            to_go = source.to_go - played + resolution.off_table * played
        if best > 0 and tick + to_go > best + resolution.slack:
            return
    if entry.key == 0:
        note_link(arrays, source.entry, slot, played)
    index = keep_node(parent, action, slot, key, to_go, switch_state, start, arrays)
    child = arrays.nodes[index]
    if not at_end:
        push_node(index, tick + resolution.weight * to_go, arrays)
    elif child.chunk >= 0 and (goal.rollouts == 0 or survives(child, start, arrays, goal.rollouts)):
        arrays.ends[counters.ends] = index
        counters.ends += 1
        counters.other_ends += other_end


@fast
def keep_node(
    parent: int, action: int, slot: int, key: int, to_go: float, switch_state: int, start: Start, arrays: SearchArrays
) -> int:
    """Make the scratch world a node, with a save-state if there is room, and enter it under its key; gives its index.

    ``slot``: the place of the key in the table.
    """
    counters = arrays.counters[0]
    tick = start.worlds[1].tick
    entry = arrays.table[slot]
    if entry.key == 0:
        counters.entries += 1
        entry.key = key
        entry.first = tick
    entry.visits += 1
    entry.first = min(entry.first, tick)
    entry.last = max(entry.last, tick)
    index = add_node(parent, action, tick, arrays)
    node = arrays.nodes[index]
    node.entry = slot
    node.to_go = to_go
    node.switch_state = switch_state
    while not keep_state(start.scratch, start.initial, node, arrays) and counters.waiting > 0:
        drop_highest(arrays)
    return index


@fast
def add_node(parent: int, action: int, tick: int, arrays: SearchArrays) -> int:
    """Add a node without a save-state; gives its index."""
    counters = arrays.counters[0]
    index = counters.nodes
    counters.nodes += 1
    node = arrays.nodes[index]
    node.parent = parent
    node.tick = tick
    node.action = action
    node.chunk = -1
    return int(index)


@fast
def note_link(arrays: SearchArrays, source: int, target: int, ticks: int) -> None:
    counters = arrays.counters[0]
    link = arrays.links[counters.links]
    counters.links += 1
    link.source = source
    link.target = target
    link.ticks = ticks


@fast
def survives(node: Node, start: Start, arrays: SearchArrays, rollouts: int) -> bool:
    """Whether the ninja, from a node's save-state on with random keys, ever lands or lives for a while.

    This overwrites the scratch world.
    """
    w = start.worlds[1]
    counters = arrays.counters[0]
    for _ in range(rollouts):
        load_state(start.scratch, start.initial, node, arrays)
        until = w.tick + SURVIVAL
        while w.outcome != OUTCOME_DEAD:
            if w.tick >= until or not w.ninja.in_air:
                return True
            direction = random_below(counters, 3) - 1
            mode = RELEASED if random_below(counters, 3) else PRESSED
            counters.ticks += play_macro(start.maps[0], w, direction, mode, 4 + random_below(counters, 30))
    return False

"""The data of a search: plain arrays and records under names, without Python objects.

The groups are named tuples, which compiled code accepts. Counters are a record, alone in its array.

A node's save-state is stored as the words (8 bytes) that differ from the start of the level, in chunks of a pool. A
node that was expanded gives its chunks back.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.compiled import load_worlds
from ninja_game.backend.layout import STATE_START, WorldArray, dtype_of, new_worlds, used_bytes
from ninja_game.backend.memories import compiled
from ninja_game.search.heuristics import UNREACHED
from ninja_game.sim.level import Level
from ninja_game.sim.schema.declare import f4, fast, i4, i8, kernel, struct, struct_base

StateWords = NDArray[np.int64]
Int32s = NDArray[np.int32]

CHUNK = 32  # words in a chunk
BUCKETS = 1 << 14  # buckets of the open list, by priority: one per tick, two per tick in a search along a run
LARGE_STATE = 10_000  # words; the states of all levels of N are smaller
_MAX_ENDS = 96  # ends of a leg that are kept, with room for those of the last expansion


FROM_START, MUTATIONS, ALONG_RUN, PASSES = 6, 7, 8, 9
"""Streams of random numbers of a seed: searches from the start, edits of keys, searches along a run, choices."""


@struct_base
class RandomState:
    """A stream of pseudo-random numbers."""

    random: i8  #: never 0


@fast
def random_below(source: RandomState, limit: int) -> int:
    """A pseudo-random number from 0 to limit - 1 (xorshift)."""
    x = source.random
    x ^= x << 13
    x ^= (x >> 7) & 0x01FFFFFFFFFFFFFF
    x ^= x << 17
    source.random = x
    return int(((x >> 20) & 0x7FFFFFFF) % limit)


@struct
class Node:
    """A state that a search has reached."""

    parent: i4  #: index of the previous node, -1: this is the root
    tick: i4  #: ticks run
    action: i4  #: action that led here (macros.py)
    chunk: i4  #: first chunk of its save-state, -1: none (any more)
    words: i4  #: words in its save-state
    next: i4  #: next node of its bucket, -1: last
    switch_state: i4  #: index of its switch state (heuristics.py)
    entry: i4  #: place in the table
    to_go: f4  #: estimated ticks to the exit


@struct
class TableEntry:
    """A row of the table: states that count as the same."""

    key: i8  #: 0: empty
    first: i4  #: earliest tick at which it was reached
    last: i4  #: latest accepted tick
    visits: i4  #: number of accepted arrivals
    value: f4  #: ticks from here to the exit, if known


@struct
class Link:
    """One played macro, from table entry to table entry (-1: the exit)."""

    source: i4
    target: i4
    ticks: i4


@struct
class Counters(RandomState):
    """The counters of a search, shared by its kernels and their caller."""

    nodes: i8  #: made so far
    entries: i8  #: entries of the table in use
    links: i8  #: links recorded so far
    free_chunk: i8  #: first free chunk, -1: none
    waiting: i8  #: nodes in buckets
    lowest: i8  #: no node waits in a bucket below it
    highest: i8  #: no node waits in a bucket above it
    ticks: i8  #: ticks simulated
    best_ticks: i8  #: ticks of the shortest run; at first the bound, 0: none
    best_node: i8  #: its last node, -1: no run found
    fields_wanted: i8  #: reached switch states that have no field yet
    ends: i8  #: ends of a leg found so far
    other_ends: i8  #: ends of a leg at a switch that was not wanted


class Resolution(NamedTuple):
    """The resolution of a search: states within these steps of each other count as the same."""

    cell: float = 12.0  #: size of a place, px
    speed: float = 1.0  #: size of a velocity, px/tick
    macro: int = 5  #: length of a macro, ticks
    jitter: int = 0  #: most ticks by which a macro is longer, at random
    weight: float = 2.0  #: factor of the estimated ticks to go
    patience: int = 40  #: ticks after which the same place counts as new
    visits: int = 1  #: most times that a place counts
    enemy_cell: float = 0.0  #: size of a place of the enemies near the ninja, px; 0: enemies are ignored
    enemy_reach: float = 100.0  #: reach for these enemies: |dx| + |dy|, px
    slack: float = 0.0  #: guided search: ticks by which an estimate may exceed the best run, in a plan a share
    off_table: float = 1.0  #: guided search: factor of a tick where the guide knows nothing
    shift_x: float = 0.0  #: offset of the cells of places, px; each search draws its own
    shift_y: float = 0.0  #: px
    shift_vx: float = 0.0  #: offset of the cells of velocities, px/tick
    shift_vy: float = 0.0  #: px/tick


class Start(NamedTuple):
    """A level at tick 0 and two more worlds: that of the expanded node, and the scratch world.

    The words are views of the states of all three worlds.
    """

    maps: Any  #: the one level as kernels take it
    worlds: Any  #: the two worlds: the expanded node, scratch
    initial: StateWords  #: words of the level at tick 0, which never change
    node: StateWords  #: words of the expanded node
    scratch: StateWords


class SearchArrays(NamedTuple):
    """The arrays of one search: nodes and their links, the pool of save-states, the open list, the ends of a leg."""

    nodes: Sequence[Node]  #: states in the order in which they were reached
    table: Sequence[TableEntry]  #: states that were reached
    links: Sequence[Link]  #: the played macros
    chunk_next: Int32s  #: the next chunk of a save-state, or of the free ones
    chunk_index: Int32s  #: places of the words that differ
    chunk_value: StateWords  #: those words
    buckets: Int32s  #: the open list: the first node of each priority
    ends: Int32s  #: nodes at the end of a leg
    counters: Sequence[Counters]


class BackedUpHeuristic(NamedTuple):
    """The table of an earlier search, whose values serve as estimates (length 1: none), and its resolution."""

    table: Sequence[TableEntry]
    resolution: Resolution


def ticks_at_once(start: Start) -> int:
    """The most ticks between two looks at the clock: a million on levels of N, far fewer if states are larger."""
    return max(1, int(1_000_000 * min(1.0, LARGE_STATE / len(start.initial)) ** 2))


def open_start(level: Level, *, box: bool) -> Start:
    """Load a level. Raises LevelError if it cannot be played."""
    maps, first = load_worlds(compiled, [level], box=box)
    used = int(first["slots_used"][0])
    size = (used_bytes(used) - STATE_START) // 8
    initial = _words(first, 0, size).copy()
    worlds = new_worlds(2, used)
    start = Start(maps, worlds, initial, _words(worlds, 0, size), _words(worlds, 1, size))
    start.node[:] = initial
    start.scratch[:] = initial
    return start


def _words(worlds: WorldArray, index: int, size: int) -> StateWords:
    """View the state of a world as words."""
    return np.ndarray((size,), np.int64, worlds.base, index * worlds.strides[0] + STATE_START)


def zeroed(kind: type, count: int) -> Any:
    """Make zeroed records of a kind; memory is only touched when it is used."""
    return np.zeros(count, dtype_of(kind)).view(np.recarray)


def new_table(nodes: int) -> Any:
    """Make an empty table for this many nodes; its length is a power of two."""
    return zeroed(TableEntry, 1 << (2 * nodes - 1).bit_length())


def new_arrays(nodes: int) -> SearchArrays:
    """Make the arrays of a search of at most ``nodes`` nodes and chunks. Clear them before each search."""
    return SearchArrays(
        nodes=zeroed(Node, nodes),
        table=new_table(nodes),
        links=zeroed(Link, 6 * nodes),
        chunk_next=np.empty(nodes, np.int32),
        chunk_index=np.empty(nodes * CHUNK, np.int32),
        chunk_value=np.empty(nodes * CHUNK, np.int64),
        buckets=np.empty(BUCKETS, np.int32),
        ends=np.zeros(_MAX_ENDS, np.int32),
        counters=zeroed(Counters, 1),
    )


def clear(arrays: Any) -> None:
    """Reset the arrays for a new search. ``arrays.table`` must be the table of these nodes, or empty."""
    arrays.table[arrays.nodes["entry"][: int(arrays.counters[0].nodes)]] = 0
    arrays.chunk_next[:] = np.arange(1, len(arrays.chunk_next) + 1, dtype=np.int32)
    arrays.chunk_next[-1] = -1
    arrays.buckets[:] = -1
    arrays.counters[:] = 0
    arrays.counters[0].lowest = BUCKETS
    arrays.counters[0].best_node = -1


@kernel
def back_up_values(table: Sequence[TableEntry], links: Sequence[Link], count: int, sweeps: int) -> int:
    """Set ``value`` of all entries to the least ticks to the exit over ``count`` links; gives the sweeps made.

    The played macros link the entries; values spread backwards from the exit. An entry joins states that differ a
    little, so values are estimates, mostly too low.
    """
    for slot in range(len(table)):
        table[slot].value = UNREACHED
    for sweep in range(sweeps):
        changed = False
        for index in range(count - 1, -1, -1):
            link = links[index]
            value = 0.0 + link.ticks
            if link.target >= 0:
                value += table[link.target].value
            if value < table[link.source].value - 0.5:
                table[link.source].value = value
                changed = True
        if not changed:
            return sweep + 1
    return sweeps


@fast
def copy_words(target: StateWords, source: StateWords) -> None:
    for k in range(len(target)):
        target[k] = source[k]


@fast
def keep_state(words: StateWords, initial: StateWords, node: Node, arrays: SearchArrays) -> bool:
    """Store the first word and the words that differ from the start; False, without storing, if the pool is empty."""
    counters = arrays.counters[0]
    first = -1
    chunk = -1
    count = 0
    for k in range(len(words)):
        if words[k] == initial[k] and k > 0:
            continue
        if count % CHUNK == 0:
            free = counters.free_chunk
            if free < 0:
                if first >= 0:
                    arrays.chunk_next[chunk] = -1
                    free_state(first, arrays)
                return False
            counters.free_chunk = arrays.chunk_next[free]
            if first < 0:
                first = free
            else:
                arrays.chunk_next[chunk] = free
            chunk = free
        place = chunk * CHUNK + count % CHUNK
        arrays.chunk_index[place] = k
        arrays.chunk_value[place] = words[k]
        count += 1
    arrays.chunk_next[chunk] = -1
    node.chunk = first
    node.words = count
    return True


@fast
def free_state(first: int, arrays: SearchArrays) -> None:
    """Give a chain of chunks back."""
    counters = arrays.counters[0]
    last = first
    while arrays.chunk_next[last] >= 0:
        last = arrays.chunk_next[last]
    arrays.chunk_next[last] = counters.free_chunk
    counters.free_chunk = first


@fast
def load_state(words: StateWords, initial: StateWords, node: Node, arrays: SearchArrays) -> None:
    """Load the world of a node: the start with the node's words."""
    for k in range(len(initial)):
        words[k] = initial[k]
    chunk = node.chunk
    left = node.words
    while left > 0:
        place = chunk * CHUNK
        for k in range(place, place + min(left, CHUNK)):
            words[arrays.chunk_index[k]] = arrays.chunk_value[k]
        left -= CHUNK
        chunk = arrays.chunk_next[chunk]


@fast
def push_node(index: int, priority: float, arrays: SearchArrays) -> None:
    counters = arrays.counters[0]
    bucket = int(priority)
    bucket = 0 if bucket < 0 else min(bucket, BUCKETS - 1)
    arrays.nodes[index].next = arrays.buckets[bucket]
    arrays.buckets[bucket] = index
    counters.waiting += 1
    counters.lowest = min(counters.lowest, bucket)
    counters.highest = max(counters.highest, bucket)


@fast
def pop_lowest(arrays: SearchArrays) -> int:
    """Take the most promising node; -1 if the open list is empty."""
    counters = arrays.counters[0]
    bucket = counters.lowest
    while bucket < BUCKETS and arrays.buckets[bucket] < 0:
        bucket += 1
    counters.lowest = bucket
    return take_first(bucket, arrays) if bucket < BUCKETS else -1


@fast
def drop_highest(arrays: SearchArrays) -> None:
    """Give up the least promising node to free its memory."""
    counters = arrays.counters[0]
    bucket = counters.highest
    while bucket >= 0 and arrays.buckets[bucket] < 0:
        bucket -= 1
    counters.highest = bucket
    if bucket < 0:
        return
    node = arrays.nodes[take_first(bucket, arrays)]
    if node.chunk >= 0:
        free_state(node.chunk, arrays)
        node.chunk = -1


@fast
def take_first(bucket: int, arrays: SearchArrays) -> int:
    index = arrays.buckets[bucket]
    arrays.buckets[bucket] = arrays.nodes[index].next
    arrays.counters[0].waiting -= 1
    return int(index)

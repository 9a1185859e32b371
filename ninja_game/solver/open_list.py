"""A search's queue and its pool of save-states: buckets of nodes by priority, chunks of words."""

from __future__ import annotations

from typing import Any

from ninja_game.sim.memory.declare import fast
from ninja_game.solver.search_memory import (
    BUCKETS,
    CHUNK,
    FREE_CHUNK,
    HIGHEST,
    LOWEST,
    RANDOM,
    WAITING,
)


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
    if nodes[index].chunk >= 0:
        free_state(nodes[index].chunk, pool, counters)
        nodes[index].chunk = -1

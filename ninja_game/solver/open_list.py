"""A search's queue and its pool of save-states: buckets of nodes by priority, chunks of words."""

from __future__ import annotations

from ninja_game.sim.memory.declare import fast
from ninja_game.solver.search_memory import BUCKETS, CHUNK, Node, SearchMemory, Words


@fast
def keep_state(words: Words, base: Words, node: Node, memory: SearchMemory) -> bool:
    """Store the first word and those that differ from the start; False, and nothing stored, if the pool is empty."""
    counters = memory.counters[0]
    first = -1
    chunk = -1
    count = 0
    for k in range(len(words)):
        if words[k] != base[k] or k == 0:
            if count % CHUNK == 0:
                free = counters.free_chunk
                if free < 0:
                    if first >= 0:
                        memory.chunk_next[chunk] = -1
                        free_state(first, memory)
                    return False
                counters.free_chunk = memory.chunk_next[free]
                if first < 0:
                    first = free
                else:
                    memory.chunk_next[chunk] = free
                chunk = free
            place = chunk * CHUNK + count % CHUNK
            memory.chunk_index[place] = k
            memory.chunk_value[place] = words[k]
            count += 1
    if first >= 0:
        memory.chunk_next[chunk] = -1
    node.chunk = first
    node.words = count
    return True


@fast
def free_state(first: int, memory: SearchMemory) -> None:
    """Give a chain of chunks back."""
    counters = memory.counters[0]
    last = first
    while memory.chunk_next[last] >= 0:
        last = memory.chunk_next[last]
    memory.chunk_next[last] = counters.free_chunk
    counters.free_chunk = first


@fast
def load_state(words: Words, base: Words, node: Node, memory: SearchMemory) -> None:
    """Make the world of a node: the start with the node's words."""
    for k in range(len(base)):
        words[k] = base[k]
    chunk = node.chunk
    left = node.words
    while left > 0:
        place = chunk * CHUNK
        for k in range(place, place + min(left, CHUNK)):
            words[memory.chunk_index[k]] = memory.chunk_value[k]
        left -= CHUNK
        chunk = memory.chunk_next[chunk]


@fast
def push(index: int, priority: float, memory: SearchMemory) -> None:
    """Put a node into its bucket."""
    counters = memory.counters[0]
    bucket = int(priority)
    bucket = 0 if bucket < 0 else min(bucket, BUCKETS - 1)
    memory.nodes[index].priority = bucket
    memory.nodes[index].next = memory.buckets[bucket]
    memory.buckets[bucket] = index
    counters.waiting += 1
    if bucket < counters.lowest:
        counters.lowest = bucket
    if bucket > counters.highest:
        counters.highest = bucket


@fast
def pop_lowest(memory: SearchMemory) -> int:
    """Take the most promising node; -1 if there is none."""
    counters = memory.counters[0]
    bucket = counters.lowest
    while bucket < BUCKETS and memory.buckets[bucket] < 0:
        bucket += 1
    counters.lowest = bucket
    return take_first(bucket, memory) if bucket < BUCKETS else -1


@fast
def drop_highest(memory: SearchMemory) -> None:
    """Give up the least promising node, for the sake of its memory."""
    counters = memory.counters[0]
    bucket = counters.highest
    while bucket >= 0 and memory.buckets[bucket] < 0:
        bucket -= 1
    counters.highest = bucket
    if bucket < 0:
        return
    node = memory.nodes[take_first(bucket, memory)]
    if node.chunk >= 0:
        free_state(node.chunk, memory)
        node.chunk = -1


@fast
def take_first(bucket: int, memory: SearchMemory) -> int:
    """Take the first node out of a bucket that has one."""
    index = memory.buckets[bucket]
    memory.buckets[bucket] = memory.nodes[index].next
    memory.counters[0].waiting -= 1
    return int(index)

"""What a search holds: nodes, the table of places seen, compact save-states, buckets - plain arrays, no Python objects.

A node's save-state is kept as the words (8 bytes) in which it differs from the start of the level, in chunks from a
pool; a node that has been expanded gives its chunks back.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.compile_cache import compiled
from ninja_game.sim.level import Level
from ninja_game.sim.memory.compiled import load_worlds
from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.memory.layout import STATE_START, Records, new_worlds, used_bytes
from ninja_game.solver.distance_field import POINTS

NODE = np.dtype(
    [
        ("parent", "<i4"),  # index of the node it came from, -1: the root
        ("tick", "<i4"),  # ticks run
        ("action", "<i4"),  # see macro_actions.py
        ("chunk", "<i4"),  # first chunk of its save-state, -1: none (any more)
        ("words", "<i4"),  # words in it
        ("next", "<i4"),  # next node of its bucket, -1: last
        ("priority", "<i4"),  # its bucket
        ("switch_state", "<i4"),  # index of its switch state (heuristics.py)
        ("entry", "<i4"),  # its place in the table
        ("ahead", "<f4"),  # estimated ticks to the exit
    ]
)
ENTRY = np.dtype(
    [
        ("key", "<i8"),  # 0: empty
        ("first", "<i4"),  # earliest tick at which it was reached
        ("last", "<i4"),  # latest accepted tick
        ("visits", "<i4"),
        ("value", "<f4"),  # ticks from here to the exit, as far as known
    ]
)
LINK = np.dtype([("source", "<i4"), ("target", "<i4"), ("ticks", "<i4")])
"""One macro played: from table entry to table entry (-1: the exit)."""

CHUNK = 32
"""Words in a chunk."""
BUCKETS = 1 << 14
MAX_SWITCH_STATES = 512

# Counters (int64) of a search: what the kernel and its caller tell each other.
NODES, FREE_CHUNK, LOWEST, HIGHEST, BEST_TICKS, BEST_NODE, TICKS, EXPANDED, SWITCH_STATES, NEW_SWITCH_STATES = range(10)
ENTRIES, LINKS, RANDOM, GOLD_NEEDED, WAITING = range(10, 15)
COUNTERS = 24

# Parameters (float64) of a search.
CELL_PX, SHIFT_X, SHIFT_Y, SPEED_STEP, SHIFT_VX, SHIFT_VY, MACRO_TICKS, MACRO_JITTER = range(8)
WEIGHT, PATIENCE, REVISITS, SLACK, OFF_GUIDE = range(8, 13)
PARAMETERS = 16


@dataclass(frozen=True)
class Resolution:
    """How finely a search looks: size of a place (px), of a velocity (px/tick), length of a macro (ticks).

    ``weight``: of the estimated ticks to go against those run; ``patience``: ticks after which the same place counts
    as new, at most ``visits`` times; guided searches only: ``slack``: ticks by
    which an estimate may exceed the best run, in a plan as a share of it; ``off_guide``: how much a tick counts where
    the guide knows nothing.
    """

    cell: float = 12.0
    speed: float = 1.0
    macro: int = 5
    jitter: int = 0
    weight: float = 2.0
    patience: int = 40
    visits: int = 1
    slack: float = 0.0
    off_guide: float = 1.0


class Start:
    """A level at tick 0 and two more worlds to work in; views of their states as words."""

    def __init__(self, level: Level, *, box: bool) -> None:
        self.levels, first = load_worlds(compiled, [level], box=box)
        used = int(first["slots_used"][0])
        self.size = (used_bytes(used) - STATE_START) // 8
        self.base = _words(first, 0, self.size).copy()
        self.worlds = new_worlds(2, used)
        self.node_words = _words(self.worlds, 0, self.size)
        self.work_words = _words(self.worlds, 1, self.size)
        self.node_words[:] = self.base
        self.work_words[:] = self.base


def _words(worlds: Records, index: int, size: int) -> NDArray[np.int64]:
    """The state of a world as words, as a view."""
    return np.ndarray((size,), np.int64, worlds.base, index * worlds.strides[0] + STATE_START)


class SearchMemory:
    """The arrays of one search. ``nodes``, ``chunks``: capacities; memory is only touched as it is used."""

    def __init__(self, nodes: int, chunks: int) -> None:
        self.nodes: Any = np.empty(nodes, NODE)
        self.table: Any = np.zeros(_power_of_two(2 * nodes), ENTRY)
        self.guide: Any = np.zeros(_power_of_two(2 * nodes), ENTRY)
        self.guided_by = np.zeros(PARAMETERS)
        self.links: Any = np.empty(6 * nodes, LINK)
        self.chunk_next = np.empty(chunks, np.int32)
        self.chunk_index = np.empty(chunks * CHUNK, np.int32)
        self.chunk_value = np.empty(chunks * CHUNK, np.int64)
        self.buckets = np.empty(BUCKETS, np.int32)
        self.counters = np.zeros(COUNTERS, np.int64)
        self.parameters = np.zeros(PARAMETERS)
        self.switch_states = np.zeros(MAX_SWITCH_STATES, np.int64)
        self.switch_state_places = np.zeros((MAX_SWITCH_STATES, 2))
        self.fields = np.zeros((MAX_SWITCH_STATES, POINTS), np.float32)
        self.fields[:, 0] = -1.0

    def clear(self) -> None:
        """Forget everything but the switch states and their fields."""
        self.table[:] = 0
        self.chunk_next[:] = np.arange(1, len(self.chunk_next) + 1, dtype=np.int32)
        self.chunk_next[-1] = -1
        self.buckets[:] = -1
        switch_states = self.counters[SWITCH_STATES]
        self.counters[:] = 0
        self.counters[SWITCH_STATES] = switch_states
        self.counters[LOWEST] = BUCKETS
        self.counters[BEST_NODE] = -1

    def keep_as_guide(self, settle: Any) -> None:
        """Turn the table of the search just made into the guide of the next one."""
        settle(self.table, self.links, int(self.counters[LINKS]), 40)
        self.table, self.guide = self.guide, self.table
        self.guided_by[:] = self.parameters


def _power_of_two(count: int) -> int:
    return 1 << (count - 1).bit_length()


UNKNOWN = 1.0e9


@entry_point
def back_up_values(table: Any, links: Any, count: int, sweeps: int) -> int:
    """Set ``value`` of all entries to the least ticks to the exit over the first ``count`` links; the sweeps made.

    Places that count as the same are not quite the same, so values are estimates, on the whole too low.
    """
    for slot in range(len(table)):
        table[slot].value = UNKNOWN
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

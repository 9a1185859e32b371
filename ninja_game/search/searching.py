"""One search of one level in slices of work: set it up, continue it, read the best run so far."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ninja_game.backend.memories import compiled
from ninja_game.search.best_first import MORE, add_root, expand, load_node
from ninja_game.search.heuristics import POINTS, Heuristics
from ninja_game.search.known_run import KnownRun, play_known
from ninja_game.search.legs import Checkpoint, FieldOf, Leg, Spend
from ninja_game.search.macros import inputs_of_action
from ninja_game.search.nodes import (
    ALONG_RUN,
    FROM_START,
    BackedUpHeuristic,
    Resolution,
    Start,
    StateWords,
    TableEntry,
    back_up_values,
    clear,
    new_arrays,
    new_table,
    ticks_at_once,
    zeroed,
)
from ninja_game.search.states import MAX_SWITCH_STATES, NOT_MADE, WANTED, Goal

NO_BACKED_UP = BackedUpHeuristic(zeroed(TableEntry, 1), Resolution())
MAX_SWEEPS = 40  # most sweeps over all links to compute the values for the next search


class Search:
    """Best-first searches of a level, one after the other, in memory for ``nodes`` nodes."""

    def __init__(self, start: Start, heuristics: Heuristics, *, nodes: int, along: bool = False) -> None:
        self.start = start
        self.heuristics = heuristics
        points = 1 if along else POINTS
        self.goal = Goal(
            gold=0, leg=0, mask=0, target=0, wanted=0, ends=1, rollouts=0, gold_slots=heuristics.gold_slots,
            enemies=heuristics.enemies, switch_slots=heuristics.slots, masks=np.full(MAX_SWITCH_STATES, -1, np.int64),
            places=np.zeros((MAX_SWITCH_STATES, 2)), fields=np.zeros((MAX_SWITCH_STATES, points), np.float32),
        )  # fmt: skip
        if not along:
            self.goal.fields[:, 0] = NOT_MADE
        self.resolution = Resolution()
        self.arrays = new_arrays(nodes)
        self.counters = self.arrays.counters[0]
        self.backed_up = NO_BACKED_UP
        self._nodes = nodes
        self._other_table: Any = None
        self._field: FieldOf = heuristics.field
        self._known: KnownRun | None = None
        self._known_inputs = b""
        self._roots: Sequence[Checkpoint] = ()

    def begin(self, resolution: Resolution, *, seed: int, bound: int, backed_up: bool = False) -> None:
        """Begin a new search from the start to the exit. ``bound``: only accept runs of fewer ticks (0: any).

        ``backed_up``: use the values that the last search has learned; otherwise they are forgotten.
        """
        self.backed_up = self._learned() if backed_up else NO_BACKED_UP
        self._roots = ()
        self._begin([self.start.initial], resolution, seed, bound)

    def begin_leg(self, leg: Leg, resolution: Resolution, *, seed: int, bound: int) -> None:
        """Begin a new search from the checkpoints of a leg to its goal. ``bound``: as in ``begin``."""
        self.backed_up = NO_BACKED_UP
        self.goal = self.goal._replace(
            gold=leg.gold,
            leg=leg.until,
            mask=leg.mask,
            target=leg.target,
            wanted=leg.wanted,
            ends=leg.ends,
            rollouts=leg.rollouts,
        )
        self.goal.fields[:, 0] = NOT_MADE
        self._field = leg.field
        self._roots = leg.roots
        self._begin([root.words for root in leg.roots], resolution, seed, bound)

    def begin_along(self, run: KnownRun, inputs: bytes, resolution: Resolution, *, seed: int, gold: int) -> None:
        """Begin a search in the span of a known run with these inputs, for a shorter run with ``gold`` pieces."""
        self.goal = self.goal._replace(gold=gold)
        self.goal.masks[:] = -1
        self._known, self._known_inputs = run, inputs
        compiled(play_known)(self.start, run, self.goal.switch_slots, run.span[0], 0)
        self._begin([self.start.scratch.copy()], resolution, seed, len(inputs))

    def _begin(self, roots: Sequence[StateWords], resolution: Resolution, seed: int, bound: int) -> None:
        clear(self.arrays)
        random = np.random.default_rng([seed, FROM_START if self._known is None else ALONG_RUN])
        shifts = random.random(2) * resolution.cell
        least = 0.5 if self._known is None else 0.0
        speed_shifts = resolution.speed * least + random.random(2) * resolution.speed * (1.0 - least)
        (x, y), (vx, vy) = shifts.tolist(), speed_shifts.tolist()
        self.resolution = resolution._replace(shift_x=x, shift_y=y, shift_vx=vx, shift_vy=vy)
        self.counters.best_ticks = bound
        self.counters.random = int(random.integers(1, 1 << 62))
        for words in roots:
            self.start.scratch[:] = words
            compiled(add_root)(self.start, self.arrays, self.goal, self.resolution)
        self._fill_fields()

    def _learned(self) -> BackedUpHeuristic:
        """The table of the last search with its values; the next search uses the other table."""
        table = self.arrays.table
        compiled(back_up_values)(table, self.arrays.links, int(self.counters.links), MAX_SWEEPS)
        other = new_table(self._nodes) if self._other_table is None else self._other_table
        other[:] = 0
        self.arrays = self.arrays._replace(table=other)
        self._other_table = table
        return BackedUpHeuristic(table, self.resolution)

    def run(self, budget: int) -> int:
        """Search for about ``budget`` more ticks; gives MORE, EXHAUSTED or OUT_OF_NODES."""
        end = self.ticks + min(budget, ticks_at_once(self.start))
        while self.ticks < end:
            ended = compiled(expand)(
                self.start, self.arrays, self.goal, self._known, self.backed_up, self.resolution, end - self.ticks
            )
            if self.counters.fields_wanted:
                self._fill_fields()
            elif ended != MORE or self._enough_ends:
                return int(ended)
        return MORE

    def run_leg(self, budget: int, spend: Spend, *, part: int, least: int = 0) -> None:
        """Run a leg's search for at most ``budget`` ticks, in parts; ``spend`` gets the ticks of a part and may end it.

        After the first end, or run to the exit, it continues as long again, or up to ``least`` ticks.
        """
        stop = budget
        while self.ticks < stop:
            before = self.ticks
            self.run(min(part, stop - before))
            if spend(self.ticks - before) or self.ticks == before or self._enough_ends:
                return
            if self.counters.ends > self.counters.other_ends or self.counters.best_node >= 0:
                stop = min(stop, max(2 * self.ticks, least)) if stop == budget else stop

    @property
    def _enough_ends(self) -> bool:
        return bool(self.counters.ends - self.counters.other_ends >= self.goal.ends)

    def _fill_fields(self) -> None:
        goal = self.goal
        for index in np.flatnonzero(goal.fields[:, 0] == WANTED):
            x, y = goal.places[index]
            goal.fields[index] = self._field(int(goal.masks[index]), float(x), float(y))
        self.counters.fields_wanted = 0

    def ends(self, *, by_velocity: bool = False) -> list[Checkpoint]:
        """The checkpoints at which the leg has ended so far. ``by_velocity``: their variety includes the velocity."""
        links = []
        for index in self.arrays.ends[: int(self.counters.ends)].tolist():
            compiled(load_node)(self.start, self.arrays, index)
            root, inputs = self._path(index)
            links.append(self.checkpoint(self._roots[root], inputs, by_velocity=by_velocity))
        return links

    def checkpoint(self, before: Checkpoint | None, inputs: bytes, *, by_velocity: bool = False) -> Checkpoint:
        """Make the scratch world a checkpoint."""
        world, heuristics = self.start.worlds[1], self.heuristics
        ninja = world["ninja"]
        variety = bytes(world["objects"]["routine"][heuristics.enemies].astype(np.uint8))
        if by_velocity:
            moved = (float(ninja["x"] - ninja["prev_x"]) / 1.5, float(ninja["y"] - ninja["prev_y"]) / 1.5)
            variety += bytes(128 + max(-100, min(100, round(part))) for part in moved)
        taken, mask = heuristics.taken(world), heuristics.opened(self.start.worlds, 1)
        place = (float(ninja["x"]), float(ninja["y"]))
        return Checkpoint(self.start.scratch.copy(), int(world["tick"]), taken, mask, place, variety, before, inputs)

    def _path(self, index: int) -> tuple[int, bytes]:
        """The root of a node, and the inputs from there, one byte per tick."""
        nodes: Any = self.arrays.nodes
        parents, actions = nodes["parent"], nodes["action"]
        parts = []
        while parents[index] >= 0:
            parts.append(inputs_of_action(int(actions[index]), self._known_inputs))
            index = int(parents[index])
        return index, b"".join(reversed(parts))

    @property
    def untouched(self) -> list[int]:
        """Ids of the exits, unless one was opened, and of locked doors whose switch no search has touched so far."""
        opened = int(np.bitwise_or.reduce(np.maximum(self.goal.masks, 0)))
        switches = enumerate(zip(self.heuristics.switch_ids, self.heuristics.switches, strict=True))
        closed = [(id_, switch) for bit, (id_, switch) in switches if not opened >> bit & 1 and not switch.trap]
        shut = sum(not switch.door for _, switch in closed) == len(self.heuristics.exits)
        return [id_ for id_, switch in closed if switch.door or shut]

    @property
    def ticks(self) -> int:
        """Ticks simulated since ``begin``."""
        return int(self.counters.ticks)

    def best(self) -> bytes | None:
        """The shortest run to the exit that this search has found; None if none.

        - a search to the exit, or of a leg: from the start of the level
        - a search along a known run: from the start of the span
        """
        index = int(self.counters.best_node)
        if index < 0:
            return None
        root, inputs = self._path(index)
        return self._roots[root].run() + inputs if self._roots else inputs

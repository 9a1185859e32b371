"""A run in legs: from gold to gold along a tour, or from switch to switch, with several checkpoints per leg.

Checkpoints with the same gold and switches form a *frontier*. A step takes the frontier of the highest priority and
searches from all its checkpoints to the next piece of its tour, the next switch or the exit. Checkpoints where a leg
took a piece or touched a switch, whether it was the wanted one or not, go into their frontiers. A frontier that leads
nowhere is tried again later, with another piece, another resolution and more work; every try lowers its priority.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from ninja_game.search.heuristics import FARTHEST, UNREACHED, Heuristics, point_at
from ninja_game.search.legs import (
    ROLLOUTS,
    UNBOUNDED,
    Checkpoint,
    FieldOf,
    Frontier,
    Leg,
    LegFields,
    Spend,
    piece_numbers,
    put_checkpoint,
    short_tour,
)
from ninja_game.search.nodes import Resolution
from ninja_game.search.searching import Search

ROUTE_LEGS = (
    (Resolution(cell=12.0, speed=1.0, macro=5, weight=1.6), 400_000),
    (Resolution(cell=8.0, speed=0.5, macro=5, weight=2.0, enemy_cell=24.0), 1_000_000),
    (Resolution(cell=12.0, speed=1.0, macro=6, weight=1.3, visits=12, patience=15, enemy_cell=24.0), 2_000_000),
    (Resolution(cell=6.0, speed=0.5, macro=4, weight=2.0), 3_000_000),
    (Resolution(cell=9.0, speed=0.6, macro=7, jitter=3, weight=1.5, visits=5, patience=40, enemy_cell=24.0), 5_000_000),
    (Resolution(cell=6.0, speed=0.4, macro=4, weight=1.2, visits=2), 8_000_000),
)
"""Resolution and most ticks of a frontier's first, second … try. Not tuned one by one."""
LEG_NODES = 250_000
CAREFUL_TRIES = 4
"""Number of first tries of a frontier in which a piece must be survived, as far as random runs can tell."""
ROUTE_EXTRA = 40_000  # least ticks that a leg continues after its first end, to find others
TRY_PENALTY = 1.5  # Pieces of gold that a try counts against a frontier. Not tuned: a guess.
STALL_STEPS = 120
STALL_TICKS = 6_000_000
"""Steps and ticks without another piece of gold after which the route begins again from the start. Not tuned."""
DOOR_WORTH = 0.5  # Pieces of gold that an open door is worth. Not tuned.
DOOR_TICKS = 3_000_000
"""Ticks of search that an open door is worth, without gold. Not tuned; with this value 40-1 is solved."""
ROUTE_WIDTH = 12
ROUTE_ENDS = 24  # checkpoints of a frontier that are kept, and ends that are enough for a leg


class Route:
    """A search for runs with ``gold`` pieces (0: straight to the exit)."""

    def __init__(self, search: Search, *, gold: int, seed: int) -> None:
        self.search = search
        self.heuristics: Heuristics = search.heuristics
        self.gold = gold
        self.seed = seed
        self.steps = 0
        self.most = 0
        self.ever_taken = self.last_taken = 0  #: masks of pieces; ``last_taken``: those that were the last of all
        self.urgency = np.zeros(len(self.heuristics.gold_places))
        self.frontiers: dict[tuple[int, int], Frontier] = {}
        self._stalled_steps = self._stalled_ticks = self._restarts = 0
        self._most_now = 0.0
        self._leaving: dict[tuple[int, int], bool] = {}
        self._fields = LegFields(self.heuristics)
        switches = list(enumerate(self.heuristics.switches))
        self._exits = sum(1 << bit for bit, switch in switches if not switch.door)
        self._doors = sum(1 << bit for bit, switch in switches if switch.door and not switch.trap)
        start = search.start
        start.scratch[:] = start.initial
        self._first = search.checkpoint(None, b"")
        self._add(self._first, [])

    def step(self, spend: Spend) -> bytes | None:
        """Search one leg; gives a run to the exit with the gold, if the leg ends there."""
        stalled = self._stalled_steps > STALL_STEPS or self._stalled_ticks > STALL_TICKS * (1 + self._restarts)
        if self.gold and stalled:
            self._restart()
        frontier = max(self.frontiers.values(), key=self._priority)
        target = self._target(frontier)
        ways = 1 if self.gold else 1 + (self._doors & ~frontier.mask).bit_count()
        resolution, budget = ROUTE_LEGS[min(frontier.tries // ways, len(ROUTE_LEGS) - 1)]
        frontier.tries += 1
        self.steps += 1
        leg = self._leg(frontier, target)
        budget *= 4 if target < 0 and ways == 1 else 1
        self.search.begin_leg(leg, resolution, seed=self.seed * 10_000 + self.steps, bound=0)
        before = self._most_now
        self.search.run_leg(budget, spend, part=ROUTE_EXTRA, least=ROUTE_EXTRA)
        self._stalled_ticks += self.search.ticks
        frontier.spent += self.search.ticks
        self._stalled_steps += 1
        if leg.gold < UNBOUNDED:
            return self.search.best()
        ends = self.search.ends()
        if target >= 0 and not any(end.taken >> target & 1 for end in ends):
            frontier.failed[target] += 1
            self.urgency[target] *= 0.5
        for end in ends:
            self._add(end, frontier.tour)
        if self._most_now > before:
            self._stalled_steps = self._stalled_ticks = 0
        return None

    def _priority(self, frontier: Frontier) -> tuple[float, int, int]:
        """The progress of a frontier less the cost of its tries; without gold, less the ticks spent on it."""
        if self.gold:
            return self._done(frontier) - TRY_PENALTY * frontier.tries, frontier.taken, frontier.mask
        # The exit should be opened last: its way may block the way to the doors.
        early = bool(frontier.mask & self._exits) and not self._may_leave(frontier)
        doors = (frontier.mask & self._doors).bit_count()
        return doors - early - frontier.spent / DOOR_TICKS, -frontier.tries, frontier.mask

    def _done(self, frontier: Frontier) -> float:
        useful = self._doors | (self._exits if frontier.count >= self.gold else 0)
        return frontier.count + DOOR_WORTH * (frontier.mask & useful).bit_count()

    def _may_leave(self, frontier: Frontier) -> bool:
        """Whether an open exit can be reached, as far as walls and doors tell; computed once per frontier."""
        key = (frontier.taken, frontier.mask)
        if key not in self._leaving:
            self._leaving[key] = self.heuristics.may_leave(frontier.mask, *frontier.checkpoints[0].place)
        return self._leaving[key]

    def _restart(self) -> None:
        """Begin again from the start; the pieces missed this time get a higher priority."""
        last = max(self.frontiers.values(), key=lambda frontier: (frontier.count, -frontier.tries))
        pieces = set(range(len(self._fields.points)))
        left = pieces - set(piece_numbers(last.taken))
        if last.count >= self.gold:
            # The way to the exit is blocked: take the last piece earlier.
            checkpoint: Checkpoint | None = last.checkpoints[0]
            while checkpoint and checkpoint.before and len(left) < len(pieces) // 4 + 1:
                left |= set(piece_numbers(checkpoint.taken & ~checkpoint.before.taken))
                checkpoint = checkpoint.before
        self.urgency[list(left)] += 1.0
        self.frontiers = {}
        self._stalled_steps = self._stalled_ticks = 0
        self._most_now = 0.0
        self._restarts += 1
        self._add(self._first, [])

    def _leg(self, frontier: Frontier, target: int) -> Leg:
        roots = frontier.checkpoints
        rollouts = ROLLOUTS if frontier.tries <= CAREFUL_TRIES else 0
        if target >= 0:
            field = partial(self._fields.to_piece, target)
            return Leg(roots, frontier.count + 1, frontier.mask, UNBOUNDED, ROUTE_ENDS, rollouts, field)
        if self._may_leave(frontier):
            return Leg(roots, 0, frontier.mask, self.gold, 1, 0, self.heuristics.field)
        way = self._way_to_a_switch(frontier)
        return Leg(roots, UNBOUNDED, frontier.mask, UNBOUNDED, ROUTE_ENDS, rollouts, *way)

    def _way_to_a_switch(self, frontier: Frontier) -> tuple[FieldOf, int]:
        """The fields of the first door in the way, and the bit of its switch.

        At later tries those of the other doors' switches, in turn.
        """
        switches = enumerate(self.heuristics.switches)
        closed = [(bit, s) for bit, s in switches if s.door and not s.trap and not frontier.mask >> bit & 1]
        turn = (frontier.tries - 1) % (len(closed) + 1)
        if turn == 0:
            return self.heuristics.field, 0
        x, y = frontier.checkpoints[0].place
        closed.sort(key=lambda pair: abs(pair[1].switch_x - x) + abs(pair[1].switch_y - y))
        bit, switch = closed[turn - 1]
        return partial(self.heuristics.field_to, (switch.switch_x, switch.switch_y)), 0 if self.gold else 1 << bit

    def _add(self, checkpoint: Checkpoint, tour: list[int]) -> None:
        """Put a checkpoint into its frontier; the frontier keeps the best."""
        gold = checkpoint.taken if self.gold else 0
        frontier = put_checkpoint(self.frontiers, gold, checkpoint, tour, ROUTE_WIDTH)
        self.ever_taken |= checkpoint.taken
        self.most = max(self.most, frontier.count)
        if checkpoint.before and frontier.count >= self.gold:
            self.last_taken |= checkpoint.taken & ~checkpoint.before.taken
        self._most_now = max(self._most_now, self._done(frontier))

    def _target(self, frontier: Frontier) -> int:
        """The piece to fetch next from a frontier, -1: the exit or its switch.

        Pieces without a way to others or to the switch, for example behind one-way platforms, come last.
        """
        left = [piece for piece in range(len(self._fields.points)) if not frontier.taken >> piece & 1]
        if frontier.count >= self.gold:
            return -1
        checkpoint = frontier.checkpoints[0]
        fields = self._fields.tours(checkpoint.mask)
        here = fields[:, point_at(*checkpoint.place)].astype(np.float64)
        start = here[left]
        home = fields[-1, self._fields.points[left]]
        between = fields[left][:, self._fields.points[left]].T.astype(np.float64)
        no_return = (home >= UNREACHED) & (here[-1] < UNREACHED)
        if not frontier.mask & self._exits and no_return.all():
            return -1
        shut = no_return | ((between >= UNREACHED) & (start < UNREACHED)).any(axis=1)
        names = {piece: k for k, piece in enumerate(left)}
        order = [names[piece] for piece in frontier.tour]
        tour = short_tour(
            np.minimum(start, FARTHEST), np.minimum(between, FARTHEST), np.minimum(home, FARTHEST).astype(float), order
        )
        frontier.tour = [left[k] for k in tour]
        nearest = np.argsort(start, kind="stable").tolist()
        ranks = [min(tour.index(k), nearest.index(k) + 0.5) + 2.5 * frontier.failed[left[k]] for k in range(len(left))]
        ranked = zip(start >= UNREACHED, shut, -self.urgency[left], ranks, left, strict=True)
        return min(ranked)[-1]

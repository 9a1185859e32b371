"""Shorten a run with gold by a beam search of legs; measured legs suggest the order of the pieces.

The first *frontiers* are the checkpoints at which the known run collects or switches something. A pass begins at one of
them and proceeds depth by depth (depth: pieces collected plus switches touched). At each depth it takes the few
frontiers with the least ticks so far and to go, and searches from all their checkpoints to the next piece. Frontiers
are kept from pass to pass.
"""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import numpy as np

from ninja_game.backend.memories import compiled
from ninja_game.search.legs import (
    ROLLOUTS,
    UNBOUNDED,
    Checkpoint,
    Frontier,
    Leg,
    LegFields,
    PieceTicks,
    Spend,
    piece_numbers,
    put_checkpoint,
    short_tour,
)
from ninja_game.search.nodes import PASSES, Resolution, Start
from ninja_game.search.searching import Search
from ninja_game.sim.inputs import KEYS_DOWN, with_press_bit
from ninja_game.sim.schema.declare import kernel
from ninja_game.sim.world import step

BEAM_LEGS = (
    Resolution(cell=12.0, speed=1.0, macro=5, weight=1.3),
    Resolution(cell=12.0, speed=0.7, macro=7, jitter=3, weight=1.1, enemy_cell=24.0),
    Resolution(cell=8.0, speed=0.7, macro=5, weight=1.2),
    Resolution(cell=10.0, speed=0.7, macro=9, weight=1.0),
)
"""Resolutions of the legs of a pass, in turn. No number below was tuned by an experiment on record."""
BEAM_TICKS = 150_000
BEAM_EXTRA = 20_000  # most ticks of a leg; least ticks that it still searches after its first end
EXIT_FACTOR = 10  # factor by which the last leg, to the exit, may be longer
BEAM_WIDTH = 40
BEAM_ENDS = 80  # checkpoints of a frontier, and ends of a leg, that are kept
EFFORTS = (1, 4)
"""Factors of the ticks of a leg: the second only if the first found nothing, since far pieces need more."""
BREADTHS = (3, 6, 3, 6, 10)  # frontiers that are expanded at each depth, pass by pass
SPARE = 2  # frontiers that may replace others whose legs found nothing
FRONTIERS_KEPT = 10  # frontiers per depth that are kept from pass to pass
NOISE = 0.4  # share by which the ticks between pieces are changed at random, to get other orders
HOPE = 1.1  # a pass ends where the estimated ticks exceed those of the best run by this share


@kernel
def play_on(start: Start, keys: int) -> None:
    w = start.worlds[1]
    step(start.maps[0], w, with_press_bit(keys & KEYS_DOWN, w.ninja.jump_held))


class GoldBeam:
    """Passes that shorten a run to the exit; the shorter run collects the same pieces.

    ``seed``: seed of its random numbers.
    """

    def __init__(self, search: Search, run: bytes, *, seed: int) -> None:
        self.search = search
        self.heuristics = search.heuristics
        self.random = np.random.default_rng([seed, PASSES])
        self.seed = seed
        self.passes = 0
        self.legs = 0
        self.depths: dict[int, dict[tuple[int, int], Frontier]] = {}
        self.ticks = UNBOUNDED
        self.wanted = 0
        self._fields = LegFields(self.heuristics)
        self.piece_ticks = PieceTicks(self._fields)
        self.order: list[int] = []
        self.add_run(run)

    def add_run(self, run: bytes) -> None:
        """Add the checkpoints of a run; the shortest run sets the bound and the order."""
        start, heuristics = self.search.start, self.heuristics
        start.scratch[:] = start.initial
        world = start.worlds[1]
        checkpoint = self.search.checkpoint(None, b"")
        checkpoints = [checkpoint]
        begun, last = 0, (checkpoint.taken, checkpoint.mask)
        for tick, keys in enumerate(run[:-1], 1):
            compiled(play_on)(start, keys)
            now = (heuristics.taken(world), heuristics.opened(start.worlds, 1))
            if now != last:
                checkpoint = self.search.checkpoint(checkpoint, run[begun:tick])
                begun, last = tick, now
                checkpoints.append(checkpoint)
        if not self.wanted:
            self.wanted = checkpoints[-1].taken
        order = [p for a, b in pairwise(checkpoints) for p in piece_numbers(b.taken & ~a.taken)]
        if len(run) < self.ticks:
            self.ticks = len(run)
            self.order = [piece for piece in order if self.wanted >> piece & 1]
        for checkpoint in checkpoints:
            if checkpoint.before:
                self.piece_ticks.learn(checkpoint.before, checkpoint)
            self._add(checkpoint, self.order)

    def search_depths(self, spend: Spend) -> bytes | None:
        """Search from one of the depths to the exit; gives a shorter run, None if there is none."""
        resolution = BEAM_LEGS[self.passes % len(BEAM_LEGS)]
        self.piece_ticks.change(self.random, NOISE * (self.passes % 3) / 2)
        first = 0 if self.passes % 3 == 0 else int(self.random.integers(max(self.depths)))
        breadth = BREADTHS[self.passes % len(BREADTHS)]
        self.passes += 1
        depth = first
        while depth <= max(self.depths):
            frontiers = sorted(self.depths.get(depth, {}).values(), key=self._value)
            self.depths[depth] = {(frontier.taken, frontier.mask): frontier for frontier in frontiers[:FRONTIERS_KEPT]}
            led_on = 0
            for frontier in frontiers[: breadth + SPARE]:
                if led_on == breadth or (frontier is not frontiers[0] and self._value(frontier) > self.ticks * HOPE):
                    break
                for effort in EFFORTS:
                    run, ends = self._leg(frontier, resolution, effort, spend)
                    if run:
                        self.add_run(run)
                        return run
                    if spend(0):
                        return None
                    if ends:
                        led_on += 1
                        break
            depth += 1
        return None

    def _leg(self, frontier: Frontier, resolution: Resolution, effort: int, spend: Spend) -> tuple[bytes | None, int]:
        """Search from a frontier to the next piece or the exit; gives a run shorter than the best, and the ends."""
        self.legs += 1
        target = self._target(frontier)
        roots = frontier.checkpoints
        if target < 0:
            leg = Leg(roots, 0, frontier.mask, frontier.count, 1, 0, self.heuristics.field)
        else:
            field = partial(self._fields.to_piece, target)
            leg = Leg(roots, frontier.count + 1, frontier.mask, UNBOUNDED, BEAM_ENDS, ROLLOUTS, field)
        self.search.begin_leg(leg, resolution, seed=self.seed * 100_000 + self.legs, bound=self.ticks)
        budget = BEAM_TICKS * (EXIT_FACTOR if target < 0 else effort)
        self.search.run_leg(budget, spend, part=BEAM_EXTRA)
        if target < 0:
            return self.search.best(), 1
        checkpoints = self.search.ends(by_velocity=True)
        if not any(checkpoint.taken >> target & 1 for checkpoint in checkpoints):
            self.piece_ticks.note_failure(frontier.checkpoints[0], target)
        for checkpoint in checkpoints:
            self.piece_ticks.learn(frontier.checkpoints[0], checkpoint)
            self._add(checkpoint, frontier.tour)
        return None, len(checkpoints)

    def _add(self, checkpoint: Checkpoint, tour: list[int]) -> None:
        depth = checkpoint.taken.bit_count() + checkpoint.mask.bit_count()
        put_checkpoint(self.depths.setdefault(depth, {}), checkpoint.taken, checkpoint, tour, BEAM_WIDTH)

    def _value(self, frontier: Frontier) -> float:
        """Ticks so far plus the estimated ticks to come along the frontier's tour."""
        between, start, home = self.piece_ticks.estimate(frontier.checkpoints[0])
        tour = frontier.tour
        if not tour:
            return frontier.checkpoints[0].tick + float(home[-1])
        to_come = float(start[tour[0]] + between[tour[:-1], tour[1:]].sum() + home[tour[-1]])
        return frontier.checkpoints[0].tick + to_come

    def _target(self, frontier: Frontier) -> int:
        """The piece to fetch next from a frontier, -1: the exit. Shortens the frontier's tour."""
        left = [piece for piece in frontier.tour if not frontier.taken >> piece & 1]
        if not left:
            return -1
        between, start, home = self.piece_ticks.estimate(frontier.checkpoints[0])
        tour = short_tour(start[left], between[np.ix_(left, left)], home[left], range(len(left)))
        frontier.tour = [left[k] for k in tour]
        return frontier.tour[0]

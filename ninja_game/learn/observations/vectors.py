"""Vectors of numbers: the ninja's state, the time left, the guidance of the distance field."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np
from gymnasium.spaces import Box

from ninja_game.backend.worlds import InitialObject
from ninja_game.learn.goal_distance import point_within
from ninja_game.learn.observations.part import Array, Lookup, Part, PartContext, clamp, put_value
from ninja_game.search.heuristics import FARTHEST
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import EXIT, GOLD
from ninja_game.sim.rules import CELL, HALF, MAX_JUMP_TICKS, ROOT2, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import JUMPING, STATE_NAMES

MAX_SPEED = 24.0  # px/tick; a ninja is seldom faster than 10

_FLAG, _SIGN = (0.0, 1.0, 1.0), (-1.0, 1.0, 1.0)
_DX, _DY = (-WORLD_WIDTH, WORLD_WIDTH, WORLD_WIDTH), (-WORLD_HEIGHT, WORLD_HEIGHT, WORLD_WIDTH)

FIELDS: dict[str, tuple[float, float, float]] = {
    "x": (0.0, WORLD_WIDTH, WORLD_WIDTH),
    "y": (0.0, WORLD_HEIGHT, WORLD_WIDTH),
    "cell_x": (0.0, CELL, CELL),
    "cell_y": (0.0, CELL, CELL),
    "vx": (-MAX_SPEED, MAX_SPEED, MAX_SPEED),
    "vy": (-MAX_SPEED, MAX_SPEED, MAX_SPEED),
    "in_air": _FLAG,
    "near_wall": _FLAG,
    "wall_x": _SIGN,
    "floor_x": _SIGN,
    "floor_y": _SIGN,
    "jump_held": _FLAG,
    "jump_ticks": (0.0, float(MAX_JUMP_TICKS), float(MAX_JUMP_TICKS)),
    "exit_there": _FLAG,
    "exit_open": _FLAG,
    "exit_dx": _DX,
    "exit_dy": _DY,
    "switch_dx": _DX,
    "switch_dy": _DY,
    "gold_there": _FLAG,
    "gold_dx": _DX,
    "gold_dy": _DY,
    **dict.fromkeys(STATE_NAMES, _FLAG),
}
"""The values in order, each with lowest, highest, and divisor for normalising; px, px/tick, ticks, flags.

``cell_x``, ``cell_y``: the place within the cell; ``wall_x``: normal of a near wall; ``floor_x``, ``floor_y``: normal
of the floor below; ``…_dx``, ``…_dy``: offset from the ninja; the last eight are flags of its states.
"""

_NAMES = tuple(FIELDS)
FIRST_EXIT, FIRST_GOLD, FIRST_STATE = (_NAMES.index(name) for name in ("exit_there", "gold_there", STATE_NAMES[0]))
_FAR = 1.0e18  # px², farther than any distance
MAX_EXITS = 60  # exits per level that are looked at: the first ones


class ExitPlace(NamedTuple):
    """An exit and its switch: slot and places, px."""

    slot: int
    x: float
    y: float
    switch_x: float
    switch_y: float


@dataclass(frozen=True)
class StateVector(Part):
    """Place, velocity and flags of the ninja, offsets to the exit, its switch and the nearest gold: ``FIELDS``.

    Of several exits it shows the nearest open one; if none is open, the one with the nearest switch. The switch of an
    open exit is at (0, 0).
    """

    name: ClassVar[str] = "state"

    @property
    def box(self) -> Box:
        low, high, scale = np.array(list(FIELDS.values()), np.float64).T
        divided = scale if self.normalised else np.ones(len(FIELDS))
        return Box((low / divided).astype(np.float32), (high / divided).astype(np.float32), dtype=np.float32)

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """Factors and limits of the values; exits and gold; notes about each world.

        The notes: which exits are open, as bits, and the nearest gold. While nothing has changed, they save reading a
        world's objects, which are far away in memory.
        """

        def exits(number: int) -> list[ExitPlace]:
            switches = context.fresh[number].objects
            seen = context.objects(number, EXIT)
            return [ExitPlace(o.slot, o.x, o.y, switches[o.partner].x, switches[o.partner].y) for o in seen]

        box = self.box
        divisors = np.array([scale if self.normalised else 1.0 for _, _, scale in FIELDS.values()])
        return (
            observe_state,
            context.ranges(box.low, box.high, divisors),
            *context.rows(exits, ExitPlace),
            *context.rows(lambda number: context.objects(number, GOLD), InitialObject),
            context.changed,
            *(context.table([0] * context.count, np.int64) for _ in range(2)),
        )


@kernel
def observe_state(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, ranges: Lookup, exit_bounds: Lookup, exits: Lookup, gold_bounds: Lookup, gold: Lookup,
    changed: Lookup, opened: Lookup, nearest: Lookup,
) -> None:  # fmt: skip
    for k in range(first, last):
        index = indices[k]
        level = level_of[index]
        w = worlds[index]
        n = w.ninja
        observe_ninja(w, out, index, offset, ranges)
        for j in range(offset + FIRST_EXIT, offset + FIRST_STATE):
            out[index, j] = 0.0
        start = exit_bounds[2 * level]
        end = exit_bounds[2 * level + 1]
        if changed[index]:
            opened[index] = open_exits(w, exits, start, end)
        chosen = choose_exit(n.x, n.y, opened[index], exits, start, end)
        is_open = chosen >= 0 and (opened[index] >> (chosen - start)) & 1
        if chosen >= 0:
            out[index, offset + FIRST_EXIT] = 1.0
            out[index, offset + FIRST_EXIT + 1] = 1.0 if is_open else 0.0
            put_value(out, index, offset, FIRST_EXIT + 2, ranges, exits[chosen].x - n.x)
            put_value(out, index, offset, FIRST_EXIT + 3, ranges, exits[chosen].y - n.y)
            if not is_open:
                put_value(out, index, offset, FIRST_EXIT + 4, ranges, exits[chosen].switch_x - n.x)
                put_value(out, index, offset, FIRST_EXIT + 5, ranges, exits[chosen].switch_y - n.y)
        start = gold_bounds[2 * level]
        end = gold_bounds[2 * level + 1]
        guess = nearest[index]
        if changed[index] and not (start <= guess < end and not w.objects[gold[guess].slot].taken):
            guess = -1
        if changed[index] or guess >= 0:
            nearest[index] = nearest_gold(w, gold, start, end, guess)
        chosen = nearest[index]
        if chosen >= 0:
            out[index, offset + FIRST_GOLD] = 1.0
            put_value(out, index, offset, FIRST_GOLD + 1, ranges, gold[chosen].x - n.x)
            put_value(out, index, offset, FIRST_GOLD + 2, ranges, gold[chosen].y - n.y)


@fast
def observe_ninja(w: World, out: Any, index: int, offset: int, ranges: Any) -> None:
    """Write the first 13 values and the state."""
    n = w.ninja
    cell = cell_at(n.x, n.y)
    put_value(out, index, offset, 0, ranges, n.x)
    put_value(out, index, offset, 1, ranges, n.y)
    put_value(out, index, offset, 2, ranges, n.x - (CENTRE_X[cell] - HALF))
    put_value(out, index, offset, 3, ranges, n.y - (CENTRE_Y[cell] - HALF))
    put_value(out, index, offset, 4, ranges, n.x - n.prev_x)
    put_value(out, index, offset, 5, ranges, n.y - n.prev_y)
    out[index, offset + 6] = float(n.in_air)
    out[index, offset + 7] = float(n.near_wall)
    put_value(out, index, offset, 8, ranges, n.wall_x if n.near_wall else 0.0)
    put_value(out, index, offset, 9, ranges, 0.0 if n.in_air else n.floor_x)
    put_value(out, index, offset, 10, ranges, 0.0 if n.in_air else n.floor_y)
    out[index, offset + 11] = float(n.jump_held)
    put_value(out, index, offset, 12, ranges, float(n.jump_timer) if n.state == JUMPING else 0.0)
    for state in range(8):
        out[index, offset + FIRST_STATE + state] = 1.0 if n.state == state else 0.0


@fast
def open_exits(w: World, exits: Any, start: int, end: int) -> int:
    """The open exits of a level, one bit each, as far as there are bits."""
    opened = 0
    for k in range(start, min(end, start + MAX_EXITS)):
        if w.objects[exits[k].slot].is_open:
            opened |= 1 << (k - start)
    return opened


@fast
def choose_exit(x: float, y: float, opened: int, exits: Any, start: int, end: int) -> int:
    """Choose the exit to show to a ninja at a place, -1: none."""
    best = _FAR
    chosen = -1
    chosen_open = 0
    for k in range(start, min(end, start + MAX_EXITS)):
        is_open = (opened >> (k - start)) & 1
        dx = (exits[k].x if is_open else exits[k].switch_x) - x
        dy = (exits[k].y if is_open else exits[k].switch_y) - y
        distance = dx * dx + dy * dy
        better = distance < best if is_open == chosen_open else is_open == 1
        if better or chosen < 0:
            best = distance
            chosen = k
            chosen_open = is_open
    return chosen


@fast
def nearest_gold(w: World, gold: Any, start: int, end: int, guess: int) -> int:
    """The nearest piece that is left, the first of equally near ones; -1 if none is.

    The level's table is near in memory, the world's objects are not, so they are read last. With a good ``guess``, a
    piece that is left (or -1), such as the last nearest one, hardly any object is read.
    """
    x = w.ninja.x
    y = w.ninja.y
    best = _FAR
    chosen = guess
    if guess >= 0:
        dx = gold[guess].x - x
        dy = gold[guess].y - y
        best = dx * dx + dy * dy
    for k in range(start, end):
        dx = gold[k].x - x
        dy = gold[k].y - y
        distance = dx * dx + dy * dy
        if (distance < best or (distance == best and k < chosen)) and not w.objects[gold[k].slot].taken:
            best = distance
            chosen = k
    return chosen


MAX_TIME_LEFT = 1_000_000.0  # ticks


@dataclass(frozen=True)
class TimeLeft(Part):
    """Ticks until the episode is truncated, float32 (1,); normalised: as a share of the time limit."""

    name: ClassVar[str] = "time"

    @property
    def box(self) -> Box:
        return Box(0.0, 1.0 if self.normalised else MAX_TIME_LEFT, (1,), np.float32)

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """The time limit, the factor, the highest value."""
        factor = 1.0 / context.time_limit if self.normalised else 1.0
        return observe_time, context.time_limit, factor, float(self.box.high[0])


@kernel
def observe_time(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, time_limit: int, factor: float, highest: float,
) -> None:  # fmt: skip
    for k in range(first, last):
        index = indices[k]
        out[index, offset] = clamp((time_limit - worlds[index].tick) * factor, 0.0, highest)


_RADII = (24.0, 60.0)  # px
_SIDES = ((1.0, 0.0), (1.0 / ROOT2, 1.0 / ROOT2), (0.0, 1.0), (-1.0 / ROOT2, 1.0 / ROOT2))
EIGHT_WAYS = [*_SIDES, *((-x, -y) for x, y in _SIDES)]  # the sides, from the right by way of down
FAR_TICKS = 1000.0  # ticks to the exit that are normalised to 1


@dataclass(frozen=True)
class Guide(Part):
    """The guidance of the solver's distance field for the present switch state, float32 (17,).

    For eight directions (from the right by way of down), first 24 px and then 60 px away: ticks by which that point is
    nearer to the exit, per px, -1 to 1. Last: ticks to the exit; normalised: in 1000 ticks, at most 1.
    """

    name: ClassVar[str] = "guide"
    needs_goal: ClassVar[bool] = True

    @property
    def box(self) -> Box:
        slopes = len(_RADII) * len(EIGHT_WAYS)
        low = np.array([-1.0] * slopes + [0.0], np.float32)
        return Box(low, np.array([1.0] * slopes + [1.0 if self.normalised else FARTHEST], np.float32), dtype=np.float32)

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """The offsets of the points, px; the fields and the row of each world; factor and limit of the last value."""
        points = [(radius * x, radius * y, 1.0 / radius) for radius in _RADII for x, y in EIGHT_WAYS]
        columns = [context.table(column, np.float64) for column in zip(*points, strict=True)]
        factor = 1.0 / FAR_TICKS if self.normalised else 1.0
        highest = float(self.box.high[-1])
        return observe_guide, *columns, context.goal.fields, context.goal.rows, factor, highest


@kernel
def observe_guide(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, dx: Lookup, dy: Lookup, share: Lookup, fields: Array, rows: Array, factor: float,
    highest: float,
) -> None:  # fmt: skip
    """Read the fields of some worlds; worlds without their field yet are observed again later."""
    for k in range(first, last):
        index = indices[k]
        row = rows[index]
        x = worlds[index].ninja.x
        y = worlds[index].ninja.y
        # In compiled code `float` of a float32 stays float32, and the difference below would be rounded.
        here = np.float64(fields[row, point_within(x, y)])
        for j in range(len(dx)):
            there = np.float64(fields[row, point_within(x + dx[j], y + dy[j])])
            out[index, offset + j] = clamp((here - there) * share[j], -1.0, 1.0)
        out[index, offset + len(dx)] = clamp(here * factor, 0.0, highest)

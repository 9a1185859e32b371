"""The state vector: the ninja and where the exit, its switch and the nearest gold lie."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box

from ninja_game.learn.observations.part import Part, Ragged, Setting, clamp
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import EXIT, GOLD
from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.memory.schema import World
from ninja_game.sim.rules import CELL, HALF, LONGEST_JUMP, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.states import JUMPING, STATE_NAMES

MAX_SPEED = 24.0
"""px/tick; a ninja is seldom faster than 10."""

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
    "jump_ticks": (0.0, float(LONGEST_JUMP), float(LONGEST_JUMP)),
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
"""What its values are, in order: lowest, highest, and what normalising divides by; px, px/tick, ticks, flags.

``cell_x``, ``cell_y``: the place within the cell; ``wall_x``: the normal of a near wall; ``floor_x``, ``floor_y``: of
the floor one stands on; ``…_dx``, ``…_dy``: from the ninja to there; the last eight: which state it is in.
"""

_NAMES = tuple(FIELDS)
FIRST_EXIT, FIRST_GOLD, FIRST_STATE = (_NAMES.index(name) for name in ("exit_there", "gold_there", STATE_NAMES[0]))
FAR = 1.0e18
"""px², farther than anything."""


@dataclass(frozen=True)
class StateVector(Part):
    """Place, velocity and flags of the ninja, the way to the exit, to its switch and to the nearest gold: ``FIELDS``.

    Of several exits it is the nearest open one; while none is open, the one whose switch is nearest. Once the exit is
    open its switch is at (0, 0).
    """

    name: ClassVar[str] = "state"

    @property
    def box(self) -> Box:
        """Float32 (30,)."""
        low, high, scale = np.array(list(FIELDS.values()), np.float64).T
        divided = scale if self.normalised else np.ones(len(FIELDS))
        return Box((low / divided).astype(np.float32), (high / divided).astype(np.float32), dtype=np.float32)

    @property
    def kernel(self) -> Callable[..., None]:
        """``observe_state``."""
        return observe_state

    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """Factors and limits of the values; slots of the exits; slots and places of the gold."""
        box = self.box
        factors = [1.0 / scale if self.normalised else 1.0 for _, _, scale in FIELDS.values()]
        exits = Ragged([[o.slot for o in w.objects if o.kind == EXIT] for _, w in setting.fresh])
        gold = Ragged([[(o.slot, o.x, o.y) for o in w.objects if o.kind == GOLD] for _, w in setting.fresh])
        slots, xs, ys = zip(*gold.values, strict=True) if gold.values else ((), (), ())
        return (
            setting.table(np.stack([factors, box.low, box.high], axis=1), np.float64),
            setting.table(exits.starts, np.int64),
            setting.table(exits.values, np.int64),
            setting.table(gold.starts, np.int64),
            setting.table(slots, np.int64),
            setting.table(xs, np.float64),
            setting.table(ys, np.float64),
        )


@entry_point
def observe_state(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    scale: Any, exit_starts: Any, exits: Any, gold_starts: Any, gold: Any, gold_x: Any, gold_y: Any,
) -> None:  # fmt: skip
    """Write the state vector of some worlds: the ninja, the exit, the gold."""
    for k in range(first, last):
        index = which[k]
        level = level_of[index]
        w = worlds[index]
        row = out[index]
        write_ninja(w, row, offset, scale)
        write_exit(w, row, offset, scale, exits, exit_starts[level], exit_starts[level + 1])
        write_gold(w, row, offset, scale, gold, gold_x, gold_y, gold_starts[level], gold_starts[level + 1])


@fast
def put(row: Any, offset: int, j: int, scale: Any, value: float) -> None:
    """Write value j: times its factor, within its limits."""
    row[offset + j] = clamp(value * scale[j][0], scale[j][1], scale[j][2])


@fast
def write_ninja(w: World, row: Any, offset: int, scale: Any) -> None:
    """The first 13 values and the state."""
    n = w.ninja
    cell = cell_at(n.x, n.y)
    put(row, offset, 0, scale, n.x)
    put(row, offset, 1, scale, n.y)
    put(row, offset, 2, scale, n.x - (CENTRE_X[cell] - HALF))
    put(row, offset, 3, scale, n.y - (CENTRE_Y[cell] - HALF))
    put(row, offset, 4, scale, n.x - n.prev_x)
    put(row, offset, 5, scale, n.y - n.prev_y)
    put(row, offset, 6, scale, float(n.in_air))
    put(row, offset, 7, scale, float(n.near_wall))
    put(row, offset, 8, scale, n.wall_x if n.near_wall else 0.0)
    put(row, offset, 9, scale, 0.0 if n.in_air else n.floor_x)
    put(row, offset, 10, scale, 0.0 if n.in_air else n.floor_y)
    put(row, offset, 11, scale, float(n.jump_held))
    put(row, offset, 12, scale, float(n.jump_timer) if n.state == JUMPING else 0.0)
    for state in range(8):
        row[offset + FIRST_STATE + state] = 1.0 if n.state == state else 0.0


@fast
def write_exit(w: World, row: Any, offset: int, scale: Any, exits: Any, start: int, end: int) -> None:
    """Six values: is there one, is it open, the ways to it and to its switch."""
    n = w.ninja
    best = FAR
    chosen = 0
    for k in range(start, end):
        o = w.objects[exits[k]]
        goal = o if o.is_open else w.objects[o.partner]
        dx = goal.x - n.x
        dy = goal.y - n.y
        distance = dx * dx + dy * dy
        nearer = distance < best
        if chosen and w.objects[chosen].is_open != o.is_open:
            nearer = o.is_open == 1
        if nearer or not chosen:
            best = distance
            chosen = exits[k]
    for j in range(FIRST_EXIT, FIRST_GOLD):
        row[offset + j] = 0.0
    if chosen:
        o = w.objects[chosen]
        row[offset + FIRST_EXIT] = 1.0
        row[offset + FIRST_EXIT + 1] = float(o.is_open)
        put(row, offset, FIRST_EXIT + 2, scale, o.x - n.x)
        put(row, offset, FIRST_EXIT + 3, scale, o.y - n.y)
        if not o.is_open:
            put(row, offset, FIRST_EXIT + 4, scale, w.objects[o.partner].x - n.x)
            put(row, offset, FIRST_EXIT + 5, scale, w.objects[o.partner].y - n.y)


@fast
def write_gold(
    w: World, row: Any, offset: int, scale: Any, gold: Any, gold_x: Any, gold_y: Any, start: int, end: int
) -> None:
    """Three values: is some left, the way to the nearest piece."""
    x = w.ninja.x
    y = w.ninja.y
    best = FAR
    chosen = -1
    for k in range(start, end):
        dx = gold_x[k] - x
        dy = gold_y[k] - y
        distance = dx * dx + dy * dy
        # A world's objects are far away in memory, the level's table is near: they are asked last.
        if distance < best and not w.objects[gold[k]].taken:
            best = distance
            chosen = k
    row[offset + FIRST_GOLD] = 0.0 if chosen < 0 else 1.0
    put(row, offset, FIRST_GOLD + 1, scale, 0.0 if chosen < 0 else gold_x[chosen] - x)
    put(row, offset, FIRST_GOLD + 2, scale, 0.0 if chosen < 0 else gold_y[chosen] - y)

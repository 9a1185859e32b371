"""Macros: keys of the ninja for a few ticks. A search chooses macros, not single inputs.

An action is a number: direction + 1 (bits 0-1), mode (bits 2-3), whether the jump key was down before (bit 4), ticks
played (from bit 8 on). Its inputs follow from it. As on a keyboard, jump triggers when its key goes down.
"""

from __future__ import annotations

from functools import cache

from ninja_game.batch.batch import Keys
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bit
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.world import step

RELEASED, PRESSED, PRESSED_AGAIN = 0, 1, 2
"""Modes of the jump key: up; down (a press if it was up); up for one tick, then down (a new press)."""
FOLLOWED = 3  # mode of an action that follows a known run, from the row in its bits from 16 on
MAX_ROWS = 1 << 15  # rows of a known run that fit into an action


@fast
def macro_keys(direction: int, mode: int, held: int, k: int) -> int:
    """The input of tick ``k`` of a macro. ``held``: the jump key was down before the macro."""
    keys = 0
    if direction < 0:
        keys = KEY_LEFT
    elif direction > 0:
        keys = KEY_RIGHT
    if mode == PRESSED:
        return with_press_bit(keys + JUMP_HELD, held or k)
    if mode == PRESSED_AGAIN and k > 0:
        return with_press_bit(keys + JUMP_HELD, k - 1)
    return keys


@fast
def play_macro(tiles: TileMap, w: World, direction: int, mode: int, limit: int) -> int:
    """Play at most ``limit`` ticks; gives the number played.

    A macro ends early at a new decision: the ninja lands, leaves the ground or meets a wall, or the run ends.
    """
    n = w.ninja
    held = n.jump_held
    in_air = n.in_air
    near_wall = n.near_wall
    for k in range(limit):
        step(tiles, w, macro_keys(direction, mode, held, k))
        if w.outcome:
            return k + 1
        if (n.in_air != in_air or (n.near_wall and not near_wall)) and (k > 0 or mode != PRESSED_AGAIN):
            return k + 1
        near_wall = n.near_wall
    return limit


@fast
def action_code(direction: int, mode: int, held: int, ticks: int) -> int:
    return (direction + 1) | mode << 2 | held << 4 | ticks << 8


@cache
def action_inputs(action: int) -> bytes:
    direction, mode, held, ticks = (action & 3) - 1, action >> 2 & 3, action >> 4 & 1, action >> 8
    return bytes(macro_keys(direction, mode, held, k) for k in range(ticks))


@fast
def follow(tiles: TileMap, w: World, keys: Keys, row: int, limit: int) -> int:
    """Continue with a known run's keys from a row on, at most ``limit`` ticks; gives the number played."""
    for k in range(limit):
        if row + k >= len(keys):
            return k
        step(tiles, w, with_press_bit(keys[row + k], w.ninja.jump_held))
        if w.outcome:
            return k + 1
    return limit


@fast
def followed_code(row: int, ticks: int) -> int:
    """Code ``ticks`` of a known run from a row on as one number."""
    return FOLLOWED << 2 | ticks << 8 | row << 16


def inputs_of_action(action: int, known: bytes) -> bytes:
    """The inputs of an action, one byte per tick; ``known``: the run that it may follow."""
    if action >> 2 & 3 != FOLLOWED:
        return action_inputs(action)
    return known[action >> 16 : (action >> 16) + (action >> 8 & 255)]

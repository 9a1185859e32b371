"""Macros: what the ninja does for a few ticks. A search decides between macros, not between single inputs.

An action holds direction + 1 (bits 0-1), mode (bits 2-3), whether the jump key was down before (bit 4) and how many
ticks were played (bits 8 and up), so that its inputs can be written down again. The jump key triggers, as at a real
keyboard, exactly in the tick in which it goes down.
"""

from __future__ import annotations

from typing import Any

from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.world import step

RELEASED, PRESSED, PRESSED_AGAIN = 0, 1, 2
"""Modes of the jump key: up; down (a press if it was up); up for one tick, then down."""

LEFT_BIT, RIGHT_BIT, HELD_BIT, TRIGGERED_BIT = 1, 2, 4, 8


@fast
def macro_frame(direction: int, mode: int, held: int, k: int) -> int:
    """The input of tick ``k`` of a macro; ``held``: the jump key was down before it."""
    frame = 0
    if direction < 0:
        frame = LEFT_BIT
    elif direction > 0:
        frame = RIGHT_BIT
    if mode == PRESSED:
        frame += HELD_BIT
        if k == 0 and not held:
            frame += TRIGGERED_BIT
    elif mode == PRESSED_AGAIN and k > 0:
        frame += HELD_BIT
        if k == 1:
            frame += TRIGGERED_BIT
    return frame


@fast
def play_macro(level: TileMap, w: World, direction: int, mode: int, limit: int) -> int:
    """Play at most ``limit`` ticks; the number played.

    It ends early where there is something new to decide: the ninja lands, leaves the ground or meets a wall, or the
    run ends.
    """
    n = w.ninja
    held = n.jump_held
    in_air = n.in_air
    near_wall = n.near_wall
    for k in range(limit):
        step(level, w, macro_frame(direction, mode, held, k))
        if w.outcome:
            return k + 1
        if (n.in_air != in_air or (n.near_wall and not near_wall)) and (k > 0 or mode != PRESSED_AGAIN):
            return k + 1
        near_wall = n.near_wall
    return limit


@fast
def action_code(direction: int, mode: int, held: int, ticks: int) -> int:
    """A macro in one number."""
    return (direction + 1) | mode << 2 | held << 4 | ticks << 8


def action_frames(action: int) -> bytes:
    """The inputs of an action, one byte a tick."""
    direction, mode, held, ticks = (action & 3) - 1, action >> 2 & 3, action >> 4 & 1, action >> 8
    return bytes(macro_frame(direction, mode, held, k) for k in range(ticks))


def held_frames(frames: Any) -> bytes:
    """Inputs with the trigger put where the jump key goes down, and nowhere else."""
    fixed = bytearray()
    held = 0
    for frame in frames:
        now = frame & HELD_BIT
        fixed.append((frame & 7) + (TRIGGERED_BIT if now and not held else 0))
        held = now
    return bytes(fixed)

"""How the ninja acts on the keys, state by state: the tables of ninja.md §7, in their order.

"Store vx" means prev_x := x - vx: the velocity lives in the difference of the positions.
"""

from __future__ import annotations

from ninja_game.sim.events import JUMPED, LANDED, WALL_JUMPED, emit
from ninja_game.sim.rules import (
    AIR_ACCELERATION,
    CELEBRATION_DRAG,
    DRAG,
    GROUND_ACCELERATION,
    JUMP_GRAVITY,
    JUMP_VERTICAL,
    MAX_JUMP_TICKS,
    SKID_FRICTION,
    STAND_FRICTION,
    STAND_SPEED,
    TOP_SPEED,
    UPHILL_HELP,
    UPHILL_JUMP_Y,
    WALL_FRICTION,
    WALL_HOP_Y,
    WALL_JUMP_X,
    WALL_JUMP_Y,
)
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import Ninja, World
from ninja_game.sim.states import FALLING, JUMPING, RUNNING, SKIDDING, SLIDING, STANDING, enter_state


@fast
def jump(w: World, n: Ninja, jx: float, jy: float) -> None:
    """Enter JUMPING: drop a velocity that opposes the jump, then move the position itself."""
    enter_state(w, JUMPING)
    n.gravity = JUMP_GRAVITY
    if (n.x - n.prev_x) * jx < 0.0:
        n.prev_x = n.x
    if (n.y - n.prev_y) * jy < 0.0:
        n.prev_y = n.y
    n.x = n.x + jx
    n.y = n.y + jy * JUMP_VERTICAL
    n.jump_timer = 0


@fast
def jump_off_floor(w: World, n: Ninja, jx: float, jy: float) -> None:
    """Jump from the ground, with its event."""
    emit(w, JUMPED, 0, n.x, n.y, n.floor_x, n.floor_y)
    jump(w, n, jx, jy)


@fast
def jump_off_wall(w: World, n: Ninja, jx: float, jy: float) -> None:
    """Jump or hop off a wall, with its event."""
    emit(w, WALL_JUMPED, 0, n.x, n.y, n.wall_x, n.wall_y)
    jump(w, n, jx, jy)


@fast
def think_in_air(w: World, n: Ninja) -> None:
    """Air control, the end of a jump, wall slide and wall jumps (ninja.md §7.1)."""
    vx = n.x - n.prev_x
    vy = n.y - n.prev_y
    a = vx + n.direction * AIR_ACCELERATION
    if abs(a) < TOP_SPEED:
        vx = a
    n.prev_x = n.x - vx

    state = n.state
    if state <= SKIDDING:
        enter_state(w, FALLING)
    elif state == JUMPING:
        n.jump_timer += 1
        if not n.jump_held or n.jump_timer > MAX_JUMP_TICKS:
            enter_state(w, FALLING)
    elif n.near_wall:
        towards = n.direction * n.wall_x
        if n.jump_pressed:
            if state == SLIDING and towards < 0.0:
                jump_off_wall(w, n, n.wall_x, n.wall_y + WALL_HOP_Y)
            else:
                jump_off_wall(w, n, n.wall_x * WALL_JUMP_X, n.wall_y + WALL_JUMP_Y)
        elif state == SLIDING:
            if towards > 0.0:
                enter_state(w, FALLING)
            else:
                vy = vy + (-WALL_FRICTION) * abs(vy)
                n.prev_y = n.y - vy
        elif vy > 0.0 and towards < 0.0:
            enter_state(w, SLIDING)
    elif state == SLIDING:
        enter_state(w, FALLING)


@fast
def think_on_ground(w: World, n: Ninja) -> None:
    """Landing, jumps, running, skidding, standing (ninja.md §7.2)."""
    direction = n.direction
    vx = n.x - n.prev_x
    vy = n.y - n.prev_y
    a = vx + direction * GROUND_ACCELERATION
    if abs(a) < TOP_SPEED:
        vx = a
    n.prev_x = n.x - vx

    state = n.state
    if state >= JUMPING:
        emit(w, LANDED, 0, n.x, n.y, n.impact_x, n.impact_y)
        enter_state(w, RUNNING if vx * direction > 0.0 else SKIDDING)
        return
    floor_x = n.floor_x
    if n.jump_pressed:
        if direction * floor_x < 0.0:
            jump_off_floor(w, n, 0.0, UPHILL_JUMP_Y)
        else:
            jump_off_floor(w, n, floor_x, n.floor_y)
        return
    speed = abs(vx * (-n.floor_y) + vy * floor_x)
    if state == RUNNING:
        if not 0.0 < direction * (vx * speed):
            enter_state(w, SKIDDING)
        elif direction * floor_x < 0.0:
            run_uphill(n, vx, vy, a)
    elif state == SKIDDING:
        if (vx * speed) * direction > 0.0:
            enter_state(w, RUNNING)
        elif speed < STAND_SPEED:
            enter_state(w, STANDING)
        else:
            n.prev_x = n.x - vx * SKID_FRICTION
    elif direction != 0:
        enter_state(w, RUNNING)
    elif speed >= STAND_SPEED:
        enter_state(w, SKIDDING)
    else:
        n.prev_x = n.x - vx * STAND_FRICTION
        n.prev_y = n.y - vy * STAND_FRICTION


@fast
def run_uphill(n: Ninja, vx: float, vy: float, a: float) -> None:
    """Help the ninja up a slope against gravity (ninja.md §7.2.1). ``a``: this tick's speed before that, px/tick."""
    steepness = UPHILL_HELP * abs(n.floor_y)
    tx = n.direction * abs(n.floor_y) * steepness
    ty = -abs(n.floor_x) * steepness
    if abs(a) < TOP_SPEED:
        vx = vx + tx * GROUND_ACCELERATION
        vy = vy + ty * GROUND_ACCELERATION
    n.prev_x = n.x - vx
    n.prev_y = n.y - vy


@fast
def celebrate(n: Ninja) -> None:
    """Slow down after the exit: no control, only drag, more of it on the ground (ninja.md §9)."""
    if n.in_air and not n.celebrated_in_air:
        n.drag = DRAG
        n.celebrated_in_air = 1
    elif not n.in_air and n.celebrated_in_air:
        n.drag = CELEBRATION_DRAG
        n.celebrated_in_air = 0

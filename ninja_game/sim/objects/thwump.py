"""Thwump (objects.md §8.8): falls when the ninja is in front of it; its leading face always kills."""

from __future__ import annotations

from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, COLUMN, EXISTS, NEIGHBOUR_OFFSET, ROW, UNIT_X, UNIT_Y
from ninja_game.sim.death import kill
from ninja_game.sim.events import THWUMP_FELL, THWUMP_LANDED, emit
from ninja_game.sim.grid import cell_at, grid_insert, grid_move
from ninja_game.sim.ninja.contact_response import box_contact, push
from ninja_game.sim.rules import (
    CELL,
    RADIUS,
    THWUMP_DOWN_IMPULSE,
    THWUMP_FALL,
    THWUMP_HALF,
    THWUMP_RISE,
    THWUMP_SIDE_IMPULSE,
    THWUMP_SIDE_LIFT,
    THWUMP_SIGHT,
    THWUMP_UP_IMPULSE,
)
from ninja_game.sim.schedule import start_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Thwump
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import ELECTRIC, THWUMP_MOVE, THWUMP_REST


@fast
def create_thwump(tiles: TileMap, w: World, o: Thwump, direction: float) -> None:
    """Scan the free cells ahead: the goal is 9 px beyond the centre of the last one. Edges and doors are ignored."""
    grid_insert(w, o)
    start_update(w, o)
    o.anchor_x = o.x
    o.anchor_y = o.y
    o.speed = THWUMP_FALL
    o.sign = 1.0
    o.face_x = 1.0
    o.low = 1
    o.high = 0
    for side in range(4):
        if direction == side:
            o.face_x = UNIT_X[side]
            o.face_y = UNIT_Y[side]
            cell = o.cell
            goal = o.x if o.face_y == 0.0 else o.y
            start = goal
            sign = o.face_x + o.face_y
            if cell:
                ahead = cell + NEIGHBOUR_OFFSET[side]
                while EXISTS[ahead] and tiles.ids[ahead] == 0:
                    goal = goal + sign * CELL
                    ahead += NEIGHBOUR_OFFSET[side]
            goal = goal + sign * THWUMP_HALF
            o.fall_x = o.x
            o.fall_y = o.y
            if o.face_y == 0.0:
                o.fall_x = goal - (start - CENTRE_X[cell])
                near = COLUMN[cell]
                far = COLUMN[cell_at(o.fall_x, o.fall_y)]
            else:
                o.fall_y = goal - (start - CENTRE_Y[cell])
                near = ROW[cell]
                far = ROW[cell_at(o.fall_x, o.fall_y)]
            o.low = near if near < far else far
            o.high = far if near < far else near


@fast
def update_thwump(w: World, o: Thwump) -> None:
    """At rest: look for the ninja. Otherwise fall to the goal, then rise to the anchor, without a pause."""
    if o.routine == THWUMP_MOVE:
        move_thwump(w, o)
    elif not w.round_over:
        n = w.ninja
        if o.face_x == 0.0:
            triggered = abs(o.x - n.x) < THWUMP_SIGHT and o.low <= ROW[n.cell] <= o.high
        else:
            triggered = abs(o.y - n.y) < THWUMP_SIGHT and o.low <= COLUMN[n.cell] <= o.high
        if triggered:
            o.speed = THWUMP_FALL
            o.sign = 1.0
            o.goal_x = o.fall_x
            o.goal_y = o.fall_y
            o.routine = THWUMP_MOVE
            emit(w, THWUMP_FELL, o.slot, o.x, o.y, o.face_x, o.face_y)


@fast
def move_thwump(w: World, o: Thwump) -> None:
    """Move one step; the tick that reaches the goal does not move further."""
    dx = o.goal_x - o.x
    dy = o.goal_y - o.y
    if dx * dx + dy * dy < o.speed * o.speed:
        o.x = o.goal_x
        o.y = o.goal_y
        if o.sign > 0.0:
            o.speed = THWUMP_RISE
            o.sign = -1.0
            o.goal_x = o.anchor_x
            o.goal_y = o.anchor_y
            emit(w, THWUMP_LANDED, o.slot, o.x, o.y, o.face_x, o.face_y)
        else:
            o.routine = THWUMP_REST
    else:
        o.x = o.x + o.sign * o.face_x * o.speed
        o.y = o.y + o.sign * o.face_y * o.speed
    grid_move(w, o)


@fast
def touch_thwump(w: World, o: Thwump) -> None:
    """Box contact: the leading face kills, the other sides push."""
    n = w.ninja
    depth, mx, my = box_contact(n, o, THWUMP_HALF)
    if depth == 0.0:
        return
    if mx * o.face_x + my * o.face_y <= 0.0:
        push(n, mx * depth, my * depth, mx, my)
        return
    if my == 0.0:
        fx = mx * THWUMP_SIDE_IMPULSE
        fy = THWUMP_SIDE_LIFT
    else:
        fx = 0.0
        fy = THWUMP_UP_IMPULSE if my < 0.0 else THWUMP_DOWN_IMPULSE
    kill(w, ELECTRIC, o.slot, fx, fy, n.x + mx * 0.5 * RADIUS, n.y + my * 0.5 * RADIUS)

"""What an object of each kind does when a level is loaded (objects.md §8)."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.sim.grid import cell_at, cell_index, file, link
from ninja_game.sim.level_data import (
    BOUNCE_BLOCK,
    DOOR,
    DRONE,
    EXIT,
    FLOOR_GUARD,
    GOLD,
    LAUNCH_PAD,
    LAUNCHER,
    MINE,
    ONE_WAY,
    THWUMP,
    TURRET,
)
from ninja_game.sim.memory import fast
from ninja_game.sim.objects.door import write_edges
from ninja_game.sim.objects.drone import UNIT_X, UNIT_Y
from ninja_game.sim.rules import DOWN, DRONE_SPEED, HALF, LEFT, RIGHT, SOLID, STRIDE, THWUMP_FALL, THWUMP_HALF, UP
from ninja_game.sim.schedule import start_think, start_update
from ninja_game.sim.schema import INERT, SWITCH, Door, Drone, FloorGuard, Level, Thing, Thwump, World
from ninja_game.sim.states import (
    AUTOMATIC,
    LOCKED,
    MOVEMENT_BELOW,
    MOVEMENT_BEYOND,
    NO_NUMBER,
    TRAP,
    WEAPON_CHAINGUN,
    WEAPON_LASER,
    WEAPON_UNKNOWN,
    WEAPON_ZAP,
)
from ninja_game.sim.tiles import CENTRE_X, CENTRE_Y, COLUMN, EXISTS, ROW, UNDEFINED_ID


@fast
def create(level: Level, w: World, o: Thing, slot: int, p: Sequence[float]) -> None:
    """What an object does at load, by kind; its kind and place are set."""
    kind = o.kind
    if kind == GOLD or kind == MINE:
        file(w, o, slot)
    elif kind == BOUNCE_BLOCK:
        o.anchor_x = o.old_x = o.x
        o.anchor_y = o.old_y = o.y
        file(w, o, slot)
    elif kind == LAUNCH_PAD:
        o.face_x = p[2]
        o.face_y = p[3]
        file(w, o, slot)
    elif kind == ONE_WAY:
        o.face_x = 0.0
        o.face_y = 1.0
        for direction in range(4):
            if p[2] == direction:
                o.face_x = UNIT_X[direction]
                o.face_y = UNIT_Y[direction]
        file(w, o, slot)
    elif kind == EXIT:
        create_switch(w, o, slot, p[2], p[3])
    elif kind == TURRET:
        o.aim_x = o.x
        o.aim_y = o.y
        start_think(w, o, slot)
    elif kind == LAUNCHER:
        o.base_x = o.x
        o.base_y = o.y
        o.heading_x = 7.0
        o.heading_y = 6.0
        start_think(w, o, slot)
    elif kind == DOOR:
        create_door(w, o, slot, p)
    elif kind == THWUMP:
        create_thwump(level, w, o, slot, p[2])
    elif kind == FLOOR_GUARD:
        create_guard(level, w, o, slot)
    elif kind == DRONE:
        create_drone(w, o, slot, p)


@fast
def create_switch(w: World, o: Thing, slot: int, x: float, y: float) -> None:
    """An exit files only its switch, which has no id: it takes a slot behind those of the ids."""
    switch_slot = w.used
    w.used = switch_slot + 1
    switch = w.things[switch_slot]
    switch.kind = SWITCH
    switch.id = -1
    switch.x = x
    switch.y = y
    switch.partner = slot
    o.partner = switch_slot
    file(w, switch, switch_slot)


@fast
def create_thwump(level: Level, w: World, o: Thwump, slot: int, direction: float) -> None:
    """Scan the free cells ahead: the goal is 9 px beyond the centre of the last one. Edges and doors are ignored."""
    file(w, o, slot)
    start_update(w, o, slot)
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
            ahead = cell
            goal = o.x if o.face_y == 0.0 else o.y
            start = goal
            sign = o.face_x + o.face_y
            if cell:
                ahead = cell + (STRIDE if side == DOWN else -STRIDE if side == UP else 1 if side == RIGHT else -1)
                while EXISTS[ahead] and level.tiles[ahead] == 0:
                    goal = goal + sign * 24.0
                    ahead += STRIDE if side == DOWN else -STRIDE if side == UP else 1 if side == RIGHT else -1
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
def empty_for_guard(level: Level, cell: int) -> bool:
    """A floor guard's scan stops at tile ids above 0; a malformed id below 0 is not one."""
    return level.tiles[cell] == 0 or level.tiles[cell] == UNDEFINED_ID


@fast
def create_guard(level: Level, w: World, o: FloorGuard, slot: int) -> None:
    """Scan the corridor (floor edges as they are at this moment of loading) and the sight range along the row.

    In column 0 or 32 or outside the grid the original hangs while loading; here such a guard is inert.
    """
    cell = cell_at(o.x, o.y)
    if cell == 0 or COLUMN[cell] == 0 or COLUMN[cell] == 32:
        o.kind = INERT
        return
    file(w, o, slot)
    start_update(w, o, slot)
    o.facing = 1.0
    o.y = CENTRE_Y[cell] + HALF - 6.0
    k = cell + 1
    while empty_for_guard(level, k) and w.edges[4 * k + DOWN] == SOLID:
        k += 1
    o.high_x = CENTRE_X[k] - HALF - 6.0
    k = cell
    while empty_for_guard(level, k) and w.edges[4 * k + DOWN] == SOLID:
        k -= 1
    o.low_x = CENTRE_X[k] + HALF + 6.0
    k = cell + 1
    while empty_for_guard(level, k):
        k += 1
    o.high = COLUMN[k - 1]
    k = cell - 1
    while empty_for_guard(level, k):
        k -= 1
    o.low = COLUMN[k + 1]


@fast
def create_door(w: World, o: Door, slot: int, p: Sequence[float]) -> None:
    """Find the two edges, remember what they are, file, then close (a trap door: leave open)."""
    cell_1 = cell_index(p[4] + p[7], p[5] + p[8])
    cell_2 = 0
    if cell_1:
        cell_2 = cell_1 + STRIDE if p[2] == 1.0 else cell_1 + 1
        if not EXISTS[cell_2]:
            cell_2 = 0
    side_1 = DOWN if p[2] == 1.0 else RIGHT
    side_2 = UP if p[2] == 1.0 else LEFT
    if cell_1:
        o.stored_1 = w.edges[4 * cell_1 + side_1]
        # An odd "vertical" flag stores the right side's states but writes P1's lower and P2's upper edge (quirk).
        o.edge_1 = 4 * cell_1 + (RIGHT if p[2] == 0.0 else DOWN)
    if cell_2:
        o.stored_2 = w.edges[4 * cell_2 + side_2]
        o.edge_2 = 4 * cell_2 + (LEFT if p[2] == 0.0 else UP)
    o.mechanism = AUTOMATIC
    if is_set(p[6]):
        o.mechanism = LOCKED
    elif is_set(p[3]):
        o.mechanism = TRAP
    if o.mechanism == AUTOMATIC:
        o.x = 0.0
        o.y = 0.0
        if cell_1:
            o.x = CENTRE_X[cell_1] + (0.0 if p[2] == 1.0 else HALF)
            o.y = CENTRE_Y[cell_1] + (HALF if p[2] == 1.0 else 0.0)
    file(w, o, slot)
    write_edges(w, o, o.mechanism != TRAP)


@fast
def is_set(value: float) -> bool:
    """A flag: any number but 0 and NaN."""
    return value < 0.0 or value > 0.0


@fast
def create_drone(w: World, o: Drone, slot: int, p: Sequence[float]) -> None:
    """Filed where the record says, then snapped to that cell's centre; the first update chooses a goal."""
    cell = cell_at(o.x, o.y)
    link(w, o, slot, cell)
    o.filed = 1
    start_update(w, o, slot)
    o.x = o.goal_x = CENTRE_X[cell]
    o.y = o.goal_y = CENTRE_Y[cell]
    o.end_x = 4.0
    o.end_y = 5.0
    o.direction = direction_code(p[5])
    o.movement = MOVEMENT_BELOW if p[2] < 2.0 else MOVEMENT_BEYOND
    for movement in range(6):
        if p[2] == movement:
            o.movement = movement
    o.weapon = WEAPON_UNKNOWN
    o.speed = DRONE_SPEED
    if p[4] == WEAPON_ZAP:
        o.weapon = WEAPON_ZAP
        o.speed = DRONE_SPEED * 2.0
        if is_set(p[3]):
            o.seeker = 1
    elif p[4] == WEAPON_LASER:
        o.weapon = WEAPON_LASER
        o.speed = DRONE_SPEED * 0.5
        start_think(w, o, slot)
    elif p[4] == WEAPON_CHAINGUN:
        o.weapon = WEAPON_CHAINGUN
        o.speed = DRONE_SPEED * 0.75
        start_think(w, o, slot)


@fast
def direction_code(value: float) -> int:
    """A drone's first direction as a small number that behaves the same: 0-3, else outside but equal modulo 4.

    The remainder of the original has the sign of the dividend; -4…-7 stand for everything below -3.
    """
    if not -1e15 < value < 1e15 or value != int(value):
        return NO_NUMBER
    direction = int(value)
    if direction > 3:
        return 4 + direction % 4
    if direction < -3:
        return -4 - (-direction) % 4
    return direction

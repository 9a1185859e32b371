"""Gauss turret (objects.md §8.12): its crosshair follows the ninja, then it fires one shot through the crosshair."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.collision.rays import sees
from ninja_game.sim.death import kill
from ninja_game.sim.events import TURRET_FIRED, TURRET_LOCKED, emit
from ninja_game.sim.rules import (
    AIM_FAR,
    AIM_FAR_SQUARED,
    AIM_MID,
    AIM_MID_SQUARED,
    AIM_NEAR,
    AIM_NEAR_SQUARED,
    FAR_STEP,
    MID_CYCLE,
    MID_STEP,
    NEAR_CYCLE,
    NEAR_STEP,
    TURRET_DELAY,
    TURRET_IMPULSE,
    TURRET_SHOT,
)
from ninja_game.sim.schedule import end_think, end_update, start_think, start_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Turret
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import (
    HARD_BULLET,
    TURRET_POST_FIRE,
    TURRET_PRE_FIRE,
    TURRET_TARGET,
    TURRET_TARGETING,
    TURRET_WAITING,
)


@fast
def create_turret(w: World, o: Turret) -> None:
    """Wait, aimed at itself. It enters no cell: it cannot be touched."""
    o.aim_x = o.x
    o.aim_y = o.y
    start_think(w, o)


@fast
def sees_ninja(tiles: TileMap, w: World, o: Turret) -> bool:
    """Whether the way from the turret to the ninja is free."""
    return sees(tiles, w, o.x, o.y, w.ninja.x, w.ninja.y)[0]


@fast
def think_turret(tiles: TileMap, w: World, o: Turret) -> None:
    """Waiting: start targeting when the ninja is in sight. Targeting: stop when it is out of sight."""
    seen = sees_ninja(tiles, w, o)
    if o.think == TURRET_WAITING:
        if seen:
            o.aim_factor = AIM_FAR
            o.aim_x = o.x
            o.aim_y = o.y
            keep_targeting(w, o)
    elif not seen:
        stop_targeting(w, o)


@fast
def keep_targeting(w: World, o: Turret) -> None:
    """Start or restart the count to the shot; aim point and factor keep their values."""
    o.shot_counter = TURRET_SHOT
    o.routine = TURRET_TARGET
    o.think = TURRET_TARGETING
    start_update(w, o)


@fast
def stop_targeting(w: World, o: Turret) -> None:
    """Wait until the ninja comes in sight."""
    end_update(w, o)
    o.think = TURRET_WAITING


@fast
def update_turret(tiles: TileMap, w: World, o: Turret) -> None:
    """Target; then stand still before the shot, and again after it."""
    if o.routine == TURRET_TARGET:
        target(w, o)
    elif o.routine == TURRET_PRE_FIRE:
        o.counter += 1
        if o.counter >= TURRET_DELAY:
            if sees_ninja(tiles, w, o):
                fire(tiles, w, o)
            end_shot(w, o)
    elif o.routine == TURRET_POST_FIRE:
        o.counter += 1
        if o.counter >= TURRET_DELAY:
            if sees_ninja(tiles, w, o):
                keep_targeting(w, o)
            else:
                stop_targeting(w, o)


@fast
def target(w: World, o: Turret) -> None:
    """Move the crosshair towards the ninja's next place; the nearer it is, the sooner the shot."""
    n = w.ninja
    ex = o.aim_x - (2.0 * n.x - n.prev_x)
    ey = o.aim_y - (2.0 * n.y - n.prev_y)
    o.aim_x = o.aim_x - o.aim_factor * ex
    o.aim_y = o.aim_y - o.aim_factor * ey
    distance = ex * ex + ey * ey
    if AIM_FAR_SQUARED < distance:
        o.aim_factor = AIM_FAR
        return
    if distance < AIM_NEAR_SQUARED:
        o.shot_counter -= NEAR_STEP + w.tick % NEAR_CYCLE
    elif distance < AIM_MID_SQUARED:
        o.aim_factor = AIM_NEAR
        o.shot_counter -= MID_STEP + w.tick % MID_CYCLE
    else:
        o.aim_factor = AIM_MID
        o.shot_counter -= FAR_STEP
    if o.shot_counter < 0.0:
        end_think(w, o)
        o.counter = 0
        o.routine = TURRET_PRE_FIRE
        emit(w, TURRET_LOCKED, o.slot, o.aim_x, o.aim_y, 0.0, 0.0)


@fast
def fire(tiles: TileMap, w: World, o: Turret) -> None:
    """Shoot through the crosshair: kills if that ray meets the ninja before any tile."""
    hit, hit_x, hit_y = sees(tiles, w, o.x, o.y, o.aim_x, o.aim_y)
    emit(w, TURRET_FIRED, o.slot, o.x, o.y, o.aim_x - o.x, o.aim_y - o.y)
    if hit:
        dx = o.aim_x - o.x
        dy = o.aim_y - o.y
        length = sqrt(dx * dx + dy * dy)
        a = 1.0
        b = 0.0
        if length != 0.0:
            a = dx / length
            b = dy / length
        kill(w, HARD_BULLET, o.slot, a * TURRET_IMPULSE, b * TURRET_IMPULSE, hit_x, hit_y)


@fast
def end_shot(w: World, o: Turret) -> None:
    """Think again and cool down. It also runs if the shot killed and the death idled the turret (objects.md §4.1)."""
    start_think(w, o)
    o.think = TURRET_TARGETING
    o.counter = 0
    o.routine = TURRET_POST_FIRE

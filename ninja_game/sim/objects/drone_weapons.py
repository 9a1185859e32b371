"""The weapons of drones: zap contact, laser beam, chaingun burst (objects.md §8.17-§8.19)."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import ieee_divide
from ninja_game.sim.collision.rays import ray_tiles, sees
from ninja_game.sim.death import kill, zap
from ninja_game.sim.events import CHAINGUN_CHARGING, CHAINGUN_ON, CHAINGUN_SHOT, LASER_CHARGING, LASER_ON, emit
from ninja_game.sim.objects.drone import stop_firing
from ninja_game.sim.rules import (
    BULLET_IMPULSE,
    BURST_SHOTS,
    BURST_SHOTS_CYCLE,
    BURST_SPREAD,
    BURST_SPREAD_CYCLE,
    CHAINGUN_COOL,
    CHAINGUN_PAUSE,
    CHAINGUN_PREPARE,
    DRONE_RADIUS,
    LASER_BEAM,
    LASER_COOL,
    LASER_IMPULSE,
    LASER_PREPARE,
    RADIUS,
)
from ninja_game.sim.schedule import end_think, start_think
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Drone
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import (
    BULLET,
    DRONE_FIRING,
    DRONE_MOVE,
    DRONE_POST_FIRE,
    DRONE_PRE_FIRE,
    LASER,
    WEAPON_LASER,
    WEAPON_ZAP,
)


@fast
def touch_drone(w: World, o: Drone) -> None:
    """Disc contact: a zap drone kills; armed drones can be passed through."""
    if o.weapon == WEAPON_ZAP:
        zap(w, o, DRONE_RADIUS)


@fast
def think_drone(tiles: TileMap, w: World, o: Drone) -> None:
    """Stop a weapon drone that sees the ninja and prepare to fire."""
    if w.round_over:
        return
    n = w.ninja
    hit, hit_x, hit_y = sees(tiles, w, o.x, o.y, n.x, n.y)
    if not hit:
        return
    end_think(w, o)
    o.counter = 0
    o.routine = DRONE_PRE_FIRE
    if o.weapon == WEAPON_LASER:
        emit(w, LASER_CHARGING, o.slot, o.x, o.y, 0.0, 0.0)
        aim_beam(tiles, w, o, hit_x, hit_y)
    else:
        emit(w, CHAINGUN_CHARGING, o.slot, o.x, o.y, 0.0, 0.0)


@fast
def update_weapon(tiles: TileMap, w: World, o: Drone) -> None:
    """Continue with the weapon of a drone that stands: prepare, fire or cool down."""
    routine = o.routine
    if routine == DRONE_POST_FIRE:
        o.counter += 1
        if o.counter >= (LASER_COOL if o.weapon == WEAPON_LASER else CHAINGUN_COOL):
            start_think(w, o)
            o.routine = DRONE_MOVE
    elif o.weapon == WEAPON_LASER:
        if routine == DRONE_PRE_FIRE:
            prepare_beam(w, o)
        else:
            burn(w, o)
    elif routine == DRONE_PRE_FIRE:
        o.counter += 1
        if o.counter >= CHAINGUN_PREPARE:
            open_fire(w, o)
    else:
        shoot(tiles, w, o)


@fast
def aim_beam(tiles: TileMap, w: World, o: Drone, hit_x: float, hit_y: float) -> None:
    """Fix the beam when the drone sees the ninja: a door that closes later does not shorten it."""
    stopped, end_x, end_y = ray_tiles(tiles, w, o.x, o.y, hit_x, hit_y)
    if stopped:
        o.end_x = end_x
        o.end_y = end_y
    o.beam_x = o.end_x - o.x
    o.beam_y = o.end_y - o.y
    o.beam_length = sqrt(o.beam_x * o.beam_x + o.beam_y * o.beam_y)
    if o.beam_length == 0.0:
        stop_firing(w, o)


@fast
def prepare_beam(w: World, o: Drone) -> None:
    """Count down the warning time of the beam."""
    o.counter += 1
    if o.counter >= LASER_PREPARE:
        o.timer = 0
        o.routine = DRONE_FIRING
        emit(w, LASER_ON, o.slot, o.x, o.y, o.beam_x, o.beam_y)


@fast
def burn(w: World, o: Drone) -> None:
    """Kill the ninja if the beam's segment touches it."""
    n = w.ninja
    wx = n.x - o.x
    wy = n.y - o.y
    t = ieee_divide(wx * o.beam_x + wy * o.beam_y, o.beam_length * o.beam_length)
    if t < 0.0:
        zx = o.x
        zy = o.y
    elif t < 1.0:
        zx = o.x + t * o.beam_x
        zy = o.y + t * o.beam_y
    else:
        zx = o.end_x
        zy = o.end_y
    dx = zx - n.x
    dy = zy - n.y
    if sqrt(dx * dx + dy * dy) < RADIUS:
        stop_firing(w, o)
        a = o.beam_x / o.beam_length
        b = o.beam_y / o.beam_length
        kill(w, LASER, o.slot, LASER_IMPULSE * a, LASER_IMPULSE * b, zx, zy)
        return
    o.timer += 1
    if o.timer >= LASER_BEAM:
        stop_firing(w, o)


@fast
def open_fire(w: World, o: Drone) -> None:
    """Fix direction, sweep and length of the burst; it sweeps to the side to which the ninja was moving."""
    n = w.ninja
    o.timer = 0
    o.last_shot = BURST_SHOTS + w.tick % BURST_SHOTS_CYCLE
    o.spread = BURST_SPREAD + BURST_SPREAD * (1 + w.tick % BURST_SPREAD_CYCLE)
    o.shot = 0
    o.routine = DRONE_FIRING
    dx = n.x - o.x
    dy = n.y - o.y
    length = sqrt(dx * dx + dy * dy)
    if length == 0.0:
        stop_firing(w, o)
        return
    o.aim_x = dx / length
    o.aim_y = dy / length
    if (n.x - n.prev_x) * (-o.aim_y) + (n.y - n.prev_y) * o.aim_x < 0.0:
        o.sweep_x = o.aim_y
        o.sweep_y = -o.aim_x
    else:
        o.sweep_x = -o.aim_y
        o.sweep_y = o.aim_x
    emit(w, CHAINGUN_ON, o.slot, o.x, o.y, o.aim_x, o.aim_y)


@fast
def shoot(tiles: TileMap, w: World, o: Drone) -> None:
    """Fire a shot every sixth tick."""
    o.timer += 1
    if o.timer < CHAINGUN_PAUSE:
        return
    o.timer = 0
    if o.last_shot < o.shot:
        stop_firing(w, o)
        return
    s = (o.shot / o.last_shot - 0.5) * o.spread
    gx = o.aim_x + s * o.sweep_x
    gy = o.aim_y + s * o.sweep_y
    hit, hit_x, hit_y = sees(tiles, w, o.x, o.y, o.x + gx, o.y + gy)
    emit(w, CHAINGUN_SHOT, o.slot, o.x, o.y, gx, gy)
    if hit:
        stop_firing(w, o)
        kill(w, BULLET, o.slot, gx * BULLET_IMPULSE, gy * BULLET_IMPULSE, hit_x, hit_y)
    o.shot += 1

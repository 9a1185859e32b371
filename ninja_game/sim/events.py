"""What a tick reports to the presentation: sound, particles and animation read events, the world never does."""

from __future__ import annotations

from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import MAX_EVENTS, World
from ninja_game.sim.states import NO_CAUSE

# Per event: whose it is (``slot``, 0: the ninja's), where it is (x, y, px) and what its vector (dx, dy) means:
#
#   event                               slot            (x, y)             (dx, dy)
#   jumped                              0               ninja              normal of the floor
#   wall-jumped                         0               ninja              normal of the wall
#   landed                              0               ninja              velocity of the impact, px/tick
#   launched                            pad             ninja, before it   velocity that the pad gives, px/tick
#   died                                who killed, 0:  where it was hit   impulse on the corpse, px/tick
#                                       nobody
#   won                                 0               ninja              0, 0
#   gold-taken, mine-exploded           gold, mine      its place          0, 0
#   exit-opened                         exit            its switch         0, 0
#   door-opened, door-closed            door            its middle         0, 0
#   lock-opened, trap-closed            door            its switch         0, 0
#   block-woken                         block           its place          0, 0
#   thwump-fell, thwump-landed          thwump          its place          the way it falls, unit vector
#   guard-started                       guard           its place          the way it runs, unit vector
#   chase-started                       drone           its place          0, 0
#   rocket-launched                     launcher        its place          the rocket's heading, unit vector
#   rocket-exploded                     launcher        the rocket         0, 0
#   turret-locked                       turret          its crosshair      0, 0
#   turret-fired                        turret          its place          from it to the crosshair, px
#   laser-charging, chaingun-charging   drone           its place          0, 0
#   laser-on                            drone           its place          from it to the beam's end, px
#   chaingun-on                         drone           its place          the way it aims, unit vector
#   chaingun-shot                       drone           its place          the way of the shot, about a unit vector
#   laser-off, chaingun-off             drone           its place          0, 0

# The ninja.
JUMPED, WALL_JUMPED, LANDED, LAUNCHED, DIED, WON = range(6)
# Objects.
GOLD_TAKEN, MINE_EXPLODED, EXIT_OPENED, DOOR_OPENED, DOOR_CLOSED, LOCK_OPENED, TRAP_CLOSED, BLOCK_WOKEN = range(6, 14)
THWUMP_FELL, THWUMP_LANDED, GUARD_STARTED, CHASE_STARTED = range(14, 18)
ROCKET_LAUNCHED, ROCKET_EXPLODED, TURRET_LOCKED, TURRET_FIRED = range(18, 22)
LASER_CHARGING, LASER_ON, LASER_OFF, CHAINGUN_CHARGING, CHAINGUN_ON, CHAINGUN_SHOT, CHAINGUN_OFF = range(22, 29)

EVENT_NAMES = (
    "jumped", "wall-jumped", "landed", "launched", "died", "won",
    "gold-taken", "mine-exploded", "exit-opened", "door-opened", "door-closed", "lock-opened", "trap-closed",
    "block-woken", "thwump-fell", "thwump-landed", "guard-started", "chase-started",
    "rocket-launched", "rocket-exploded", "turret-locked", "turret-fired",
    "laser-charging", "laser-on", "laser-off", "chaingun-charging", "chaingun-on", "chaingun-shot", "chaingun-off",
)  # fmt: skip
"""Name of each event number."""


@fast
def emit(w: World, kind: int, slot: int, x: float, y: float, dx: float, dy: float) -> None:
    """Record an event of this tick; the table above says what its numbers mean."""
    k = w.event_count
    if k < MAX_EVENTS:
        event = w.events[k]
        event.kind = kind
        event.slot = slot
        event.cause = NO_CAUSE
        event.x = x
        event.y = y
        event.dx = dx
        event.dy = dy
        w.event_count = k + 1


@fast
def emit_death(w: World, cause: int, slot: int, x: float, y: float, dx: float, dy: float) -> None:
    """Record a death and its cause."""
    k = w.event_count
    emit(w, DIED, slot, x, y, dx, dy)
    if k < MAX_EVENTS:
        w.events[k].cause = cause

"""What a tick reports to presentation: sound, particles and animation consume it, nothing in the world reads it."""

from __future__ import annotations

from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import MAX_EVENTS, World

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
    """Note an event of this tick: where (x, y) in px, a vector (dx, dy) that depends on the kind, whose (0: ninja).

    For DIED, ``slot`` is the kill type and (dx, dy) the impulse; for LANDED (dx, dy) is the impact velocity.
    """
    k = w.event_count
    if k < MAX_EVENTS:
        event = w.events[k]
        event.kind = kind
        event.slot = slot
        event.x = x
        event.y = y
        event.dx = dx
        event.dy = dy
        w.event_count = k + 1

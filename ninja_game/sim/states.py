"""Numbers of states and routines of the ninja and the objects. They are part of traces and save-states."""

from __future__ import annotations

from ninja_game.sim.rules import DRAG, GRAVITY
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import World

# The ninja (ninja.md §2; the order matters: 0-2 are ground states, 3-5 air states).
STANDING, RUNNING, SKIDDING, JUMPING, FALLING, SLIDING, DEAD, CELEBRATING = range(8)
STATE_NAMES = ("standing", "running", "skidding", "jumping", "falling", "sliding", "dead", "celebrating")

# How a run ended: the first exit contact or death.
OUTCOME_RUNNING, OUTCOME_EXIT, OUTCOME_DEAD = 0, 1, 2
OUTCOME_NAMES = ("running", "exit", "dead")

# Causes of a death (objects.md §9; "bullet" and "crushed" have numbers of this program).
NO_CAUSE = -1
ELECTRIC, EXPLOSIVE, WEAK_BULLET, HARD_BULLET, FALL, LASER, BULLET, CRUSHED = range(8)
CAUSE_NAMES = ("electric", "explosive", "weak bullet", "hard bullet", "fall", "laser", "bullet", "crushed")
"""electric: guards, zap drones, thwumps; explosive: mines, rockets; hard bullet: turrets; bullet: chainguns; crushed: a
push of more than √80 px out of a tile; weak bullet: no object of this game."""

# Routines of the objects; every object starts with 0.
THWUMP_REST, THWUMP_MOVE = 0, 1
GUARD_IDLE, GUARD_CHASE = 0, 1
TURRET_TARGET, TURRET_PRE_FIRE, TURRET_POST_FIRE = 1, 2, 3
TURRET_WAITING, TURRET_TARGETING = 0, 1
DRONE_MOVE, DRONE_PRE_FIRE, DRONE_FIRING, DRONE_POST_FIRE = 0, 1, 2, 3
LAUNCHER_IDLE, LAUNCHER_PREPARE, LAUNCHER_FLIGHT = 0, 1, 2

# Types of doors, weapons and movements of drones.
AUTOMATIC, LOCKED, TRAP = 0, 1, 2
WEAPON_ZAP, WEAPON_LASER, WEAPON_CHAINGUN, WEAPON_UNKNOWN = 0, 1, 2, 3
SURFACE_CW, SURFACE_CCW, WANDER_CW, WANDER_CCW, ALTERNATING, PSEUDO_RANDOM = range(6)
MOVEMENT_BELOW, MOVEMENT_BEYOND = -1, 6
"""A malformed movement number below 2 / not below 2; they behave differently in a chase (objects.md §8.16)."""
NO_DIRECTION, NO_NUMBER = -100, -101
"""A drone's direction "none", and a direction parameter that is not a whole number (objects.md §8.15)."""


@fast
def leave_state(w: World) -> None:
    """Leave the ninja's present state (ninja.md §7.3). Every transition does this, even one into the same state."""
    n = w.ninja
    if n.state == JUMPING:
        n.gravity = GRAVITY
    elif n.state == CELEBRATING:
        n.drag = DRAG


@fast
def enter_state(w: World, state: int) -> None:
    """Leave the present state and enter one that has nothing to set but its number."""
    leave_state(w)
    w.ninja.state = state

"""Death, win and how every object reacts to them: the idle event (objects.md §4).

The reactions of all kinds are here, not in the files of the kinds: death needs the reactions and the kinds need death,
so the modules would import each other.
"""

from __future__ import annotations

from math import sqrt

from ninja_game.sim import kinds
from ninja_game.sim.events import WON, emit, emit_death
from ninja_game.sim.grid import grid_remove
from ninja_game.sim.objects.drone import stop_firing
from ninja_game.sim.rules import RADIUS, ZAP_IMPULSE
from ninja_game.sim.schedule import end_think, end_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Header
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import (
    CELEBRATING,
    DEAD,
    DRONE_FIRING,
    ELECTRIC,
    GUARD_IDLE,
    LAUNCHER_IDLE,
    OUTCOME_DEAD,
    OUTCOME_EXIT,
    OUTCOME_RUNNING,
    TURRET_WAITING,
    leave_state,
)


@fast
def kill(w: World, cause: int, slot: int, fx: float, fy: float, cx: float, cy: float) -> None:
    """Kill the ninja if it is alive.

    ``cause``: a cause of states.py; ``slot``: the killer's slot, 0 if nobody killed. The corpse gets the impulse (fx,
    fy) in px/tick at the point (cx, cy) in px.
    """
    n = w.ninja
    if n.state == DEAD:
        return
    leave_state(w)
    n.state = DEAD
    w.deaths += 1
    if w.outcome == OUTCOME_RUNNING:
        w.outcome = OUTCOME_DEAD
    emit_death(w, cause, slot, cx, cy, fx, fy)
    idle_event(w)


@fast
def zap(w: World, o: Header, radius: float) -> None:
    """Kill the ninja if it touches the electric disc of a guard or zap drone, ``radius`` in px."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    length = sqrt(dx * dx + dy * dy)
    if length < radius + RADIUS:
        a = 0.0
        b = 0.0
        if length > 0.0:
            a = dx / length
            b = dy / length
        kill(w, ELECTRIC, o.slot, (-a) * ZAP_IMPULSE, (-b) * ZAP_IMPULSE, n.x + RADIUS * a, n.y + RADIUS * b)


@fast
def win(w: World) -> None:
    """Start the celebration at the exit, also for a ninja that died earlier in this contact pass (objects.md §3)."""
    n = w.ninja
    leave_state(w)
    n.state = CELEBRATING
    n.celebrated_in_air = n.in_air
    w.won += 1
    if w.outcome == OUTCOME_RUNNING:
        w.outcome = OUTCOME_EXIT
    emit(w, WON, 0, n.x, n.y, 0.0, 0.0)
    idle_event(w)


@fast
def idle_event(w: World) -> None:
    """Let every object react to a death or a win, highest id first.

    Bounce blocks, pads, one-ways and mines do nothing. The only lasting effect is the flag ``round_over``: thwumps at
    rest stay there, launchers and drones no longer think, seekers do not chase, and the ninja's contact pass is off.
    """
    w.round_over = 1
    for slot in range(w.id_count, 0, -1):
        o = w.objects[slot]
        kind = o.kind
        if kind == kinds.GOLD:
            if not o.taken:
                grid_remove(w, o)
        elif kind == kinds.EXIT:
            if o.is_open:
                grid_remove(w, o)
        elif kind == kinds.DOOR:
            grid_remove(w, o)
        elif kind == kinds.LAUNCHER:
            if o.routine == LAUNCHER_IDLE:
                end_think(w, o)
        elif kind == kinds.TURRET:
            end_update(w, o)
            o.think = TURRET_WAITING
            end_think(w, o)
        elif kind == kinds.FLOOR_GUARD:
            o.routine = GUARD_IDLE
            end_update(w, o)
        elif kind == kinds.DRONE:
            o.chasing = 0
            if o.routine == DRONE_FIRING:
                stop_firing(w, o)

"""The picture's memory of the objects between ticks: their last places, and the ticks of their last changes.

Reads the world after each tick and never writes to it.
"""

from __future__ import annotations

from math import atan2, pi

from ninja_game.sim import kinds
from ninja_game.sim.grid import Point
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import DRONE_MOVE, LAUNCHER_FLIGHT
from ninja_game.sim.traces import place_of

MOVING_KINDS = frozenset(kind.number for kind in kinds.KINDS if kind.moves)
STATE_FIELDS = {kind.number: kind.used for kind in kinds.KINDS if kind.used} | {kinds.DRONE: "chasing"}
"""The field that holds a lasting or passing change of an object, for kinds with one."""
LONG_AGO = -100_000
_JUMP = 30.0  # px per tick; an object that moved farther was relocated
_EYE_TURN = 0.66
"""Share of the remaining angle that a drone's eye turns in a tick (0.3 a picture at the classic 120 a second)."""
_DIRECTIONS = (0.0, pi / 2, pi, -pi / 2)


def state_of(world: World, o: Object) -> tuple[int, int, int]:
    """The part of an object's state that changes its look, apart from its place."""
    if o.kind == kinds.SWITCH:
        # An exit's switch has no state of its own: it is pressed when the exit is open.
        o = world.objects[o.partner]
    return getattr(o, STATE_FIELDS.get(o.kind, "updating")), o.routine, o.updating


class ObjectAnimation:
    """The memory of one view. ``tick``: ticks seen; ``closing``: the slot of an exit that closes, or 0."""

    def __init__(self, world: World) -> None:
        self.reset(world)

    def reset(self, world: World) -> None:
        """Forget everything: a new run, or a jump in time."""
        self.tick = 0
        slots = range(1, world.slots_used)
        self.moving_slots = [slot for slot in slots if world.objects[slot].kind in MOVING_KINDS]
        self.static_slots = [slot for slot in slots if world.objects[slot].kind not in {kinds.NINJA, kinds.INERT}]
        self.switch_slots = [slot for slot in slots if world.objects[slot].kind == kinds.SWITCH]
        self.states = {slot: state_of(world, world.objects[slot]) for slot in self.static_slots}
        self.since = dict.fromkeys(self.static_slots, LONG_AGO)
        self.changed: set[int] = set()
        self.closing = 0
        self.now = {slot: place_of(world, slot) for slot in self.moving_slots}
        self.before = dict(self.now)
        self.eyes = {
            slot: _eye_angle(world, world.objects[slot])
            for slot in self.moving_slots
            if world.objects[slot].kind == kinds.DRONE
        }
        self.trails: dict[int, list[Point]] = {}
        n = world.ninja
        self.ninja_now = self.ninja_before = (n.x, n.y)

    def on_tick(self, world: World) -> None:
        """Update after a tick of the world."""
        self.tick += 1
        self.before, self.now = self.now, {}
        for slot in self.moving_slots:
            o = world.objects[slot]
            self.now[slot] = place_of(world, slot)
            if o.kind == kinds.DRONE:
                turn = (_eye_angle(world, o) - self.eyes[slot] + pi) % (2 * pi) - pi
                self.eyes[slot] += _EYE_TURN * turn
            elif o.kind == kinds.LAUNCHER:
                self._follow_rocket(slot, o)
        for slot in self.static_slots:
            state = state_of(world, world.objects[slot])
            if state != self.states[slot]:
                self.states[slot] = state
                self.since[slot] = self.tick
                self.changed.add(slot)
        for event in world.events[: world.event_count]:
            if event.slot in self.since and world.objects[event.slot].kind not in MOVING_KINDS | {kinds.DOOR}:
                self.since[event.slot] = self.tick
                self.changed.add(event.slot)
        self.ninja_before = self.ninja_now
        self.ninja_now = world.ninja.x, world.ninja.y

    def close(self, slot: int) -> None:
        """Animate the closing of an open exit."""
        self.closing, self.since[slot] = slot, self.tick
        self.changed.add(slot)

    def _follow_rocket(self, slot: int, o: Object) -> None:
        """The last places of a rocket, newest last; they fade when it is gone."""
        trail = self.trails.setdefault(slot, [])
        if o.routine == LAUNCHER_FLIGHT:
            trail.append((o.x, o.y))
        if trail and (o.routine != LAUNCHER_FLIGHT or len(trail) > 9):
            del trail[0]

    def place(self, slot: int, fraction: float) -> Point:
        """The drawn place of an object, ``fraction`` of a tick after the last but one."""
        now, before = self.now[slot], self.before[slot]
        if now == before:
            return now
        (x, y), (bx, by) = now, before
        if abs(x - bx) > _JUMP or abs(y - by) > _JUMP:
            return now
        return bx + (x - bx) * fraction, by + (y - by) * fraction

    def ninja_place(self, fraction: float) -> Point:
        (bx, by), (x, y) = self.ninja_before, self.ninja_now
        return bx + (x - bx) * fraction, by + (y - by) * fraction

    def age(self, slot: int, fraction: float) -> float:
        """Ticks since an object last changed."""
        return self.tick + fraction - 1 - self.since[slot]

    def step(self, slot: int, fraction: float, frames: float) -> int:
        """Progress of an animation of that many frames (120 a second, 3 a tick) since the change, 0…8."""
        return max(0, min(8, int(self.age(slot, fraction) * 3 / frames * 8)))


def _eye_angle(world: World, o: Object) -> float:
    """The direction of a drone's eye, radians clockwise from the right: to its target, or where it goes."""
    if o.routine != DRONE_MOVE:
        return atan2(world.ninja.y - o.y, world.ninja.x - o.x)
    return _DIRECTIONS[o.direction] if 0 <= o.direction <= 3 else pi / 2

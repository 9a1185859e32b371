"""The canonical digests of a world, and the first difference of two worlds. Both memories give the same digests.

``world_digest`` covers every field of the schema except the events, and of objects the header and the fields of their
kind. Tests compare the two memories by it; it changes with the schema. ``replay_digest`` covers only what a player can
see: replays store it, so no change inside the world may alter it. ``state_digest`` covers what decides the ticks to
come, so that states of different ticks can be compared. Numbers are little-endian, -0.0 as 0.0, every NaN as one.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Iterator
from operator import attrgetter
from typing import Any

from ninja_game.sim.arithmetic import canonical
from ninja_game.sim.kinds import DRONE, KIND_OF, KINDS
from ninja_game.sim.schema.declare import fields_of, scalars_of
from ninja_game.sim.schema.object_fields import Drone, Object
from ninja_game.sim.schema.world_fields import Ninja, World
from ninja_game.sim.states import JUMPING, PSEUDO_RANDOM
from ninja_game.sim.traces import is_traced, place_of, status_of

OVERWRITTEN = {
    "impact_x", "impact_y", "was_in_air", "near_wall", "wall_x", "wall_y", "first_floor_x", "first_floor_y",
    "last_floor_x", "last_floor_y", "floor_contacts", "direction", "jump_pressed",
}  # fmt: skip
"""Fields of the ninja that every tick writes before anything reads them."""

_SCALARS = [field for field in scalars_of(World) if field.name != "event_count"]


class _Reader:
    """Reads and packs the fields of one schema class."""

    def __init__(self, fields: list[Any]) -> None:
        self.names = [field.name for field in fields]
        self.get = attrgetter(*self.names)
        self.pack = struct.Struct("<" + "".join("d" if field.type == "f8" else "i" for field in fields)).pack

    def bytes_of(self, o: Any) -> bytes:
        """Pack the fields of an object canonically."""
        return self.pack(*map(canonical, self.get(o)))


_WORLD = _Reader(_SCALARS)
_NINJA = _Reader(fields_of(Ninja))
_STATE_WORLD = _Reader([field for field in _SCALARS if field.name != "tick"])
_STATE_NINJA = _Reader([field for field in fields_of(Ninja) if field.name not in OVERWRITTEN | {"jump_timer"}])
_OBJECTS = {kind.number: _Reader(fields_of(kind.fields)) for kind in KINDS}
_STATE_OBJECTS = {**_OBJECTS, DRONE: _Reader([field for field in fields_of(Drone) if field.name != "move_ticks"])}


def world_digest(w: World) -> str:
    """The sha256 (hex) of a world's canonical form."""
    return _digest(w, _WORLD.bytes_of(w) + _NINJA.bytes_of(w.ninja), _OBJECTS)


def state_digest(w: World) -> str:
    """The sha256 (hex) of the canonical form without the fields that no later tick reads.

    It leaves out ``OVERWRITTEN``, the jump timer outside of a jump, the ticks run, and of the ticks that a drone has
    moved all but what a pseudo-random drone uses. Turrets and armed drones do read the ticks run when they shoot;
    nothing else does.
    """
    timer = w.ninja.jump_timer if w.ninja.state == JUMPING else 0
    drones = (o for o in w.objects[1 : w.slots_used] if o.kind == DRONE)
    odd = bytes(o.move_ticks % 2 if o.movement == PSEUDO_RANDOM else 0 for o in drones)
    scalars = _STATE_WORLD.bytes_of(w) + _STATE_NINJA.bytes_of(w.ninja) + struct.pack("<i", timer)
    return _digest(w, scalars + odd, _STATE_OBJECTS)


def _digest(w: World, scalars: bytes, readers: dict[int, _Reader]) -> str:
    """Hash these scalars, all cells and all objects: sha256 (hex)."""
    digest = hashlib.sha256(scalars)
    digest.update(struct.pack(f"<{len(w.heads)}h", *w.heads) + bytes(w.edges))
    for o in w.objects[1 : w.slots_used]:
        digest.update(readers[o.kind].bytes_of(o))
    return digest.hexdigest()


def replay_digest(w: World) -> str:
    """The sha256 (hex) of what a world shows after a tick, for replays of version 2 (docs/replay-format.md).

    It covers the ninja's x, y, prev_x, prev_y (px, float64), state, body (1: box), gold, outcome and ticks run (int32);
    then, of every traced object in id order, x, y (px, float64), id, kind and status (int32). Another list of fields
    would need another version of the replay format.
    """
    n = w.ninja
    ninja = map(canonical, (n.x, n.y, n.prev_x, n.prev_y))
    digest = hashlib.sha256(struct.pack("<4d5i", *ninja, n.state, n.box, w.gold, w.outcome, w.tick))
    for slot in range(1, w.id_count + 1):
        if is_traced(w, slot):
            o = w.objects[slot]
            x, y = map(canonical, place_of(w, slot))
            digest.update(struct.pack("<2d3i", x, y, o.id, o.kind, status_of(w, slot)))
    return digest.hexdigest()


def differences(ours: World, theirs: World) -> Iterator[tuple[str, Any, Any]]:
    """Every field that differs in two worlds, first those of the ninja: (name, our value, their value)."""
    yield from _unequal("ninja", _NINJA, ours.ninja, theirs.ninja)
    yield from _unequal("world", _WORLD, ours, theirs)
    for slot in range(1, min(ours.slots_used, theirs.slots_used)):
        mine, other = ours.objects[slot], theirs.objects[slot]
        yield from _unequal(_report_name(mine), _OBJECTS[mine.kind], mine, other)
    for name in ("heads", "edges"):
        for index, (mine, other) in enumerate(zip(getattr(ours, name), getattr(theirs, name), strict=True)):
            if mine != other:
                yield f"{name}[{index}]", mine, other


def _report_name(o: Object) -> str:
    """Name an object for a report: "object 12 (drone)"."""
    name = KIND_OF[o.kind].name
    return f"object {o.id} ({name})" if o.id >= 0 else f"{name} at ({o.x}, {o.y})"


def _unequal(name: str, reader: _Reader, ours: Any, theirs: Any) -> Iterator[tuple[str, Any, Any]]:
    """The fields in which two objects differ; NaN equals NaN."""
    for field, mine, other in zip(reader.names, reader.get(ours), reader.get(theirs), strict=True):
        if mine != other and not (mine != mine and other != other):
            yield f"{name}: {field}", mine, other

"""One run of one level: make it, step it, look at it, save and restore it.

>>> from ninja_game import Simulation, parse_level
>>> level = parse_level("0" * 713 + "|5^100,566")
>>> run = Simulation(level)
>>> for _ in range(30):
...     run.step(right=True)
>>> run.ninja.x, run.ninja.state
(158.9550544815997, 'running')
>>> state = run.save()
>>> run.step(right=True, jump=True)
>>> run.ninja.state, [event.name for event in run.events]
('jumping', ['jumped'])
>>> run.restore(state)
>>> run.tick, run.ninja.state
(30, 'running')
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ninja_game.backend.memories import open_worlds
from ninja_game.backend.worlds import MemoryName
from ninja_game.errors import ArgumentError
from ninja_game.sim.digest import differences, replay_digest, world_digest
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import ALL_KEYS, JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bit
from ninja_game.sim.kinds import KIND_OF
from ninja_game.sim.level import Body, Level, is_box
from ninja_game.sim.loader import tile_map
from ninja_game.sim.schema.world_fields import Event, TileMap, World
from ninja_game.sim.states import CAUSE_NAMES, NO_CAUSE, OUTCOME_NAMES, STATE_NAMES

__all__ = ["EventView", "NinjaView", "ObjectView", "SaveState", "Simulation"]


@dataclass(frozen=True)
class NinjaView:
    """The ninja after a tick: place and previous place (px), velocity (px/tick), state by name."""

    x: float
    y: float
    prev_x: float
    prev_y: float
    state: str  #: its name, of STATE_NAMES
    in_air: bool
    near_wall: bool

    @property
    def vx(self) -> float:
        """Horizontal velocity, px/tick."""
        return self.x - self.prev_x

    @property
    def vy(self) -> float:
        """Vertical velocity, px/tick, positive downwards."""
        return self.y - self.prev_y


@dataclass(frozen=True)
class ObjectView:
    """An object after a tick: id and kind, place (px), and its status number (docs/replay-format.md)."""

    id: int
    kind: str
    x: float
    y: float
    status: int


@dataclass(frozen=True)
class EventView:
    """Something that happened in the last tick: name, place (px), a vector that depends on the event (sim/events.py).

    ``object_id``: the object whose event it is, of a death the killer; None for the ninja's own. ``cause``: of a death,
    what killed, one of CAUSE_NAMES; else "".
    """

    name: str
    x: float
    y: float
    dx: float  #: the vector's x
    dy: float
    object_id: int | None
    cause: str = ""


@dataclass(frozen=True)
class SaveState:
    """A moment of a run, from ``Simulation.save``: only good for runs of an equal level, body and memory.

    Equal states have an equal level, body, memory and the same past: ``inputs``, and ``kills`` (tick and arguments).
    """

    level: Level = field(repr=False)
    body: Body
    memory: MemoryName
    inputs: bytes = field(repr=False)
    data: Any = field(repr=False, compare=False)  #: the world, in the form of its memory
    kills: tuple[tuple[int, int, float, float], ...] = field(default=(), repr=False)

    @property
    def tick(self) -> int:
        """Ticks run so far."""
        return len(self.inputs)


class Simulation:
    """A world in which a level is played, one tick (1/40 s) at a time.

    ``level``: what to play. ``body``: "circle" (the classic rules, radius 10 px) or "box" (an AABB of 20 x 20 px).
    ``memory``: "plain" (starts at once, can be looked into), "compiled" (Numba; fast for many ticks) or "auto", which
    is compiled where nothing is to be compiled first. The two give the same bits. Raises LevelError for a level that
    cannot be played, ArgumentError for another body or memory, MemoryUnavailableError for "compiled" without Numba.
    """

    def __init__(self, level: Level, *, body: Body = "circle", memory: str = "plain") -> None:
        self.level = level
        self.body = body
        self._worlds = open_worlds(memory, level, box=is_box(body), at_once=True)
        self._inputs = bytearray()
        self._kills: list[tuple[int, int, float, float]] = []

    def __copy__(self) -> Simulation:
        return deepcopy(self)

    def __repr__(self) -> str:
        return f"<Simulation in tick {self.tick}: {self.outcome}, {self.gold} gold, {self.body}, {self.memory}>"

    @property
    def memory(self) -> MemoryName:
        """The memory in use, "plain" or "compiled"."""
        return self._worlds.name

    @property
    def world(self) -> World:
        """The whole state as plain objects; of the plain memory the world itself, of the compiled one a copy."""
        return self._worlds.world()

    @cached_property
    def tiles(self) -> TileMap:
        """The level as the rules see it: tile ids by grid index."""
        return tile_map(self.level)

    # --- time ---

    def reset(self) -> None:
        """Go back to tick 0 of the level."""
        self._inputs.clear()
        self._kills.clear()
        self._worlds.load([0], [0])

    def step(self, *, left: bool = False, right: bool = False, jump: bool = False) -> None:
        """Advance one tick with these keys down. The jump triggers in the first sampled tick in which it is down."""
        down = (KEY_LEFT if left else 0) + (KEY_RIGHT if right else 0) + (JUMP_HELD if jump else 0)
        self.step_keys(with_press_bit(down, self._worlds.jump_held()) if jump else down)

    def step_keys(self, keys: int) -> None:
        """Advance one tick with these keys, a sum of ``Input`` flags. Raises ArgumentError for anything else."""
        if not 0 <= keys <= ALL_KEYS:
            raise ArgumentError(f"keys are {keys!r}; expected a sum of Input flags, 0 to {ALL_KEYS}")
        self._worlds.step(keys)
        self._inputs.append(keys)

    def kill(self, cause: int, dx: float, dy: float) -> None:
        """Kill the ninja where it is, as the game does when its time is over or the player ends the try.

        ``cause``: one of those in sim/states.py; (dx, dy): its corpse's impulse, px/tick. It is part of no recording.
        Raises ArgumentError for another cause.
        """
        if not 0 <= cause < len(CAUSE_NAMES):
            raise ArgumentError(f"cause is {cause!r}; expected 0 to {len(CAUSE_NAMES) - 1}, as in sim/states.py")
        self._worlds.kill(cause, dx, dy)
        self._kills.append((self.tick, cause, dx, dy))

    # --- looking ---

    @property
    def tick(self) -> int:
        """Ticks run so far."""
        return self._worlds.number("tick")

    @property
    def outcome(self) -> str:
        """The result: "exit" or "dead", whichever came first; "running" before that."""
        return OUTCOME_NAMES[self._worlds.number("outcome")]

    @property
    def gold(self) -> int:
        """Pieces of gold collected."""
        return self._worlds.number("gold")

    @property
    def ninja(self) -> NinjaView:
        """The ninja after the last tick."""
        n = self._worlds.ninja()
        return NinjaView(n.x, n.y, n.prev_x, n.prev_y, STATE_NAMES[n.state], bool(n.in_air), bool(n.near_wall))

    @property
    def objects(self) -> list[ObjectView]:
        """All objects but ninjas and inert ones, in id order."""
        return [seen for seen in map(self._seen, range(self._worlds.number("id_count"))) if seen]

    def object(self, id_: int) -> ObjectView:
        """One object by its id. Raises ArgumentError for an id that no object has, of a ninja or an inert object."""
        seen = self._seen(id_) if 0 <= id_ < self._worlds.number("id_count") else None
        if seen is None:
            raise ArgumentError(f"there is no object {id_!r}; ids are those of the list 'objects'")
        return seen

    def _seen(self, id_: int) -> ObjectView | None:
        """The object of an id; None for a ninja or an inert object."""
        kind, x, y, status = self._worlds.observe(id_ + 1)
        return ObjectView(id_, KIND_OF[kind].name, x, y, status) if KIND_OF[kind].traced else None

    @property
    def events(self) -> list[EventView]:
        """The events of the last tick, in order."""
        return [_event_view(event) for event in self._worlds.events()]

    # --- save-states and digests ---

    def save(self) -> SaveState:
        """A save-state of this tick, for ``restore``; later steps do not change it."""
        return SaveState(
            self.level, self.body, self.memory, bytes(self._inputs), self._worlds.save(), tuple(self._kills)
        )

    def restore(self, state: SaveState) -> None:
        """Go back to a saved moment. Raises ArgumentError for a state of another level, body or memory."""
        if (state.level, state.body, state.memory) != (self.level, self.body, self.memory):
            raise ArgumentError("this save-state is of another level, body or memory")
        self._inputs = bytearray(state.inputs)
        self._kills = list(state.kills)
        self._worlds.restore(state.data)

    def digest(self) -> str:
        """Sha256 (hex) of the whole state in canonical form: the same for both memories, not for other versions."""
        return world_digest(self.world)

    def replay_digest(self) -> str:
        """Sha256 (hex) of what the world shows, as replays state it (docs/replay-format.md)."""
        return replay_digest(self.world)

    @property
    def inputs(self) -> bytes:
        """The inputs that led here, one byte per tick."""
        return bytes(self._inputs)

    def first_difference(self, other: Simulation) -> tuple[str, Any, Any] | None:
        """The first field in which two runs' states differ: (name, value here, value there); None if they are equal."""
        return next(differences(self.world, other.world), None)


def _event_view(e: Event) -> EventView:
    """The public view of an event of the schema."""
    cause = CAUSE_NAMES[e.cause] if e.cause != NO_CAUSE else ""
    return EventView(EVENT_NAMES[e.kind], e.x, e.y, e.dx, e.dy, e.slot - 1 if e.slot else None, cause)

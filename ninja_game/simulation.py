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

from dataclasses import dataclass
from typing import Any, Literal

from ninja_game.compile_cache import choose_memory, kernels
from ninja_game.sim.digest import differences, replay_digest, world_digest
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, pressed
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import Level
from ninja_game.sim.memory.plain import load_plain, restore_plain, save_plain
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.states import OUTCOME_NAMES, STATE_NAMES
from ninja_game.sim.traces import is_traced, place_of, status_of
from ninja_game.sim.world import step

Body = Literal["circle", "box"]
BODIES: tuple[Body, ...] = ("circle", "box")


@dataclass(frozen=True)
class NinjaView:
    """The ninja after a tick: place and previous place (px), velocity (px/tick), state by name."""

    x: float
    y: float
    px: float
    py: float
    state: str
    in_air: bool
    near_wall: bool

    @property
    def vx(self) -> float:
        """Horizontal velocity, px/tick."""
        return self.x - self.px

    @property
    def vy(self) -> float:
        """Vertical velocity, px/tick, positive downwards."""
        return self.y - self.py


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
    """Something that happened in the last tick: name, place (px), a vector that depends on the event."""

    name: str
    x: float
    y: float
    dx: float
    dy: float
    object_id: int | None


class SaveState:
    """A moment of a run, from ``Simulation.save``: only good for runs of the same level, body and memory."""

    __slots__ = ("data", "inputs", "owner")

    def __init__(self, owner: tuple[Any, ...], data: Any, inputs: bytes) -> None:
        self.owner = owner
        self.data = data
        self.inputs = inputs


class Simulation:
    """A world in which a level is played, one tick (1/40 s) at a time.

    ``level``: what to play. ``body``: "circle" (the classic rules, radius 10 px) or "box" (an AABB of 20 x 20 px).
    ``memory``: "plain" (starts at once, can be looked into), "compiled" (Numba; fast for many ticks) or "auto". The two
    give the same bits. Raises LevelError for a level without a ninja or with too many objects.
    """

    def __init__(self, level: Level, *, body: Body = "circle", memory: str = "plain") -> None:
        if body not in BODIES:
            raise ValueError(f"body is {body!r}; expected 'circle' or 'box'")
        self.level = level
        self.body = body
        self.memory = choose_memory(memory)
        self._level: TileMap
        self._world: World
        self.reset()

    def reset(self) -> None:
        """Start afresh from the loaded level, as at first."""
        self._inputs = bytearray()
        if self.memory == "plain":
            self._level, self._world = load_plain(self.level, self.body == "box")
            return
        from ninja_game.sim.memory.compiled import load_compiled
        from ninja_game.sim.memory.layout import state_view

        self._kernels = kernels()
        self._levels, self._worlds = load_compiled(self._kernels, self.level, self.body == "box")
        self._state = state_view(self._worlds, 0)

    @property
    def world(self) -> World:
        """The whole state as plain objects; of the plain memory the world itself, of the compiled one a copy."""
        if self.memory == "plain":
            return self._world
        from ninja_game.sim.memory.layout import plain_copy

        return plain_copy(self._worlds, 0)

    @property
    def static(self) -> TileMap:
        """The level as the rules see it: tile ids by grid index. Plain memory only."""
        return self._level

    # --- time ---

    def step(self, *, left: bool = False, right: bool = False, jump: bool = False) -> None:
        """Advance one tick with these keys down. The jump triggers in the first sampled tick in which it is down."""
        held = self._world.ninja.jump_held if self.memory == "plain" else self._worlds["ninja"]["jump_held"][0]
        self.step_keys(pressed(left * KEY_LEFT + right * KEY_RIGHT + jump * JUMP_HELD, held))

    def step_keys(self, keys: int) -> None:
        """Advance one tick with these keys, a sum of ``Input`` flags."""
        self._inputs.append(keys)
        if self.memory == "plain":
            step(self._level, self._world, keys)
        else:
            self._kernels["step_world"](self._levels, self._worlds, 0, keys)

    # --- looking ---

    @property
    def tick(self) -> int:
        """Ticks run so far."""
        return self._world.tick if self.memory == "plain" else int(self._worlds["tick"][0])

    @property
    def outcome(self) -> str:
        """What came first: "exit" or "dead"; "running" while neither has."""
        number = self._world.outcome if self.memory == "plain" else int(self._worlds["outcome"][0])
        return OUTCOME_NAMES[number]

    @property
    def gold(self) -> int:
        """Pieces of gold collected."""
        return self._world.gold if self.memory == "plain" else int(self._worlds["gold"][0])

    @property
    def ninja(self) -> NinjaView:
        """The ninja."""
        n = self.world.ninja
        return NinjaView(n.x, n.y, n.prev_x, n.prev_y, STATE_NAMES[n.state], bool(n.in_air), bool(n.near_wall))

    @property
    def objects(self) -> list[ObjectView]:
        """All objects but ninjas and inert ones, in id order."""
        w = self.world
        return [
            ObjectView(w.objects[slot].id, KIND_NAMES[w.objects[slot].kind], *place_of(w, slot), status_of(w, slot))
            for slot in range(1, w.id_count + 1)
            if is_traced(w, slot)
        ]

    @property
    def events(self) -> list[EventView]:
        """What happened in the last tick, in order."""
        w = self.world
        return [
            EventView(EVENT_NAMES[e.kind], e.x, e.y, e.dx, e.dy, e.slot - 1 if 0 < e.slot <= w.id_count else None)
            for e in w.events[: w.event_count]
        ]

    # --- save-states and digests ---

    def save(self) -> SaveState:
        """This moment, to come back to. The state is never changed by later steps."""
        data = save_plain(self._world) if self.memory == "plain" else self._state.copy()
        return SaveState(self._owner(), data, bytes(self._inputs))

    def restore(self, state: SaveState) -> None:
        """Go back to a saved moment. Raises ValueError for a state of another level, body or memory."""
        if state.owner != self._owner():
            raise ValueError("this save-state is of another level, body or memory")
        self._inputs = bytearray(state.inputs)
        if self.memory == "plain":
            restore_plain(self._world, state.data)
        else:
            self._state[:] = state.data
            self._worlds["event_count"][0] = 0

    def _owner(self) -> tuple[Any, ...]:
        return id(self.level), self.body, self.memory

    def digest(self) -> str:
        """Sha256 (hex) of the whole state in canonical form: the same for both memories, not for other versions."""
        return world_digest(self.world)

    def replay_digest(self) -> str:
        """Sha256 (hex) of what the world shows, as replays state it (docs/replay-format.md)."""
        return replay_digest(self.world)

    @property
    def inputs(self) -> bytes:
        """The inputs that led here, one byte a tick."""
        return bytes(self._inputs)

    def first_difference(self, other: Simulation) -> tuple[str, Any, Any] | None:
        """The first field in which two runs' states differ: (name, value here, value there); None if they are equal."""
        return next(differences(self.world, other.world), None)

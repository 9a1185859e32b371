"""What the plain and the compiled memory have in common: one world in one level."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, Protocol

from ninja_game.sim.memory.schema import TileMap, World

MemoryName = Literal["plain", "compiled"]
Body = Literal["circle", "box"]

BODIES: tuple[Body, ...] = ("circle", "box")
"""The shapes that the ninja can have: the circle of the classic rules, and a box of the same size."""


class RunRecord(NamedTuple):
    """The ninja after each tick of a run: ``places`` x, y in turn (float64, px), ``states`` (uint8); flat buffers."""

    places: Any
    states: Any


TRACED_PLACES = ("x", "y", "prev_x", "prev_y", "wall_x", "floor_x", "floor_y")
TRACED_NUMBERS = ("state", "gold", "jump_timer", "in_air", "near_wall", "floor_contacts", "outcome")
"""What a trace records of the ninja and the run: the schema's fields, seven of each sort."""


class TraceRecord(NamedTuple):
    """What a trace recorded, in flat buffers as ``trace_world`` has them.

    ``ninja``, ``places``: float64; ``numbers``, ``statuses``: int32; ``switched``, ``events``: uint8.
    """

    ninja: Any
    numbers: Any
    places: Any
    statuses: Any
    switched: Any
    events: Any


class Memory(Protocol):
    """One world in one level: loaded, run, saved and looked at, at the same cost whatever the level's size.

    ``name``: "plain" or "compiled". ``tiles``: the level as the rules see it.
    """

    name: MemoryName
    tiles: TileMap

    @property
    def tick(self) -> int:
        """Ticks run."""

    @property
    def outcome(self) -> int:
        """The outcome, by number (sim/states.py)."""

    @property
    def gold(self) -> int:
        """Pieces of gold collected."""

    @property
    def jump_held(self) -> int:
        """Whether the jump key was down in the last sampled tick."""

    @property
    def id_count(self) -> int:
        """How many objects have an id."""

    def load(self) -> None:
        """Start afresh from the level."""

    def step(self, keys: int) -> None:
        """One tick. ``keys``: a sum of ``Input`` flags, not checked."""

    def kill(self, cause: int, dx: float, dy: float) -> None:
        """Kill the ninja where it is; (dx, dy) is its corpse's impulse, px/tick."""

    def run(self, inputs: bytes) -> RunRecord:
        """Run until the tick of the first exit contact or death, or to the end of ``inputs``."""

    def trace(self, inputs: bytes, slots: Sequence[int], *, events: bool) -> TraceRecord:
        """Run all of ``inputs`` and record the ninja, the objects in ``slots`` and, if asked for, the events."""

    def save(self) -> Any:
        """The state, unchanged by what happens later; without the events of the last tick."""

    def restore(self, state: Any) -> None:
        """Go back to a state that ``save`` gave in the same level; nothing has happened in its last tick."""

    def ninja(self) -> Any:
        """The ninja, with the fields of the schema; to be read at once, it may change with the next tick."""

    def events(self) -> Sequence[Any]:
        """The events of the last tick, with the fields of the schema; to be read at once."""

    def observe(self, slot: int) -> tuple[int, float, float, int]:
        """Kind, x, y (px) and status of the object in a slot."""

    def world(self) -> World:
        """The whole state as plain objects: of the plain memory the world itself, of the compiled one a copy."""

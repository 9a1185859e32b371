"""The common interface of the plain and the compiled memory: worlds in levels, one or thousands."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, NamedTuple, TypeAlias, TypeVar

from ninja_game.sim.level import Level
from ninja_game.sim.schema.world_fields import World

R = TypeVar("R")
Kernel: TypeAlias = Callable[..., R]  # a kernel, or its compiled twin

MemoryName = Literal["plain", "compiled"]


class RunPath(NamedTuple):
    """The ninja after each tick of a run: ``places`` x, y in turn (float64, px), ``states`` (uint8); flat buffers."""

    places: Any
    states: Any


TRACED_FLOATS = ("x", "y", "prev_x", "prev_y", "wall_x", "floor_x", "floor_y")
TRACED_INTS = ("state", "gold", "jump_timer", "in_air", "near_wall", "floor_contacts", "outcome")
"""The fields of the ninja and the run that a trace records, seven floats and seven ints.

``trace_world`` writes them in this order.
"""


class TraceArrays(NamedTuple):
    """The recording of a trace, in flat buffers as ``trace_world`` fills them.

    ``ninja``, ``places``: float64; ``numbers``, ``statuses``: int32; ``switched``, ``events``: uint8.
    """

    ninja: Any
    numbers: Any
    places: Any
    statuses: Any
    switched: Any
    events: Any


class InitialObject(NamedTuple):
    """An object of a new world; ``partner``: the slot of an exit's switch."""

    slot: int
    kind: int
    x: float
    y: float
    partner: int


class InitialLevel(NamedTuple):
    """The first state of a level: its grid of tiles; its objects by slot (slot 0 is unused); the ninja's place, px."""

    tiles: Sequence[int]
    objects: Sequence[InitialObject]
    start: tuple[float, float]


class Worlds(ABC):
    """``count`` worlds in some levels; at first world i is in level i modulo the number of levels.

    Methods of a single world take its ``index``, those of several worlds ``indices``, an array or list. ``name``:
    "plain" or "compiled". ``level_of`` (count,): the level of each world, as a buffer to be read. ``maps``, ``worlds``,
    ``fresh``: the levels, the worlds, and a new world per level, which must never change, as kernels take them: arrays
    of records, or lists of plain objects.

    Copies and pickles are independent worlds: equal, with their events, and going on alike.
    """

    name: MemoryName
    levels: Sequence[Level]
    count: int
    box: bool  #: whether the ninjas are boxes
    slots: int  #: for objects in each world: what the level with the most objects needs
    level_of: Any
    maps: Any
    worlds: Any
    fresh: Any
    #: The worlds as NumPy records (count,), in one block; of the plain memory as after the last ``run_batch``, ``load``
    #: or ``restore_many``, without events
    records: Any
    states: Any  #: the records as a matrix of bytes, one row per world, without events

    @abstractmethod
    def kernel(self, entry: Kernel[R]) -> Kernel[R]:
        """The form of a kernel that takes maps and worlds: its compiled twin, or itself."""

    # --- one world ---

    @abstractmethod
    def number(self, field: str, index: int = 0) -> int:
        """A number of a world by its name in the schema: tick, outcome, gold or id_count."""

    def tick(self, index: int = 0) -> int:
        """Ticks run."""
        return self.number("tick", index)

    def outcome(self, index: int = 0) -> int:
        """The outcome, by number (sim/states.py)."""
        return self.number("outcome", index)

    def gold(self, index: int = 0) -> int:
        """Pieces of gold collected."""
        return self.number("gold", index)

    @abstractmethod
    def jump_held(self, index: int = 0) -> int:
        """Whether the jump key was down in the last tick that read the keys."""

    @abstractmethod
    def step(self, keys: int, index: int = 0) -> None:
        """Run one tick. ``keys``: a sum of ``Input`` flags, not checked."""

    @abstractmethod
    def kill(self, cause: int, dx: float, dy: float, index: int = 0) -> None:
        """Kill the ninja where it is; (dx, dy) is its corpse's impulse, px/tick."""

    @abstractmethod
    def run(self, inputs: bytes, index: int = 0) -> RunPath:
        """Run to the tick of the first exit contact or death, or to the end of ``inputs``."""

    @abstractmethod
    def trace(self, inputs: bytes, slots: Sequence[int], *, events: bool, index: int = 0) -> TraceArrays:
        """Run all of ``inputs`` and record the ninja, the objects in ``slots`` and, on request, the events."""

    @abstractmethod
    def save(self, index: int = 0) -> Any:
        """Save the state, without the events of the last tick; later ticks do not change it."""

    @abstractmethod
    def restore(self, state: Any, index: int = 0) -> None:
        """Restore a state that ``save`` gave in the same level; afterwards there are no events."""

    @abstractmethod
    def ninja(self, index: int = 0) -> Any:
        """The ninja, with the fields of the schema. Read it at once: the next tick may change it."""

    @abstractmethod
    def events(self, index: int = 0) -> Sequence[Any]:
        """The events of the last tick, with the fields of the schema. Read them at once."""

    @abstractmethod
    def objects(self, index: int = 0) -> Sequence[Any]:
        """The objects by slot, with the fields of the schema. Read them at once."""

    @abstractmethod
    def observe(self, slot: int, index: int = 0) -> tuple[int, float, float, int]:
        """Kind, x, y (px) and status of the object in a slot, as traces show them."""

    @abstractmethod
    def world(self, index: int = 0) -> World:
        """The whole state as plain objects: in the plain memory the world itself, in the compiled one a copy."""

    # --- several worlds ---

    @abstractmethod
    def load(self, indices: Any, levels: Any) -> None:
        """Start worlds afresh, in the levels of these numbers."""

    @abstractmethod
    def initial_levels(self, numbers: Iterable[int]) -> list[InitialLevel]:
        """Levels by their numbers."""

    @abstractmethod
    def put_levels(self, numbers: Any, levels: Sequence[Level]) -> None:
        """Replace the levels with these numbers (an array), and start the worlds of the same numbers in the new levels.

        A level must not have more objects than the levels with which the worlds were opened.
        """

    @abstractmethod
    def save_many(self, indices: Any) -> Any:
        """Save the states of worlds, without events; later ticks do not change them."""

    @abstractmethod
    def restore_many(self, states: Any, indices: Any, levels: Any) -> None:
        """Restore states that ``save_many`` gave for as many worlds, in the levels that these had."""

    @abstractmethod
    def run_batch(self, inputs: Any, first: int, last: int, *, stop: bool) -> int:
        """Run worlds ``first`` … ``last`` - 1 for all rows of ``inputs`` (ticks, count), as ``run_worlds``."""

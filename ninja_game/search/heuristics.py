"""Distance to a place, in ticks, from anywhere in a level: a shortest-path field over points 6 px apart.

The field knows walls, mines, doors and the sides of one-way platforms, but no gravity and no jumps. It guides a search;
it is mostly too optimistic and no bound.
"""

from __future__ import annotations

from math import hypot
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.layout import WorldArray
from ninja_game.backend.memories import compiled_if_possible
from ninja_game.sim import kinds
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.rules import CELL, EXIT_RADIUS, RADIUS, STRIDE
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import AUTOMATIC, LOCKED
from ninja_game.sim.traces import is_open

_SPACING = 6.0  # px between points
_PER_CELL = round(CELL / _SPACING)
"""Points along a cell side. All sides lie on points: a door is closed if those on it are blocked."""
ACROSS = 133
_DOWN = 101
POINTS = ACROSS * _DOWN

CLEARANCE = 9.0
"""Px; a point is free if this circle around it is. A little less than the ninja's radius, since the ninja slides."""

UNREACHED = 1.0e9  # ticks to go without a known way
MINE_COST = 12.0  # factor of a step beside a mine: to be avoided, not impossible

RING_X = [1.0, 0.866, 0.5, 0.0, -0.5, -0.866, -1.0, -0.866, -0.5, 0.0, 0.5, 0.866]
RING_Y = [0.0, 0.5, 0.866, 1.0, 0.866, 0.5, 0.0, -0.5, -0.866, -1.0, -0.866, -0.5]

# Moves to the eight neighbours and their costs (ticks): running and falling are faster than climbing.
MOVE_X = [1, 1, 0, -1, -1, -1, 0, 1]
MOVE_Y = [0, 1, 1, 1, 0, -1, -1, -1]
MOVE_TICKS = [1.45, 1.85, 1.2, 1.85, 1.45, 2.3, 1.9, 2.3]

DistanceField = NDArray[np.float32]
Costs = NDArray[np.float32]
Blocks = NDArray[np.uint8]


@kernel
def free_points(maps: Any, costs: Costs) -> None:
    """Set the cost factor of every point: 1 if the ninja fits among the tiles, 0 if not."""
    tiles = maps[0]
    for point in range(POINTS):
        x = _SPACING * (point % ACROSS)
        y = _SPACING * (point // ACROSS)
        free = not solid_at(tiles, x, y)
        if free:
            for k in range(12):
                if solid_at(tiles, x + CLEARANCE * RING_X[k], y + CLEARANCE * RING_Y[k]):
                    free = False
                    break
        costs[point] = 1.0 if free else 0.0


@kernel
def lower_field(costs: Costs, blocked: Blocks, field: DistanceField, queue: NDArray[np.int32], waiting: Blocks) -> None:
    """Lower ``field`` (ticks, UNREACHED: unknown) to the shortest way to the points that are already set.

    ``costs``: factor of a step onto a point, 0: impassable. ``blocked``: bit k of a point forbids its move k.
    ``queue``: room for POINTS + 1 indices.
    """
    capacity = POINTS + 1
    head = 0
    tail = 0
    for point in range(POINTS):
        waiting[point] = 0
        if field[point] < UNREACHED:
            queue[tail] = point
            tail += 1
            waiting[point] = 1
    while head != tail:
        point = queue[head]
        head = (head + 1) % capacity
        waiting[point] = 0
        column = point % ACROSS
        row = point // ACROSS
        for k in range(8):
            # The field spreads against the move: from its end to its start.
            i = column - MOVE_X[k]
            j = row - MOVE_Y[k]
            if not (0 <= i < ACROSS and 0 <= j < _DOWN):
                continue
            start = j * ACROSS + i
            if costs[start] == 0.0 or (blocked[start] >> k) & 1:
                continue
            value = np.float32(float(field[point]) + MOVE_TICKS[k] * float(costs[start]))
            if value < field[start] - np.float32(1e-3):
                field[start] = value
                if not waiting[start]:
                    waiting[start] = 1
                    queue[tail] = start
                    tail = (tail + 1) % capacity


@fast
def point_at(x: float, y: float) -> int:
    """Index of the point nearest to a place; a place outside the world counts as at its border."""
    i = int((x + _SPACING / 2) / _SPACING) if x > 0.0 else 0
    j = int((y + _SPACING / 2) / _SPACING) if y > 0.0 else 0
    i = min(i, ACROSS - 1)
    j = min(j, _DOWN - 1)
    return j * ACROSS + i


def points_at(places: NDArray[np.float64]) -> NDArray[np.int64]:
    """``point_at`` of many places, (count, 2), px; NaN is 0."""
    limits = np.array([[ACROSS - 1], [_DOWN - 1]])
    i, j = (np.nan_to_num(places).T / _SPACING + 0.5).clip(0, limits).astype(np.int64)
    points: NDArray[np.int64] = j * ACROSS + i
    return points


def widen(field: DistanceField) -> DistanceField:
    """Add values for impassable points at most three beside passable ones: the ninja may rest between points."""
    grid = field.reshape(_DOWN, ACROSS)
    for _ in range(3):
        padded = np.pad(grid, 1, constant_values=UNREACHED)
        around = [padded[1 + dy : 1 + dy + _DOWN, 1 + dx : 1 + dx + ACROSS] for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        nearest = np.minimum.reduce(around) + np.float32(2.0)
        grid = np.where(grid >= UNREACHED, np.minimum(nearest, UNREACHED), grid)
    return grid.reshape(-1)


def points_about(x: float, y: float, radius: float) -> list[int]:
    """List the points within ``radius`` px of a place."""
    reach = int(radius / _SPACING) + 1
    steps = range(-reach, reach + 1)
    around = {point_at(x + i * _SPACING, y + j * _SPACING) for i in steps for j in steps}
    far = {point: hypot(_SPACING * (point % ACROSS) - x, _SPACING * (point // ACROSS) - y) for point in around}
    return sorted(point for point in around if far[point] < radius)


DOOR_COST = 40.0  # factor of a step through a closed door, in fields that pretend it can be passed
MAX_BITS = 60  # most switches, of exits and doors, whose states a search distinguishes
FARTHEST = 20_000.0  # ticks that an unreachable place counts in sums
SWITCH_COST = 3.0  # factor of a step beside a switch that is better touched later
_MOST_AFTER_SWITCH = 5000.0  # most ticks that the way on from a switch counts at it
_EXIT_SWITCH_TICKS = 30.0  # ticks that an exit's switch costs, besides the ways
_NEAR = 15.0  # px from an object within which a point counts as touching it

FieldSource = tuple[float, float, float]  # start of a field: place (px) and value there (ticks)


class Switchable(NamedTuple):
    """An exit (``door`` is False) or a locked or trap door, with its switch and the points that it blocks."""

    slot: int
    x: float  #: px, as all places
    y: float
    switch_x: float
    switch_y: float
    bars: tuple[int, ...] = ()  #: indices of the blocked points
    door: bool = False
    trap: bool = False  #: whether it is a trap door


class Heuristics:
    """Distance fields of one level, by switch state.

    ``maps``: the level as kernels take it; ``worlds``: a new world in it, as a record.
    """

    def __init__(self, maps: Any, worlds: WorldArray) -> None:
        used = int(worlds["slots_used"][0])
        objects = worlds["objects"][0][:used]
        self.costs = np.zeros(POINTS, np.float32)
        compiled_if_possible(free_points)(maps, self.costs)
        self.blocked = np.zeros(POINTS, np.uint8)
        self._queue = np.zeros(POINTS + 1, np.int32)
        self._waiting = np.zeros(POINTS, np.uint8)
        exits, doors, gold = [], [], []
        for slot in range(1, used):
            record = objects[slot]
            kind = int(record["kind"])
            x, y = float(record["x"]), float(record["y"])
            if kind == kinds.EXIT:
                switch = objects[int(record["partner"])]
                exits.append(Switchable(slot, x, y, float(switch["x"]), float(switch["y"])))
            elif kind == kinds.DOOR and int(record["mechanism"]) != AUTOMATIC:
                trap = int(record["mechanism"]) != LOCKED
                doors.append(Switchable(slot, x, y, x, y, _bars(int(record["edge_1"])), door=True, trap=trap))
            elif kind == kinds.GOLD:
                gold.append((slot, x, y))
            elif kind == kinds.MINE:
                self.costs[points_about(x, y, _NEAR)] *= np.float32(MINE_COST)
            elif kind == kinds.ONE_WAY:
                self._bar_one_way(x, y, float(record["face_x"]), float(record["face_y"]))
        self.exits = exits
        self.switches = (exits + doors)[:MAX_BITS]
        self.switch_ids = [int(objects[switch.slot]["id"]) for switch in self.switches]
        self.slots = np.array([switch.slot for switch in self.switches], np.int64)
        self.enemies = np.flatnonzero(np.isin(objects["kind"], kinds.MOVING_ENEMIES))
        self.gold_slots = np.array([slot for slot, _, _ in gold], np.int64)
        self.gold_ids = [int(objects[slot]["id"]) for slot, _, _ in gold]
        self.gold_places = [(x, y) for _, x, y in gold]

    def taken(self, world: Any) -> int:
        """The collected pieces of gold, one bit per piece."""
        bits = world["objects"]["taken"][self.gold_slots] != 0
        return sum(1 << k for k in np.flatnonzero(bits).tolist())

    def opened(self, worlds: WorldArray, index: int) -> int:
        """The switch state of world ``index``."""
        return int(open_masks(worlds["objects"][index : index + 1], self.slots)[0])

    def tour_fields(self, switch_state: int) -> DistanceField:
        """Ticks to each piece of gold and, in the last row, to the exit by way of its switch: (pieces + 1, points).

        Closed locked doors can be passed at a high cost.
        """
        costly = self._closed(switch_state, DOOR_COST / 4)
        careful = self._careful(costly.copy(), switch_state)
        fields = [self._field(careful, [(*place, 0.0)]) for place in self.gold_places]
        fields.append(self._field(costly, self._exit_sources(switch_state, costly)))
        return np.array([widen(field) for field in fields], np.float32)

    def field_to(self, place: tuple[float, float], switch_state: int, x: float, y: float) -> DistanceField:
        """Ticks from every point to a place, by way of the switches that a ninja at (x, y) must touch first."""
        costs = self._careful(self._closed(switch_state, 0.0), switch_state)
        costly = self._careful(self._closed(switch_state, DOOR_COST), switch_state)
        return self._toward([(*place, 0.0)], costs, costly, switch_state, point_at(x, y))

    def field(self, switch_state: int, x: float, y: float) -> DistanceField:
        """Ticks from every point to the exit, by way of the switches that a ninja at (x, y) must touch first."""
        costs = self._closed(switch_state, 0.0)
        costly = self._closed(switch_state, DOOR_COST)
        return self._toward(self._exit_sources(switch_state, costly), costs, costly, switch_state, point_at(x, y))

    def may_leave(self, switch_state: int, x: float, y: float) -> bool:
        """Whether a ninja at (x, y) can reach an open exit without opening a door, as far as the fields know."""
        places = [(e.x, e.y, 0.0) for bit, e in enumerate(self.exits) if bit < MAX_BITS and switch_state >> bit & 1]
        field = widen(self._field(self._closed(switch_state, 0.0), places))
        return bool(field[point_at(x, y)] < UNREACHED)

    def _exit_sources(self, switch_state: int, costly: Costs) -> list[FieldSource]:
        """The open exits, and the switches of the others with the distance from there on as their value."""
        sources = []
        for bit, exit_ in enumerate(self.exits):
            if bit < MAX_BITS and switch_state >> bit & 1:
                sources.append((exit_.x, exit_.y, 0.0))
            else:
                home = widen(self._field(costly, [(exit_.x, exit_.y, 0.0)]))
                rest = min(float(home[point_at(exit_.switch_x, exit_.switch_y)]), _MOST_AFTER_SWITCH)
                sources.append((exit_.switch_x, exit_.switch_y, rest + _EXIT_SWITCH_TICKS))
        return sources

    def _toward(
        self, sources: list[FieldSource], costs: Costs, costly: Costs, switch_state: int, here: int
    ) -> DistanceField:
        """Make the field of some places, by way of the switches of the locked doors between them and a point."""
        visited: set[int] = set()
        while True:
            field = widen(self._field(costs, sources))
            if field[here] < UNREACHED:
                return field
            imagined = widen(self._field(costly, sources))
            door = self._first_door(imagined, here, switch_state)
            if door is None or door.slot in visited:
                return imagined
            visited.add(door.slot)
            # First to the switch; the value there is that of the imagined way, which falls a lot once the door is open.
            rest = min(float(imagined[point_at(door.switch_x, door.switch_y)]), _MOST_AFTER_SWITCH)
            sources = [(door.switch_x, door.switch_y, rest)]

    def _field(self, costs: Costs, sources: list[FieldSource]) -> DistanceField:
        field = np.full(POINTS, UNREACHED, np.float32)
        for x, y, value in sources:
            # The ninja touches an object from up to 16 px away: any free point around it is enough.
            near = points_about(x, y, _NEAR)
            free = [point for point in near if costs[point] > 0.0]
            free = free or [point for point in points_about(x, y, EXIT_RADIUS + RADIUS) if costs[point] > 0.0] or near
            field[free] = np.minimum(field[free], np.float32(value))
        compiled_if_possible(lower_field)(costs, self.blocked, field, self._queue, self._waiting)
        return field

    def _closed(self, switch_state: int, door_cost: float) -> Costs:
        """The cost factors with the doors as they are in a switch state."""
        costs = self.costs.copy()
        for bit, switch in enumerate(self.switches):
            if switch.door and switch.trap == bool(switch_state >> bit & 1):
                bars = [point for point in switch.bars if costs[point] > 0.0]
                costs[bars] = np.float32(0.0 if switch.trap else door_cost)
        return costs

    def _careful(self, costs: Costs, switch_state: int) -> Costs:
        """The cost factors while gold is fetched: avoid open exits, and switches of exits and trap doors."""
        for bit, switch in enumerate(self.switches):
            done = bool(switch_state >> bit & 1)
            if not switch.door and done:
                costs[points_about(switch.x, switch.y, 26.0)] *= np.float32(MINE_COST)
            elif not done and (switch.trap or not switch.door):
                costs[points_about(switch.switch_x, switch.switch_y, 18.0)] *= np.float32(SWITCH_COST)
        return costs

    def _first_door(self, field: DistanceField, here: int, switch_state: int) -> Switchable | None:
        """The first closed locked door on the way down a field."""
        closed = {
            point: switch
            for bit, switch in enumerate(self.switches)
            if switch.door and not switch.trap and not switch_state >> bit & 1
            for point in switch.bars
        }
        for _ in range(POINTS):
            if here in closed:
                return closed[here]
            steps = [here + MOVE_Y[k] * ACROSS + MOVE_X[k] for k in range(8)]
            there = min((step for step in steps if 0 <= step < POINTS), key=lambda step: float(field[step]))
            if field[there] >= field[here]:
                return None
            here = there
        return None

    def _bar_one_way(self, x: float, y: float, face_x: float, face_y: float) -> None:
        """Forbid the moves through a one-way platform's face; the ninja's centre meets it 22 px from its middle."""
        for point in points_about(x, y, 40.0):
            px, py = _SPACING * (point % ACROSS), _SPACING * (point // ACROSS)
            along = abs(px - x) if face_x == 0.0 else abs(py - y)
            depth = (px - x) * face_x + (py - y) * face_y
            if along > 14.0 or not 22.0 <= depth < 22.0 + _SPACING:
                continue
            for k in range(8):
                if MOVE_X[k] * face_x + MOVE_Y[k] * face_y < 0.0:
                    self.blocked[point] |= np.uint8(1 << k)


def _bars(edge: int) -> tuple[int, ...]:
    """The points on the cell side of an edge index (right or down side of its cell)."""
    cell, side = divmod(edge, 4)
    if cell == 0:
        return ()
    left, top = (cell % STRIDE - 1) * _PER_CELL, (cell // STRIDE - 1) * _PER_CELL
    if side == 0:
        return tuple((top + k) * ACROSS + left + _PER_CELL for k in range(_PER_CELL + 1))
    return tuple((top + _PER_CELL) * ACROSS + left + k for k in range(_PER_CELL + 1))


@fast
def open_bits(w: World, slots: Any, first: int, last: int) -> int:
    """The switch state of a world: bit k is 1 if the exit or door ``slots[first + k]`` is not in its first state."""
    mask = 0
    for k in range(first, last):
        if is_open(w, int(slots[k])):
            mask |= 1 << (k - first)
    return mask


@fast
def open_mask(w: World, slots: Any) -> int:
    """The switch state, with a bit for each of ``slots``."""
    return open_bits(w, slots, 0, len(slots))


def open_masks(objects: Any, slots: Any) -> NDArray[np.int64]:
    """The switch states of many worlds, by their objects: records (worlds, slots)."""
    kind, opened, switched = (objects[name][:, slots] for name in ("kind", "is_open", "switched"))
    masks: NDArray[np.int64] = (np.where(kind == EXIT, opened, switched) != 0) @ (1 << np.arange(len(slots)))
    return masks

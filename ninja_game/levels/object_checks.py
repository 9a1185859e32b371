"""What is legal but odd about a single object, kind by kind: each oddity is one sentence for the level's maker."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import isnan, sqrt

from ninja_game.formats.ascii.places import place_text
from ninja_game.levels.reach import Ground, edges_of
from ninja_game.sim import kinds
from ninja_game.sim.arithmetic import is_set
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.collision.tiles import COLUMN, FULL, ROW, SHAPE
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import VALUE_COUNTS
from ninja_game.sim.level import COLUMNS, ROWS, ObjectSpec, well_formed
from ninja_game.sim.rules import DOOR_SWITCH_RADIUS, EXIT_RADIUS, GOLD_RADIUS, OFF, SOLID, SWITCH_RADIUS

_DIRECTIONS = (0, 1, 2, 3)
_SAMPLES = (-1.0, -0.5, 0.0, 0.5, 1.0)
"""Where a piece of gold is looked at, across and down, as parts of its radius."""
_HIDDEN = 2 / 3
"""The share of gold in the rock from which on nobody sees it: tiles are drawn over it."""
_UNIT_TOLERANCE = 0.02  # pads of other editors have 0.7 for both parts of a diagonal


def oddities(record: ObjectSpec, ground: Ground) -> Iterator[str]:
    """What is odd about an object of the level that ``ground`` describes; nothing for a proper one."""
    if not well_formed(record):
        count, needed = len(record.values), VALUE_COUNTS[record.kind]
        does = "starts at 45,70px" if record.kind == kinds.NINJA else "does nothing"
        yield f"it has {count} values where its kind needs {needed}: it {does}"
        return
    if any(map(isnan, record.values)):
        yield "one of its values is not a number"
    if record.kind != kinds.DOOR:
        yield from _place_oddities(record, ground)
    if record.kind in _CHECKS:
        yield from _CHECKS[record.kind](record, ground)


def _place_oddities(record: ObjectSpec, ground: Ground) -> Iterator[str]:
    x, y = record.values[:2]
    if isnan(x) or isnan(y):
        return
    cell = cell_at(x, y)
    if record.kind == kinds.FLOOR_GUARD:
        return
    if not cell:
        yield "it is outside the grid"
    elif record.kind in _IN_TILE and _deep(ground, x, y):
        border = COLUMN[cell] in (0, COLUMNS + 1) or ROW[cell] in (0, ROWS + 1)
        yield "it is in the border of the level, inside the rock" if border else _IN_TILE[record.kind]
    elif record.kind in (kinds.DRONE, kinds.THWUMP) and SHAPE[ground.level.tiles[cell]] == FULL:
        yield "it is inside a full tile"


_IN_TILE = {
    kinds.NINJA: "it starts inside a tile",
    kinds.TURRET: "it is inside a tile: what it sees and hits is odd",
    kinds.MINE: "it is inside a tile",
    kinds.LAUNCH_PAD: "it is inside a tile",
    kinds.LAUNCHER: "it is inside a tile: its rockets explode at once",
}


def _deep(ground: Ground, x: float, y: float) -> bool:
    """Whether a point is inside a tile and not just on its surface, where turrets and launchers are often put."""
    return all(solid_at(ground.level, x + dx, y + dy) for dx in (-0.5, 0.5) for dy in (-0.5, 0.5))


def _exit(record: ObjectSpec, ground: Ground) -> Iterator[str]:
    x, y, switch_x, switch_y = record.values
    if cell_at(x, y) and not ground.touchable(x, y, EXIT_RADIUS):
        yield "the ninja cannot reach it"
    if not ground.touchable(switch_x, switch_y, SWITCH_RADIUS):
        yield f"the ninja cannot reach its switch at {place_text(switch_x, switch_y)}"


def _gold(record: ObjectSpec, ground: Ground) -> Iterator[str]:
    x, y = record.values
    if not cell_at(x, y):
        return
    places = [(x + a * GOLD_RADIUS, y + b * GOLD_RADIUS) for a in _SAMPLES for b in _SAMPLES]
    if not ground.touchable(x, y, GOLD_RADIUS):
        yield "the ninja cannot reach it"
    elif sum(solid_at(ground.level, *place) for place in places) >= _HIDDEN * len(places):
        yield "the tiles hide it"


def _launch_pad(record: ObjectSpec, ground: Ground) -> Iterator[str]:  # noqa: ARG001 - all checks have one signature
    _, _, a, b = record.values
    length = sqrt(a * a + b * b)
    if abs(length - 1.0) > _UNIT_TOLERANCE:
        yield f"its normal has length {length:.3g} instead of 1 and its strength changes with it"


def _one_way(record: ObjectSpec, ground: Ground) -> Iterator[str]:  # noqa: ARG001
    if record.values[2] not in _DIRECTIONS:
        yield "its direction is not 0 to 3: it faces down"


def _thwump(record: ObjectSpec, ground: Ground) -> Iterator[str]:  # noqa: ARG001
    if record.values[2] not in _DIRECTIONS:
        yield "its direction is not 0 to 3: it never moves, its right side kills"


def _floor_guard(record: ObjectSpec, ground: Ground) -> Iterator[str]:
    cell = cell_at(*record.values[:2])
    if COLUMN[cell] in (0, 32):
        yield "a guard in the left or right border or outside hangs the original game; here it does nothing"
    elif SHAPE[ground.level.tiles[cell]] == FULL:
        yield "it is inside a full tile"
    elif ground.edges[4 * cell + 1] != SOLID:
        yield "it does not stand on a solid floor: it cannot run to the left"


def _drone(record: ObjectSpec, ground: Ground) -> Iterator[str]:
    x, y, movement, seeker, weapon, direction = record.values
    if weapon not in (0, 1, 2):
        yield "its weapon is not 0 to 2: it is harmless"
    if movement not in range(6):
        yield "its movement is not 0 to 5: it gets stuck"
    if direction not in _DIRECTIONS:
        yield "its direction is not 0 to 3"
    if seeker not in (0, 1):
        yield "its seeker flag is not 0 or 1"
    elif seeker and weapon != 0:
        yield "only zap drones seek: its seeker flag does nothing"
    cell = cell_at(x, y)
    sides = range(4 * cell, 4 * cell + 4)
    if cell and all(ground.edges[side] != OFF or side in ground.closed_edges for side in sides):
        yield "it is closed in on all sides: it never moves"


def _door(record: ObjectSpec, ground: Ground) -> Iterator[str]:
    x, y, vertical, trap, _, _, locked, _, _ = record.values
    edges = edges_of(ground.doors[record])
    if vertical not in (0, 1):
        yield "its vertical flag is not 0 or 1: it closes another side than it is drawn on"
    if trap not in (0, 1) or locked not in (0, 1):
        yield "its trap or locked flag is not 0 or 1"
    elif trap and locked:
        yield "it is flagged as locked and as trap: it is a locked door"
    if 0 in edges:
        yield "it is not between two cells of the grid"
    elif ground.doors_on_side[edges] > 1:
        yield "another door is on the same side: the later one may never open"
    elif any(ground.edges[edge] == SOLID or SHAPE[ground.level.tiles[edge // 4]] == FULL for edge in edges):
        yield "the tiles close this side anyway: the door changes nothing"
    if (is_set(trap) or is_set(locked)) and not ground.touchable(x, y, DOOR_SWITCH_RADIUS):
        yield f"the ninja cannot reach its switch at {place_text(x, y)}"


_CHECKS: dict[int, Callable[[ObjectSpec, Ground], Iterator[str]]] = {
    kinds.DOOR: _door,
    kinds.DRONE: _drone,
    kinds.EXIT: _exit,
    kinds.FLOOR_GUARD: _floor_guard,
    kinds.GOLD: _gold,
    kinds.LAUNCH_PAD: _launch_pad,
    kinds.ONE_WAY: _one_way,
    kinds.THWUMP: _thwump,
}

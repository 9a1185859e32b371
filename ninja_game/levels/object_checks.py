"""What is legal but odd about a single object, kind by kind: each oddity is a finding for the level's maker."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import isnan, sqrt

from ninja_game.formats.ascii.places import place_text
from ninja_game.levels.findings import Finding, found
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


def oddities(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    """What is odd about an object of the level that ``ground`` describes; nothing for a proper one."""
    if not well_formed(record):
        count, needed = len(record.values), VALUE_COUNTS[record.kind]
        does = "starts at 45,70px" if record.kind == kinds.NINJA else "does nothing"
        yield found("value-count", count=count, needed=needed, does=does)
        return
    if any(map(isnan, record.values)):
        yield found("not-a-number")
    if record.kind != kinds.DOOR:
        yield from _place_oddities(record, ground)
    if record.kind in _CHECKS:
        yield from _CHECKS[record.kind](record, ground)


def _place_oddities(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y = record.values[:2]
    if isnan(x) or isnan(y):
        return
    cell = cell_at(x, y)
    if record.kind == kinds.FLOOR_GUARD:
        return
    if not cell:
        yield found("outside-grid")
    elif record.kind in _IN_TILE and _deep(ground, x, y):
        border = COLUMN[cell] in (0, COLUMNS + 1) or ROW[cell] in (0, ROWS + 1)
        yield found("in-border") if border else found("in-tile", what=_IN_TILE[record.kind])
    elif record.kind in (kinds.DRONE, kinds.THWUMP) and SHAPE[ground.level.tiles[cell]] == FULL:
        yield found("in-full-tile")


_IN_TILE = {
    kinds.NINJA: "starts inside a tile",
    kinds.TURRET: "is inside a tile: what it sees and hits is odd",
    kinds.MINE: "is inside a tile",
    kinds.LAUNCH_PAD: "is inside a tile",
    kinds.LAUNCHER: "is inside a tile: its rockets explode at once",
}


def _deep(ground: Ground, x: float, y: float) -> bool:
    """Whether a point is inside a tile and not just on its surface, where turrets and launchers are often put."""
    return all(solid_at(ground.level, x + dx, y + dy) for dx in (-0.5, 0.5) for dy in (-0.5, 0.5))


def _exit(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y, switch_x, switch_y = record.values
    if cell_at(x, y) and not ground.touchable(x, y, EXIT_RADIUS):
        yield found("unreachable")
    if not ground.touchable(switch_x, switch_y, SWITCH_RADIUS):
        yield found("unreachable-switch", place=place_text(switch_x, switch_y))


def _gold(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y = record.values
    if not cell_at(x, y):
        return
    places = [(x + a * GOLD_RADIUS, y + b * GOLD_RADIUS) for a in _SAMPLES for b in _SAMPLES]
    if not ground.touchable(x, y, GOLD_RADIUS):
        yield found("unreachable")
    elif sum(solid_at(ground.level, *place) for place in places) >= _HIDDEN * len(places):
        yield found("hidden-gold")


def _launch_pad(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:  # noqa: ARG001 - all checks have one signature
    _, _, a, b = record.values
    length = sqrt(a * a + b * b)
    if abs(length - 1.0) > _UNIT_TOLERANCE:
        yield found("pad-normal", length=length)


def _one_way(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:  # noqa: ARG001
    if record.values[2] not in _DIRECTIONS:
        yield found("direction", but=": it faces down")


def _thwump(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:  # noqa: ARG001
    if record.values[2] not in _DIRECTIONS:
        yield found("direction", but=": it never moves, its right side kills")


def _floor_guard(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    cell = cell_at(*record.values[:2])
    if COLUMN[cell] in (0, COLUMNS + 1):
        yield found("guard-in-border")
    elif SHAPE[ground.level.tiles[cell]] == FULL:
        yield found("in-full-tile")
    elif ground.edges[4 * cell + 1] != SOLID:
        yield found("guard-without-floor")


def _drone(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y, movement, seeker, weapon, direction = record.values
    if weapon not in (0, 1, 2):
        yield found("weapon")
    if movement not in range(6):
        yield found("movement")
    if direction not in _DIRECTIONS:
        yield found("direction", but="")
    if seeker not in (0, 1):
        yield found("seeker-flag")
    elif seeker and weapon != 0:
        yield found("seeker-with-weapon")
    cell = cell_at(x, y)
    sides = range(4 * cell, 4 * cell + 4)
    if cell and all(ground.edges[side] != OFF or side in ground.closed_edges for side in sides):
        yield found("closed-in")


def _door(record: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y, vertical, trap, _, _, locked, _, _ = record.values
    edges = edges_of(ground.doors[record])
    if vertical not in (0, 1):
        yield found("vertical-flag")
    if trap not in (0, 1) or locked not in (0, 1):
        yield found("door-flags")
    elif trap and locked:
        yield found("locked-trap")
    if 0 in edges:
        yield found("door-outside")
    elif ground.doors_on_side[edges] > 1:
        yield found("doors-on-one-side")
    elif any(ground.edges[edge] == SOLID or SHAPE[ground.level.tiles[edge // 4]] == FULL for edge in edges):
        yield found("closed-anyway")
    if (is_set(trap) or is_set(locked)) and not ground.touchable(x, y, DOOR_SWITCH_RADIUS):
        yield found("unreachable-switch", place=place_text(x, y))


_CHECKS: dict[int, Callable[[ObjectSpec, Ground], Iterator[Finding]]] = {
    kinds.DOOR: _door,
    kinds.DRONE: _drone,
    kinds.EXIT: _exit,
    kinds.FLOOR_GUARD: _floor_guard,
    kinds.GOLD: _gold,
    kinds.LAUNCH_PAD: _launch_pad,
    kinds.ONE_WAY: _one_way,
    kinds.THWUMP: _thwump,
}

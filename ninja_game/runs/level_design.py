"""Countable properties of a good level (docs/good-levels.md), from a level and a run that passes it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.levels.findings import PackFinding, pack_finding
from ninja_game.levels.ground import Ground
from ninja_game.runs.trace import RunTrace, trace_level
from ninja_game.sim import kinds
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec, well_formed
from ninja_game.sim.rules import CELL, RADIUS
from ninja_game.sim.states import LAUNCHER_FLIGHT, TURRET_PRE_FIRE

Points = NDArray[np.float64]  # places, px: (n, 2)

STANDING_TICKS = 400  # pause at the start: ten seconds
_NEAR = 20.0  # a near miss: fewer px between the ninja and a hazard
BAIT = 40.0  # gold closer (px) to a possible place of a hazard is in danger
_EMPTY = 4 * CELL  # space farther (px) from every object and from the run is unused
FEW = 6  # with fewer pieces, evenness is not measured
BAY = 6, 5  # columns and rows of a bay that may repeat

HAZARDS = [kind for kind in kinds.KINDS if kind.killer]
_RADII = {kind.name: kind.disc or kind.box or 0.0 for kind in HAZARDS}
"""Distance from its place in a trace at which a hazard kills, px: a turret's shot and a rocket's tip are points."""
GUNS = {"gauss turret": TURRET_PRE_FIRE, "homing launcher": LAUNCHER_FLIGHT}
"""Hazards that kill by shots, and their status number during a shot."""
_DIRECTIONS = (1, 0), (0, 1), (-1, 0), (0, -1)  # right, down, left, up, as a thwump's direction numbers them
_LANES = {kinds.THWUMP, kinds.FLOOR_GUARD}  # hazards that strike along a line


class Design(NamedTuple):
    """The counts of a level. Distances in px, shares from 0 to 1; None where there are too few things to count.

    ``hazard_distance``: from a hazard to the run, the median. ``bait``: the share of the gold near a possible place of
    a hazard, or in the sight of a gun. ``gold_evenness``, ``mine_evenness``: mean distance to the nearest other piece
    over the random expectation; above 1 they are evenly strewn. ``bays``: how often the commonest bay of tiles occurs.
    ``unused``: the share of the open space far from every object and from the run. ``detour``: length of the run over
    the distance from start to exit. ``near_ticks``: the share of the run's ticks within 20 px of a hazard.
    """

    hazard_distance: float | None
    bait: float | None
    gold_evenness: float | None
    mine_evenness: float | None
    bays: int
    unused: float
    detour: float
    near_ticks: float


BOUNDS = {
    "safe-gold": ("bait", ">=", 0.15),
    "even-gold": ("gold_evenness", "<=", 1.1),
    "even-mines": ("mine_evenness", "<=", 1.3),
    "far-hazards": ("hazard_distance", "<=", 180),
    "same-bay": ("bays", "<=", 3),
    "unused-space": ("unused", "<=", 0.25),
    "short-trip": ("detour", ">=", 1.6),
}
"""The demanded range of a count, by the code of the finding: the outer tenths of the reference, or the judges' wish."""


def design_findings(counts: Design, file: str = "") -> Iterator[PackFinding]:
    """The design findings of a level. ``file``: its own."""
    for code, (name, sign, bound) in BOUNDS.items():
        value = getattr(counts, name)
        if value is not None and (value < bound if sign == ">=" else value > bound):
            yield pack_finding(code, file, value=value, bound=bound)


def measure_design(level: Level, inputs: bytes) -> Design:
    """The counts of a level, with a run that passes it (``Recording.playback``).

    Raises LevelError for a level that cannot be played.
    """
    run, still = trace_level(level, inputs), trace_level(level, bytes(STANDING_TICKS))
    ground = Ground(level)
    path = np.column_stack([run.ninja["x"], run.ninja["y"]])
    gold, mines = places_of_kind(level, kinds.GOLD), places_of_kind(level, kinds.MINE)
    room = len(ground.cells) * CELL * CELL
    homes = np.concatenate([places_of_kind(level, kind.number) for kind in HAZARDS])
    to_exit = distances(places_of_kind(level, kinds.NINJA)[-1:], places_of_kind(level, kinds.EXIT))
    return Design(
        float(np.median(distances(homes, path))) if len(homes) else None,
        float(np.mean(in_danger(level, ground, still, gold))) if len(gold) and len(homes) else None,
        evenness(gold, room),
        evenness(mines, room),
        most_bays(level),
        unused_share(level, ground, path),
        float(np.abs(np.diff(path, axis=0)).sum()) / max(CELL, float(to_exit.min(initial=np.inf))),
        float(np.mean(clearance(run) < _NEAR)),
    )


def places_of_kind(level: Level, kind: int) -> Points:
    points = [record.values[:2] for record in level.objects if record.kind == kind and well_formed(record)]
    return np.array(points, np.float64).reshape(-1, 2)


def distances(points: Points, others: Points) -> NDArray[np.float64]:
    """Distance from each point to the nearest of the others, px, (n,); infinite without others."""
    if not len(others):
        return np.full(len(points), np.inf)
    apart = np.hypot(*(points[:, None] - others[None]).transpose(2, 0, 1))
    return np.asarray(apart.min(axis=1), np.float64)


def clearance(run: RunTrace) -> NDArray[np.float64]:
    """Distance between the ninja and the nearest hazard, after each tick, px: (ticks,)."""
    nearest = np.full(len(run.ninja), np.inf)
    for column, kind in enumerate(run.kinds):
        if kind not in _RADII:
            continue
        rows = run.objects[:, column]
        deadly = rows["s"] == GUNS.get(kind, 1) if kind == "mine" or kind in GUNS else True
        space = np.hypot(run.ninja["x"] - rows["x"], run.ninja["y"] - rows["y"]) - RADIUS - _RADII[kind]
        nearest = np.minimum(nearest, np.where(deadly, space, np.inf))
    return nearest


def in_danger(level: Level, ground: Ground, still: RunTrace, points: Points) -> NDArray[np.bool_]:
    """Whether points lie within 40 px of a possible place of a hazard, or in the sight of a gun."""
    by_touch = _RADII.keys() - GUNS.keys()
    moving = [rows[::5] for kind, rows in zip(still.kinds, still.objects.T, strict=True) if kind in by_touch]
    reached = [np.column_stack([rows["x"], rows["y"]]) for rows in moving]
    lanes = [danger_lane(ground, record) for record in level.objects if record.kind in _LANES and well_formed(record)]
    reached += [np.array(list(cells)).reshape(-1, 2) for cells in lanes]
    near = distances(points, np.concatenate([places_of_kind(level, kinds.MINE), *reached])) < BAIT
    for kind in (kinds.TURRET, kinds.LAUNCHER):
        for gun in places_of_kind(level, kind):
            near |= np.array([in_sight(ground, gun, point) for point in points], bool)
    return near


def danger_lane(ground: Ground, record: ObjectSpec) -> Iterator[tuple[float, float]]:
    """The places where a thwump strikes or a guard runs: steps of half a cell up to the rock."""
    x, y = record.values[:2]
    is_guard = record.kind == kinds.FLOOR_GUARD
    for dx, dy in [(1, 0), (-1, 0)] if is_guard else [_DIRECTIONS[int(record.values[2]) % 4]]:
        for step in range(2 * COLUMNS):
            place = x + dx * step * CELL / 2, y + dy * step * CELL / 2
            if solid_at(ground.tiles, *place):
                break
            yield place


def in_sight(ground: Ground, gun: Sequence[float], point: Sequence[float]) -> bool:
    """Whether no rock lies between two places."""
    steps = max(1, int(hypot(point[0] - gun[0], point[1] - gun[1]) / 6))
    return not any(
        solid_at(ground.tiles, gun[0] + (point[0] - gun[0]) * k / steps, gun[1] + (point[1] - gun[1]) * k / steps)
        for k in range(1, steps)
    )


def evenness(points: Points, room: float) -> float | None:
    """Mean distance to the nearest other piece over that of randomly placed pieces (Clark and Evans, 1954)."""
    if len(points) < FEW:
        return None
    apart = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    np.fill_diagonal(apart, np.inf)
    return float(apart.min(axis=1).mean() / (0.5 * sqrt(max(room, 1.0) / len(points))))


def most_bays(level: Level) -> int:
    """The count of the commonest block of 6 x 5 cells, without overlaps; nearly full or empty ones do not count."""
    columns, rows = BAY
    where: dict[tuple[int, ...], list[tuple[int, int]]] = {}
    for i in range(COLUMNS - columns + 1):
        for j in range(ROWS - rows + 1):
            starts = range(i * ROWS + j, (i + columns) * ROWS + j, ROWS)
            block = tuple(tile for start in starts for tile in level.tiles[start : start + rows])
            if len(set(block)) > 2 and 6 <= sum(tile > 0 for tile in block) <= columns * rows - 6:
                where.setdefault(block, []).append((i, j))
    return max((len(_apart(cells)) for cells in where.values()), default=0)


def _apart(cells: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """The number of the blocks at these cells without overlaps, from the left."""
    kept: list[tuple[int, int]] = []
    for i, j in cells:
        if all(abs(i - a) >= BAY[0] or abs(j - b) >= BAY[1] for a, b in kept):
            kept.append((i, j))
    return kept


def unused_share(level: Level, ground: Ground, path: Points) -> float:
    """The share of the cells in reach that are far from every object and from the run."""
    if not ground.cells:
        return 0.0
    cells = np.array([(CENTRE_X[cell], CENTRE_Y[cell]) for cell in ground.cells])
    used = np.array([record.values[:2] for record in level.objects if well_formed(record)], np.float64)
    return float(np.mean(np.minimum(distances(cells, used), distances(cells, path[::5])) > _EMPTY))

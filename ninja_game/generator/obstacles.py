"""Enemies and lines of mines around gold, exit and switches, never at the start; fixtures that hinder without harm."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from math import dist, hypot
from random import Random

import numpy as np

from ninja_game.formats.ascii.legend import WEAPONS
from ninja_game.generator.gold import lay_gold_around, points_along
from ninja_game.generator.scene import MIDDLE_COLUMN, Scene, mirrored, object_of, object_places
from ninja_game.sim import kinds
from ninja_game.sim.grid import Cell, Point, middle_of
from ninja_game.sim.kinds import ENEMIES
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL, PAD_RADIUS

MAX_MINES = 34
MAX_OBJECTS = 110
MAX_HARDENING = 28  # most mines and objects that are added when a level turns out too easy
SAFE_PX = 150.0  # px around the ninja's start without any danger
BESIDE_PX = 110.0  # distance from gold, exit and switches within which enemies are placed first
BAIT_PX = 120.0  # px from the middle of a group of gold within which mines guard it
RUN_GAP_PX = 17.0  # least px from a certified run to a mine: the sum of the radii, and a little
CLOSE_PX = 48.0  # px from a certified run within which hazards are added when a level turns out too easy
SIGHT_PX = 200.0  # the same for enemies that shoot
MAX_ENEMIES = 11
MAX_ADDED = 15  # most enemies and lines of mines that are added when a level turns out too easy
ENEMY_TRIES = 14  # how often the program looks for a place for one more enemy
FEW_SOURCES = 6  # number of these tries after which all sources are used
# The same columns on both sides, so that a level looks designed.
TURRET_COLUMNS = (5, 8, 11, MIDDLE_COLUMN, 21, 24, 27)
LAUNCHER_COLUMNS = (2, 3, MIDDLE_COLUMN, 29, 30)
MAX_VOIDS = 4  # most empty places that get something
VOID_PX = 4.2 * CELL  # px around such a place without any object
_STEP = 28.0  # px between the mines of a line
ROCK_GAP_PX = 6.0  # px from the rock to the middle of a mine
GATE_PX = 20.0  # px from the run to either mine of a gate

ObstacleSource = Callable[[Scene, Random], Iterator[ObjectSpec]]


def guards(scene: Scene, rng: Random) -> Iterator[ObjectSpec]:
    """On floors that are long enough for a guard to run."""
    for run in scene.runs():
        if run.length >= 5:
            yield object_of(f"floor guard {run.column + rng.randint(1, run.length - 2)},{run.row}")


def zaps(scene: Scene, rng: Random) -> Iterator[ObjectSpec]:
    """Around stones and along walls."""
    turn = rng.choice(("surface-cw", "surface-ccw"))
    edges = [(c, r) for c, r in sorted(scene.reachable) if scene.full((c, r + 1)) != scene.full((c, r - 1))]
    for column, row in edges:
        direction = "right" if scene.full((column, row + 1)) == (turn == "surface-ccw") else "left"
        yield object_of(f"zap drone {column},{row} {turn} {direction}")


def patrols(scene: Scene, rng: Random) -> Iterator[ObjectSpec]:
    """Drones that go back and forth over a floor."""
    kind = rng.choice(("zap drone", *WEAPONS))
    for run in scene.runs():
        if run.length >= 4:
            direction = rng.choice(("left", "right"))
            place = f"{run.column + run.length // 2},{run.row - rng.choice((0, 1))}"
            yield object_of(f"{kind} {place} alternating {direction}")


def thwumps(scene: Scene, _: Random) -> Iterator[ObjectSpec]:
    """Under ceilings with air below."""
    for column, row in sorted(scene.reachable):
        depth = 1
        while (column, row + depth) in scene.reachable:
            depth += 1
        if scene.full((column, row - 1)) and 4 <= depth <= 12 and column % 2 == 0:
            yield object_of(f"thwump {column},{row} down")


def turrets(scene: Scene, _: Random) -> Iterator[ObjectSpec]:
    """In the open."""
    for column, row in sorted(scene.reachable):
        around = all((column + i, row + j) in scene.reachable for i in (-1, 0, 1) for j in (-1, 0, 1))
        if around and column in TURRET_COLUMNS:
            yield object_of(f"gauss turret {column},{row}")


def launchers(scene: Scene, _: Random) -> Iterator[ObjectSpec]:
    """In high corners."""
    for column, row in sorted(scene.reachable):
        corner = scene.full((column, row - 1)) and (column - 1, row) in scene.reachable and row < 12
        if corner and column in LAUNCHER_COLUMNS:
            yield object_of(f"homing launcher {column},{row}")


SOURCES: dict[ObstacleSource, tuple[int, float]] = {
    guards: (1, 3.0), zaps: (1, 5.0), thwumps: (1, 1.8), patrols: (2, 1.5), turrets: (3, 0.8), launchers: (5, 1.5),
}  # fmt: skip
"""Sources of enemies: their least difficulty, and how often they are chosen."""


def place_enemies(scene: Scene, rng: Random, count: int, difficulty: int) -> bool:
    """Put about ``count`` enemies of two or three sources into a scene; tells whether there are at least three."""
    for x, y in scene.rings:
        turret = difficulty >= SOURCES[turrets][0] and _if_fits(
            scene, object_of(f"gauss turret {x:g},{y:g}px"), 4 * CELL
        )
        scene.hazards.append([turret or object_of(f"mine {x:g},{y:g}px")])
    possible = [source for source, (least, _) in SOURCES.items() if difficulty >= least]
    weights = [SOURCES[source][1] for source in possible]
    chosen = [rng.choices(possible, weights)[0] for _ in range(3)]
    for number in range(ENEMY_TRIES):
        source = chosen[number % len(chosen)]
        if number == FEW_SOURCES:
            chosen = possible
        if scene.count(*ENEMIES) >= count:
            break
        offered = list(source(scene, rng))
        rng.shuffle(offered)
        # The first three guard the same group of gold; every further one guards another place.
        guards_vault = len(scene.hazards) < 3
        offered.sort(key=partial(_distance_from_vault if guards_vault else _guards_nothing, scene))
        gap = (2 if guards_vault else 4) * CELL
        enemy = next((spec for spec in offered if _if_fits(scene, spec, gap)), None)
        if enemy:
            scene.hazards.append([enemy])
            x, y, *_ = enemy.values
            twins = [spec for spec in offered if [spec.values[:2]] == scene.mirrored_points([(x, y)])]
            if twins and rng.random() < 0.75 and scene.count(*ENEMIES) < count and _if_fits(scene, twins[0], gap):
                scene.hazards.append([twins[0]])
    return scene.count(*ENEMIES) >= 3


def _guards_nothing(scene: Scene, enemy: ObjectSpec) -> bool:
    """Whether an enemy is far from everything that the player wants or has to touch."""
    return all(dist(enemy.values[:2], point) > BESIDE_PX for point in scene.wanted())


def _distance_from_vault(scene: Scene, enemy: ObjectSpec) -> float:
    return dist(enemy.values[:2], middle_of(scene.board.vault_floor[len(scene.board.vault_floor) // 2]))


def _if_fits(scene: Scene, spec: ObjectSpec, apart: float) -> ObjectSpec | None:
    """An enemy if it has room, is ``apart`` px from others, and does not move towards the start."""
    start = middle_of(scene.start)
    point = (spec.values[0], spec.values[1])
    enemies = [other for other in scene.objects if other.kind in ENEMIES]
    clear = scene.is_clear(point, needed=60.0, other=14.0) and dist(point, start) >= SAFE_PX
    alone = all(dist(point, other.values[:2]) >= apart for other in enemies)
    seen = spec.kind in _SHOOTERS and scene.sees(point, start)
    same_floor = spec.kind == kinds.FLOOR_GUARD and int(point[1] // CELL) == scene.start[1]
    return spec if clear and alone and not seen and not same_floor else None


_SHOOTERS = (kinds.TURRET, kinds.LAUNCHER)


def fill_voids(scene: Scene, rng: Random, difficulty: int) -> None:
    """Fill large empty places with a few pieces of gold around a moving drone, a turret or a mine."""
    air = [middle_of(cell) for cell in sorted(scene.reachable)]
    for _ in range(MAX_VOIDS):
        taken = np.array([point for spec in scene.objects for point in object_places(spec)])
        distances = np.hypot(*(np.array(air)[:, None] - taken[None]).transpose(2, 0, 1)).min(1)
        x, y = air[int(distances.argmax())]
        if distances.max() < VOID_PX or not lay_gold_around(scene, (x, y), rng):
            break
        kind = rng.choice(("zap drone", "zap drone", "gauss turret" if difficulty >= SOURCES[turrets][0] else "mine"))
        line = f"{kind} {x:g},{y:g}px"
        enemy = _if_fits(
            scene, object_of(f"{line} alternating {rng.choice(('left', 'right'))}" if "zap" in line else line), 60
        )
        if scene.count(*ENEMIES) >= MAX_ENEMIES or enemy is None:
            scene.rings.append((x, y))
            enemy = object_of(f"mine {x:g},{y:g}px")
        scene.hazards.append([enemy])


# --- mines ---


def place_mines(scene: Scene, rng: Random, count: int) -> None:
    """Put mines on the rock near gold, exit and switches: under ceilings, up walls, over edges, in a pit."""
    rock = [face.out_by(ROCK_GAP_PX) for chain in scene.surfaces for face in chain]
    wanted_places = scene.wanted()
    near_first = [
        (min(dist(line[len(line) // 2], at) for at in wanted_places) * rng.uniform(0.5, 1), line)
        for line in _surface_lines(scene, rng)
    ]
    for line in (line for far, line in sorted(near_first) if far < BAIT_PX):
        for points in [line, scene.mirrored_points(line)] if rng.random() < 0.8 else [line]:
            group = [mine for mine in _mines(scene, points) if any(dist(mine.values[:2], at) < _STEP for at in rock)]
            is_crowded = any(
                dist(points[len(points) // 2], spec.values[:2]) < 4 * CELL
                for spec in scene.objects
                if spec.kind == kinds.MINE
            )
            if len(group) >= 3 and not is_crowded and scene.count(kinds.MINE) + len(group) <= min(count, MAX_MINES):
                scene.hazards.append(group)


def _surface_lines(scene: Scene, rng: Random, *, floors: bool = False) -> list[list[Point]]:
    """Lines along the rock, on hardly any floors except those of pits; ``floors``: short ones there, too."""
    lines = list[list[Point]]()
    for chain in scene.surfaces:
        for first in range(0, len(chain) - 2, 3):
            part = chain[first : first + rng.randint(5, 10)]
            floor = [face for face in part if face.away_y < -0.9]
            if len(floor) > 2 and min(face.y for face in part) <= CELL * 20:
                part = floor[:3] if floors else []
            if part:
                lines.append(points_along([face.out_by(ROCK_GAP_PX) for face in part], _STEP))
    return lines


def _mines(scene: Scene, points: Sequence[Point]) -> list[ObjectSpec]:
    """Make mines at the points that have room."""
    start = middle_of(scene.start)
    fit = [p for p in points if scene.is_clear(p, needed=44.0, other=14.0) and dist(p, start) >= SAFE_PX / 2]
    return [object_of(f"mine {round(x)},{round(y)}px") for x, y in dict.fromkeys(fit)]


def hazards_beside(scene: Scene, run: Sequence[Point], difficulty: int, rng: Random) -> list[ObjectSpec]:
    """Make an enemy, or a line of mines on the rock, close to a run that passes the level; perhaps none.

    No mine is less than ``RUN_GAP_PX`` px from the run. The caller must test whether the run still passes an enemy.
    """
    if scene.count(*ENEMIES) < MAX_ADDED and rng.random() < 0.4:
        weights = [weight if difficulty >= least else 0.0 for least, weight in SOURCES.values()]
        source = rng.choices(list(SOURCES), weights)[0]
        offered = list(source(scene, rng))
        rng.shuffle(offered)
        for spec in offered[:60]:
            reach = SIGHT_PX if spec.kind in _SHOOTERS else CLOSE_PX
            if min(dist(spec.values[:2], at) for at in run) < reach and _if_fits(scene, spec, 3 * CELL):
                return [spec]
    excess = max(scene.count(kinds.MINE) - MAX_MINES, len(scene.objects) - MAX_OBJECTS)
    if excess > MAX_HARDENING - 3:
        return []
    if rng.random() < 0.5 and (gate := _gate(scene, run, rng)):
        return gate
    groups = list[tuple[float, list[ObjectSpec]]]()
    for line in _surface_lines(scene, rng, floors=True):
        distances = [(min(dist(spec.values[:2], at) for at in run), spec) for spec in _mines(scene, line)]
        group = [spec for distance, spec in distances if distance >= RUN_GAP_PX][:8]
        if len(group) >= 2 and min(distance for distance, _ in distances) < CLOSE_PX:
            groups.append((sum(distance < CLOSE_PX for distance, _ in distances), group))
    # Choose one of the groups with the most mines close to the run.
    groups.sort(key=lambda pair: -pair[0])
    return rng.choice(groups[:6])[1] if groups else []


def _gate(scene: Scene, run: Sequence[Point], rng: Random) -> list[ObjectSpec]:
    """Make a mine on either side of a run in the air; perhaps none."""
    for _ in range(20 if len(run) > 50 else 0):
        tick = rng.randint(40, len(run) - 3)
        (x0, y0), (x, y) = run[tick - 1], run[tick]
        speed = hypot(x - x0, y - y0)
        if speed >= 1.5:
            nx, ny = (y - y0) / speed, (x0 - x) / speed
            gate = _mines(scene, [(round(x + side * nx), round(y + side * ny)) for side in (-GATE_PX, GATE_PX)])
            if len(gate) == 2 and min(dist(mine.values[:2], at) for mine in gate for at in run) >= RUN_GAP_PX:
                return gate
    return []


def nearest_hazard(scene: Scene, run: Sequence[Point]) -> int | None:
    """The number of the group of hazards nearest to a run that can be removed; None if none can."""
    enemies = scene.count(*ENEMIES)
    removable = [
        (min(dist(spec.values[:2], at) for spec in group for at in run), number)
        for number, group in enumerate(scene.hazards)
        if group[0].kind == kinds.MINE or enemies - len(group) >= 3
    ]
    return min(removable)[1] if removable else None


MAX_FIXTURES = 12


def pads(scene: Scene, rng: Random) -> Iterator[ObjectSpec]:
    """Launch pads on floors."""
    runs = [run for run in scene.runs() if run.length >= 3]
    rng.shuffle(runs)
    for run in runs[:2]:
        yield object_of(f"launch pad {run.column + rng.randint(0, run.length - 1)},{run.row} up")


def one_ways(scene: Scene, rng: Random) -> Iterator[ObjectSpec]:
    """One-way platforms over two gaps between tiles."""
    gaps = list[list[Cell]]()
    for row in range(4, 22):
        for column in range(2, 30):
            width = 0
            while (column + width, row) in scene.empty and column + width < 30:
                width += 1
            ends = (column - 1, row) in scene.tiles and (column + width, row) in scene.tiles
            cells = [(column + k, row) for k in range(width)]
            open_ = all((cell_column, row + k) in scene.empty for cell_column, _ in cells for k in (-2, -1, 1, 2))
            if ends and 2 <= width <= 5 and open_:
                gaps.append(cells)
    rng.shuffle(gaps)
    apart = [gap for gap in gaps[1:] if abs(gap[0][1] - gaps[0][0][1]) > 3 or gap[0][0] > gaps[0][-1][0]]
    for gap in [*gaps[:1], *apart[:1]]:
        yield from (object_of(f"one-way {cell_column},{cell_row} up") for cell_column, cell_row in gap)


def blocks(scene: Scene, rng: Random) -> Iterator[ObjectSpec]:
    """Bounce blocks in open air, in pairs or like steps, some mirrored on both sides."""
    air = [
        (c, r)
        for c, r in sorted(scene.reachable)
        if all((c + i, r + j) in scene.reachable for i in (-2, 0, 2) for j in (-2, -1, 0, 1, 2))
    ]
    x, y = rng.choice(((1, 0), (0, 1), (2, 1), (2, -1), (3, 0)))
    for c, r in rng.sample(air, min(len(air), 3)):
        steps = [(c + x * k, r + y * k) for k in range(3 if x > 1 else 2)]
        if rng.random() < 0.7:
            steps += [mirrored(step) for step in steps]
        yield from (object_of(f"bounce block {c},{r}") for c, r in steps if (c, r) in scene.reachable)


def place_fixtures(scene: Scene, rng: Random) -> None:
    """Put one or two kinds of fixtures into a scene."""
    sources = rng.sample((blocks, pads, one_ways), rng.choice((1, 2, 2)))
    for spec in (spec for source in sources for spec in source(scene, rng)):
        # A pad lies on the edge of its cell.
        point = (spec.values[0], spec.values[1] - (PAD_RADIUS if spec.kind == kinds.LAUNCH_PAD else 0.0))
        if len(scene.fixtures) < MAX_FIXTURES and scene.is_clear(point, needed=40.0, other=12.0):
            scene.fixtures.append(spec)

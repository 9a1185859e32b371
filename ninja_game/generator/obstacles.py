"""Enemies and mines beside the route, never on the ninja; what hinders without harm; mirrored where there is room."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import dist, hypot
from random import Random

from ninja_game.generator.scene import ENEMIES, MIDDLE, Cell, Point, Scene, flipped, middle, places, spec, with_mirror
from ninja_game.sim import kinds
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL

MOST_MINES, MOST_OBJECTS = 21, 88
SAFE = 150.0
"""px from the ninja's start in which nothing waits."""
BESIDE = 190.0
"""px from exit and switches in which enemies are put first."""
FROM_RUN = 17.0
"""px from a certified run at which a mine leaves it alone: their radii, and a little."""

Source = Callable[[Scene, Random], Iterator[str]]


def guards(scene: Scene, rng: Random) -> Iterator[str]:
    """On floors that are long enough to run on."""
    for run in scene.runs():
        if run.length >= 5:
            yield f"floor guard {run.column + rng.randint(1, run.length - 2)},{run.row}"


def zaps(scene: Scene, rng: Random) -> Iterator[str]:
    """Around stones and along walls."""
    way = rng.choice(("surface-cw", "surface-ccw"))
    for column, row in _beside_tiles(scene):
        direction = "right" if scene.full((column, row + 1)) == (way == "surface-ccw") else "left"
        yield f"zap drone {column},{row} {way} {direction}"


def patrols(scene: Scene, rng: Random) -> Iterator[str]:
    """Drones that go to and fro over a floor."""
    kind = rng.choice(("zap drone", "zap drone", "laser drone", "chaingun drone"))
    for run in scene.runs():
        if run.length >= 4:
            direction = rng.choice(("left", "right"))
            yield f"{kind} {run.column + run.length // 2},{run.row - rng.choice((0, 1))} alternating {direction}"


def thwumps(scene: Scene, _: Random) -> Iterator[str]:
    """Under ceilings with air below."""
    for column, row in sorted(scene.steps):
        depth = 1
        while (column, row + depth) in scene.steps:
            depth += 1
        if scene.full((column, row - 1)) and 4 <= depth <= 12 and column % 2 == 0:
            yield f"thwump {column},{row} down"


def turrets(scene: Scene, rng: Random) -> Iterator[str]:
    """In the open."""
    for column, row in sorted(scene.steps):
        around = all((column + i, row + j) in scene.steps for i in (-1, 0, 1) for j in (-1, 0, 1))
        if around and (column in (MIDDLE, 5, 8, 11) or rng.random() < 0.1):
            yield f"gauss turret {column},{row}"


def launchers(scene: Scene, _: Random) -> Iterator[str]:
    """In high corners."""
    for column, row in sorted(scene.steps):
        corner = scene.full((column, row - 1)) and (column - 1, row) in scene.steps and row < 12
        if corner and column in (2, 3, MIDDLE):
            yield f"homing launcher {column},{row}"


SOURCES: dict[Source, tuple[int, float]] = {
    guards: (1, 3.0), zaps: (1, 4.0), thwumps: (1, 2.0), patrols: (2, 2.0), turrets: (4, 2.0), launchers: (6, 1.5),
}  # fmt: skip
"""Where enemies come from: the least difficulty for them, and how often they are taken."""


def place_enemies(scene: Scene, rng: Random, wanted: int, difficulty: int) -> bool:
    """Put about so many enemies of two or three sources into a scene; whether there are at least three."""
    able = [source for source, (least, _) in SOURCES.items() if difficulty >= least]
    weights = [SOURCES[source][1] for source in able]
    chosen = [rng.choices(able, weights)[0] for _ in range(3)]
    for number in range(12):
        source = chosen[number % len(chosen)]
        if number == 6:
            chosen = able
        if scene.count(*ENEMIES) >= wanted:
            break
        lines = list(source(scene, rng))
        rng.shuffle(lines)
        lines.sort(key=lambda line: not _on_the_way(scene, line))
        # Alone it breaks the symmetry; that is the exception.
        alone = rng.random() < 0.25 or source is launchers or wanted - scene.count(*ENEMIES) == 1
        group = next((group for line in lines if (group := _group(scene, line, alone))), None)
        if group:
            scene.hazards.append(group)
    return scene.count(*ENEMIES) >= 3


def _on_the_way(scene: Scene, line: str) -> bool:
    """Whether an enemy is near to something that one has to touch."""
    x, y, *_ = spec(line).values
    wanted = [point for record in scene.key[1:] for point in places(record)]
    return any(dist((x, y), point) <= BESIDE for point in wanted)


def _group(scene: Scene, line: str, alone: bool) -> list[ObjectSpec]:
    """The enemy of a line and its mirror image, if they have room; else nothing."""
    record = spec(line)
    group = [record] if alone else [record, mirror_image(record)]
    if group[0].values[:2] == group[-1].values[:2]:
        group = group[:1]
    start = middle(scene.start)
    for each in group:
        point = (each.values[0], each.values[1])
        clear = scene.clear_of(point, key=60.0, other=14.0) and dist(point, start) >= SAFE
        enemies = [other for other in scene.objects if other.kind in ENEMIES]
        apart = all(dist(point, other.values[:2]) >= 4 * CELL for other in enemies)
        if not clear or not apart or (each.kind in _SHOOTERS and scene.sees(point, start)):
            return []
    return group


_SHOOTERS = (kinds.TURRET, kinds.LAUNCHER)


def mirror_image(record: ObjectSpec) -> ObjectSpec:
    """The mirrored object; drones turn the other way round."""
    x, y, *rest = record.values
    x, y = flipped((x, y))
    if record.kind == kinds.DRONE:
        movement, seeker, weapon, direction = rest
        movement = {0.0: 1.0, 1.0: 0.0, 2.0: 3.0, 3.0: 2.0}.get(movement, movement)
        rest = [movement, seeker, weapon, {0.0: 2.0, 2.0: 0.0}.get(direction, direction)]
    elif record.kind == kinds.LAUNCH_PAD:
        rest = [0.0 - rest[0], rest[1]]
    return ObjectSpec(record.kind, (x, y, *rest))


def _beside_tiles(scene: Scene) -> Iterator[Cell]:
    for column, row in sorted(scene.steps):
        if scene.full((column, row + 1)) != scene.full((column, row - 1)):
            yield column, row


# --- mines ---


def place_mines(scene: Scene, rng: Random, wanted: int) -> None:
    """Rows of mines where the level invites: under ceilings, on floors' ends, up the walls, all of one sort."""
    sort = rng.choice((_ceiling_mines, _edge_mines, _wall_mines))
    rows = list(sort(scene))
    rng.shuffle(rows)
    for row in rows:
        group = _mines(scene, [point for each in row for point in with_mirror(each)])
        if len(group) >= 2 and scene.count(kinds.MINE) + len(group) <= wanted:
            scene.hazards.append(group)


def _ceiling_mines(scene: Scene) -> Iterator[list[Point]]:
    for column, row in sorted(scene.steps):
        cells = [(column + 2 * k, row) for k in range(3)]
        if column % 2 and all(cell in scene.steps and scene.full((cell[0], row - 1)) for cell in cells):
            yield [(x, y - 8) for x, y in map(middle, cells)]


def _edge_mines(scene: Scene) -> Iterator[list[Point]]:
    for run in scene.runs():
        if run.length >= 3:
            (left, y), (right, _) = middle((run.column, run.row)), middle((run.column + run.length - 1, run.row))
            yield [(left - 6, y + 8), (right + 6, y + 8)]


def _wall_mines(scene: Scene) -> Iterator[list[Point]]:
    for column, row in sorted(scene.steps):
        for dx in (-1, 1):
            cells = [(column, row + 2 * k) for k in range(3)]
            if all(cell in scene.steps and scene.full((column + dx, cell[1])) for cell in cells):
                yield [(x + 8 * dx, y) for x, y in map(middle, cells)]


def _mines(scene: Scene, points: Sequence[Point]) -> list[ObjectSpec]:
    """Mines at those of the points that have room."""
    start = middle(scene.start)
    fit = [p for p in points if scene.clear_of(p, key=44.0, other=17.0) and dist(p, start) >= SAFE / 2]
    return [spec(f"mine {round(x)},{round(y)}px") for x, y in dict.fromkeys(fit)]


def mines_beside(scene: Scene, run: Sequence[Point], rng: Random) -> list[ObjectSpec]:
    """Mines beside a run that passes, at a place where it is in the air, and their mirror images; perhaps none.

    The run stays possible: no mine is less than ``FROM_RUN`` px from it.
    """
    if scene.count(kinds.MINE) + 4 > MOST_MINES or len(scene.objects) + 4 > MOST_OBJECTS or len(run) < 50:
        return []
    for _ in range(20):
        tick = rng.randint(40, len(run) - 3)
        (x0, y0), (x, y) = run[tick - 1], run[tick]
        speed = hypot(x - x0, y - y0)
        if speed < 1.0:
            continue
        nx, ny = (y - y0) / speed, (x0 - x) / speed
        points = []
        for side in (-1, 1):
            for away in (18, 22, 26):
                point = (6.0 * round((x + side * away * nx) / 6), 6.0 * round((y + side * away * ny) / 6))
                if min(dist(point, at) for at in run) >= FROM_RUN:
                    points.append(point)
                    break
        both = [p for each in points for p in with_mirror(each) if min(dist(p, at) for at in run) >= FROM_RUN]
        group = _mines(scene, both)
        if group:
            return group
    return []


def nearest_hazard(scene: Scene, run: Sequence[Point]) -> int | None:
    """Number of the group of hazards that is nearest to a run and that can be spared; None if none can."""
    enemies = scene.count(*ENEMIES)
    spare = [
        (min(dist(record.values[:2], at) for record in group for at in run), number)
        for number, group in enumerate(scene.hazards)
        if group[0].kind == kinds.MINE or enemies - len(group) >= 3
    ]
    return min(spare)[1] if spare else None


MOST_FIXTURES = 12


def blocks(scene: Scene, rng: Random) -> Iterator[str]:
    """Bounce blocks in staggered rows, in open air."""
    apart, first = rng.choice((3, 4)), rng.randint(4, 7)
    for number, row in enumerate(range(first, 20, apart)):
        for column in range(16 - (number % 2) * 2, 1, -4):
            if all((column + i, row + j) in scene.empty for i in (-1, 0, 1) for j in (-1, 0, 1)):
                yield f"bounce block {column},{row}"


def pads(scene: Scene, rng: Random) -> Iterator[str]:
    """Launch pads on floors."""
    runs = [run for run in scene.runs() if run.length >= 3 and run.column < 16]
    rng.shuffle(runs)
    for run in runs[:2]:
        yield f"launch pad {run.column + rng.randint(0, run.length - 1)},{run.row} up"


def one_ways(scene: Scene, _: Random) -> Iterator[str]:
    """One-way platforms over gaps between tiles."""
    for row in range(4, 22):
        for column in range(2, 17):
            wide = 0
            while (column + wide, row) in scene.empty and column + wide < 30:
                wide += 1
            ends = (column - 1, row) in scene.tiles and (column + wide, row) in scene.tiles
            cells = [(column + k, row) for k in range(wide)]
            open_ = all((c, row + k) in scene.empty for c, _ in cells for k in (-2, -1, 1, 2))
            if ends and 2 <= wide <= 5 and open_:
                yield from (f"one-way {c},{row} up" for c, _ in cells)


def place_fixtures(scene: Scene, rng: Random) -> None:
    """Perhaps put one sort of fixtures into a scene, mirrored."""
    kind = rng.choice((blocks, pads, pads, one_ways, one_ways, None))
    for line in kind(scene, rng) if kind else ():
        first = spec(line)
        for record in dict.fromkeys((first, mirror_image(first))):
            point = (record.values[0], record.values[1])
            if len(scene.fixtures) < MOST_FIXTURES and scene.clear_of(point, key=40.0, other=12.0):
                scene.fixtures.append(record)

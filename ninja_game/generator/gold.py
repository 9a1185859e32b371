"""Puts gold into a level, as bait and to suggest movements: around stones, along walls, in bows, in the vault."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from math import cos, dist, sin, tau
from random import Random

from ninja_game.generator.scene import Scene, object_of
from ninja_game.sim.grid import Point, cell_of, middle_of
from ninja_game.sim.rules import CELL

MIN_PIECES = 26  # least pieces in a level
MAX_PIECES = 38  # most pieces; a last group may exceed this
APART = 12.0  # px between two pieces
_FROM_NEEDED = 26.0  # px from ninja, exit and switches
BETWEEN = 3.5 * CELL  # px between the middles of two groups
_OFF = 14.0  # px from the rock

Pattern = Callable[[Scene, Random], Iterator[list[Point]]]


def round_stones(scene: Scene, _: Random) -> Iterator[list[Point]]:
    """Around a small stone, or over it and beside it."""
    small = [stone for stone in scene.stones() if len(stone) <= 25]
    for chain in scene.surfaces:
        inside = {cell_of(*face.out_by(-4.0)) for face in chain}
        if len(chain) <= 20 and any(inside <= piece for piece in small):
            yield points_along([face.out_by(_OFF) for face in chain], 30.0)


def along_walls(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """Along a slope, a wall or a ceiling, or over an edge."""
    for chain in scene.surfaces:
        if len(chain) >= 6:
            first, count = rng.randrange(len(chain) - 4), rng.randint(4, 7)
            part = chain[first : first + count]
            if len({face[2:] for face in part}) > 1:
                yield points_along([face.out_by(_OFF) for face in part], 20.0)


def bows(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """Along the flight from one ledge to another."""
    ends = [middle_of((run.column + k, run.row)) for run in scene.runs() for k in {0, run.length - 1}]
    rng.shuffle(ends)
    for x0, y0 in ends[:12]:
        for x1, y1 in ends:
            width, height = x1 - x0, rng.choice((40, 56, 66))
            if 90 <= abs(width) <= 230 and abs(y1 - y0) <= 60:
                bow = [
                    (x0 + width * t, y0 + (y1 - y0) * t - height * 4 * t * (1 - t))
                    for t in (0.1 + k * 0.02 for k in range(41))
                ]
                if all(scene.sees(a, b) for a, b in pairwise(bow)):
                    yield points_along(bow, 24.0)
                    break


def falls(scene: Scene, _: Random) -> Iterator[list[Point]]:
    """Down the middle of a shaft."""
    for column, row in sorted(scene.reachable):
        shaft = [(column, row + k) for k in range(5)]
        if all(cell in scene.reachable and _is_between_walls(scene, *cell) for cell in shaft):
            x, y = middle_of((column, row))
            yield [(x, y + 22.0 * k) for k in range(5)]


def _is_between_walls(scene: Scene, column: int, row: int) -> bool:
    return all(any((column + side * k, row) not in scene.reachable for k in (1, 2)) for side in (-1, 1))


def hoard(scene: Scene, rng: Random) -> list[Point]:
    """A row or an arch on the floor of the vault, or nothing, since the exit or switch there is enough."""
    (left, y), (right, _) = (
        middle_of(cell) for cell in sorted({scene.board.vault_floor[0], scene.board.vault_floor[-1]})
    )
    count, arch = rng.choice((0, 0, 5, 6, 7)), rng.choice((0, 0, 34))
    half_width = min((right - left) / 2, 12.0 * count)
    row = [((left + right) / 2 + half_width * (2 * k / (count - 1) - 1), k / (count - 1)) for k in range(count)]
    return [point for x, t in row if _fits(scene, point := (x, y + 4 - arch * 4 * t * (1 - t)))]


def gold_rows(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """A few pieces on a floor, the smallest floors first: for a guard, thwump or mine to watch."""
    floors = sorted(scene.runs(), key=lambda run: (run.length > 6, rng.random()))
    for run in floors:
        count = min(run.length, 4)
        if count >= 2:
            x, y = run.middle
            yield [(x + 20.0 * (k - (count - 1) / 2), y + 4.0) for k in range(count)]


def dangers(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """At the spots of the plan, then in open air out of sight of the start, with a danger in the middle."""
    size, start = rng.choice((34, 40, 46)), middle_of(scene.start)
    form = rng.choice((ring, bowl, bowl, cross, sides, sides))
    reach = range(-2, 3)
    air = [
        cell
        for cell in sorted(scene.reachable)
        if all((cell[0] + i, cell[1] + j) in scene.reachable for i in reach for j in reach)
        and scene.is_clear(middle_of(cell), needed=60.0, other=30.0)
    ]
    rng.shuffle(air)
    for x, y in (
        spot
        for spot in scene.board.danger_places
        if scene.is_clear((CELL * spot[0], CELL * spot[1]), needed=9, other=30)
    ):
        yield from (form(CELL * x, CELL * y, far) for far in (size, 28, 22))
    for x, y in sorted(map(middle_of, air), key=lambda at: scene.sees(at, start)):
        yield form(x, y, size)


def ring(x: float, y: float, size: float) -> list[Point]:
    """Points of a circle, more of them on a larger one."""
    count = round(size / 4) + 2
    return [(x + size * cos(k * tau / count), y + size * sin(k * tau / count)) for k in range(count)]


def bowl(x: float, y: float, size: float) -> list[Point]:
    """Points of the lower half of a circle."""
    return [(x + size * cos(k * tau / 14), y + size * sin(k * tau / 14)) for k in range(8)]


def cross(x: float, y: float, size: float) -> list[Point]:
    """Two pieces to each side."""
    return [(x + k * dx, y + k * dy) for dx, dy in ((1, 0), (0, 1), (-1, 0), (0, -1)) for k in (size - 13, size)]


def sides(x: float, y: float, size: float) -> list[Point]:
    """A short column to the left and to the right."""
    return [(x + side * size, y + k) for side in (-1, 1) for k in (-18.0, 0.0, 18.0)]


def points_along(line: list[Point], step: float) -> list[Point]:
    """Points on a line, ``step`` px apart."""
    points, last = [line[0]], line[0]
    for point in line[1:]:
        while (far := dist(last, point)) >= step:
            last = last[0] + (point[0] - last[0]) * step / far, last[1] + (point[1] - last[1]) * step / far
            points.append(last)
    # Around a stone the last point meets the first one again.
    while len(points) > 2 and dist(points[-1], points[0]) < step * 0.75:
        points.pop()
    return points


def lay_gold(scene: Scene, rng: Random) -> bool:
    """Put a few groups of gold into a scene: in the vault, around dangers, then others; tells whether it is enough."""
    count = rng.randint(MIN_PIECES + 2, MAX_PIECES)
    _lay(scene, hoard(scene, rng), count)
    first = (dangers, min(rng.choice((0, 1, 1, 2)), len(scene.board.danger_places) or 1)), (bows, 1)
    for pattern, most in (*first, *((other, 3) for other in rng.sample(PATTERNS, len(PATTERNS)))):
        done = 0
        for group in pattern(scene, rng):
            if done >= most or (len(scene.gold_middles) > 6 and len(scene.gold) > MIN_PIECES):
                break
            both = [group, scene.mirrored_points(group)] if rng.random() < 0.6 else [group]
            laid = sum([_lay(scene, points, count) for points in both])
            done += laid > 0
            if laid and pattern is dangers:
                scene.rings += scene.gold_middles[-laid:]
    return len(scene.gold) >= MIN_PIECES and len(scene.gold_middles) >= 3


PATTERNS: tuple[Pattern, ...] = (round_stones, along_walls, bows, falls, gold_rows)


def _lay(scene: Scene, points: list[Point], count: int) -> bool:
    """Put a group where all of it has room, away from other groups; tells whether there was such a place."""
    if len(scene.gold) >= count or len(points) < 2 or not all(_fits(scene, point) for point in points):
        return False
    centre = sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points)
    if any(dist(centre, other) < BETWEEN for other in scene.gold_middles):
        return False
    scene.gold_middles.append(centre)
    scene.gold += [object_of(f"gold {round(px)},{round(py)}px") for px, py in points]
    return True


def lay_gold_around(scene: Scene, place: Point, rng: Random) -> bool:
    """Put a small group around a place; tells whether there was room."""
    form, size = rng.choice((bowl, cross, sides)), rng.choice((26, 32))
    return _lay(scene, form(*place, size), MAX_PIECES + 8) or _lay(scene, sides(*place, 24), MAX_PIECES + 8)


def lay_trails(scene: Scene, run: Sequence[Point], rng: Random) -> None:
    """Put up to three more groups along flights of a run that passes the level."""
    for _ in range(20):
        first = rng.randrange(40, max(41, len(run) - 60))
        points = points_along(list(run[first : first + rng.randint(30, 50)]), 23.0)
        in_air = all(not scene.can_stand(cell_of(*point)) for point in points[1:-1])
        if in_air and _lay(scene, points[:7], MAX_PIECES + 8) and len(scene.gold_middles) > 10:
            break


def _fits(scene: Scene, point: Point) -> bool:
    return scene.is_clear(point, needed=_FROM_NEEDED, other=APART)

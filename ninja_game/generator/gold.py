"""Gold is bait and draws the movement: round stones, along walls, in bows from ledge to ledge, a hoard in the heart."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise
from math import dist
from random import Random

from ninja_game.generator.scene import Point, Scene, cell_of, middle, places, spec
from ninja_game.sim.rules import CELL

LEAST, MOST = 30, 66
"""Pieces in a level."""
APART, FROM_KEY = 12.0, 26.0
"""px between pieces, and from ninja, exit and switches."""
BETWEEN = 4.0 * CELL
"""px between the middles of two groups."""
OFF = 14.0
"""px from the rock."""

Pattern = Callable[[Scene, Random], Iterator[list[Point]]]


def round_stones(scene: Scene, _: Random) -> Iterator[list[Point]]:
    """Round a small stone, or over and beside it."""
    small = [set(piece) for piece in scene.board.pieces() if len(piece) <= 25]
    for chain in scene.surfaces:
        inside = {cell_of(face.off(-4.0)) for face in chain}
        if len(chain) <= 20 and any(inside <= piece for piece in small):
            yield along([face.off(OFF) for face in chain], 22.0)


def along_walls(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """Along a slope, a wall or a ceiling, or over an edge."""
    for chain in scene.surfaces:
        if len(chain) >= 6:
            first, count = rng.randrange(len(chain) - 4), rng.randint(4, 7)
            part = chain[first : first + count]
            if len({face[2:] for face in part}) > 1:
                yield along([face.off(OFF) for face in part], 20.0)


def bows(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """The flight from one ledge to another."""
    ends = [middle((run.column + k, run.row)) for run in scene.runs() for k in {0, run.length - 1}]
    rng.shuffle(ends)
    for x0, y0 in ends[:12]:
        for x1, y1 in ends:
            wide, high = x1 - x0, rng.choice((40, 56, 66))
            if 90 <= abs(wide) <= 230 and abs(y1 - y0) <= 60:
                bow = [
                    (x0 + wide * t, y0 + (y1 - y0) * t - high * 4 * t * (1 - t))
                    for t in (0.1 + k * 0.02 for k in range(41))
                ]
                if all(scene.sees(a, b) for a, b in pairwise(bow)):
                    yield along(bow, 24.0)
                    break


def falls(scene: Scene, _: Random) -> Iterator[list[Point]]:
    """Down the middle of a shaft."""
    for column, row in sorted(scene.steps):
        shaft = [(column, row + k) for k in range(5)]
        if all(cell in scene.steps and _walled(scene, *cell) for cell in shaft):
            x, y = middle((column, row))
            yield [(x, y + 22.0 * k) for k in range(5)]


def _walled(scene: Scene, column: int, row: int) -> bool:
    return all(any((column + side * k, row) not in scene.steps for k in (1, 2)) for side in (-1, 1))


def hoard(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """A heap on a floor, far from the start: what the level is about."""
    runs = [run for run in scene.runs() if run.length >= 3]
    runs.sort(key=lambda run: (run.column + run.length // 2, run.row) not in scene.board.heart)
    for run in runs:
        (x, y), wide = run.middle, min(2 * run.length - 2, rng.choice((5, 7)))
        if dist(run.middle, middle(scene.start)) >= 7 * CELL:
            rows = ((j, k) for j in range(3) for k in range(wide - 2 * j))
            yield [(x + 13 * (k + j - (wide - 1) / 2), y + 4 - 13 * j) for j, k in rows]


def along(line: list[Point], step: float) -> list[Point]:
    """Points on a line, so many px apart."""
    points, last = [line[0]], line[0]
    for point in line[1:]:
        while (far := dist(last, point)) >= step:
            last = last[0] + (point[0] - last[0]) * step / far, last[1] + (point[1] - last[1]) * step / far
            points.append(last)
    # Round a stone the last one comes to the first again.
    while len(points) > 2 and dist(points[-1], points[0]) < step * 0.75:
        points.pop()
    return points


PATTERNS: tuple[Pattern, ...] = (round_stones, along_walls, bows, falls)


def lay_gold(scene: Scene, rng: Random) -> bool:
    """Put groups of gold of two or three sorts into a scene, most of them on both sides; whether it is enough."""
    wanted = rng.randint(LEAST + 10, MOST - 8)
    stops = [cell_of(point) for record in scene.key for point in places(record)]
    groups = [next(hoard(scene, rng), [])] if rng.random() < 0.6 or scene.board.heart.isdisjoint(stops) else []
    for pattern in rng.sample(PATTERNS, 3):
        some = list(pattern(scene, rng))
        rng.shuffle(some)
        groups += some[: 2 if pattern is bows else 5]
    for group in groups:
        both = [group, scene.twin(group)] if rng.random() < 0.8 else [group]
        for points in both:
            if len(scene.gold) < wanted and len(points) >= 3 and all(_fits(scene, point) for point in points):
                centre = centre_of(points)
                if all(dist(centre, other) >= BETWEEN for other in scene.baits):
                    scene.baits.append(centre)
                    scene.gold += [spec(f"gold {round(px)},{round(py)}px") for px, py in points]
    return LEAST <= len(scene.gold) <= MOST and len(scene.baits) >= 3


def centre_of(points: list[Point]) -> Point:
    """The middle of some points."""
    return sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points)


def _fits(scene: Scene, point: Point) -> bool:
    return scene.clear_of(point, key=FROM_KEY, other=APART)

"""Gold is bait: compact groups on floors, up walls and over jumps, far from each other; hazards come to them later."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import dist
from random import Random

from ninja_game.generator.scene import Cell, Point, Scene, middle, spec
from ninja_game.sim.rules import CELL

LEAST, MOST = 26, 48
"""Pieces in a level."""
APART, FROM_KEY = 12.0, 30.0
"""px between pieces, and from ninja, exit and switches."""
BETWEEN = 5.0 * CELL
"""px between the middles of two groups."""

Pattern = Callable[[Scene, Random], Iterator[list[Point]]]


def blocks(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """Pieces in a block, on a floor."""
    wide, high = rng.choice(((3, 3), (4, 2), (3, 2), (5, 2)))
    for run in scene.runs():
        if run.length >= 2:
            x, y = run.middle
            yield [(x + 12 * (i - (wide - 1) / 2), y + 4 - 12 * j) for j in range(high) for i in range(wide)]


def walls(scene: Scene, _: Random) -> Iterator[list[Point]]:
    """Two columns up a wall."""
    for column, row in sorted(scene.steps):
        for dx in (-1, 1):
            cells: list[Cell] = []
            while (column, row + len(cells)) in scene.steps and scene.full((column + dx, row + len(cells))):
                cells.append((column, row + len(cells)))
            above = (column, row - 1) in scene.steps and scene.full((column + dx, row - 1))
            if len(cells) >= 4 and not above:
                x, y = middle(cells[1])
                yield [(x + dx * (4 - 12 * i), y + 12 * j) for j in range(4) for i in range(2)]


def arcs(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """A bow over a floor, as one jumps."""
    high = rng.choice((48, 60, 72))
    for run in scene.runs():
        if run.length >= 4:
            x, y = run.middle
            yield [(x + 14 * k, y - high + 2 * k * k) for k in range(-3, 4)]


def stones(scene: Scene, _: Random) -> Iterator[list[Point]]:
    """A block on a small stone."""
    for piece in scene.board.pieces():
        if len(piece) <= 14:
            row = min(r for _, r in piece)
            columns = [c for c, r in piece if r == row]
            x = CELL * ((min(columns) + max(columns)) / 2 + 0.5)
            yield [(x + 12 * i, CELL * (row - 0.5) - 12 * j) for j in range(2) for i in (-1, 0, 1)]


def hoards(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """A great heap on a floor, far from the start: what the level is about."""
    wide, high = rng.choice(((5, 3), (4, 4), (6, 2)))
    for run in scene.runs():
        x, y = run.middle
        if run.length >= 4 and dist(run.middle, middle(scene.start)) >= 8 * CELL:
            yield [(x + 12 * (i - (wide - 1) / 2), y + 4 - 12 * j) for j in range(high) for i in range(wide)]


PATTERNS: tuple[Pattern, ...] = (blocks, blocks, walls, arcs, stones)


def lay_gold(scene: Scene, rng: Random) -> bool:
    """Put a hoard and two to five groups of gold into a scene, far from each other; whether it is enough."""
    wanted = rng.randint(LEAST + 2, MOST - 10)
    heaps = list(hoards(scene, rng))
    groups = [group for pattern in PATTERNS for group in pattern(scene, rng)]
    rng.shuffle(heaps)
    rng.shuffle(groups)
    for group in [*heaps, *groups]:
        if len(scene.baits) == 1 and group in heaps:
            continue
        x, y = centre = centre_of(group)
        far = all(dist(centre, other) >= BETWEEN for other in scene.baits)
        if len(scene.gold) < wanted and far and all(_fits(scene, point) for point in group):
            scene.baits.append((x, y))
            scene.gold += [spec(f"gold {round(px)},{round(py)}px") for px, py in group]
    return LEAST <= len(scene.gold) <= MOST


def centre_of(points: list[Point]) -> Point:
    """The middle of some points."""
    return sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points)


def _fits(scene: Scene, point: Point) -> bool:
    return scene.clear_of(point, key=FROM_KEY, other=APART)

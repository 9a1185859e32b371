"""Gold: rows on floors, blocks, lines up the walls, arcs over what one jumps, a piece over each stone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random

from ninja_game.generator.scene import Cell, Point, Scene, middle, spec, with_mirror
from ninja_game.sim.rules import CELL

LEAST, MOST = 26, 48
"""Pieces in a level."""
APART, FROM_KEY = 11.0, 30.0
"""px between pieces, and from ninja, exit and switches."""

Pattern = Callable[[Scene, Random], Iterator[list[Point]]]


def rows(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """Pieces side by side along a floor."""
    step = rng.choice((12, 18, 24))
    for run in scene.runs():
        count = min(9, int((run.length - 1) * CELL // step) + 1)
        x, y = run.middle
        if count >= 3:
            yield [(x + step * (k - (count - 1) / 2), y + 4) for k in range(count)]


def blocks(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """Pieces in a block, on a floor."""
    wide, high = rng.choice(((3, 3), (4, 2), (3, 2), (5, 2)))
    for run in scene.runs():
        if run.length >= 2:
            x, y = run.middle
            yield [(x + 12 * (i - (wide - 1) / 2), y + 4 - 12 * j) for j in range(high) for i in range(wide)]


def walls(scene: Scene, _: Random) -> Iterator[list[Point]]:
    """A line up a wall."""
    for column, row in sorted(scene.steps):
        for dx in (-1, 1):
            cells: list[Cell] = []
            while (column, row + len(cells)) in scene.steps and scene.full((column + dx, row + len(cells))):
                cells.append((column, row + len(cells)))
            above = (column, row - 1) in scene.steps and scene.full((column + dx, row - 1))
            if len(cells) >= 4 and not above:
                # The lowest cell belongs to who stands there.
                yield [(x + 4 * dx, y) for x, y in map(middle, cells[: min(8, len(cells) - 1)])]


def arcs(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """A bow over a floor, as one jumps."""
    high = rng.choice((48, 60, 72))
    for run in scene.runs():
        if run.length >= 4:
            x, y = run.middle
            yield [(x + 22 * k, y - high + 4 * k * k) for k in range(-3, 4)]


def stones(scene: Scene, rng: Random) -> Iterator[list[Point]]:
    """Two or three pieces over a small stone."""
    count = rng.choice((1, 2, 3))
    for piece in scene.board.pieces():
        if len(piece) <= 14:
            row = min(r for _, r in piece)
            columns = [c for c, r in piece if r == row]
            x = CELL * ((min(columns) + max(columns)) / 2 + 0.5)
            yield [(x + 14 * (k - (count - 1) / 2), CELL * (row - 0.5)) for k in range(count)]


PATTERNS: tuple[Pattern, ...] = (rows, blocks, walls, arcs, stones)


def lay_gold(scene: Scene, rng: Random) -> bool:
    """Put gold into a scene, in two or three patterns, mirrored; whether it is enough."""
    wanted = rng.randint(LEAST + 4, MOST - 6)
    order = list(PATTERNS)
    rng.shuffle(order)
    # One pattern is the level's own; the others come after it.
    for number, pattern in enumerate(order):
        groups = list(pattern(scene, rng))
        rng.shuffle(groups)
        share = (0.5, 0.85, 1.0, 1.0, 1.0)[number] * wanted
        for group in groups:
            points = list(dict.fromkeys(point for each in group for point in with_mirror(each)))
            if len(scene.gold) >= share or len(scene.gold) + len(points) > MOST:
                continue
            if group_fits(scene, group):
                _put(scene, points)
    return len(scene.gold) >= LEAST


def group_fits(scene: Scene, group: list[Point]) -> bool:
    """Whether a whole group has room, and some more to other groups."""
    return all(scene.clear_of(point, key=FROM_KEY, other=2 * APART) for point in group)


def _fits(scene: Scene, point: Point) -> bool:
    return scene.clear_of(point, key=FROM_KEY, other=APART)


def _put(scene: Scene, points: list[Point]) -> None:
    fit = [point for point in points if _fits(scene, point)]
    scene.gold += [spec(f"gold {round(x)},{round(y)}px") for x, y in fit]

"""Lines, bent lines and ellipses: the cells that they cover, and places along them."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate, pairwise
from math import cos, dist, hypot, pi, sin

from ninja_game.editor.brush import cells_between
from ninja_game.editor.draft import Cell, cell_of
from ninja_game.editor.specs import Point
from ninja_game.editor.stamp import area_between, cells_of

_PIECES = 64
"""Straight pieces of a curve."""


def curve(shape: str, a: Point, b: Point, bend: float = 0.0) -> list[Point]:
    """Points of a line from a to b, its middle ``bend`` px to the right of it, or of the ellipse in their box, px."""
    (ax, ay), (bx, by) = a, b
    if shape == "ellipse":
        turns = [2 * pi * k / _PIECES - pi / 2 for k in range(_PIECES)]
        points = [((ax + bx + (bx - ax) * cos(t)) / 2, (ay + by + abs(by - ay) * sin(t)) / 2) for t in turns]
        return [*points, points[0]]
    length = hypot(bx - ax, by - ay) or 1.0
    across = (ay - by) / length, (bx - ax) / length
    shares = [k / _PIECES for k in range(_PIECES + 1)] if bend else [0.0, 1.0]
    bends = [4 * bend * share * (1 - share) for share in shares]
    return [
        (ax + (bx - ax) * share + across[0] * aside, ay + (by - ay) * share + across[1] * aside)
        for share, aside in zip(shares, bends, strict=True)
    ]


def spread(path: list[Point], spacing: float) -> list[Point]:
    """Places along a path, evenly and about ``spacing`` px apart, from its first point to its last."""
    lengths = list(accumulate((dist(*ends) for ends in pairwise(path)), initial=0.0))
    count = max(1, round(lengths[-1] / spacing))
    places = []
    for k in range(count + (path[0] != path[-1])):
        at = lengths[-1] * k / count
        n = min(bisect_right(lengths, at), len(path) - 1)
        share = (at - lengths[n - 1]) / ((lengths[n] - lengths[n - 1]) or 1.0)
        (ax, ay), (bx, by) = path[n - 1], path[n]
        places.append((ax + (bx - ax) * share, ay + (by - ay) * share))
    return places


def covered(shape: str, a: Cell, b: Cell, bend: float) -> list[Cell]:
    """The cells of a box or of the ellipse in it, filled, or those of a line."""
    area = area_between(a, b)
    if shape == "line":
        start, end = ((24.0 * column + 12, 24.0 * row + 12) for column, row in (a, b))
        path = [cell_of(*point) for point in curve(shape, start, end, bend)]
        return [cell for ends in pairwise(path) for cell in cells_between(*ends)]
    column, row, columns, rows = area
    x, y = column + (columns - 1) / 2, row + (rows - 1) / 2
    return [
        (i, j) for i, j in cells_of(area) if shape == "rectangle" or hypot((i - x) / columns, (j - y) / rows) <= 0.5
    ]

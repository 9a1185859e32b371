"""Ground plans: each is one figure over the whole screen, with a heart for the exit or its switch."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from ninja_game.generator.scene import MIDDLE, Board, Cell
from ninja_game.sim.level import COLUMNS, ROWS

Layout = Callable[[Board, Random], None]


def octagon(column: int, row: int, wide: int, high: int, cut: int) -> set[Cell]:
    """The cells of an octagon about a cell: half its width and height, and what is cut off its corners, in cells."""
    return {
        (column + dx, row + dy)
        for dx in range(-wide, wide + 1)
        for dy in range(-high, high + 1)
        if abs(dx) + abs(dy) <= wide + high - cut
    }


def room(board: Board, cut: int) -> None:
    """The whole screen as one room, its corners cut off."""
    board.draw(octagon(MIDDLE, 12, COLUMNS, ROWS, 0))
    board.dig(octagon(MIDDLE, 12, 14, 10, cut))


def ledges(board: Board, rng: Random, rows: tuple[int, ...], width: int = 3) -> None:
    """Short shelves at both walls."""
    for row in rows:
        board.fill(1, row + rng.choice((-1, 0, 0, 1)), width, 1)


def rings(board: Board, rng: Random) -> None:
    """A ring in a ring, their gates turned against each other."""
    room(board, rng.choice((3, 5, 6)))
    wide, high = rng.choice(((9, 7), (10, 7), (9, 6)))
    board.draw(octagon(MIDDLE, 12, wide, high, 5) - octagon(MIDDLE, 12, wide - 1, high - 1, 4))
    board.draw(octagon(MIDDLE, 12, 5, 3, 2) - octagon(MIDDLE, 12, 4, 2, 2))
    if rng.random() < 0.5:
        board.clear(MIDDLE - 2, 12 - high, 5, 2)
        board.clear(MIDDLE - 6, 11, 3, 3)
    else:
        board.clear(MIDDLE - wide, 11, 2, 3)
        board.clear(MIDDLE - 1, 8, 3, 3)
    board.clear(MIDDLE - 2, 11 + high, 5, 2)
    ledges(board, rng, (9, 16), 2)
    board.heart = octagon(MIDDLE, 12, 4, 2, 2)


def bowl(board: Board, rng: Random) -> None:
    """Pillars hang into a bowl, their lengths in an arc."""
    room(board, rng.choice((6, 8)))
    board.dig(octagon(MIDDLE, 8, 14, 6, 2))
    first, grow = rng.choice(((4, 3), (6, 2), (11, -2)))
    for i in range(2):
        column, length = 5 + 5 * i, first + grow * i
        board.fill(column, 1, 2, 1 + length)
    board.fill(MIDDLE - 1, 1, 3, rng.choice((6, 9, 11)))
    board.fill(MIDDLE - 2, 20, 5, 3)
    board.fill(8, rng.choice((17, 18)), 3, 1)
    ledges(board, rng, (11,))
    board.heart = {(c, 19) for c in range(MIDDLE - 2, MIDDLE + 3)}


def wheel(board: Board, rng: Random) -> None:
    """Stones on a wheel about a great stone."""
    room(board, rng.choice((5, 7)))
    size = rng.choice((2, 3))
    board.draw(octagon(MIDDLE, 12, size + 1, size, size))
    for column, row in rng.choice((((9, 12), (11, 6), (11, 18)), ((7, 9), (7, 15), (12, 5), (12, 19)))):
        board.draw(octagon(column, row, *rng.choice(((1, 1, 0), (2, 1, 0)))))
    if rng.random() < 0.6:
        board.draw(octagon(MIDDLE, 4, 2, 0, 0))
    ledges(board, rng, (12,))
    board.heart = octagon(MIDDLE, 12 - size - 1, 2, 0, 0)


def shafts(board: Board, rng: Random) -> None:
    """Shafts side by side, joined above and below in turn, each with a danger of its own."""
    board.fill(1, 1, COLUMNS, ROWS)
    top, low = rng.choice((3, 4)), rng.choice((20, 21))
    board.clear(2, top, 4, low - top + 1)
    board.clear(8, top + 1, 3, low - top)
    board.clear(MIDDLE - 3, top, 7, low - top + 1)
    board.clear(2, low - 2, 9, 3)
    board.clear(8, top + 1, 8, 3)
    for row in range(top + 5, low - 4, 5):
        board.fill(rng.choice((2, 4)), row, 2, 1)
    board.fill(MIDDLE - 1, rng.choice((9, 10)), 3, 2)
    board.fill(MIDDLE - 3, 14, 2, 1)
    board.fill(MIDDLE - 2, low - 1, 5, 2)
    board.heart = {(c, low - 2) for c in range(MIDDLE - 2, MIDDLE + 3)}


def pyramid(board: Board, rng: Random) -> None:
    """A hollow pyramid, a smaller one in it."""
    room(board, 2)
    apex = rng.choice((5, 6))
    for row in range(apex, ROWS - 1):
        half = row - apex
        board.fill(MIDDLE - half, row, 2 * half + 1, 1)
        if row > apex + 3:
            board.clear(MIDDLE - half + 3, row, 2 * half - 5, 1)
    board.clear(1, 1, 3, 21)
    for row in range(14, 19):
        board.fill(MIDDLE - (row - 14), row, 2 * (row - 14) + 1, 1)
    board.clear(MIDDLE - 2, 17, 5, 2)
    board.fill(MIDDLE - 5, 19, 11, 1)
    board.clear(MIDDLE - 1, 19 if rng.random() < 0.5 else 14, 3, 1)
    board.clear(4, 20, 8, 3)
    if rng.random() < 0.5:
        board.clear(MIDDLE - 1, apex, 3, 4)
    ledges(board, rng, (8, 14))
    board.heart = {(c, 18) for c in range(MIDDLE - 2, MIDDLE + 3)}


def hourglass(board: Board, rng: Random) -> None:
    """Two wide chambers and the neck between them."""
    room(board, 2)
    neck, waist = rng.choice((2, 3)), rng.choice((11, 12, 13))
    for row in range(1, ROWS + 1):
        left = MIDDLE - neck - abs(row - waist) * 2
        if left > 2:
            board.fill(1, row, left - 1, 1)
    board.draw(octagon(MIDDLE, waist + 4, 1, 1, 0))
    board.draw(octagon(MIDDLE - rng.choice((5, 6)), 19, 2, 1, 0))
    board.draw(octagon(MIDDLE - rng.choice((5, 7)), 5, 2, 0, 0))
    board.fill(MIDDLE - 2, 21, 5, 2)
    board.heart = {(c, 20) for c in range(MIDDLE - 2, MIDDLE + 3)}


def star(board: Board, rng: Random) -> None:
    """A hollow star in the middle, a stone in each quarter."""
    room(board, rng.choice((6, 8)))
    size = rng.choice((6, 7))
    board.draw(octagon(MIDDLE, 12, size, size, size))
    board.draw(octagon(MIDDLE, 12, size + 4, 0, 0))
    board.dig(octagon(MIDDLE, 12, 3, 3, 2))
    if rng.random() < 0.5:
        board.clear(MIDDLE - 1, 4, 3, 7)
    else:
        board.clear(MIDDLE - 1, 13, 3, 7)
        board.fill(MIDDLE - 1, 21, 3, 2)
    for row in (6, 18):
        board.draw(octagon(rng.choice((7, 8)), row, 2, 1, 0))
    ledges(board, rng, (12,), 2)
    board.heart = octagon(MIDDLE, 13, 2, 1, 1)


def tower(board: Board, rng: Random) -> None:
    """A hollow tower with battlements, shelves on both sides of it."""
    room(board, rng.choice((2, 4)))
    half, top = rng.choice((4, 5)), rng.choice((6, 7))
    board.fill(MIDDLE - half, top, 2 * half + 1, ROWS - top)
    board.clear(MIDDLE - half + 1, top + 1, 2 * half - 1, 21 - top)
    for column in range(MIDDLE - half - 1, MIDDLE + 1, 2):
        board.fill(column, top - 1, 1, 1)
    board.clear(MIDDLE - 1, top - 1, 3, 2)
    board.fill(MIDDLE - half, 12, half - 1, 1)
    board.fill(MIDDLE - 1, 17, 3, 1)
    board.clear(MIDDLE - half, rng.choice((9, 14)), 1, 3)
    board.draw(octagon(rng.choice((6, 7)), 10, 2, 1, 0))
    board.draw(octagon(rng.choice((8, 9)), 16, 2, 1, 0))
    ledges(board, rng, (7, 14))
    board.heart = {(c, 21) for c in range(MIDDLE - 2, MIDDLE + 3)}


def galleries(board: Board, rng: Random) -> None:
    """Three long caves over each other, a long stone in each, holes between them."""
    board.fill(1, 1, COLUMNS, ROWS)
    for number, row in enumerate((5, 12, 19)):
        board.dig(octagon(MIDDLE, row, 14, 2, 1))
        board.dig(octagon(rng.choice((8, 9)), row, 3, 3, 1))
        board.draw(octagon(rng.choice((8, 9)) if number % 2 else MIDDLE, row, rng.choice((2, 3)), 0, 0))
    board.clear(rng.choice((3, 4)), 7, 3, 4)
    if rng.random() < 0.5:
        board.clear(MIDDLE - 1, 14, 3, 4)
    else:
        board.clear(6, 14, 3, 4)
        board.fill(3, 17, 2, 1)
    board.clear(MIDDLE - 2, 3, 5, 1)
    board.heart = {(c, 13) for c in range(MIDDLE - 3, MIDDLE + 4)}


def comb(board: Board, rng: Random) -> None:
    """Teeth from above and below, pointed, between each other."""
    room(board, 3)
    first = rng.choice((11, 12, 13))
    for i, column in enumerate((5, 10)):
        down = i % 2 == 0
        length = first - i
        for k in range(length):
            board.fill(
                column if k < length - 1 else column + 1, 2 + k if down else 22 - k, 3 if k < length - 1 else 1, 1
            )
    if rng.random() < 0.5:
        board.fill(MIDDLE - 1, 1, 3, rng.choice((7, 9)))
        board.fill(MIDDLE - 2, 20, 5, 3)
    else:
        board.fill(MIDDLE - 1, 14, 3, 9)
        board.fill(MIDDLE - 3, 6, 7, 1)
    ledges(board, rng, (8, 16), 2)
    board.heart = {(c, r) for c in range(MIDDLE - 2, MIDDLE + 3) for r in (5, 13, 19)}


def eights(board: Board, rng: Random) -> None:
    """Two round chambers with a core each, and the throat between them."""
    board.fill(1, 1, COLUMNS, ROWS)
    board.dig(octagon(8, 12, 6, 9, 4))
    board.dig(octagon(MIDDLE, rng.choice((8, 12, 15)), 4, 2, 0))
    board.clear(MIDDLE - 2, 5, 5, 13)
    core = rng.choice((1, 2))
    board.draw(octagon(8, 8, 2, 1, 0))
    board.draw(octagon(8, 16, core + 1, core, 1))
    board.fill(MIDDLE - 1, rng.choice((9, 10)), 3, rng.choice((2, 4)))
    ledges(board, rng, (12,))
    board.heart = {(c, 17) for c in range(MIDDLE - 2, MIDDLE + 3)}


def diamonds(board: Board, rng: Random) -> None:
    """A field of diamonds about a great one."""
    room(board, rng.choice((4, 7)))
    big = rng.choice((2, 3))
    board.draw(octagon(MIDDLE, 12, big, big, big))
    for column, row in ((12, 6), (12, 18), (7, 9), (7, 15), (9, 12), (5, 4), (5, 20))[rng.choice((0, 1)) :: 1]:
        board.draw(octagon(column, row, 1, 1, 0))
    board.fill(1, 12, 2, 1)
    board.heart = octagon(MIDDLE, 11 - big, 1, 0, 0)


def chambers(board: Board, rng: Random) -> None:
    """Four chambers, a stone in each, doorways between them and a keep in the middle."""
    board.fill(1, 1, COLUMNS, ROWS)
    for row, high in ((7, 4), (17, 4)):
        board.dig(octagon(8, row, 6, high, 3))
        board.draw(octagon(8, row, *rng.choice(((1, 1, 0), (2, 1, 0)))))
    board.clear(6, 10, 5, 4)
    board.dig(octagon(MIDDLE, 7, 3, 1, 0))
    board.dig(octagon(MIDDLE, 17, 3, 2, 0))
    board.clear(MIDDLE - 2, 10, 5, 4)
    if rng.random() < 0.5:
        board.clear(MIDDLE - 1, 7, 3, 9)
    else:
        board.clear(MIDDLE - 3, 11, 7, 3)
        board.clear(11, 11, 2, 2)
    board.heart = {(c, 13) for c in range(MIDDLE - 2, MIDDLE + 3)}


def hive(board: Board, rng: Random) -> None:
    """Seven cells of a comb, with openings where they touch."""
    board.fill(1, 1, COLUMNS, ROWS)
    for column, row in ((6, 7), (6, 17), (MIDDLE, 12), (MIDDLE, 4), (MIDDLE, 20)):
        board.dig(octagon(column, row, 4, 3 if column == MIDDLE and row != 12 else 4, 2))
    board.clear(9, 8, 5, 3)
    board.clear(9, 14, 5, 3)
    board.clear(5, 10, 3, 4)
    if rng.random() < 0.5:
        board.clear(MIDDLE - 1, 6, 3, 3)
    else:
        board.clear(10, 4, 3, 3)
    board.clear(MIDDLE - 1, 15, 3, 3)
    board.draw(octagon(6, rng.choice((6, 7)), 1, 0, 0))
    board.draw(octagon(6, 17, 1, 1, 0))
    board.draw(octagon(MIDDLE, 13, 2, 0, 0))
    board.heart = octagon(MIDDLE, 12, 2, 0, 0)


def castle(board: Board, rng: Random) -> None:
    """Towers of different heights and a gate in the middle."""
    room(board, rng.choice((5, 8)))
    high, low = rng.choice((13, 15)), rng.choice((7, 9))
    board.fill(9, ROWS - high, 4, high)
    board.fill(4, ROWS - low, 3, low)
    for column, top in ((9, high), (12, high)):
        board.fill(column, ROWS - top - 1, 1, 1)
    board.fill(12, ROWS - 9, MIDDLE - 11, 3)
    board.clear(10, 15, 2, 3)
    board.clear(9, 18, 4, rng.choice((3, 4)))
    board.clear(7, 20, 3, 2)
    board.fill(12, 20, 1, 3)
    board.draw(octagon(MIDDLE, rng.choice((6, 8)), 2, 1, 0))
    ledges(board, rng, (8,))
    board.heart = {(c, 22) for c in range(MIDDLE - 2, MIDDLE + 3)}


LAYOUTS: dict[str, Layout] = {
    "rings": rings, "bowl": bowl, "wheel": wheel, "shafts": shafts, "pyramid": pyramid, "hourglass": hourglass,
    "star": star, "tower": tower, "galleries": galleries, "comb": comb, "eights": eights, "diamonds": diamonds,
    "chambers": chambers, "hive": hive, "castle": castle,
}  # fmt: skip
"""The ground plans by name."""

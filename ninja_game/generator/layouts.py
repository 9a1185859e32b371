"""Ground plans: each draws the strong shape of a level, its left half and the middle; the board mirrors it."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from ninja_game.generator.scene import MIDDLE, Board, mirrored
from ninja_game.sim.level import COLUMNS, ROWS

Layout = Callable[[Board, Random], None]


def frame(board: Board, rng: Random) -> None:
    """What the room is like at its edges: plain, with thick walls, corners cut off, or steps."""
    board.fill(1, ROWS, COLUMNS, 1)
    kind = rng.choice(("plain", "walls", "cut", "cut", "steps", "beam"))
    if kind == "walls":
        board.fill(1, 1, rng.choice((1, 2)), ROWS)
    elif kind in ("cut", "steps"):
        size, step = rng.choice((2, 3, 4)), 1 if kind == "cut" else 2
        for i in range(size):
            wide = (size - i) * step
            board.fill(1, 1 + i, wide, 1)
            if kind == "cut":
                board.fill(1, ROWS - 1 - i, wide, 1)
    elif kind == "beam":
        board.fill(1, 1, COLUMNS, 1)
        board.fill(rng.randint(4, 9), 2, 3, 1)


def terraces(board: Board, rng: Random) -> None:
    """Stands rise to both sides; islands float between them."""
    steps, rise = rng.choice((3, 4)), rng.choice((2, 3, 4))
    wide = rng.choice((2, 3))
    for i in range(steps):
        board.fill(1, ROWS - rise * (i + 1), wide * (steps - i), rise)
    top = ROWS - rise * steps
    for row in range(max(4, top - 2), ROWS - 4, 5):
        width = rng.choice((3, 5, 7))
        board.fill(MIDDLE - width // 2, row, width, rng.choice((1, 2)))
    board.fill(rng.randint(6, 9), max(3, top - 4), 4, 1)


def pillars(board: Board, rng: Random) -> None:
    """Columns in a row, hanging, standing or floating, their lengths in an arc."""
    kind = rng.choice(("hanging", "alternate", "floating"))
    first, grow = rng.randint(6, 9), rng.choice((-2, 2, 3))
    for i in range(3):
        column, length = 4 + 4 * i, first + grow * i
        top = 3 + (ROWS - length - 5) // 2
        if kind == "hanging" or (kind == "alternate" and i % 2 == 0):
            top = 1
        elif kind == "alternate":
            top = ROWS - length
        board.fill(column, top, 2, length)
    width = rng.choice((1, 3, 5))
    board.fill(MIDDLE - width // 2, rng.randint(11, 14), width, rng.choice((2, 3)))
    board.fill(1, rng.randint(6, 15), 2, 1)


def islands(board: Board, rng: Random) -> None:
    """Stones in staggered rows."""
    width, height = rng.choice(((3, 2), (4, 1), (3, 1), (2, 2), (5, 1)))
    apart = width + rng.choice((3, 4))
    for number, row in enumerate(range(5, ROWS - 3, rng.choice((4, 5)))):
        if number % 2:
            board.fill(MIDDLE - width // 2, row, width, height)
        shift = apart if number % 2 else apart // 2 + 1
        for column in range(MIDDLE - shift - width // 2, 0, -apart):
            board.fill(column, row, width, height)
    board.fill(1, rng.randint(9, 16), 3, 2)


def ring(board: Board, rng: Random) -> None:
    """A great ring with gates, and something in its heart."""
    outer, thick = rng.choice((8, 9)), 2
    row = 11
    for c in range(1, MIDDLE + 1):
        for r in range(1, ROWS):
            dx, dy = abs(c - MIDDLE), abs(r - row)
            far = max(dx, dy, (dx + dy) * (0.72 if outer == 8 else 0.7))
            if outer - thick < far <= outer:
                board.fill(c, r, 1, 1)
    for gate in rng.sample(("top", "sides", "bottom", "shoulders"), 2):
        if gate == "top":
            board.clear(MIDDLE - 2, 1, 5, 5)
        elif gate == "bottom":
            board.clear(MIDDLE - 2, row + outer - thick, 5, 3)
        elif gate == "sides":
            board.clear(MIDDLE - outer, row - 1, 3, 3)
        else:
            board.clear(MIDDLE - outer, row - outer, 5, 5)
    width = rng.choice((3, 5))
    board.fill(MIDDLE - width // 2, row, width, rng.choice((1, 2, 3)))
    board.fill(MIDDLE - outer + 3, row + 3, 3, 1)
    board.fill(1, rng.randint(7, 10), 3, 1)
    board.fill(1, ROWS - 4, 4, 4)


def storeys(board: Board, rng: Random) -> None:
    """Floors over each other with gaps in the middle and at the sides in turn."""
    thick, apart = rng.choice(((1, 5), (2, 5), (2, 6), (1, 4)))
    for number, row in enumerate(range(ROWS - apart, 3, -apart)):
        gap = rng.choice((3, 4))
        if number % 2:
            board.fill(1 + gap, row, COLUMNS - 2 * gap, thick)
        else:
            board.fill(1, row, MIDDLE - 1 - gap // 2 - 1, thick)
        if rng.random() < 0.8 and apart > 4:
            column = rng.randint(5, 11)
            board.fill(column, row - 1, rng.choice((2, 3)), 1)
            board.fill(rng.randint(5, 11), row + thick, 2, 1)


def temple(board: Board, rng: Random) -> None:
    """A roof on columns over a stepped base."""
    half = rng.choice((9, 10, 11))
    roof = rng.choice((4, 5))
    for i in range(3):
        board.fill(MIDDLE - half + 3 * i, roof + 2 - i, 2 * (half - 3 * i) + 1, 1)
    for i in range(rng.choice((2, 3))):
        board.fill(MIDDLE - half - 1 + 2 * i, ROWS - 1 - i, 2 * (half + 1 - 2 * i) + 1, 1)
    apart = rng.choice((4, 5))
    for column in range(MIDDLE - half + 1, MIDDLE - 2, apart):
        length = ROWS - roof - 9 - rng.choice((0, 1))
        board.fill(column, roof + 3, 2, length)
    altar = rng.choice((1, 3))
    board.fill(MIDDLE - altar // 2 - 1, 12, altar + 2, 1)
    board.fill(1, rng.randint(10, 13), 2, 1)


def cross(board: Board, rng: Random) -> None:
    """Arms around an open heart, shelves in the four quarters."""
    long, gap, row = rng.choice((8, 9, 10)), rng.choice((2, 3)), 12
    board.fill(MIDDLE - gap - long, row + gap, long, 2)
    board.fill(MIDDLE - gap - long, row - gap - 1, long, 2)
    board.fill(MIDDLE - gap - 1, row - gap - 6, 2, 6)
    board.fill(MIDDLE - gap - 1, row + gap + 1, 2, 4)
    rising = rng.random() < 0.5
    for i in range(3):
        board.fill(2 + 3 * i, 5 + i if rising else 7 - i, 2, 2)
    board.fill(1, rng.randint(17, 19), 3, 1)
    board.clear(MIDDLE - 1, 1, 3, ROWS - 1)


def orbits(board: Board, rng: Random) -> None:
    """Single stones on rings about the middle, each with its slope or curve to the heart."""
    tiles = rng.choice(("sawq", "KJIU", "qwas", "IUKJ"))
    for column, row in ((0, 9), (4, 8), (7, 6), (9, 3), (10, 0), (0, 5), (3, 4), (5, 2), (6, 0)):
        for dy in {row, -row}:
            cell = MIDDLE - column, 11 + dy
            for each in {cell, mirrored(cell)}:
                number = (each[0] > MIDDLE) + 2 * (dy > 0)
                board.fill(*each, 1, 1, one_sided=True)
                if column and row:
                    board.stones[each] = tiles[number]
    board.fill(MIDDLE - 1, 10, 3, 3)
    board.fill(1, 1, 2, rng.randint(6, 9))
    board.fill(1, 15, 3, 9)
    board.fill(1, 21, 8, 2)


def funnel(board: Board, rng: Random) -> None:
    """Walls that close in downwards, with shelves in them."""
    start, wide = rng.choice((6, 8, 9)), rng.choice((9, 10, 11))
    for row in range(start, ROWS + 1):
        board.fill(1, row, min(wide, row - start + 1), 1)
    for row in range(start + 3, ROWS - 3, 4):
        board.clear(max(1, row - start - 3), row - 2, 8, 3)
    for i, row in enumerate((5, 9, 13, 17)):
        width = (3, 5, 3, 1)[i] + rng.choice((0, 2))
        if rng.random() < 0.75:
            board.fill(MIDDLE - width // 2, row, width, rng.choice((1, 2)))


def arches(board: Board, rng: Random) -> None:
    """Gates beside each other: two legs and a bow."""
    high = rng.choice((7, 9, 11))
    inner = rng.choice((2, 3))
    column = MIDDLE - (inner + 4) // 2
    tops = [ROWS - 4 - high, ROWS - 4 - high + rng.choice((-3, 3, 4))]
    for number in range(2):
        left = column - number * (inner + 7)
        top = max(3, tops[number])
        width = inner + 4 + (inner + 4 + 1) % 2 if number == 0 else inner + 4
        board.fill(left, top, width, ROWS - 3 - top)
        board.clear(left + 2, top + 2, width - 4, ROWS)
        board.fill(left, ROWS, width, 1)
    board.fill(1, rng.randint(5, 9), 2, 1)
    board.fill(MIDDLE - 2, ROWS - 1, 5, 1)


def valley(board: Board, rng: Random) -> None:
    """Hills below and a rock ceiling above, stones between."""
    low, high = rng.randint(2, 4), rng.randint(1, 3)
    column = 1
    while column <= MIDDLE:
        width = min(rng.randint(2, 4), MIDDLE + 1 - column)
        low = max(1, min(8, low + rng.choice((-3, -2, -1, 2, 3))))
        high = max(1, min(5, high + rng.choice((-2, -1, 1, 2))))
        board.fill(column, ROWS + 1 - low, width, low)
        board.fill(column, 1, width, high)
        column += width
    for row, width in ((9, 3), (13, 5)):
        board.fill(rng.randint(4, 9), row, width, rng.choice((1, 2)))
    board.fill(MIDDLE - 1, rng.randint(8, 12), 3, 2)


def chevrons(board: Board, rng: Random) -> None:
    """Bars that lean to the middle, over each other."""
    down = rng.random() < 0.5
    long = rng.choice((5, 6))
    for row in range(4, ROWS - long - 1, rng.choice((5, 6))):
        for i in range(long):
            board.fill(MIDDLE - 4 - i if down else MIDDLE - 4 - long + i, row + i, 2, 1)
    board.fill(1, rng.randint(7, 9), 3, 1)
    board.fill(1, rng.randint(14, 16), 3, 2)
    width = rng.choice((1, 3))
    for row in (6, 12, 18):
        board.fill(MIDDLE - width // 2, row, width, 1)


def rooms(board: Board, rng: Random) -> None:
    """Rooms in two or three storeys, with doorways and hatches between them."""
    walls, floors = rng.choice(((8, 13), (6, 11), (7, 12))), (8, 16)
    for row in floors:
        board.fill(1, row, COLUMNS, 1)
        hatch = rng.randint(2, walls[0] - 4)
        board.clear(hatch if rng.random() < 0.6 else walls[0] + 2, row, 3, 1)
        if rng.random() < 0.5:
            board.clear(MIDDLE - 1, row, 3, 1)
    for number, top in enumerate((1, 9, 17)):
        wall = walls[number % 2]
        board.fill(wall, top, 1, 7)
        board.clear(wall, top + rng.choice((2, 3, 3)), 1, 3)
        board.fill(min(wall + rng.choice((2, 3, 4)), MIDDLE - 1), top + 4, 3, 1)
        board.fill(1, top + 3, 2, 1)


LAYOUTS: dict[str, Layout] = {
    "terraces": terraces, "pillars": pillars, "islands": islands, "ring": ring, "storeys": storeys, "temple": temple,
    "cross": cross, "orbits": orbits, "funnel": funnel, "arches": arches, "valley": valley, "chevrons": chevrons,
    "rooms": rooms,
}  # fmt: skip
"""The ground plans by name."""

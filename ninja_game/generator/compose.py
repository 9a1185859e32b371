"""One attempt at a level: ground plan, tiles, ninja and exit, gold, enemies, mines - or nothing, if it does not fit."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import dist
from random import Random
from typing import NamedTuple

from ninja_game.generator.gold import lay_gold
from ninja_game.generator.layouts import LAYOUTS, frame
from ninja_game.generator.obstacles import MOST_OBJECTS, place_enemies, place_fixtures, place_mines
from ninja_game.generator.scene import MIDDLE, Board, Cell, Scene, mirrored, spec, steps_from
from ninja_game.generator.shaping import chosen_style
from ninja_game.levels.warnings import level_findings
from ninja_game.sim.level import COLUMNS, ROWS, TILES

CHOICES = 24
"""Routes of which the best is taken."""
CLOSE = 6.0
"""Cells that are at least between any two of ninja, switches and exit."""


class Niche(NamedTuple):
    """A place for the exit behind locked doors: the exit's cell, cells with a door, the side of these."""

    exit: Cell
    doors: tuple[Cell, ...]
    side: str


def place_route(board: Board, tiles: dict[Cell, str], niche: Niche | None, rng: Random, *, far: float) -> Scene | None:
    """A scene with ninja, exit and doors, the way over all switches about ``far`` cells long; None if it cannot be."""
    bare = Scene(board, tiles, (0, 0))
    bare.steps = dict.fromkeys(bare.empty, 0)
    floor = [cell for cell in sorted(bare.empty) if bare.stands(cell) and not _in_niche(cell, niche)]
    if len(floor) < 12:
        return None
    best: tuple[float, list[Cell]] | None = None
    for _ in range(CHOICES):
        start = rng.choice(floor)
        axis = [cell for cell in floor if cell[0] == MIDDLE]
        ends = [niche.exit] if niche else [*floor, *axis * 4, *[mirrored(start)] * 8]
        exit_ = rng.choice([cell for cell in ends if niche or cell in floor])
        switches = [rng.choice(floor) for _ in range(1 + (len(niche.doors) if niche else 0))]
        stops = [start, *switches, exit_]
        worth = _worth(stops, bare.empty, far)
        if worth is not None and (best is None or worth > best[0]):
            best = worth, stops
    if best is None:
        return None
    start, *switches, exit_ = best[1]
    scene = Scene(board, tiles, start)
    # Now and then one has to jump for a switch.
    places = [f"{c},{r - 1 if rng.random() < 0.3 else r}" for c, r in switches]
    scene.key = [spec(f"ninja {start[0]},{start[1]}"), spec(f"exit {exit_[0]},{exit_[1]} switch {places[0]}")]
    if niche:
        doors = zip(niche.doors, places[1:], strict=True)
        scene.key += [spec(f"locked door {c},{r} {niche.side} switch {place}") for (c, r), place in doors]
    return scene


def _in_niche(cell: Cell, niche: Niche | None) -> bool:
    return niche is not None and cell[1] == niche.exit[1] and abs(cell[0] - niche.exit[0]) <= 4


def _worth(stops: Sequence[Cell], empty: set[Cell], far: float) -> float | None:
    """How well a route would do; None for one that cannot be walked, or with things too close together."""
    if min(dist(a, b) for number, a in enumerate(stops) for b in stops[:number]) < CLOSE:
        return None
    way = 0
    for a, b in pairwise(stops):
        steps = steps_from(a, empty)
        if b not in steps:
            return None
        way += steps[b]
    start, exit_ = stops[0], stops[-1]
    height = max(row for _, row in stops) - min(row for _, row in stops)
    composed = (MIDDLE in (exit_[0], start[0])) + (exit_ == mirrored(start))
    return 4.0 * composed + min(height, 14) - abs(way - far)


SOLID = 0.13, 0.37
SHAPES = 20, 73
MIRROR = 0.73
OBJECTS = 50, MOST_OBJECTS
"""What levels keep to: shares of the cells, tiles with a shape, objects (the quartiles of N's own levels)."""


def compose(layout: str, rng: Random, difficulty: int) -> Scene | None:
    """A level that keeps to all marks and has nothing odd; None if this attempt does not."""
    board = Board()
    frame(board, rng)
    LAYOUTS[layout](board, rng)
    _break_symmetry(board, rng)
    niche = _niche(board, rng) if rng.random() < 0.4 else None
    tiles = chosen_style(board, rng, *SHAPES)
    if tiles is None or not SOLID[0] <= len(tiles) / TILES <= SOLID[1] or _mirror_share(tiles) < MIRROR:
        return None
    scene = place_route(board, tiles, niche, rng, far=22 + 3 * difficulty)
    if scene is None:
        return None
    place_fixtures(scene, rng)
    if not lay_gold(scene, rng):
        return None
    if not place_enemies(scene, rng, rng.choice((3, 4, 4)) + difficulty // 3, difficulty):
        return None
    place_mines(scene, rng, rng.choice((4, 6, 8)) + difficulty // 2)
    if not OBJECTS[0] <= len(scene.objects) <= OBJECTS[1] or level_findings(scene.level):
        return None
    return scene


def _mirror_share(tiles: dict[Cell, str]) -> float:
    cells = [(c, r) for c in range(1, COLUMNS + 1) for r in range(1, ROWS + 1)]
    return sum((cell in tiles) == (mirrored(cell) in tiles) for cell in cells) / TILES


def _break_symmetry(board: Board, rng: Random) -> None:
    """Once: a stone is missing at one side, or a ledge is there; or the plan stays as it is."""
    kind = rng.choice(("missing", "ledge", "ledge", "none"))
    if kind == "missing":
        stones = [piece for piece in board.pieces() if len(piece) <= 12 and all(c > MIDDLE for c, _ in piece)]
        if stones:
            gone = rng.choice(stones)
            board.cells -= set(gone)
            for cell in gone:
                board.stones.pop(cell, None)
    elif kind == "ledge":
        for _ in range(20):
            column, row, width = rng.randint(2, 26), rng.randint(5, 18), rng.choice((3, 4, 5))
            if board.free(column - 2, row - 3, width + 4, 7):
                board.fill(column, row, width, rng.choice((1, 1, 2)), one_sided=True)
                return


def _niche(board: Board, rng: Random) -> Niche | None:
    """A low roof beside a wall, over the exit, for one or two doors; None if there is no place for it."""
    doors = rng.choice((1, 2, 2))
    found = []
    for column in range(1, COLUMNS - doors - 3):
        for row in range(4, ROWS + 1):
            wide = doors + 4
            floor = all(board.solid((column + k, row + 1)) for k in range(wide))
            if floor and board.solid((column - 1, row)) and board.free(column, row - 3, wide, 4):
                found.append((column, row))
    if not found:
        return None
    column, row = rng.choice(found)
    right = rng.random() < 0.5 and _mirrored_too(board, column, row, doors + 4)
    cells = [(column + k, row) for k in range(doors)]
    roof = [(column + k, row - 1) for k in range(doors + 1)]
    if right:
        cells, roof = [mirrored(cell) for cell in cells], [mirrored(cell) for cell in roof]
    board.cells |= set(roof)
    exit_ = mirrored((column, row)) if right else (column, row)
    return Niche(exit_, tuple(cells), "left" if right else "right")


def _mirrored_too(board: Board, column: int, row: int, wide: int) -> bool:
    """Whether the mirrored place is as free."""
    left = COLUMNS + 1 - (column + wide - 1)
    floor = all(board.solid((left + k, row + 1)) for k in range(wide))
    return floor and board.solid((left + wide, row)) and board.free(left, row - 3, wide, 4)

"""One attempt at a level: a ground plan, tiles, the way, gold as bait, hazards round it - or nothing."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import dist
from random import Random
from typing import NamedTuple

from ninja_game.generator.gold import lay_gold
from ninja_game.generator.layouts import LAYOUTS
from ninja_game.generator.obstacles import MOST_OBJECTS, place_enemies, place_fixtures, place_mines
from ninja_game.generator.scene import Board, Cell, Scene, mirrored, spec, steps_from
from ninja_game.generator.shaping import chosen_style
from ninja_game.levels.warnings import level_findings
from ninja_game.runs.run import run_level
from ninja_game.sim.inputs import Input
from ninja_game.sim.level import COLUMNS, ROWS, TILES, Level
from ninja_game.sim.rules import TICKS_PER_SECOND

CHOICES = 96
"""Routes of which the best is taken."""
CLOSE = 4.0
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
    heart = [cell for cell in floor if cell in board.heart]
    best: tuple[float, list[Cell]] | None = None
    for _ in range(CHOICES):
        start = rng.choice(floor)
        exit_ = niche.exit if niche else rng.choice([*floor, *heart * 4])
        switches = [rng.choice(floor) for _ in range(1 + (len(niche.doors) if niche else 0))]
        stops = [start, *switches, exit_]
        worth = _worth(stops, bare.empty, far, board.heart)
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


def _worth(stops: Sequence[Cell], empty: set[Cell], far: float, heart: set[Cell]) -> float | None:
    """How well a route would do; None for one that cannot be walked, or with things too close together."""
    spread = min(dist(a, b) for number, a in enumerate(stops) for b in stops[:number])
    if spread < CLOSE:
        return None
    way = 0
    for a, b in pairwise(stops):
        steps = steps_from(a, empty)
        if b not in steps:
            return None
        way += steps[b]
    width = max(column for column, _ in stops) - min(column for column, _ in stops)
    height = max(row for _, row in stops) - min(row for _, row in stops)
    told = 12.0 if stops[-1] in heart else 6.0 if not heart.isdisjoint(stops[1:]) else 0.0
    return told - 20.0 * (stops[0] in heart) + min(spread, 12.0) + min(height, 14) / 2 + width / 2 - abs(way - far) / 2


SOLID = 0.13, 0.5
SHAPES = 20, 110
OBJECTS = 62, MOST_OBJECTS
"""What levels keep to: shares of the cells, tiles with a shape, objects."""


def compose(layout: str, rng: Random, difficulty: int) -> Scene | None:
    """A level of a ground plan that keeps to all marks and has nothing odd; None if this attempt does not."""
    board = Board()
    LAYOUTS[layout](board, rng)
    _break_symmetry(board, rng)
    niche = _niche(board, rng) if rng.random() < 0.6 else None
    tiles = chosen_style(board, rng, *SHAPES)
    if tiles is None or not SOLID[0] <= len(tiles) / TILES <= SOLID[1]:
        return None
    scene = place_route(board, tiles, niche, rng, far=36 + 4 * difficulty)
    if scene is None:
        return None
    place_fixtures(scene, rng)
    if not lay_gold(scene, rng):
        return None
    if not place_enemies(scene, rng, rng.choice((5, 6, 7)) + difficulty // 4, difficulty):
        return None
    place_mines(scene, rng, rng.choice((14, 18, 22)) + difficulty)
    if not OBJECTS[0] <= len(scene.objects) <= OBJECTS[1] or level_findings(scene.level) or not _fair(scene.level):
        return None
    return scene


def _break_symmetry(board: Board, rng: Random) -> None:
    """One side has a shelf that the other one has not."""
    row, wide, high = rng.randint(6, 18), rng.randint(4, 7), rng.choice((1, 1, 2))
    shelf = {(column, row + k) for column in range(1, wide + 1) for k in range(high)}
    board.cells |= {mirrored(cell) for cell in shelf} if rng.random() < 0.5 else shelf


def _fair(level: Level) -> bool:
    """Whether who stands still for ten seconds, or runs a second to either side, is alive."""
    openings = bytes(10 * TICKS_PER_SECOND), *(bytes([key] * TICKS_PER_SECOND) for key in (Input.LEFT, Input.RIGHT))
    return all(run_level(level, inputs, memory="plain").outcome != "dead" for inputs in openings)


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

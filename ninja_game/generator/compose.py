"""One attempt at a level: a ground plan, its tiles, the route, gold as bait, hazards around it. It may fail."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import pairwise
from math import dist
from random import Random

from ninja_game.generator.gold import lay_gold
from ninja_game.generator.layouts import LAYOUTS
from ninja_game.generator.obstacles import MAX_OBJECTS, fill_voids, place_enemies, place_fixtures, place_mines
from ninja_game.generator.scene import RockBoard, Scene, flood, mirrored, object_of, steps_from
from ninja_game.generator.shaping import shaped
from ninja_game.levels.lint import level_findings
from ninja_game.runs.run import run_level
from ninja_game.sim.grid import Cell
from ninja_game.sim.inputs import Input
from ninja_game.sim.level import TILES, Level
from ninja_game.sim.rules import TICKS_PER_SECOND

_CHOICES = 96  # number of routes from which the best is taken
CLOSE_CELLS = 4.0  # least distance between any two of ninja, switches and exit
BESIDE_CELLS = 5.0, 11.0  # best distance between start and exit: near, but not beside each other


def place_route(board: RockBoard, tiles: dict[Cell, str], rng: Random, *, far: float) -> Scene | None:
    """Make a scene with ninja, exit and doors, the way over all switches about ``far`` cells long; None if impossible.

    The exit is in the vault behind one or two locked doors; or the switch is in the vault and the exit near the start.
    """
    bare = Scene(board, tiles, board.vault_floor[0])
    inner = flood(board.vault_floor[0], bare.empty - set(board.gate))
    outside = bare.reachable.keys() - inner - set(board.gate)
    floor = [(c, r) for c, r in sorted(outside) if (c, r + 1) not in bare.empty and (c, r - 1) in bare.empty]
    hidden, locks = rng.random() < 0.65, rng.choice((1, 2, 2))
    locks = locks if hidden else rng.choice((0, 1))
    locks = locks if len(inner) <= 70 else 0
    vault = board.vault_floor[len(board.vault_floor) // 2]
    if len(floor) < 12 or vault not in inner:
        return None
    steps = cache(lambda first: steps_from(first, bare.empty))
    best: tuple[float, list[Cell]] | None = None
    for _ in range(_CHOICES):
        key = rng.choice(floor)
        # The second place is the mirror image of the first, if the ninja can stand there.
        errands = [key, *([mirrored(key)] if mirrored(key) in floor else []), *rng.sample(floor, 3)]
        stops = [rng.choice(floor), *errands[: locks + hidden], vault, *([] if hidden else [rng.choice(floor)])]
        score = _route_score(stops, steps, far)
        if score is not None and (best is None or score > best[0]):
            best = score, stops
    if best is None:
        return None
    start, *keys, exit_ = best[1]
    switch = keys.pop()
    scene = Scene(board, tiles, start)
    # Sometimes the ninja must jump to reach a switch.
    places = [f"{c},{r - 1 if rng.random() < 0.3 else r}" for c, r in (switch, *keys)]
    needed = f"ninja {start[0]},{start[1]}", f"exit {exit_[0]},{exit_[1]} switch {places[0]}"
    scene.needed = [object_of(record) for record in needed]
    for number, place in enumerate(places[1:]):
        for c, r in board.gate[number * board.doors : (number + 1) * board.doors]:
            scene.needed.append(object_of(f"locked door {c},{r} {board.side} switch {place}"))
    return scene


def _route_score(stops: Sequence[Cell], steps: Callable[[Cell], Mapping[Cell, int]], far: float) -> float | None:
    """Rate a route; None if the ninja cannot walk it, or if its places are too close together.

    ``steps``: gives the distances from a cell to all cells in reach; it is asked for every second stop, since a way is
    as long in both directions.
    """
    spread = min(dist(a, b) for number, a in enumerate(stops) for b in stops[:number])
    if spread < CLOSE_CELLS:
        return None
    walked = 0
    for number, pair in enumerate(pairwise(stops)):
        there = steps(pair[1 - number % 2]).get(pair[number % 2])
        if there is None:
            return None
        walked += there
    width = max(column for column, _ in stops) - min(column for column, _ in stops)
    height = max(row for _, row in stops) - min(row for _, row in stops)
    near = dist(stops[0], stops[-1])
    apart = max(BESIDE_CELLS[0] - near, near - BESIDE_CELLS[1], 0.0)
    even = sum(mirrored(a) in stops for a in stops[1:-1])
    return even * 2 + min(spread, 10.0) + min(height, 14) / 2 + width / 2 - apart - abs(walked - far) / 3


_SOLID = 0.13, 0.64
_SHAPES = 20, 190
OBJECTS = 50, MAX_OBJECTS  # limits of a level: shares of the cells, tiles with a shape, objects
_ENEMIES, _MINES = (6, 7, 8), (20, 24, 28)  # numbers to choose from; a hard level has up to two enemies more


def compose(layout: str, rng: Random, difficulty: int) -> Scene | None:
    """Make a level of a ground plan that keeps to all limits and has no oddities; None if this attempt fails."""
    board = RockBoard(rng.choice((1, 2, 2, 3)))
    LAYOUTS[layout](board, rng)
    if rng.random() < 0.5:
        board.open_roof(rng)
    board.fill(rng)
    if rng.random() < 0.5:
        board.flip()
    tiles = shaped(board.ink, even=board.even)
    if not _SOLID[0] <= len(tiles) / TILES <= _SOLID[1]:
        return None
    if not _SHAPES[0] <= sum(tile != "#" for tile in tiles.values()) <= _SHAPES[1]:
        return None
    scene = place_route(board, tiles, rng, far=40 + 4 * difficulty)
    if scene is None:
        return None
    place_fixtures(scene, rng)
    if not lay_gold(scene, rng):
        return None
    if not place_enemies(scene, rng, rng.choice(_ENEMIES) + difficulty // 4, difficulty):
        return None
    place_mines(scene, rng, rng.choice(_MINES))
    fill_voids(scene, rng, difficulty)
    if not OBJECTS[0] <= len(scene.objects) <= OBJECTS[1] or level_findings(scene.level) or not _is_fair(scene.level):
        return None
    return scene


def _is_fair(level: Level) -> bool:
    """Whether a ninja lives that stands still for ten seconds, or runs for a second to either side."""
    openings = bytes(10 * TICKS_PER_SECOND), *(bytes([key] * TICKS_PER_SECOND) for key in (Input.LEFT, Input.RIGHT))
    return all(run_level(level, inputs, memory="plain").outcome != "dead" for inputs in openings)

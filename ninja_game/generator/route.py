"""Where a level begins and ends: ninja, exit and switches, far enough from each other, in line with the symmetry."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import dist
from random import Random
from typing import NamedTuple

from ninja_game.generator.board import MIDDLE, Board, Cell, mirrored, steps_from
from ninja_game.generator.scene import Scene, spec

CHOICES = 24
"""Routes of which the best is taken."""
CLOSE = 6.0
"""Cells that are at least between any two of ninja, switches and exit."""


class Niche(NamedTuple):
    """A place for the exit behind locked doors: the exit's cell, cells with a door, the side of these."""

    exit: Cell
    doors: tuple[Cell, ...]
    side: str


def place_route(
    board: Board, tiles: dict[Cell, str], niche: Niche | None, rng: Random, *, far: float
) -> Scene | None:  # fmt: skip
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

"""What helps or hinders without harm: bounce blocks, launch pads, one-way platforms; at most one sort a level."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from ninja_game.generator.hazards import mirror_image
from ninja_game.generator.scene import Scene, spec

MOST = 12


def blocks(scene: Scene, rng: Random) -> Iterator[str]:
    """Bounce blocks in staggered rows, in open air."""
    apart, first = rng.choice((3, 4)), rng.randint(4, 7)
    for number, row in enumerate(range(first, 20, apart)):
        for column in range(16 - (number % 2) * 2, 1, -4):
            if all((column + i, row + j) in scene.empty for i in (-1, 0, 1) for j in (-1, 0, 1)):
                yield f"bounce block {column},{row}"


def pads(scene: Scene, rng: Random) -> Iterator[str]:
    """Launch pads on floors."""
    runs = [run for run in scene.runs() if run.length >= 3 and run.column < 16]
    rng.shuffle(runs)
    for run in runs[:2]:
        yield f"launch pad {run.column + rng.randint(0, run.length - 1)},{run.row} up"


def one_ways(scene: Scene, _: Random) -> Iterator[str]:
    """One-way platforms over gaps between tiles."""
    for row in range(4, 22):
        for column in range(2, 17):
            wide = 0
            while (column + wide, row) in scene.empty and column + wide < 30:
                wide += 1
            ends = (column - 1, row) in scene.tiles and (column + wide, row) in scene.tiles
            cells = [(column + k, row) for k in range(wide)]
            open_ = all((c, row + k) in scene.empty for c, _ in cells for k in (-2, -1, 1, 2))
            if ends and 2 <= wide <= 5 and open_:
                yield from (f"one-way {c},{row} up" for c, _ in cells)


def place_fixtures(scene: Scene, rng: Random) -> None:
    """Perhaps put one sort of fixtures into a scene, mirrored."""
    kind = rng.choice((blocks, pads, pads, one_ways, one_ways, None))
    for line in kind(scene, rng) if kind else ():
        first = spec(line)
        for record in dict.fromkeys((first, mirror_image(first))):
            point = (record.values[0], record.values[1])
            if len(scene.fixtures) < MOST and scene.clear_of(point, key=40.0, other=12.0):
                scene.fixtures.append(record)

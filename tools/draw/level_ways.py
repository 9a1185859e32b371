"""Four ways through each level: `python3 tools/dev.py tool draw.level_ways LEVEL… --out FOLDER`.

Red: the certificate to the exit; yellow: the one with all gold; blue and green: runs of the solver, other seeds, that
take some of the gold. A level in which all four are one line has no choice. The table says how many of them differ -
two runs are the same where they share half of the cells that one of them visits - and how long each run is, with the
share of its ticks within 20 px of what kills.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import pygame

from ninja_game.formats.load import load_levels, load_replays
from ninja_game.play.replay.paths import draw_path
from ninja_game.runs.level_design import NEAR, clearance
from ninja_game.runs.trace import RunTrace, trace_level
from ninja_game.search.solve import Task, solve
from ninja_game.sim.level import Level
from ninja_game.sim.rules import CELL, TICKS_PER_SECOND
from ninja_game.ui.canvas import WIDTH, Canvas
from ninja_game.ui.theme import PALETTES
from ninja_game.view.sprites.thumbnail import thumbnail
from tools.draw.contact_sheet import MARGIN, grid
from tools.measure.level_figures import shared_share

COLOURS = ("#dc2828", "#ebb400", "#2860dc", "#2ca02c")
GOLD_SHARES = (0.3, 0.6)
"""Of the gold, in the runs with other seeds."""
WORK = 1_500_000
"""Ticks of the solver for each."""
SAME = 0.5


def ways(level: Level, folder: Path, stem: str) -> list[RunTrace]:
    """The certificates of a level, and a run for each of ``GOLD_SHARES`` that is found."""
    files = (folder / f"{stem}.{kind}.replay.txt" for kind in ("exit", "gold"))
    inputs = [load_replays(file, level=level)[0].inputs for file in files if file.exists()]
    for seed, share in enumerate(GOLD_SHARES, start=2):
        run = solve(Task(level, gold=int(share * level.gold), work=WORK, seed=seed, first_only=True))
        inputs += [run.inputs] if run else []
    return [trace_level(level, each) for each in inputs]


def differing(runs: list[RunTrace]) -> int:
    """How many of some runs are no other's line."""
    seen: list[frozenset[int]] = []
    for run in runs:
        cells = frozenset(
            int(x // CELL) * 100 + int(y // CELL) for x, y in zip(run.ninja["x"], run.ninja["y"], strict=True)
        )
        if all(shared_share(cells, other) < SAME for other in seen):
            seen.append(cells)
    return len(seen)


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("levels", nargs="+", type=Path)
    parser.add_argument("--out", type=Path, required=True, help="folder of pictures, twelve levels in each")
    args = parser.parse_args(argv)
    pygame.font.init()
    pictures: list[tuple[str, pygame.Surface]] = []
    for path in args.levels:
        level = load_levels(path)[0].level
        runs = ways(level, path.parent / "certificates", path.stem)
        picture = thumbnail(level, PALETTES["classic"], WIDTH)
        canvas = Canvas(picture.get_size())
        for run, colour in zip(runs, COLOURS, strict=False):
            draw_path(picture, canvas, np.column_stack([run.ninja["x"], run.ninja["y"]]), pygame.Color(colour))
        near = (
            f"{len(run.ninja) / TICKS_PER_SECOND:.1f} s {100 * np.mean(clearance(run) < NEAR):.0f} %" for run in runs
        )
        print(f"{path.stem:30} {differing(runs)} of {len(runs)} differ; {', '.join(near)}", flush=True)
        pictures.append((f"{path.stem[:4]}: {differing(runs)} ways", picture))
    args.out.mkdir(parents=True, exist_ok=True)
    for first in range(0, len(pictures), 12):
        sheet = grid(pictures[first : first + 12], 3 * (WIDTH + MARGIN) + MARGIN, PALETTES["dark"], 3)
        pygame.image.save(sheet, args.out / f"ways-{first // 12}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Levels with the routes of their certificates: `python3 tools/dev.py tool draw.level_sheet LEVEL… --out FILE`.

Red: the run to the exit; yellow: the run with all gold, where the certificates lie beside the levels. Look at the
picture with the list of questions in levels/README.md.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.errors import NinjaGameError
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.named_level import NamedLevel
from ninja_game.play.replay.paths import draw_path
from ninja_game.runs.run import run_level
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.ui.canvas import WIDTH, Canvas
from ninja_game.ui.theme import PALETTES, Theme
from ninja_game.view.sprites.thumbnail import thumbnail

COLUMNS = 2
MARGIN = 24
ROUTES = {"exit": pygame.Color(220, 40, 40), "gold": pygame.Color(235, 180, 0)}


def route(named: NamedLevel, certificate: Path) -> NDArray[np.float64]:
    """The ninja's positions in a certificate, (ticks, 2), px; none if there is none or if it is of another level."""
    try:
        recording = load_replays(certificate, level=named.level)[0]
        return run_level(named.level, recording.inputs).positions
    except (NinjaGameError, OSError):
        return np.zeros((0, 2))


def draw_level(named: NamedLevel, certificates: Path | None) -> tuple[pygame.Surface, str]:
    """A level with its routes, and what they take as words."""
    picture = thumbnail(named.level, PALETTES["classic"], WIDTH)
    canvas = Canvas(picture.get_size())
    words = []
    for name, colour in ROUTES.items():
        if not certificates:
            break
        positions = route(named, certificates / f"{Path(named.file).stem}.{name}.replay.txt")
        draw_path(picture, canvas, positions, colour)
        if len(positions):
            words.append(f"{name} {len(positions) / TICKS_PER_SECOND:.1f} s")
    return picture, ", ".join(words) if words or not certificates else "no certificates"


def grid(pictures: list[tuple[str, pygame.Surface]]) -> pygame.Surface:
    """Labelled pictures side by side, WIDTH px wide."""
    palette = PALETTES["dark"]
    theme = Theme(palette, Canvas((1188, 900)))
    h = WIDTH * 25 // 33
    rows = -(-len(pictures) // COLUMNS)
    sheet = pygame.Surface((COLUMNS * (WIDTH + MARGIN) + MARGIN, rows * (h + 44) + MARGIN))
    sheet.fill(palette.background)
    for k, (label, picture) in enumerate(pictures):
        x, y = MARGIN + k % COLUMNS * (WIDTH + MARGIN), MARGIN + k // COLUMNS * (h + 44)
        sheet.blit(pygame.transform.smoothscale(picture, (WIDTH, h)), (x, y))
        sheet.blit(theme.lettering.rendered(label, 9, palette.faint), (x, y + h + 4), (0, 0, WIDTH, 44))
    return sheet


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("levels", nargs="+", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--without-routes", action="store_true")
    parser.add_argument("--unnamed", action="store_true", help="numbers instead of names, for blind comparisons")
    args = parser.parse_args(argv)
    folder = None if args.without_routes else args.levels[0].parent / "certificates"
    pictures: list[tuple[str, pygame.Surface]] = []
    for level in (level for path in args.levels for level in load_levels(path)):
        drawn, words = draw_level(level, folder)
        named = f"{Path(level.file).stem[:4]} {level.name}: {words}"
        pictures.append((str(len(pictures) + 1) if args.unnamed else named, drawn))
    pygame.font.init()
    pygame.image.save(grid(pictures), args.out)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

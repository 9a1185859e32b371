"""Draw the pictures of docs/how-it-works.md from the rules and from the lab's figures: `python3 tools/dev.py docs`."""

from __future__ import annotations

import os

os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

from ninja_game.play.lab.screen import export_figure
from ninja_game.play.view.sprites.tile_sheet import outline
from tools import ROOT
from tools.draw.legend import picture as draw_legend
from tools.draw.svg import BLUE, FAINT, INK, SOLID, Picture, Point

PICTURES = ROOT / "docs" / "pictures"
CLASSES = ("45°", "concave", "convex", "22° thin", "22° thick", "67° thin", "67° thick", "half")

FIGURES = ("cells.png", "edges.png", "nine-cells.png", "rays.png", "drones.png", "pairs.gif", "tick.gif")
"""Figures of the lab, and films of them."""


def draw_tile(picture: Picture, tile: int, centre: Point, zoom: float) -> None:
    corners = [(centre[0] + x * zoom, centre[1] + y * zoom) for x, y in outline(tile)]
    if corners:
        picture.polygon(corners, SOLID)


def draw_shapes() -> Picture:
    """All 34 shapes with their ids: a row for each orientation k."""
    picture = Picture(760, 340)
    picture.text("k", (20, 28), 12)
    for column, name in enumerate(CLASSES):
        picture.text(name, (90 + 84 * column, 28), 12)
        for k in range(4):
            centre = (90.0 + 84 * column, 76.0 + 72 * k)
            picture.box(centre[0] - 24, centre[1] - 24, 48, 48, "#ffffff", FAINT)
            draw_tile(picture, 2 + 4 * column + k, centre, 2)
            picture.text(str(2 + 4 * column + k), (centre[0] + 34, centre[1] + 5), 11, BLUE)
    for k in range(4):
        picture.text(str(k), (20, 80 + 72 * k), 12)
    return picture


TICK = (
    ("world.py", "step: the whole tick", ""),
    ("objects/dispatch.py", "1. update_objects: newest first", "objects/*.py"),
    ("objects/dispatch.py", "2. think: one object every fourth tick", "objects/*.py → collision/rays.py"),
    ("ninja/tick.py", "3. integrate, look up the cell", "grid.py"),
    ("objects/dispatch.py", "4. touch_objects: nine cells", "objects/*.py → ninja/contact_response.py, death.py"),
    ("collision/circle.py", "5. collide_circle: at most four cells", "circle_own_tile.py, circle_neighbours.py"),
    ("ninja/tick.py", "6. evaluate_floor, probe_walls", "collision/rays.py (solid_at)"),
    ("ninja/control.py", "7. think_in_air, think_on_ground", "keys, states, jumps"),
)
"""File, what it does there, and the files that it calls; under ninja_game/sim."""


def draw_tick() -> Picture:
    """The way of one tick through the files."""
    picture = Picture(760, 36 + 44 * len(TICK))
    for number, (file, what, calls) in enumerate(TICK):
        y = 20 + 44 * number
        picture.box(20, y, 190, 30, "#ffffff", SOLID)
        picture.text(file, (115, y + 20), 12, BLUE)
        picture.text(what, (230, y + 20), 12, INK, "start")
        picture.text(calls, (480, y + 20), 11, SOLID, "start")
        if number + 1 < len(TICK):
            picture.arrow((115, y + 31), (115, y + 43), SOLID)
    return picture


VECTORS = {"shapes.svg": draw_shapes, "tick.svg": draw_tick, "tiles.svg": draw_legend}

if __name__ == "__main__":
    PICTURES.mkdir(exist_ok=True)
    for name, draw in VECTORS.items():
        draw().save(PICTURES / name)
    for file in FIGURES:
        export_figure(file.partition(".")[0], PICTURES / f"lab-{file}")
    print(f"drew {len(VECTORS) + len(FIGURES)} pictures into docs/pictures")

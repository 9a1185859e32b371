"""Draw the pictures of docs/how-it-works.md from the rules themselves: `python3 tools/dev.py docs`."""

from __future__ import annotations

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.play.view.sprites.tile_shapes import outline
from ninja_game.sim.collision.rays import ray_tiles
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, COLUMN, EXISTS, ROW
from ninja_game.sim.grid import cell_at
from ninja_game.sim.memory.plain import load_plain
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.objects.dispatch import NINE_CELLS
from ninja_game.sim.rules import OFF, RADIUS, STRIDE
from tools import ROOT
from tools.draw.svg import BLUE, FAINT, GOLD, GREEN, INK, PAPER, RED, SOLID, Picture, Point

PICTURES = ROOT / "docs" / "pictures"
ZOOM = 2.5
CLASSES = ("45°", "concave", "convex", "22° thin", "22° thick", "67° thin", "67° thick", "half")
EDGE_COLOURS = {0: FAINT, 1: GOLD, 2: RED}

MAP = """
...............
...............
.........2.....
......31112....
11....1111112..
"""
"""A corner of a world, by tile: rows from cell (1, 1); what is not drawn is empty. Digits are tile ids."""


def small_world() -> tuple[TileMap, World]:
    """The world of MAP, with a floor under it."""
    rows = MAP.split()
    tiles = [0] * 713
    for row, line in enumerate(rows):
        for column, character in enumerate(line):
            tiles[column * 23 + row] = 0 if character == "." else int(character)
    for column in range(15):
        tiles[column * 23 + len(rows)] = 1
    return load_plain(parse_level_string("".join(chr(48 + tile) for tile in tiles) + "|5^200,60"), box=False)


def at(x: float, y: float) -> Point:
    """Where a point of the world lies in a picture that begins at cell (1, 1)."""
    return ((x - 24) * ZOOM, (y - 24) * ZOOM)


def draw_tile(picture: Picture, tile: int, centre: Point, zoom: float) -> None:
    """One tile."""
    corners = [(centre[0] + x * zoom, centre[1] + y * zoom) for x, y in outline(tile)]
    if corners:
        picture.polygon(corners, SOLID)


def draw_world(picture: Picture, level: TileMap) -> None:
    """Tiles and grid of the cells that the picture shows."""
    width, height = picture.size
    for cell, tile in enumerate(level.tiles):
        x, y = at(CENTRE_X[cell], CENTRE_Y[cell])
        if EXISTS[cell] and 0 < x < width and 0 < y < height:
            draw_tile(picture, tile, (x, y), ZOOM)
    for k in range(int(width / (24 * ZOOM)) + 1):
        picture.line((k * 24 * ZOOM, 0), (k * 24 * ZOOM, height), FAINT)
    for k in range(int(height / (24 * ZOOM)) + 1):
        picture.line((0, k * 24 * ZOOM), (width, k * 24 * ZOOM), FAINT)


def blank() -> tuple[Picture, TileMap, World]:
    """A picture of the small world without anything in it."""
    level, w = small_world()
    picture = Picture(15 * 24 * ZOOM, 6 * 24 * ZOOM)
    draw_world(picture, level)
    return picture, level, w


def shade(picture: Picture, cell: int, colour: str) -> None:
    """Mark a cell."""
    x, y = at(CENTRE_X[cell] - 12, CENTRE_Y[cell] - 12)
    picture.parts.append(
        f'<rect x="{x:g}" y="{y:g}" width="{24 * ZOOM:g}" height="{24 * ZOOM:g}" fill="{colour}" fill-opacity="0.22"/>'
    )


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


def draw_edges() -> Picture:
    """Every cell's own state for each of its four sides, drawn a little inside the cell."""
    picture, _, w = blank()
    inside = 10.2
    for cell in range(len(EXISTS)):
        x, y = CENTRE_X[cell], CENTRE_Y[cell]
        if not EXISTS[cell] or not 1 <= COLUMN[cell] <= 15 or not 1 <= ROW[cell] <= 6:
            continue
        for side in range(4):
            state = w.edges[4 * cell + side]
            if state == OFF:
                continue
            out = ((1, 0), (0, 1), (-1, 0), (0, -1))[side]
            along = (abs(out[1]) * 8.0, abs(out[0]) * 8.0)
            middle = (x + out[0] * inside, y + out[1] * inside)
            start, end = at(middle[0] - along[0], middle[1] - along[1]), at(middle[0] + along[0], middle[1] + along[1])
            picture.line(start, end, EDGE_COLOURS[state], 3)
    return picture


def draw_touched() -> Picture:
    """The four cells that a circle touches: own, vertical, horizontal, diagonal."""
    picture, _, _ = blank()
    x, y = 163.0, 88.5
    cell = cell_at(x, y)
    vertical = STRIDE if y > CENTRE_Y[cell] else -STRIDE
    horizontal = 1 if x > CENTRE_X[cell] else -1
    names = {0: "own", vertical: "vertical", horizontal: "horizontal", vertical + horizontal: "diagonal"}
    for number, (step, name) in enumerate(names.items(), 1):
        shade(picture, cell + step, (GREEN, BLUE, GOLD, RED)[number - 1])
        place = at(CENTRE_X[cell + step], CENTRE_Y[cell + step] - 7.5)
        picture.text(f"{number} {name}", place, 11)
    picture.circle(at(x, y), RADIUS * ZOOM, "none", INK, 2)
    picture.circle(at(x, y), 2.5, INK)
    return picture


def draw_nine() -> Picture:
    """The nine cells that the ninja asks for things, in their order."""
    picture, _, _ = blank()
    x, y = 235.0, 62.0
    centre = cell_at(x, y)
    for number, step in enumerate(NINE_CELLS, 1):
        shade(picture, centre + step, BLUE if step else GREEN)
        picture.text(str(number), at(CENTRE_X[centre + step] - 8, CENTRE_Y[centre + step] - 4), 13, BLUE)
    picture.circle(at(x, y), RADIUS * ZOOM, "none", INK, 2)
    for gold in ((212, 40), (250, 91), (259, 60), (300, 60)):
        picture.box(at(*gold)[0] - 7, at(*gold)[1] - 7, 14, 14, GOLD, INK)
    return picture


def draw_ray() -> Picture:
    """A ray steps from cell to cell; only what it crosses is asked, and only interesting edges cost a shape test."""
    picture, level, w = blank()
    start, through = (40.0, 40.0), (140.0, 82.0)
    _, end_x, end_y = ray_tiles(level, w, *start, *through)
    steps = 400
    seen: list[int] = []
    for k in range(steps + 1):
        cell = cell_at(start[0] + (end_x - start[0]) * k / steps, start[1] + (end_y - start[1]) * k / steps)
        if cell not in seen:
            seen.append(cell)
            shade(picture, cell, GREEN)
            picture.text(str(len(seen)), at(CENTRE_X[cell] - 8, CENTRE_Y[cell] + 10), 11, GREEN)
    picture.arrow(at(*start), at(end_x, end_y), RED, 2)
    picture.circle(at(*start), 4, RED, RED)
    picture.circle(at(end_x, end_y), 5, PAPER, RED, 2)
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


DRAWINGS = {
    "shapes": draw_shapes,
    "edges": draw_edges,
    "touched-cells": draw_touched,
    "nine-cells": draw_nine,
    "ray": draw_ray,
    "tick": draw_tick,
}

if __name__ == "__main__":
    PICTURES.mkdir(exist_ok=True)
    for name, draw in DRAWINGS.items():
        draw().save(PICTURES / f"{name}.svg")
    print(f"drew {len(DRAWINGS)} pictures into docs/pictures")

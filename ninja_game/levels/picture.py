"""A level as text in the terminal: 62 x 23 characters, tiles as quarter blocks, objects as signs of the legend."""

from __future__ import annotations

from itertools import groupby
from operator import itemgetter

from rich.text import Text

from ninja_game.formats.ascii.legend import SYMBOL_OF_CHAR, symbol_chars
from ninja_game.formats.ascii.writer import RULER
from ninja_game.sim import kinds
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.level import COLUMNS, ROWS, Level
from ninja_game.sim.loader import tile_map
from ninja_game.sim.rules import CELL, HALF
from ninja_game.sim.schema.world_fields import TileMap

SIGN_COLOURS = dict.fromkeys((kind.number for kind in kinds.KINDS if kind.killer), "bright_red") | {
    kinds.GOLD: "bright_yellow",
    kinds.BOUNCE_BLOCK: "cyan",
    kinds.LAUNCH_PAD: "bright_cyan",
    kinds.FLOOR_GUARD: "bright_magenta",
    kinds.NINJA: "bold bright_green",
    kinds.DRONE: "bright_magenta",
    kinds.ONE_WAY: "cyan",
    kinds.THWUMP: "bright_magenta",
    kinds.DOOR: "bright_blue",
    kinds.EXIT: "bold bright_green",
}
"""Terminal colours: red and magenta kill, cyan moves the ninja, green is start and goal."""

# Index: 1 upper left + 2 upper right + 4 lower left + 8 lower right.
_QUARTERS = " ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█"


def level_picture(level: Level) -> Text:
    """Draw the level, two characters per cell, with a border line and numbers of columns and rows."""
    tiles = tile_map(level)
    columns, rows = 2 * COLUMNS, ROWS
    signs = [[(_block(tiles, column, row), "grey62") for column in range(columns)] for row in range(rows)]
    for spec in level.objects:
        for char, px, py in symbol_chars(spec):
            # An object on a side of its cell is drawn in that cell.
            x, y = px - SYMBOL_OF_CHAR[char].dx, py - SYMBOL_OF_CHAR[char].dy
            # A character is half a cell wide; the cell's centre belongs to the left one.
            if CELL <= x <= CELL * (COLUMNS + 1) and CELL <= y <= CELL * (ROWS + 1):
                column = min(max(round((x - CELL) / HALF) - 1, 0), columns - 1)
                row = min(int((y - CELL) / CELL), rows - 1)
                signs[row][column] = (char, SIGN_COLOURS[spec.kind])
    text = Text(no_wrap=True)
    for digits in RULER.replace(";", "").splitlines():
        text.append("    " + " ".join(digits[4:]).rstrip() + "\n", "dim")
    text.append("   ▗" + "▄" * columns + "▖\n", "grey62")
    for number, line in enumerate(signs, 1):
        text.append(f"{number:2d} ", "dim")
        text.append("▐", "grey62")
        for style, run in groupby(line, key=itemgetter(1)):
            text.append("".join(char for char, _ in run), style)
        text.append("▌\n", "grey62")
    text.append("   ▝" + "▀" * columns + "▘", "grey62")
    return text


def _block(tiles: TileMap, column: int, row: int) -> str:
    x, y = CELL + HALF * column, CELL + CELL * row
    quarters = ((3.0, 6.0), (9.0, 6.0), (3.0, 18.0), (9.0, 18.0))
    return _QUARTERS[sum(1 << k for k, (dx, dy) in enumerate(quarters) if solid_at(tiles, x + dx, y + dy))]

"""Draw docs/pictures/tiles.svg: the 34 tile shapes, each over its character. Run it after a change of the legend."""

from __future__ import annotations

from ninja_game.formats.ascii.legend import TILE_CHARS, TILE_FAMILIES, TILE_OF_CHAR
from ninja_game.play.view.sprites.tile_sheet import outline
from tools import ROOT
from tools.draw.svg import FAINT, SOLID, Picture

PICTURE = ROOT / "docs" / "pictures" / "tiles.svg"
SIZE, STEP_X, STEP_Y, LEFT, TOP = 36, 64, 66, 190, 14


def draw_cell(picture: Picture, tile: int, left: float, top: float) -> None:
    """A tile in its frame with its character below."""
    half, zoom = SIZE / 2, SIZE / 24
    if corners := [(left + half + x * zoom, top + half + y * zoom) for x, y in outline(tile)]:
        picture.polygon(corners, SOLID)
    picture.box(left, top, SIZE, SIZE, "none", FAINT)
    picture.text(TILE_CHARS[tile], (left + half, top + SIZE + 18), 16, font="monospace")


def picture() -> Picture:
    """All tiles, a family a row."""
    rows = [("empty, full", ".#"), ("half tiles", '_"[]'), *TILE_FAMILIES]
    drawn = Picture(LEFT + 4 * STEP_X + 10, TOP + len(rows) * STEP_Y + 6)
    for row, (name, characters) in enumerate(rows):
        drawn.text(name, (12, TOP + row * STEP_Y + 22), 14, anchor="start")
        for column, character in enumerate(characters):
            draw_cell(drawn, TILE_OF_CHAR[character], LEFT + column * STEP_X, TOP + row * STEP_Y)
    return drawn

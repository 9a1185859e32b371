"""Draw docs/pictures/tiles.svg: the 34 tile shapes, each over its character. Run it after a change of the legend."""

from __future__ import annotations

import sys
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from ninja_game.formats.ascii.legend import TILE_CHARS, TILE_FAMILIES, TILE_OF_CHAR
from ninja_game.sim.collision.tiles import (
    CONCAVE,
    CONVEX,
    FULL,
    HALF_TILE,
    SHAPE,
    SIGN_X,
    SIGN_Y,
    SLOPE_45,
    THICK_22,
    THICK_67,
    THIN_22,
    THIN_67,
)

PICTURE = ROOT / "docs" / "pictures" / "tiles.svg"
SIZE, STEP_X, STEP_Y, LEFT, TOP = 36, 64, 66, 190, 14

# The solid part for a solid corner bottom left, in half-widths from the middle, y downwards.
OUTLINES = {
    SLOPE_45: "M-1,-1 L1,1 L-1,1 Z",
    THIN_22: "M-1,0 L1,1 L-1,1 Z",
    THICK_22: "M-1,-1 L1,0 L1,1 L-1,1 Z",
    THIN_67: "M-1,-1 L0,1 L-1,1 Z",
    THICK_67: "M-1,-1 L0,-1 L1,1 L-1,1 Z",
    CONCAVE: "M-1,-1 A2,2 0 0 0 1,1 L-1,1 Z",
    CONVEX: "M-1,-1 A2,2 0 0 1 1,1 L-1,1 Z",
    FULL: "M-1,-1 L1,-1 L1,1 L-1,1 Z",
}
HALVES = {
    (0, -1): "M-1,0 h2 v1 h-2 Z",
    (-1, 0): "M0,-1 h1 v2 h-1 Z",
    (0, 1): "M-1,-1 h2 v1 h-2 Z",
    (1, 0): "M-1,-1 h1 v2 h-1 Z",
}


def shape_path(tile: int) -> str:
    """SVG path of a tile's solid part, mirrored to its corner; '' for the empty tile."""
    sign_x, sign_y = int(SIGN_X[tile]), int(SIGN_Y[tile])
    if SHAPE[tile] == HALF_TILE:
        return f'<path d="{HALVES[sign_x, sign_y]}"/>'
    outline = OUTLINES.get(SHAPE[tile], "")
    return f'<path transform="scale({sign_x or 1},{-sign_y or 1})" d="{outline}"/>' if outline else ""


def cell(tile: int, column: int, row: int) -> str:
    """A tile in its frame with its character below."""
    x, y = LEFT + column * STEP_X + SIZE // 2, TOP + row * STEP_Y + SIZE // 2
    half = SIZE // 2
    return (
        f'<g transform="translate({x},{y})"><g transform="scale({half})" fill="#797988">{shape_path(tile)}</g>'
        f'<rect x="-{half}" y="-{half}" width="{SIZE}" height="{SIZE}" class="frame"/>'
        f'<text y="{half + 18}">{escape(TILE_CHARS[tile])}</text></g>'
    )


def picture() -> str:
    """The whole picture as SVG."""
    rows = [("empty, full", ".#"), ("half tiles", '_"[]')]
    rows += [(f"{name}", chars) for name, chars in TILE_FAMILIES]
    width, height = LEFT + 4 * STEP_X + 10, TOP + len(rows) * STEP_Y + 6
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
        (
            "<style>text{font:16px monospace;text-anchor:middle;fill:#222}.name{text-anchor:start;font:14px sans-serif}"
            ".frame{fill:none;stroke:#999;stroke-width:1}</style>"
        ),
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
    ]
    for row, (name, chars) in enumerate(rows):
        lines.append(f'<text class="name" x="12" y="{TOP + row * STEP_Y + 22}">{escape(name)}</text>')
        lines += [cell(TILE_OF_CHAR[char], column, row) for column, char in enumerate(chars)]
    return "\n".join([*lines, "</svg>"]) + "\n"


if __name__ == "__main__":
    PICTURE.parent.mkdir(exist_ok=True)
    PICTURE.write_text(picture(), encoding="utf-8")
    print(PICTURE.relative_to(ROOT))

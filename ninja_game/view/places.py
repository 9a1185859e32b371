"""The place of a panel over a level that hides least."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from math import ceil, hypot

from ninja_game.sim.collision.tiles import FULL, SHAPE
from ninja_game.sim.grid import Point
from ninja_game.sim.kinds import EXIT, GOLD, SWITCH
from ninja_game.sim.level import ROWS
from ninja_game.sim.rules import CELL
from ninja_game.sim.schema.world_fields import World
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.theme import Area

_BESIDE = 36.0  # px from a place to the panel of its message: far enough not to fade while the ninja is there
_AWAY = 4 * CELL  # px across and down from a place to the farthest such panel, less at a corner
_MAX_BOTTOM = 573.0  # lowest end of a panel: below are the level's name and the texts after a pass, px
_NEAR = 16.0  # px between a panel and the middle of a thing
_ALONG = 7  # open cells that cost as much as an open cell beside a solid one

Things = tuple[tuple[float, float, int], ...]
"""Places of things, px, and the cost of covering them: ``MUST``, or ``MAY`` for gold and the author's route."""

MUST, MAY = 1000, 30

TAG_ROOM = 72.0  # below this line, px, there is room for a thing's name above it


def tag_top(y: float) -> float:
    """Upper edge of the name of a thing at ``y``, px: above it, or below it at the upper edge."""
    return y - 39 if y > TAG_ROOM else y + 23


def things_in(world: World, *, tagged: bool) -> Things:
    """The ninja and the other objects of a world; ``tagged``: with the names beside switches and exits."""
    objects = world.objects[1:]
    places = [(o.x, o.y, MAY if o.kind == GOLD else MUST) for o in objects]
    names = [o for o in objects if tagged and o.kind in {SWITCH, EXIT}]
    return (
        (world.ninja.x, world.ninja.y, MUST),
        *places,
        *((o.x + dx, tag_top(o.y) + 8, MUST) for o in names for dx in (-12, 12)),
    )


def away_from(point: Point, x: float, y: float, w: float, h: float) -> float:
    """Distance between a point and a panel, px."""
    return hypot(max(x - point[0], 0.0, point[0] - x - w), max(y - point[1], 0.0, point[1] - y - h))


def points_in(area: Area, cost: int) -> Things:
    """Things all over an area, px, so close that a panel over a part of it hides one."""
    x, y, w, h = area
    columns, rows = ceil(w / CELL), ceil(h / CELL)
    middles = ((x + w * (k + 0.5) / columns, y + h * (j + 0.5) / rows) for k in range(columns) for j in range(rows))
    return tuple((*middle, cost) for middle in middles)


def hidden_by(things: Things, x: float, y: float, w: float, h: float) -> Iterator[int]:
    """The costs of all things that a panel would hide."""
    return (cost for a, b, cost in things if -_NEAR < a - x < w + _NEAR and -_NEAR < b - y < h + _NEAR)


def _around(at: float, size: float, away: float, first: float, last: float) -> list[float]:
    """Left or upper edges for a panel near a coordinate, within an area."""
    step = (away + size / 2) / 6
    return [min(max(first, at + k * step - size / 2), last - size) for k in range(-6, 7)]


@lru_cache(maxsize=4)
def solid_place(
    tiles: tuple[int, ...],
    w: float,
    h: float,
    things: Things = (),
    near: Point | None = None,
    *,
    rows: int = 0,
    beside: Point | None = None,
    reach: int = 1,
) -> tuple[float, float, int, int]:
    """Upper left corner of a panel of that size, px, then the whole cost, and the part of it for hidden things.

    Solid cells cost nothing, open cells beside solid ones most. Of equal places the one nearest to ``near`` is taken,
    or to the middle of the upper border. ``rows``: only at the left, in the middle and at the right of that many
    heights, from the upper border to the lower one; ``beside``: only around that place, _BESIDE to ``reach`` times
    _AWAY px from it.
    """
    (open_cells, ways), away = _ways(tiles), reach * _AWAY

    def cost(place: tuple[float, float]) -> tuple[int, float, int]:
        x, y = place
        columns, heights = (slice(int(a // CELL) - 1, int((a + b - 1) // CELL)) for a, b in ((x, w), (y, h)))
        area = (1 << heights.stop) - (1 << heights.start)
        covered = sum((cells & area).bit_count() for cells in open_cells[columns])
        covered += (_ALONG - 1) * sum((cells & area).bit_count() for cells in ways[columns])
        hidden = sum(hidden_by(things, x, y, w, h))
        far = hypot(x + w / 2 - near[0], y + h / 2 - near[1]) if near else 0.0
        # Rounded: otherwise the last bit of a width would choose between left and right.
        return covered + hidden, round(far or abs(x + w / 2 - WIDTH / 2) + y, 3), hidden

    edge = CELL + 4
    lefts = [edge + k * (WIDTH - 2 * edge - w) / 8 for k in range(0, 9, 4 if rows else 1)]
    apart = (_MAX_BOTTOM - h - edge) / max(1, rows - 1) if rows else 6
    tops = [edge + k * apart for k in range(rows or int((_MAX_BOTTOM - h - edge) / 6))]
    if beside:
        things = tuple(thing for thing in things if away_from(thing[:2], *beside, 0, 0) < hypot(w, h) + 2 * away)
        lefts = _around(beside[0], w, away, edge, WIDTH - edge)
        tops = _around(beside[1], h, away, edge, _MAX_BOTTOM)
    places = [(x, y) for x in lefts for y in tops]
    clear = [place for place in places if beside and _BESIDE - 1 <= away_from(beside, *place, w, h) < away + 4]
    x, y = min(clear or places, key=cost)
    covered, _, hidden = cost((x, y))
    return x, y, covered, hidden


@lru_cache(maxsize=4)
def _ways(tiles: tuple[int, ...]) -> tuple[list[int], list[int]]:
    """Bit masks, a number per column, a bit per row: the open cells, and those of them beside solid ones."""
    all_rows = (1 << ROWS) - 1
    full = [
        sum(1 << row for row in range(ROWS) if SHAPE[tiles[first + row]] == FULL)
        for first in range(0, len(tiles), ROWS)
    ]
    along = [all_rows, *(a | b | c for a, b, c in zip(full, full[1:], full[2:], strict=False)), all_rows]
    edges = 1 | 1 << ROWS - 1
    return [~solid & all_rows for solid in full], [
        (near | near << 1 | near >> 1 | edges) & ~solid & all_rows for near, solid in zip(along, full, strict=True)
    ]

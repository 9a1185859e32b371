"""The columns of the roll, and where things are in the window."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import NamedTuple

import pygame

from ninja_game.play.ui.canvas import Canvas
from ninja_game.play.ui.theme import Area
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT

HEAD, ROW, BAR = 16.0, 11.0, 12.0
"""Height of the heads and of a row, width of the scroll bar, logical px."""


class Column(NamedTuple):
    """``width``: logical px; 0: what is left. ``decimals``: of a number. ``key``: that it shows.

    Those with a ``meaning`` may be hidden.
    """

    name: str
    head: str
    width: float
    decimals: int = 0
    key: int = 0
    meaning: str = ""


COLUMNS = (
    Column("tick", "tick", 28),
    Column("left", "L", 13, key=KEY_LEFT),
    Column("right", "R", 13, key=KEY_RIGHT),
    Column("jump", "J", 13, key=JUMP_HELD),
    Column("x", "x", 32, 2, meaning="x, px"),
    Column("y", "y", 32, 2, meaning="y, px"),
    Column("vx", "vx", 30, 3, meaning="Speed to the right, px a tick"),
    Column("vy", "vy", 30, 3, meaning="Speed downwards, px a tick"),
    Column("state", "state", 24, meaning="State"),
    Column("jump_timer", "jt", 13, meaning="Jump timer, ticks"),
    Column("contacts", "|_|", 14, meaning="Floor and walls"),
    Column("gold", "gold", 18, meaning="Gold taken"),
    Column("exit", "exit", 27, 1, meaning="Px to the exit's disc"),
    Column("events", "events", 0, meaning="Events and markers"),
)
"""From left to right."""


class Place(NamedTuple):
    """A column in the window: its first px, and how many it has."""

    column: Column
    left: int
    width: int


@dataclass(frozen=True)
class RollLayout:
    """Where things are, px of the window. ``rows``: how many are seen; ``row``: the height of one."""

    heads: pygame.Rect
    body: pygame.Rect
    bar: pygame.Rect
    row: int
    rows: int
    places: tuple[Place, ...]

    def row_at(self, y: int) -> int:
        """The number of the row at a px, from the first that is seen: negative above it."""
        return (y - self.body.top) // self.row

    def column_at(self, x: int) -> Column:
        """The column at a px; beside them the nearest one."""
        return next((place.column for place in self.places if x < place.left + place.width), self.places[-1].column)


def layout_of(canvas: Canvas, area: Area, hidden: Collection[str]) -> RollLayout:
    """Heads, rows and scroll bar in an area, logical px. All rows have the same height, whole px."""
    whole = canvas.rect(*area)
    head, row, bar = canvas.px(HEAD), max(6, int(ROW * canvas.scale)), canvas.px(BAR)
    rows = max(1, (whole.height - head) // row)
    body = pygame.Rect(whole.left, whole.top + head, whole.width - bar, rows * row)
    shown = [column for column in COLUMNS if column.name not in hidden]
    free = area[2] - BAR - sum(column.width for column in shown)
    places, x = [], 0.0
    for column in shown:
        left, x = x, x + (column.width or free)
        first, behind = round(left * canvas.scale), min(round(x * canvas.scale), body.width)
        places.append(Place(column, whole.left + first, behind - first))
    heads = pygame.Rect(whole.left, whole.top, whole.width, head)
    side = pygame.Rect(body.right, body.top, whole.right - body.right, whole.height - head)
    return RollLayout(heads, body, side, row, rows, tuple(places))
